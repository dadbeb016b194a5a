dnl SPDX-FileCopyrightText: The Impinge authors
dnl SPDX-License-Identifier: MIT

# serial 1

# IMPINGE_PLUGIN_INIT([VERSION])
# ------------------------------
# For the configure.ac of a plugin, behind AC_PROG_CC (AC_PROG_CXX) and LT_INIT. Finds the SDK of
# Impinge, of at least VERSION if that is given, by pkg-config. To be used in Makefile.am:
#
#   AM_CPPFLAGS = $(IMPINGE_PLUGIN_CPPFLAGS)
#   AM_CFLAGS = $(IMPINGE_PLUGIN_CFLAGS)             (or AM_CXXFLAGS)
#   AM_LDFLAGS = -module $(IMPINGE_PLUGIN_LDFLAGS)   (automake wants to see the -module)
#   plugin_LTLIBRARIES = wobble.la
#   wobble_la_SOURCES = wobble.c
#   wobble_la_LIBADD = -lm
#
#   plugindir   where `make install` puts plugins, in terms of $(prefix), so that another prefix
#               at make time, and `make distcheck`, move it too
#   IMPINGE     the command `impinge` that belongs to the SDK, for tests
#
# Unless --prefix says otherwise the prefix is that of Impinge, because its plugins are looked for
# there. --with-user-plugins installs for one user, without root, whatever the prefix;
# --with-plugindir=DIR into DIR.
AC_DEFUN([IMPINGE_PLUGIN_INIT], [
AC_REQUIRE([PKG_PROG_PKG_CONFIG])
PKG_CHECK_MODULES([IMPINGE_SDK], [impinge-sdk]m4_ifval([$1], [[ >= $1]]))

IMPINGE_PLUGIN_CPPFLAGS="$IMPINGE_SDK_CFLAGS"
AC_SUBST([IMPINGE_PLUGIN_CPPFLAGS])
IMPINGE_PLUGIN_CFLAGS="-ffp-contract=off -fvisibility=hidden"
AC_SUBST([IMPINGE_PLUGIN_CFLAGS])
IMPINGE_PLUGIN_LDFLAGS="-avoid-version -shared -export-symbols-regex '^impinge_plugin\$\$'"
AC_SUBST([IMPINGE_PLUGIN_LDFLAGS])

impinge_bindir=`$PKG_CONFIG --variable=bindir impinge-sdk`
AC_ARG_VAR([IMPINGE], [the command impinge, for tests of the plugin])
AC_PATH_PROG([IMPINGE], [impinge], [impinge], [$impinge_bindir$PATH_SEPARATOR$PATH])

_IMPINGE_PLUGIN_DIRECTORY
AC_MSG_CHECKING([where plugins go])
AC_MSG_RESULT([$plugindir])
AS_CASE([$prefix:$plugindir],
  [$impinge_prefix:*|*:$impinge_plugindir|*:$pluginuserdir], [],
  [AC_MSG_NOTICE([Impinge looks in $impinge_plugindir and $pluginuserdir;
for another directory say so in IMPINGE_PLUGIN_PATH])])
])

# _IMPINGE_PLUGIN_DIRECTORY
# -------------------------
# Sets plugindir, and prefix where nobody asked for one.
AC_DEFUN([_IMPINGE_PLUGIN_DIRECTORY], [
impinge_prefix=`$PKG_CONFIG --variable=prefix impinge-sdk`
impinge_plugindir=`$PKG_CONFIG --variable=plugindir impinge-sdk`
impinge_abi=`$PKG_CONFIG --variable=abi_major impinge-sdk`

# Below Impinge's prefix: the same place below ours. Elsewhere (Impinge was configured so): that
# very place for Impinge's own prefix, and for any other the usual one.
AS_CASE([$impinge_plugindir],
  [$impinge_prefix/*], [plugindir="\${prefix}/${impinge_plugindir@%:@$impinge_prefix/}"],
  [AS_CASE([$prefix],
    [NONE|$impinge_prefix], [plugindir=$impinge_plugindir],
    [plugindir="\${libdir}/impinge/$impinge_abi"])])
test "x$prefix" != xNONE || prefix=$impinge_prefix

AS_CASE([${XDG_DATA_HOME-}],
  [/*], [impinge_data=$XDG_DATA_HOME],
  [impinge_data=$HOME/.local/share])
pluginuserdir=$impinge_data/impinge/$impinge_abi
AC_SUBST([pluginuserdir])

AC_ARG_WITH([user-plugins],
  [AS_HELP_STRING([--with-user-plugins], [install the plugin for yourself alone, without root])],
  [AS_CASE([$withval], [no], [], [plugindir=$pluginuserdir])])
AC_ARG_WITH([plugindir],
  [AS_HELP_STRING([--with-plugindir=DIR], [install the plugin into DIR])],
  [AS_CASE([$withval],
    [yes|no|''], [AC_MSG_ERROR([--with-plugindir wants a directory])],
    [plugindir=$withval])])
AC_SUBST([plugindir])
])

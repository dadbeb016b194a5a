# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# One line per plugin: plugins/NAME.la is built from plugins/NAME.c and headers.

plugin_LTLIBRARIES = \
    plugins/bezier.la \
    plugins/cone.la \
    plugins/cylinder.la \
    plugins/ellipsoid.la \
    plugins/nurbs.la \
    plugins/plane.la \
    plugins/point.la \
    plugins/product.la \
    plugins/revolution.la \
    plugins/ripple.la \
    plugins/rotate.la \
    plugins/segment.la \
    plugins/sphere.la \
    plugins/spike.la \
    plugins/superellipsoid.la \
    plugins/supertoroid.la \
    plugins/sweep.la \
    plugins/torus.la \
    plugins/translate.la \
    plugins/triangle.la

# What they share; private, never installed.
noinst_HEADERS += \
    plugins/bernstein.h \
    plugins/chebyshev.h \
    plugins/couple.h \
    plugins/curve.h \
    plugins/knots.h \
    plugins/linear.h \
    plugins/near.h \
    plugins/nurbs_cells.h \
    plugins/patch.h \
    plugins/patch_include.h \
    plugins/patch_rate.h \
    plugins/patch_series.h \
    plugins/pieces.h \
    plugins/plugin.h \
    plugins/polynomial.h \
    plugins/superquadric.h

plugin_ldflags = -avoid-version -shared -export-symbols-regex '^impinge_plugin$$'

# They link with libm and nothing else, whatever configure found for the host.
$(plugin_LTLIBRARIES): LIBS = -lm

# Hosts load the .so itself; a .la beside it would only mislead.
.PHONY: install-plugins-without-la uninstall-plugins
install-plugins-without-la:
	for plugin in $(plugin_LTLIBRARIES); do \
	  rm -f "$(DESTDIR)$(plugindir)/$${plugin##*/}"; \
	done
uninstall-plugins:
	for plugin in $(plugin_LTLIBRARIES:.la=.so); do \
	  rm -f "$(DESTDIR)$(plugindir)/$${plugin##*/}"; \
	done

# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# One line per plugin: plugins/NAME.la is built from plugins/NAME.c and headers.

plugin_LTLIBRARIES = \
    plugins/bend.la \
    plugins/bezier.la \
    plugins/cone.la \
    plugins/cylinder.la \
    plugins/ellipsoid.la \
    plugins/ffd.la \
    plugins/formula.la \
    plugins/keyframes.la \
    plugins/map-formula.la \
    plugins/nurbs.la \
    plugins/plane.la \
    plugins/point.la \
    plugins/product.la \
    plugins/revolution.la \
    plugins/ripple.la \
    plugins/rotate.la \
    plugins/scale.la \
    plugins/screw.la \
    plugins/segment.la \
    plugins/sphere.la \
    plugins/spike.la \
    plugins/superellipsoid.la \
    plugins/supertoroid.la \
    plugins/sweep.la \
    plugins/taper.la \
    plugins/torus.la \
    plugins/translate.la \
    plugins/triangle.la \
    plugins/twist.la \
    plugins/wave.la

# What they share; private, never installed.
noinst_HEADERS += \
    plugins/axis.h \
    plugins/bernstein.h \
    plugins/chebyshev.h \
    plugins/quad.h \
    plugins/curve.h \
    plugins/expression_type.h \
    plugins/ffd_model.h \
    plugins/knots.h \
    plugins/lattice.h \
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
    plugins/series.h \
    plugins/sinc.h \
    plugins/spline.h \
    plugins/superquadric.h

# The language of formulas, for both types that have texts in it.
noinst_LTLIBRARIES += plugins/libexpression.la
plugins_libexpression_la_SOURCES = \
    plugins/expression.c plugins/expression.h \
    plugins/expression_builder.c plugins/expression_builder.h \
    plugins/expression_functions.h \
    plugins/expression_names.c plugins/expression_names.h \
    plugins/expression_operation.c plugins/expression_operation.h \
    plugins/expression_parser.c plugins/expression_parser.h \
    plugins/expression_rules.c plugins/expression_rules.h \
    plugins/expression_token.c plugins/expression_token.h \
    plugins/expression_zeros.c plugins/expression_zeros.h
plugins_libexpression_la_LDFLAGS =
plugins_formula_la_LIBADD = plugins/libexpression.la
plugins_map_formula_la_LIBADD = plugins/libexpression.la

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

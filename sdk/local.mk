# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

# What plugin authors get: headers, impinge-sdk.pc, impinge.m4, the template that `impinge new`
# fills in, the guide and its examples; and, for other languages, the page of the layout and the
# arithmetic of models as a static library.

pkginclude_HEADERS = \
    sdk/impinge/decimal.h \
    sdk/impinge/formula.h \
    sdk/impinge/formula_text.h \
    sdk/impinge/interval.h \
    sdk/impinge/interval_functions.h \
    sdk/impinge/model.h \
    sdk/impinge/model.hpp \
    sdk/impinge/model_angles.h \
    sdk/impinge/model_arithmetic.h \
    sdk/impinge/model_basics.h \
    sdk/impinge/model_functions.h \
    sdk/impinge/model_link.h \
    sdk/impinge/model_powers.h \
    sdk/impinge/model_series.h \
    sdk/impinge/plugin.h \
    sdk/impinge/quad.h \
    sdk/impinge/surface.h

pkgconfig_DATA += sdk/impinge-sdk.pc

sdkcmakedir = $(libdir)/cmake/ImpingeSDK
sdkcmake_DATA = sdk/cmake/ImpingeSDKConfig.cmake sdk/cmake/ImpingeSDKConfigVersion.cmake

aclocaldir = $(datadir)/aclocal
dist_aclocal_DATA = sdk/impinge.m4

# impinge.m4 a second time: a new project gets a copy, because aclocal does not look below every
# prefix.
templatedir = $(pkgdatadir)/template
dist_template_DATA = \
    sdk/impinge.m4 \
    sdk/template/CMakeLists.txt \
    sdk/template/Makefile.am \
    sdk/template/README \
    sdk/template/check.sh \
    sdk/template/configure.ac \
    sdk/template/github.yml \
    sdk/template/gitlab.yml \
    sdk/template/map.c \
    sdk/template/meson.build \
    sdk/template/meson_options.txt \
    sdk/template/surface.c \
    sdk/template/surface.cc

sdkdocdir = $(docdir)/sdk
dist_sdkdoc_DATA = sdk/README
nodist_sdkdoc_DATA = sdk/guide.html sdk/layout.txt
CLEANFILES += sdk/guide.html sdk/layout.txt
EXTRA_DIST += sdk/guide_html.awk sdk/LAYOUT
sdk/layout.txt: sdk/LAYOUT tests/abi/layout_1.txt
	$(AM_V_GEN)$(MKDIR_P) sdk && cat $(top_srcdir)/sdk/LAYOUT \
	  $(top_srcdir)/tests/abi/layout_1.txt >$@.part && mv $@.part $@
sdk/guide.html: sdk/README sdk/guide_html.awk
	$(AM_V_GEN)$(MKDIR_P) sdk && LC_ALL=C $(AWK) -f $(top_srcdir)/sdk/guide_html.awk \
	  $(top_srcdir)/sdk/README >$@.part && mv $@.part $@

examplesdir = $(sdkdocdir)/examples
dist_examples_DATA = \
    sdk/examples/gear.c \
    sdk/examples/hand_rates.c \
    sdk/examples/gear_pieces.cc \
    sdk/examples/puddle.cc \
    sdk/examples/seashell.c \
    sdk/examples/twirl.c \
    sdk/examples/waves.cc

rustdocdir = $(sdkdocdir)/gear-rs
dist_rustdoc_DATA = sdk/examples/gear-rs/Cargo.toml sdk/examples/gear-rs/build.rs
rustsrcdir = $(rustdocdir)/src
dist_rustsrc_DATA = sdk/examples/gear-rs/src/abi.rs sdk/examples/gear-rs/src/lib.rs

lib_LIBRARIES = sdk/libimpinge-model.a
sdk_libimpinge_model_a_SOURCES = sdk/model_link.c
sdk_libimpinge_model_a_CFLAGS = $(AM_CFLAGS) -fPIC -fvisibility=hidden

# Innermost first.
sdk_folders = $(rustsrcdir) $(rustdocdir) $(sdkcmakedir) $(libdir)/cmake $(templatedir) $(examplesdir) $(sdkdocdir) $(hostexamplesdir) $(docdir)

# The Python module, also installed by pip from here. Installed by make it knows its library.
python_module = \
    sdk/python/impinge/__init__.py \
    sdk/python/impinge/_arguments.py \
    sdk/python/impinge/_assembly.py \
    sdk/python/impinge/_command.py \
    sdk/python/impinge/_crew.py \
    sdk/python/impinge/_document.py \
    sdk/python/impinge/_files.py \
    sdk/python/impinge/_find.py \
    sdk/python/impinge/_handle.py \
    sdk/python/impinge/_library.py \
    sdk/python/impinge/_mesh.py \
    sdk/python/impinge/_parts.py \
    sdk/python/impinge/_query.py \
    sdk/python/impinge/_registry.py \
    sdk/python/impinge/_survey.py \
    sdk/python/impinge/_surveys.py \
    sdk/python/impinge/_values.py \
    sdk/python/impinge/batching.py \
    sdk/python/impinge/builder.py \
    sdk/python/impinge/errors.py \
    sdk/python/impinge/motions.py \
    sdk/python/impinge/pictures.py \
    sdk/python/impinge/py.typed \
    sdk/python/impinge/results.py \
    sdk/python/impinge/scene.py
python_robot = \
    sdk/python/impinge/robot/__init__.py \
    sdk/python/impinge/robot/__main__.py \
    sdk/python/impinge/robot/_check.py \
    sdk/python/impinge/robot/_course.py \
    sdk/python/impinge/robot/_matrix_report.py \
    sdk/python/impinge/robot/_moveit.py \
    sdk/python/impinge/robot/_positions.py \
    sdk/python/impinge/robot/_report.py \
    sdk/python/impinge/robot/_seek.py \
    sdk/python/impinge/robot/_shapes.py \
    sdk/python/impinge/robot/_srdf.py \
    sdk/python/impinge/robot/_urdf.py
EXTRA_DIST += sdk/python/MANIFEST.in sdk/python/pyproject.toml sdk/python/setup.py $(python_module) $(python_robot)
if HAVE_PYTHON
pythonmoduledir = $(pythondir)/impinge
pythonmodule_DATA = $(python_module) sdk/python/_installed.py
pythonrobotdir = $(pythondir)/impinge/robot
pythonrobot_DATA = $(python_robot)
sdk/python/_installed.py: Makefile
	$(AM_V_GEN)$(MKDIR_P) sdk/python && echo 'LIBRARY = "$(libdir)/libimpinge.so.0"' >$@
CLEANFILES += sdk/python/_installed.py
uninstall_python = uninstall-pycache
sdk_folders += $(pythonrobotdir) $(pythonmoduledir)
uninstall-pycache:
	rm -rf "$(DESTDIR)$(pythonmoduledir)/__pycache__" "$(DESTDIR)$(pythonrobotdir)/__pycache__"
endif

# Packages for pip, in the folder python-packages: a wheel with library, plugins and command inside, and
# the sources of all of it, which pip builds.
build_package = (cd python-packages/$@ && IMPINGE_BUILD='$(IMPINGE_BUILD)' $(PYTHON3) -c \
    'import setuptools.build_meta as b; print(b.build_$@("$(abs_top_builddir)/python-packages"))')
copy_python = rm -rf python-packages/$@ && $(MKDIR_P) python-packages && \
    cp -R $(srcdir)/sdk/python python-packages/$@ && chmod -R u+w python-packages/$@
.PHONY: wheel sdist
wheel: IMPINGE_BUILD = $(abs_top_builddir)
wheel: all
	$(copy_python)
	$(build_package) >python-packages/$@.log 2>&1 || { cat python-packages/$@.log; exit 1; }
	@tail -n 1 python-packages/$@.log
sdist:
	$(copy_python)
	$(MAKE) -s distdir distdir=python-packages/sdist/source
	chmod -R u+w python-packages/sdist/source
	$(build_package) >python-packages/$@.log 2>&1 || { cat python-packages/$@.log; exit 1; }
	@tail -n 1 python-packages/$@.log

# Programs that use the library, beside the plugins that the guide builds.
hostexamplesdir = $(docdir)/examples
dist_hostexamples_DATA = \
    sdk/examples/arm.c \
    sdk/examples/arm.py \
    sdk/examples/linked_in.c \
    sdk/examples/profile.py \
    sdk/examples/robot.py \
    sdk/examples/steps.c

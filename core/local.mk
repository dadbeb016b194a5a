# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Modules, bottom-up, one per line: a module includes only what stands above it, which
# tests/structure.bats checks. The registry side and the solver side both build on the
# base and never include each other.

core_base = \
    core/impinge/impinge.h \
    core/status.c core/status.h \
    core/fp_mode.h \
    core/in_call.c core/in_call.h \
    core/array.h \
    core/text.c core/text.h \
    core/place.c core/place.h \
    core/region.c core/region.h \
    core/surface.h \
    core/surface_parts.h \
    core/surface.c core/surface_rate.c core/surface_include.c \
    core/scene.h

core_solver = \
    core/vec.h \
    core/lanes.h \
    core/node.h \
    core/node_model.c core/node_model.h \
    core/node.c \
    core/claims.c core/claims.h \
    core/scene_trees.h \
    core/scene.c \
    core/broad_phase.c core/broad_phase.h \
    core/quadratic.h \
    core/relative.c core/relative.h \
    core/normal_field.c core/normal_field.h \
    core/nearest_axis.c core/nearest_axis.h \
    core/axes.c core/axes.h \
    core/separation.c core/separation.h \
    core/pair_heap.c core/pair_heap.h \
    core/witness.c core/witness.h \
    core/time_of_impact.c core/time_of_impact.h \
    core/couples.c core/couples.h \
    core/query.c

core_registry = \
    core/elf_file.c core/elf_file.h \
    core/elf_probe.c core/elf_probe.h \
    core/parameter_table.c core/parameter_table.h \
    core/json_words.c core/json_words.h \
    core/parameters.c core/parameters.h \
    core/type_view.h \
    core/plugin_check.c core/plugin_check.h \
    core/plugin_trial.h \
    core/plugin_trial.c \
    core/trial_book.c \
    core/plugin_file.c core/plugin_file.h \
    core/search_path.c core/search_path.h \
    core/registry.h \
    core/registry_parts.h \
    core/registry.c core/registry_scan.c \
    core/file_text.c core/file_text.h \
    core/pipeline_value.c core/pipeline_value.h \
    core/pipeline.c core/pipeline.h \
    core/json_keys.c core/json_keys.h \
    core/isolate.c core/isolate.h \
    core/scene_build.c core/scene_build.h \
    core/instance.c \
    core/scene_bodies.c core/scene_bodies.h \
    core/scene_file.c core/scene_file.h

# Everything, internal symbols included: what the Check suites link.
noinst_LTLIBRARIES += core/libcore.la
core_libcore_la_SOURCES = $(core_base) $(core_solver) $(core_registry)
core_libcore_la_LIBADD = $(JANSSON_LIBS) -lm

# The same objects, public symbols only.
#
# -version-info CURRENT:REVISION:AGE, at each release (libtool's rule, not the version of
# the package):
#   code changed, interface the same        REVISION + 1
#   interface grew, nothing lost            CURRENT + 1, REVISION 0, AGE + 1
#   anything public removed or changed      CURRENT + 1, REVISION 0, AGE 0
lib_LTLIBRARIES += libimpinge.la
libimpinge_la_SOURCES =
libimpinge_la_LIBADD = core/libcore.la
libimpinge_la_LDFLAGS = $(AM_LDFLAGS) -version-info 0:0:0 -no-undefined \
    -export-symbols-regex '^imp_'

core_includedir = $(pkgincludedir)
core_include_HEADERS = core/impinge/impinge.h

pkgconfig_DATA += core/impinge.pc

EXTRA_DIST += core/README

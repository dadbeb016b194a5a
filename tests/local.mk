# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# One line per suite: tests/NAME is built from tests/NAME.c and linked with everything in
# core, internal symbols included.
check_suites = \
    tests/fuzz_scene \
    tests/test_alloc_failure \
    tests/test_contacts \
    tests/test_elf_probe \
    tests/test_isolate \
    tests/test_expression \
    tests/test_expression_faults \
    tests/test_faulty_types \
    tests/test_formula_answers \
    tests/test_guarantees \
    tests/test_lanes \
    tests/test_loosened \
    tests/test_metamorphic \
    tests/test_map_answers \
    tests/test_parameters \
    tests/test_pair_heap \
    tests/test_pipeline \
    tests/test_plugin_parameters \
    tests/test_quadratic \
    tests/test_query \
    tests/test_query_memory \
    tests/test_registry \
    tests/test_scene_file \
    tests/test_separation \
    tests/test_spheres \
    tests/test_steps \
    tests/test_surface

# The same, with MPFI as the judge of bounds.
mpfi_suites = \
    tests/test_checker \
    tests/test_expression_bounds \
    tests/test_formula \
    tests/test_keyframes \
    tests/test_maps \
    tests/test_model \
    tests/test_plugins \
    tests/test_shapes \
    tests/test_tightness

# What types are judged by, and instances of them.
type_oracle = tests/oracle_number.c tests/oracle_number.h \
    tests/type_oracle.c tests/type_oracle.h \
    tests/shape_oracle.c tests/shape_oracle.h \
    tests/expression_oracle.c tests/expression_oracle.h \
    tests/map_oracle.c tests/map_oracle.h \
    tests/instance.c tests/instance.h
tests_test_keyframes_SOURCES = tests/test_keyframes.c tests/map_images.h $(type_oracle)
tests_test_maps_SOURCES = tests/test_maps.c tests/map_images.h $(type_oracle)
tests_test_shapes_SOURCES = tests/test_shapes.c $(type_oracle)
tests_test_tightness_SOURCES = tests/test_tightness.c $(type_oracle)
tests_test_plugins_SOURCES = tests/test_plugins.c $(type_oracle) \
    tests/judge.c tests/judge.h \
    tests/sampling.c tests/sampling.h
# The checker's own arithmetic, which the command keeps to itself.
tests_test_checker_SOURCES = tests/test_checker.c \
    tests/expression_oracle.c tests/oracle_number.c \
    tools/check_branch.c tools/check_formula.c tools/check_jet.c tools/check_jet_functions.c \
    tools/check_polynomial.c tools/check_reader.c tools/check_span.c tools/check_view.c
tests_test_expression_bounds_SOURCES = tests/test_expression_bounds.c \
    tests/expression_oracle.c tests/oracle_number.c tests/judge.c tests/sampling.c
tests_test_expression_bounds_LDADD = plugins/libexpression.la $(LDADD)

# Command-line tests; the environment below tells them where things are.
bats_suites = \
    tests/bench.bats \
    tests/check.bats \
    tests/cli.bats \
    tests/cli_batch.bats \
    tests/cli_list.bats \
    tests/cli_pair.bats \
    tests/readme.bats \
    tests/cli_solve.bats \
    tests/host.bats \
    tests/matrix.bats \
    tests/why.bats

# Tests of the sources, the scripts and the installation.
script_suites = \
    tests/preparation.bats \
    tests/sdk.bats \
    tests/structure.bats \
    tests/install.bats

# Plugins for the tests of the loader, mostly faulty: tests/plugins/NAME.la is built from
# tests/plugins/NAME.c. Never installed; -rpath makes libtool build a shared object all the same.
check_LTLIBRARIES = \
    tests/plugins/bad_name.la \
    tests/plugins/bad_parameter_table.la \
    tests/plugins/constructor_aborts.la \
    tests/plugins/constructor_crashes.la \
    tests/plugins/constructor_exits.la \
    tests/plugins/constructor_hangs.la \
    tests/plugins/create_crashes.la \
    tests/plugins/create_fails.la \
    tests/plugins/create_null.la \
    tests/plugins/create_overflows.la \
    tests/plugins/create_rounds.la \
    tests/plugins/domain_crashes.la \
    tests/plugins/domain_nan.la \
    tests/plugins/domain_rounds.la \
    tests/plugins/eval_aborts.la \
    tests/plugins/eval_crashes.la \
    tests/plugins/eval_error_negative.la \
    tests/plugins/eval_exits.la \
    tests/plugins/eval_hangs.la \
    tests/plugins/eval_nan_late.la \
    tests/plugins/eval_overflows_stack.la \
    tests/plugins/eval_rounds.la \
    tests/plugins/fast_math.la \
    tests/plugins/fp_mode.la \
    tests/plugins/half_bad.la \
    tests/plugins/include_inverted.la \
    tests/plugins/include_lies.la \
    tests/plugins/include_negative.la \
    tests/plugins/include_rounds.la \
    tests/plugins/kit.la \
    tests/plugins/liar_beyond.la \
    tests/plugins/liar_corners.la \
    tests/plugins/liar_counter.la \
    tests/plugins/liar_crash.la \
    tests/plugins/liar_errno.la \
    tests/plugins/liar_error.la \
    tests/plugins/liar_exports.la \
    tests/plugins/liar_factory.la \
    tests/plugins/liar_grid.la \
    tests/plugins/liar_hang.la \
    tests/plugins/liar_leak.la \
    tests/plugins/liar_map_rate.la \
    tests/plugins/liar_model_time.la \
    tests/plugins/liar_nan.la \
    tests/plugins/liar_percent.la \
    tests/plugins/liar_range.la \
    tests/plugins/liar_refusal.la \
    tests/plugins/liar_remainder.la \
    tests/plugins/liar_rounding.la \
    tests/plugins/liar_sign.la \
    tests/plugins/liar_single.la \
    tests/plugins/liar_spot.la \
    tests/plugins/liar_time.la \
    tests/plugins/liar_truthful.la \
    tests/plugins/map_rate_negative.la \
    tests/plugins/newer_minor.la \
    tests/plugins/no_entry.la \
    tests/plugins/no_factory.la \
    tests/plugins/no_note.la \
    tests/plugins/note_disagrees.la \
    tests/plugins/null_callback.la \
    tests/plugins/null_string.la \
    tests/plugins/rate_infinite.la \
    tests/plugins/rate_lies.la \
    tests/plugins/rate_negative.la \
    tests/plugins/twin.la \
    tests/plugins/undefined_symbol.la \
    tests/plugins/wrong_abi_major.la
test_plugin_ldflags = -avoid-version -shared -rpath /nowhere
tests_plugins_fast_math_la_LDFLAGS = -module $(test_plugin_ldflags) -Wc,-ffast-math
$(check_LTLIBRARIES): LIBS = -lm

# Suites that fail every allocation in turn.
alloc_failure_ldflags = -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=free \
    -Wl,--wrap=strdup,--wrap=strndup
tests_test_alloc_failure_SOURCES = tests/test_alloc_failure.c tests/alloc_failure.c
tests_test_alloc_failure_LDFLAGS = $(AM_LDFLAGS) $(alloc_failure_ldflags)
tests_test_query_memory_SOURCES = tests/test_query_memory.c tests/alloc_failure.c
tests_test_query_memory_LDFLAGS = $(AM_LDFLAGS) $(alloc_failure_ldflags)

# The language of formulas.
tests_test_expression_SOURCES = tests/test_expression.c tests/expression_kit.h \
    tests/alloc_failure.c
tests_test_expression_LDFLAGS = $(AM_LDFLAGS) $(alloc_failure_ldflags)
tests_test_expression_LDADD = plugins/libexpression.la $(LDADD)
tests_test_expression_faults_LDADD = plugins/libexpression.la $(LDADD)

# One scene told in many ways.
tests_test_guarantees_SOURCES = tests/test_guarantees.c tests/retelling.c
tests_test_metamorphic_SOURCES = tests/test_metamorphic.c tests/retelling.c
tests_test_steps_SOURCES = tests/test_steps.c tests/retelling.c

# Models and their exact meaning, side by side.
tests_test_formula_SOURCES = tests/test_formula.c tests/oracle.c
tests_test_model_SOURCES = tests/test_model.c tests/oracle.c

noinst_HEADERS += tests/built_plugins.h tests/oracle.h tests/suite.h tests/asking.h tests/balls.h tests/retelling.h tests/sandbox.h tests/kit_registry.h tests/alloc_failure.h tests/plugins/tiny.h tests/plugins/liar.h
noinst_HEADERS += tests/plugins/slab.h tests/model_value.h

# What tests/fuzz_scene reads: scenes, and pipelines.
EXTRA_DIST += \
    tests/fuzz_scene.d/all_kinds.json \
    tests/fuzz_scene.d/bad_shapes.json \
    tests/fuzz_scene.d/bar.txt \
    tests/fuzz_scene.d/deep.json \
    tests/fuzz_scene.d/kit.txt \
    tests/fuzz_scene.d/not_utf8.json \
    tests/fuzz_scene.d/numbers.txt \
    tests/fuzz_scene.d/patch.json \
    tests/fuzz_scene.d/quotes.txt \
    tests/fuzz_scene.d/sphere.txt

LDADD = core/libcore.la $(CHECK_LIBS) $(MPFI_LIBS) -lm

TESTS =
without_check =
without_mpfi =
without_bats =
if HAVE_CHECK
check_PROGRAMS += $(check_suites)
TESTS += $(check_suites)
if HAVE_MPFI
check_PROGRAMS += $(mpfi_suites)
TESTS += $(mpfi_suites)
else
without_mpfi += $(mpfi_suites)
endif
else
without_check += $(check_suites) $(mpfi_suites)
endif
if HAVE_BATS
TESTS += $(bats_suites) $(script_suites)
else
without_bats += $(bats_suites) $(script_suites)
endif

check-local:
	@for suite in $(without_check); do echo "SKIP: $$suite (Check not found)"; done
	@for suite in $(without_mpfi); do echo "SKIP: $$suite (MPFI not found)"; done
	@for suite in $(without_bats); do echo "SKIP: $$suite (bats or jq not found)"; done

# IMPINGE is the command to test. The user's own plugins stay out of it.
TEST_EXTENSIONS = .bats
BATS_LOG_COMPILER = $(BATS) --tap
AM_TESTS_ENVIRONMENT = \
    IMPINGE='$(abs_top_builddir)/tools/impinge'; export IMPINGE; \
    top_srcdir='$(abs_top_srcdir)'; export top_srcdir; \
    top_builddir='$(abs_top_builddir)'; export top_builddir; \
    CC='$(CC)'; export CC; \
    MAKE='$(MAKE)'; export MAKE; \
    XDG_DATA_HOME='$(abs_top_builddir)/tests/no-user-data'; export XDG_DATA_HOME; \
    XDG_CACHE_HOME='$(abs_top_builddir)/tests/cache'; export XDG_CACHE_HOME; \
    unset IMPINGE_PLUGIN_PATH;

EXTRA_DIST += $(bats_suites) $(script_suites) tests/include_order tests/cli_helper.bash \
    tests/schema.jq

# What must not change; tests/abi/README tells more.
EXTRA_DIST += \
    tests/abi/README \
    tests/abi/ask_fixture.c \
    tests/abi/fixture.c \
    tests/abi/fixture_1_0.so \
    tests/abi/fixture_1_0.txt \
    tests/abi/layout.c \
    tests/abi/layout_1.txt \
    tests/abi/libimpinge \
    tests/abi/libimpinge_0.abi

# With sanitizers a second full run is slow and tells nothing new of scripts and installation.
.PHONY: check-sanitized
check-sanitized:
	$(MAKE) check TESTS='$(filter-out $(script_suites),$(TESTS))'

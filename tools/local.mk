# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The command: main and one file per verb. It sees the public API and nothing else of core.
tool_sources = \
    tools/arguments.c tools/arguments.h \
    tools/bench.h tools/bench_cases.c tools/bench_json.c tools/bench_measure.c \
    tools/bench_patches.c tools/bench_print.c tools/bench_sets.c \
    tools/build_tree.c tools/build_tree.h \
    tools/catalogue.c tools/catalogue.h \
    tools/check_answer.c tools/check_answer.h \
    tools/check_branch.c tools/check_branch.h \
    tools/check_child.c tools/check_child.h \
    tools/check_cost.c tools/check_cost.h \
    tools/check_file.c tools/check_file.h \
    tools/check_formula.c tools/check_formula.h \
    tools/check_inclusions.c tools/check_inclusions.h \
    tools/check_jet.c tools/check_jet_functions.c tools/check_jet.h \
    tools/check_list.c tools/check_list.h \
    tools/check_pair.c tools/check_pair.h \
    tools/check_points.c tools/check_points.h \
    tools/check_polynomial.c tools/check_polynomial.h \
    tools/check_proof.c tools/check_proof.h \
    tools/check_purity.c tools/check_purity.h \
    tools/check_rates.c tools/check_rates.h \
    tools/check_reader.c tools/check_steps.h \
    tools/check_reach.c tools/check_reach.h \
    tools/check_report.c tools/check_report.h \
    tools/check_said.c tools/check_said.h \
    tools/check_sampling.c tools/check_sampling.h \
    tools/check_span.c tools/check_span.h \
    tools/check_subject.c tools/check_subject.h \
    tools/check_table.c tools/check_table.h \
    tools/check_under.c tools/check_under.h \
    tools/check_view.c tools/check_view.h \
    tools/crash.c tools/crash.h \
    tools/compile.c tools/compile.h \
    tools/input.c tools/input.h \
    tools/interrupt.c tools/interrupt.h \
    tools/main.c \
    tools/message.c tools/message.h \
    tools/options.c tools/options.h \
    tools/output.c tools/output.h \
    tools/program.c tools/program.h \
    tools/project.c tools/project.h \
    tools/query.c tools/query.h \
    tools/result.h tools/result_json.c tools/result_text.c \
    tools/verbs.c tools/verbs.h \
    tools/verb_batch.c \
    tools/verb_check.c \
    tools/verb_bench.c \
    tools/verb_build.c \
    tools/verb_demo.c \
    tools/verb_help.c \
    tools/verb_info.c \
    tools/verb_list.c \
    tools/verb_matrix.c \
    tools/verb_new.c \
    tools/verb_pair.c \
    tools/verb_solve.c \
    tools/verb_why.c

bin_PROGRAMS += tools/impinge
tools_impinge_SOURCES = $(tool_sources)
tools_impinge_LDADD = libimpinge.la $(JANSSON_LIBS) -lm

dist_man_MANS = tools/impinge.1
pkgdata_DATA = \
    tools/data/bicubic_moving_100.jsonl \
    tools/data/teapot.json \
    tools/schema/bench.schema.json \
    tools/schema/check.schema.json \
    tools/schema/matrix.schema.json \
    tools/schema/result.schema.json \
    tools/schema/scene.schema.json \
    tools/schema/types.schema.json \
    tools/schema/why.schema.json

# Where build_tree_data looks, so that the command just built meets the data of its own tree.
built_data = tools/built-data
noinst_DATA = \
    $(built_data)/bicubic_moving_100.jsonl \
    $(built_data)/teapot.json \
    $(addprefix $(built_data)/template/,$(notdir $(dist_template_DATA))) \
    $(pkginclude_HEADERS:sdk/%=$(built_data)/include/%)
CLEANFILES += $(noinst_DATA)
copy_data = $(AM_V_GEN)$(MKDIR_P) $(@D) && cp $< $@ && chmod u+w $@
$(built_data)/%: tools/data/%
	$(copy_data)
$(built_data)/template/%: sdk/template/%
	$(copy_data)
$(built_data)/template/impinge.m4: sdk/impinge.m4
	$(copy_data)
$(built_data)/include/%: sdk/%
	$(copy_data)

EXTRA_DIST += tools/demo tools/prepare tools/test $(pkgdata_DATA)

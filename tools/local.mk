# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Of core, the command sees the public API and core/common. Rooms, bottom-up: proof and cli,
# then check, bench, simulate and view.

# The interval arithmetic that the checker proves with, for the command and its tests.
noinst_LTLIBRARIES += tools/libproof.la
tools_libproof_la_SOURCES = \
    tools/proof/box.h tools/proof/double_interval.h \
    tools/proof/branch.c tools/proof/branch.h \
    tools/proof/formula.c tools/proof/formula.h \
    tools/proof/jet.c tools/proof/jet.h \
    tools/proof/jet_internal.h \
    tools/proof/jet_several.c \
    tools/proof/jet_functions.c \
    tools/proof/double_interval.h \
    tools/proof/ld_ends.h \
    tools/proof/ld_interval.c tools/proof/ld_interval.h \
    tools/proof/polynomial.c tools/proof/polynomial.h \
    tools/proof/reader.c tools/proof/reader_internal.h \
    tools/proof/reader_names.c \
    tools/proof/reader_part.c \
    tools/proof/steps.h \
    tools/proof/view.c tools/proof/view.h

tools_check = \
    tools/check/allocations.c tools/check/allocations.h \
    tools/check/answer.c tools/check/answer.h \
    tools/check/argument_list.c tools/check/argument_list.h \
    tools/check/arguments.c tools/check/arguments.h \
    tools/check/badge.c tools/check/badge.h \
    tools/check/buffers.c tools/check/buffers.h \
    tools/check/calls.c tools/check/calls.h \
    tools/check/closed.c tools/check/closed.h \
    tools/check/clearance_cost.c tools/check/clearance_cost.h \
    tools/check/content.c tools/check/content.h \
    tools/check/cost.c tools/check/cost.h \
    tools/check/fate.c tools/check/fate.h \
    tools/check/distances.c tools/check/distances.h \
    tools/check/domain.c tools/check/domain.h \
    tools/check/environment.c tools/check/environment.h \
    tools/check/file.c tools/check/file.h \
    tools/check/formulas.c tools/check/formulas.h \
    tools/check/guard.c tools/check/guard.h \
    tools/check/inclusions.c tools/check/inclusions.h \
    tools/check/job.c tools/check/job.h \
    tools/check/list.c tools/check/list.h \
    tools/check/motions.c tools/check/motions.h \
    tools/check/moving_point.c tools/check/moving_point.h \
    tools/check/nearest.c tools/check/nearest.h \
    tools/check/nets.c tools/check/nets.h \
    tools/check/operand.c tools/check/operand.h \
    tools/check/malloc_watch.c tools/check/malloc_watch.h \
    tools/check/map_operand.c tools/check/map_operand.h \
    tools/check/own_formula.c tools/check/own_formula.h \
    tools/check/pair.c tools/check/pair.h \
    tools/check/parts.c tools/check/parts.h \
    tools/check/pieces.c tools/check/pieces.h \
    tools/check/points.c tools/check/points.h \
    tools/check/poses.c tools/check/poses.h \
    tools/check/proof.c tools/check/proof.h \
    tools/check/proof_text.c tools/check/proof_text.h \
    tools/check/purity.c tools/check/purity.h \
    tools/check/rates.c tools/check/rates.h \
    tools/check/renewal.c tools/check/renewal.h \
    tools/check/remainders.c tools/check/remainders.h \
    tools/check/report.c tools/check/report.h \
    tools/check/request.c tools/check/request.h \
    tools/check/sampling.c tools/check/sampling.h \
    tools/check/state.c tools/check/state.h \
    tools/check/stated_formula.c tools/check/stated_formula.h \
    tools/check/subject.c tools/check/subject.h \
    tools/check/subject_domain.c \
    tools/check/subject_text.c \
    tools/check/heap_growth.c tools/check/heap_growth.h \
    tools/check/table.c tools/check/table.h \
    tools/check/tubes.c tools/check/tubes.h \
    tools/check/values.c tools/check/values.h \
    tools/check/verb_check.c

tools_bench = \
    tools/bench/arm.c tools/bench/arm.h \
    tools/bench/bench.h \
    tools/bench/cases.c \
    tools/bench/certificate_cases.c \
    tools/bench/certificates.c \
    tools/bench/changes.c \
    tools/bench/columns.c tools/bench/columns.h \
    tools/bench/conformal.c \
    tools/bench/parameters.c \
    tools/bench/crowd.c tools/bench/crowd.h \
    tools/bench/crowds.c \
    tools/bench/everyday.c tools/bench/everyday.h \
    tools/bench/everyday_families.c \
    tools/bench/everyday_text.c \
    tools/bench/instructions.c tools/bench/instructions.h \
    tools/bench/json.c \
    tools/bench/kernel_time.c tools/bench/kernel_time.h \
    tools/bench/measure.c \
    tools/bench/patches.c \
    tools/bench/print.c \
    tools/bench/saddles.c \
    tools/bench/scenes.c tools/bench/scenes.h \
    tools/bench/sets.c \
    tools/bench/stream.c \
    tools/bench/tune.c tools/bench/tune.h \
    tools/bench/verb_bench.c

tools_cli = \
    tools/cli/arguments.c tools/cli/arguments.h \
    tools/cli/batch.c tools/cli/batch.h \
    tools/cli/batch_record.c tools/cli/batch_record.h \
    tools/cli/batch_resume.c tools/cli/batch_resume.h \
    tools/cli/batch_scene.c tools/cli/batch_scene.h \
    tools/cli/build_tree.c tools/cli/build_tree.h \
    tools/cli/catalogue.c tools/cli/catalogue.h \
    tools/cli/clearance.h \
    tools/cli/clearance_each.c \
    tools/cli/clearance_survey.c \
    tools/cli/clearance_tell.c tools/cli/clearance_tell.h \
    tools/cli/clearance_json.c \
    tools/cli/clearance_measure.c tools/cli/clearance_measure.h \
    tools/cli/clearance_table.c \
    tools/cli/clearance_text.c \
    tools/cli/command_line.c tools/cli/command_line.h \
    tools/cli/compile.c tools/cli/compile.h \
    tools/cli/crash.c tools/cli/crash.h \
    tools/cli/crew.c tools/cli/crew.h \
    tools/cli/each.c tools/cli/each.h \
    tools/cli/each_parts.c \
    tools/cli/each_internal.h tools/cli/each_line.c \
    tools/cli/explain.c tools/cli/explain.h tools/cli/explain_advice.c \
    tools/cli/explain_internal.h \
    tools/cli/file_lock.c tools/cli/file_lock.h \
    tools/cli/help_topics.c tools/cli/help_topics.h \
    tools/cli/input.c tools/cli/input.h \
    tools/cli/interrupt.c tools/cli/interrupt.h \
    tools/cli/json_line.c tools/cli/json_line.h \
    tools/cli/json_memory.c tools/cli/json_memory.h \
    tools/cli/message.c tools/cli/message.h \
    tools/cli/options.c tools/cli/options.h \
    tools/cli/ordered_pool.c tools/cli/ordered_pool.h \
    tools/cli/output.c tools/cli/output.h \
    tools/cli/output_json.c \
    tools/cli/output_file.c tools/cli/output_file.h \
    tools/cli/output_operands.c tools/cli/output_operands.h \
    tools/cli/output_target.c tools/cli/output_target.h \
    tools/cli/parts.c tools/cli/parts.h \
    tools/cli/program.c tools/cli/program.h \
    tools/cli/progress.c tools/cli/progress.h \
    tools/cli/project.c tools/cli/project.h \
    tools/cli/proof_output.c tools/cli/proof_output.h \
    tools/cli/query.c tools/cli/query.h \
    tools/cli/query_options.c \
    tools/cli/reading_limit.c tools/cli/reading_limit.h \
    tools/cli/result.h \
    tools/cli/result_json.c \
    tools/cli/result_text.c \
    tools/cli/run_options.c tools/cli/run_options.h \
    tools/cli/scene_info.c tools/cli/scene_info.h \
    tools/cli/scene_values.c tools/cli/scene_values.h \
    tools/cli/survey.c tools/cli/survey.h \
    tools/cli/survey_answer.c tools/cli/survey_answer.h \
    tools/cli/survey_boxes.c tools/cli/survey_boxes.h \
    tools/cli/survey_explain.c tools/cli/survey_explain.h \
    tools/cli/survey_parameters.c \
    tools/cli/survey_parts.c tools/cli/survey_parts.h \
    tools/cli/survey_parts_run.c \
    tools/cli/series.c tools/cli/series.h \
    tools/cli/shortest.c tools/cli/shortest.h \
    tools/cli/standard_output.c tools/cli/standard_output.h \
    tools/cli/vec.h \
    tools/cli/verb_batch.c \
    tools/cli/verb_build.c \
    tools/cli/verb_clearance.c \
    tools/cli/verb_complete.c \
    tools/cli/verb_help.c \
    tools/cli/verb_list.c \
    tools/cli/verb_matrix.c \
    tools/cli/verb_new.c \
    tools/cli/verb_pair.c \
    tools/cli/verb_solve.c \
    tools/cli/verb_watch.c \
    tools/cli/verb_why.c \
    tools/cli/verbs.c tools/cli/verbs.h \
    tools/cli/version.c tools/cli/version.h \
    tools/cli/watched_files.c tools/cli/watched_files.h

tools_view = \
    tools/view/animation.h \
    tools/view/camera.h \
    tools/view/canvas.c tools/view/canvas.h \
    tools/view/cloud.c tools/view/cloud.h \
    tools/view/events.c tools/view/events.h \
    tools/view/film.c tools/view/film.h \
    tools/view/gap.c tools/view/gap.h \
    tools/view/glb.c \
    tools/view/glb_buffer.c tools/view/glb_buffer.h \
    tools/view/html.c tools/view/html.h \
    tools/view/html_data.c tools/view/html_data.h \
    tools/view/legend.c tools/view/legend.h \
    tools/view/allowance.c tools/view/allowance.h \
    tools/view/mesh.c tools/view/mesh.h \
    tools/view/mesh_cell.c tools/view/mesh_cell.h \
    tools/view/mesh_grid.c tools/view/mesh_grid.h \
    tools/view/mesh_points.c tools/view/mesh_steps.c \
    tools/view/nearest.c tools/view/nearest.h \
    tools/view/obj.c \
    tools/view/palette.c tools/view/palette.h \
    tools/view/picture.c tools/view/picture.h \
    tools/view/plot.c tools/view/plot.h \
    tools/view/plot_source.c tools/view/plot_source.h \
    tools/view/plot_text.c \
    tools/view/png.c tools/view/png.h \
    tools/view/raster.c tools/view/raster.h \
    tools/view/recorded.c tools/view/recorded.h \
    tools/view/regions.c tools/view/regions.h \
    tools/view/request.c tools/view/request.h \
    tools/view/stage.c tools/view/stage.h \
    tools/view/storyboard.c tools/view/storyboard.h \
    tools/view/stroke_font.c tools/view/stroke_font.h \
    tools/view/subject.c tools/view/subject.h \
    tools/view/at_values.c tools/view/at_values.h \
    tools/view/view.c tools/view/view.h \
    tools/view/view_film.c tools/view/view_film.h \
    tools/view/visibility.c tools/view/visibility.h \
    tools/view/vtu.c \
    tools/view/verb_demo.c \
    tools/view/verb_info.c \
    tools/view/verb_plot.c \
    tools/view/verb_view.c

tools_simulate = \
    tools/simulate/actor.c tools/simulate/actor.h \
    tools/simulate/balance.c tools/simulate/balance.h \
    tools/simulate/chart.c tools/simulate/chart.h \
    tools/simulate/coulomb.c tools/simulate/coulomb.h \
    tools/simulate/drift.c tools/simulate/drift.h \
    tools/simulate/eliminate.c tools/simulate/eliminate.h \
    tools/simulate/event.c tools/simulate/event.h \
    tools/simulate/footprint.c tools/simulate/footprint.h \
    tools/simulate/gather.c tools/simulate/gather.h \
    tools/simulate/impact.c tools/simulate/impact.h \
    tools/simulate/integrals.c tools/simulate/integrals.h \
    tools/simulate/limits.c tools/simulate/limits.h \
    tools/simulate/mass.c tools/simulate/mass.h \
    tools/simulate/meeting.c tools/simulate/meeting.h \
    tools/simulate/mover.c tools/simulate/mover.h \
    tools/simulate/closest.c tools/simulate/closest.h \
    tools/simulate/nesting.c tools/simulate/nesting.h \
    tools/simulate/carried.c tools/simulate/carried.h \
    tools/simulate/outline.c tools/simulate/outline.h \
    tools/simulate/patches.c tools/simulate/patches.h \
    tools/simulate/placed.c tools/simulate/placed.h \
    tools/simulate/polygon.c tools/simulate/polygon.h \
    tools/simulate/record.c tools/simulate/record.h \
    tools/simulate/response.c tools/simulate/response.h \
    tools/simulate/rest.c tools/simulate/rest.h \
    tools/simulate/rigid.h \
    tools/simulate/setup.c tools/simulate/setup.h \
    tools/simulate/shells.c tools/simulate/shells.h \
    tools/simulate/simulation.c tools/simulate/simulation.h \
    tools/simulate/smooth.c tools/simulate/smooth.h \
    tools/simulate/strike.c \
    tools/simulate/timeline.c tools/simulate/timeline.h \
    tools/simulate/touch.c tools/simulate/touch.h \
    tools/simulate/values.c tools/simulate/values.h \
    tools/simulate/verb_simulate.c

# All but main, for both commands.
noinst_LIBRARIES += tools/libtools.a
tools_libtools_a_SOURCES = $(tools_cli) $(tools_check) $(tools_bench) $(tools_simulate) \
    $(tools_view)
tools_libs = tools/libtools.a tools/libproof.la core/libcommon.la libimpinge.la $(JANSSON_LIBS) \
    $(LIBPNG_LIBS) -lm

bin_PROGRAMS += tools/impinge
tools_impinge_SOURCES = tools/cli/main.c
tools_impinge_LDADD = $(tools_libs)

# The verifier of certificates, whose interval arithmetic is MPFI's; of the checker's proofs it shares
# formulas and jets.
dist_man_MANS =
if HAVE_MPFI
noinst_LTLIBRARIES += tools/libverify.la tools/libkernel.la
bin_PROGRAMS += tools/impinge-verify tools/impinge-verify-kernel
dist_man_MANS += tools/impinge-verify.1 tools/impinge-verify-kernel.1
else
EXTRA_DIST += tools/impinge-verify.1 tools/impinge-verify-kernel.1
endif
# The kernel of the verifier: at most 1,500 lines (tests/cli/certificates_kernel.bats), which use nothing else of
# Impinge.
tools_impinge_verify_kernel_SOURCES = tools/kernel/main.c
tools_impinge_verify_kernel_LDADD = tools/libkernel.la
tools_libkernel_la_SOURCES = \
    tools/kernel/kernel.h \
    tools/kernel/claim.c \
    tools/kernel/expression.c \
    tools/kernel/leaf.c \
    tools/kernel/slope.c \
    tools/kernel/trees.c
tools_libkernel_la_LIBADD = $(MPFI_LIBS) -lm
tools_impinge_verify_SOURCES = \
    core/common/search_path.c core/common/search_path.h \
    tools/cli/build_tree.c tools/cli/build_tree.h \
    tools/cli/file_lock.c tools/cli/file_lock.h \
    tools/cli/output_file.c tools/cli/output_file.h \
    tools/cli/output_target.c tools/cli/output_target.h \
    tools/verify/complain.c \
    tools/verify/coq.c tools/verify/coq.h \
    tools/verify/coq_goal.c tools/verify/coq_goal.h \
    tools/verify/coq_term.c tools/verify/coq_term.h \
    tools/verify/coq_text.c tools/verify/coq_text.h \
    tools/verify/main.c \
    tools/verify/receipt.c tools/verify/receipt.h \
    tools/verify/rewrite.c tools/verify/rewrite.h \
    tools/verify/run.c tools/verify/run.h
tools_impinge_verify_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tools_impinge_verify_LDADD = tools/libverify.la
tools_libverify_la_SOURCES = \
    core/common/array.h \
    core/common/sha256.c core/common/sha256.h \
    tools/proof/box.h tools/proof/double_interval.h \
    tools/proof/formula.c tools/proof/formula.h \
    tools/proof/jet.c tools/proof/jet.h \
    tools/proof/jet_internal.h \
    tools/proof/jet_several.c \
    tools/proof/jet_functions.c \
    tools/proof/ld_ends.h tools/proof/ld_interval.h \
    tools/proof/reader.c tools/proof/reader_internal.h \
    tools/proof/reader_names.c \
    tools/proof/reader_part.c \
    tools/proof/steps.h \
    tools/verify/aim.c tools/verify/aim.h \
    tools/verify/apart.c tools/verify/apart.h \
    tools/verify/apart_axis.c tools/verify/apart_internal.h \
    tools/verify/apart_cell.c tools/verify/apart_guess.c \
    tools/verify/apart_round.c tools/verify/apart_centre.c \
    tools/verify/elaborate.c tools/verify/elaborate.h \
    tools/verify/enclose.c tools/verify/enclose.h \
    tools/verify/enclose_parts.c \
    tools/verify/input.c tools/verify/input.h \
    tools/verify/jumps.c tools/verify/jumps.h \
    tools/verify/look.c tools/verify/look.h \
    tools/verify/motion_internal.h tools/verify/motion_affine.c \
    tools/verify/motion.c tools/verify/motion.h \
    tools/verify/motion_form.c tools/verify/motion_rigid.c \
    tools/verify/form.h tools/verify/form_turned.c \
    tools/verify/mpfi_functions.c \
    tools/verify/orbit.c tools/verify/orbit.h \
    tools/verify/turn.c tools/verify/turn.h \
    tools/verify/net.c tools/verify/net.h \
    tools/verify/net_formula.c tools/verify/net_internal.h \
    tools/verify/net_jets.c \
    tools/verify/meridian.c tools/verify/meridian.h \
    tools/verify/round_guess.c \
    tools/verify/round.c tools/verify/round.h \
    tools/verify/shadow.c tools/verify/shadow.h \
    tools/verify/shadow_internal.h tools/verify/shadow_round.c \
    tools/verify/cloud.c tools/verify/cloud.h \
    tools/verify/sides.c tools/verify/sides.h \
    tools/verify/statement.c tools/verify/statement.h \
    tools/verify/statement_internal.h \
    tools/verify/statement_stage.c \
    tools/verify/tighten.c tools/verify/tighten.h \
    tools/verify/walk.c tools/verify/walk.h \
    tools/verify/walk_internal.h tools/verify/walk_points.c \
    tools/verify/walk_tree.c \
    tools/verify/words.c tools/verify/words.h
tools_libverify_la_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tools_libverify_la_LIBADD = tools/libkernel.la $(MPFI_LIBS) -lm

# The command for `bench --tune`, whose tuning constants are variables: built by name only. The library
# is linked in as one object, whose internal symbols are local. Positive variables stand for
# constants there, so that changes of sign are harmless.
EXTRA_LIBRARIES = core/libtunable.a
core_libtunable_a_SOURCES = $(core_common) $(core_libcore_la_SOURCES) core/bounds/tuning.c
core_libtunable_a_CPPFLAGS = $(AM_CPPFLAGS) -DIMP_TUNABLE
core_libtunable_a_CFLAGS = $(AM_CFLAGS) $(UNROLL_CFLAGS) -Wno-sign-conversion -Wno-sign-compare
core/tunable.o: core/libtunable.a
	$(AM_V_GEN)$(LD) -r -o $@ --whole-archive core/libtunable.a && \
	  $(OBJCOPY) --localize-hidden $@

EXTRA_PROGRAMS = tools/impinge-tunable
CLEANFILES += core/libtunable.a core/tunable.o tools/impinge-tunable
tools_impinge_tunable_SOURCES = tools/cli/main.c tools/bench/tune.c
tools_impinge_tunable_CPPFLAGS = $(AM_CPPFLAGS) -DIMP_TUNABLE
tools_impinge_tunable_LDADD = core/tunable.o tools/libtools.a tools/libproof.la core/libcommon.la \
    $(JANSSON_LIBS) $(ZLIB_LIBS) $(LIBPNG_LIBS) -lm

# batch and solve --each for clusters, where there is MPI.
if HAVE_MPI
bin_PROGRAMS += tools/impinge-mpi
endif
tools_impinge_mpi_SOURCES = \
    tools/mpi/main.c \
    tools/mpi/ranks.c tools/mpi/ranks.h \
    tools/mpi/ranks_batch.c \
    tools/mpi/ranks_each.c
tools_impinge_mpi_CFLAGS = $(AM_CFLAGS) $(MPI_CFLAGS)
tools_impinge_mpi_LDADD = $(tools_libs) $(MPI_LIBS)

dist_man_MANS += tools/impinge.1
pkgdata_DATA = \
    tools/data/arm.csv \
    tools/data/arm.json \
    tools/data/arm.srdf \
    tools/data/arm.urdf \
    tools/data/arm_off.json \
    tools/data/arm_shelf.yaml \
    tools/data/bicubic_moving_100.jsonl \
    tools/data/blade.json \
    tools/data/bolt.json \
    tools/data/bowl.json \
    tools/data/die.json \
    tools/data/door.json \
    tools/data/egg.json \
    tools/data/page.html \
    tools/data/pebble.json \
    tools/data/recoil.json \
    tools/data/spindle.json \
    tools/data/teapot.json \
    tools/schema/badge.schema.json \
    tools/schema/bench.schema.json \
    tools/schema/check.schema.json \
    tools/schema/clearance.schema.json \
    tools/schema/error.schema.json \
    tools/schema/matrix.schema.json \
    tools/schema/result.schema.json \
    tools/schema/scene.schema.json \
    tools/schema/simulate.schema.json \
    tools/schema/types.schema.json \
    tools/schema/version.schema.json \
    tools/schema/why.schema.json

# Where build_tree_data looks, so that the command just built meets the data of its own tree.
built_data = tools/built-data
noinst_DATA = \
    $(built_data)/arm.csv \
    $(built_data)/arm.json \
    $(built_data)/bicubic_moving_100.jsonl \
    $(built_data)/blade.json \
    $(built_data)/door.json \
    $(built_data)/page.html \
    $(built_data)/spindle.json \
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

EXTRA_DIST += tools/data/blade.png tools/data/blade_gap.png \
    tools/data/arm_off.png tools/data/door.png tools/data/spindle.png
EXTRA_DIST += tools/debian tools/package
EXTRA_DIST += tools/coverage tools/coverage.gaps tools/coverage.py tools/demo tools/prepare tools/test $(pkgdata_DATA)

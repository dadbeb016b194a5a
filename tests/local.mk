# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# One line per suite: tests/unit/NAME is built from tests/unit/NAME.c and linked with everything in
# core, internal symbols included.
check_suites = \
    tests/unit/test_touchings \
    tests/unit/test_survey_parts \
    tests/fuzz/api \
    tests/fuzz/array \
    tests/fuzz/cache \
    tests/fuzz/csv \
    tests/fuzz/elf \
    tests/fuzz/formula \
    tests/fuzz/json \
    tests/fuzz/mesh \
    tests/fuzz/picture \
    tests/fuzz/pipeline \
    tests/fuzz/proof \
    tests/fuzz/scene \
    tests/unit/test_alloc_failure \
    tests/unit/test_api \
    tests/unit/test_arena \
    tests/unit/test_array_archives \
    tests/unit/test_array_files \
    tests/unit/test_union_find \
    tests/unit/test_callers_mode \
    tests/unit/test_clearance \
    tests/unit/test_clearance_required \
    tests/unit/test_clearance_steps \
    tests/unit/test_time_descent \
    tests/unit/test_broad_phase \
    tests/unit/test_balls \
    tests/unit/test_builder \
    tests/unit/test_contacts \
    tests/unit/test_decimal \
    tests/unit/test_distance_maps \
    tests/unit/test_distance_windows \
    tests/unit/test_slips \
    tests/unit/test_slip_pairs \
    tests/unit/test_slip_planes \
    tests/unit/test_aside \
    tests/unit/test_held \
    tests/unit/test_held_values \
    tests/unit/test_tubes \
    tests/unit/test_glances \
    tests/unit/test_screw_slips \
    tests/unit/test_half_planes \
    tests/unit/test_screw_pieces \
    tests/unit/test_orbits \
    tests/unit/test_shared_solids \
    tests/unit/test_time_models \
    tests/unit/test_solids \
    tests/unit/test_solid_shells \
    tests/unit/test_solid_questions \
    tests/unit/test_elf_probe \
    tests/unit/test_elf_tables \
    tests/unit/test_isolate \
    tests/unit/test_isolate_faults \
    tests/unit/test_isolated_threads \
    tests/unit/test_expression \
    tests/unit/test_expression_faults \
    tests/unit/test_faulty_types \
    tests/unit/test_formula_answers \
    tests/unit/test_formula_texts \
    tests/unit/test_guarantees \
    tests/unit/test_impacts \
    tests/unit/test_lanes \
    tests/unit/test_limits \
    tests/unit/test_locale \
    tests/unit/test_json_quick \
    tests/unit/test_kept_instances \
    tests/unit/test_linked_in \
    tests/unit/test_load_cache \
    tests/unit/test_loosened \
    tests/unit/test_mechanism \
    tests/unit/test_mesh \
    tests/unit/test_mesh_files \
    tests/unit/test_gltf_files \
    tests/unit/test_mesh_text \
    tests/unit/test_metamorphic \
    tests/unit/test_misuse \
    tests/unit/test_map_answers \
    tests/unit/test_palette \
    tests/unit/test_parallel \
    tests/unit/test_parameters \
    tests/unit/test_parts \
    tests/unit/test_pair_heap \
    tests/unit/test_explanation \
    tests/unit/test_pending \
    tests/unit/test_piece_sides \
    tests/unit/test_pieces \
    tests/unit/test_piece_answers \
    tests/unit/test_pipeline \
    tests/unit/test_plugin_parameters \
    tests/unit/test_posed_pairs \
    tests/unit/test_quadratic \
    tests/unit/test_query \
    tests/unit/test_query_bodies \
    tests/unit/test_query_steps \
    tests/unit/test_query_memory \
    tests/unit/test_registry \
    tests/unit/test_rigid_motion \
    tests/unit/test_scene_file \
    tests/unit/test_scene_judge \
    tests/unit/test_separation \
    tests/unit/test_dividing_surface \
    tests/unit/test_normal_field \
    tests/unit/test_separation_distance \
    tests/unit/test_strategy \
    tests/unit/test_shared_motion \
    tests/unit/test_series \
    tests/unit/test_meetings \
    tests/unit/test_upper_times \
    tests/unit/test_sliding \
    tests/unit/test_spheres \
    tests/unit/test_spines \
    tests/unit/test_steps \
    tests/unit/test_surface \
    tests/unit/test_survey \
    tests/unit/test_survey_state \
    tests/unit/test_clocks \
    tests/unit/test_contact_paraboloid \
    tests/unit/test_survey_samples \
    tests/unit/test_survey_descent \
    tests/unit/test_spreads \
    tests/unit/test_survey_forms \
    tests/unit/test_threads \
    tests/unit/test_times \
    tests/unit/test_tolerance

# The same, with MPFI as the judge of bounds; the longest first.
mpfi_suites = \
    tests/fuzz/certificate \
    tests/fuzz/kernel \
    tests/unit/test_certificate_nets \
    tests/unit/test_certificates \
    tests/unit/test_kernel \
    tests/unit/test_certificate_round \
    tests/unit/test_certificate_turns \
    tests/unit/test_certificate_orbits \
    tests/unit/test_certificate_parts \
    tests/unit/test_certificate_changes \
    tests/unit/test_proof_memory \
    tests/unit/test_plugins \
    tests/unit/test_checker \
    tests/unit/test_distances \
    tests/unit/test_expression_bounds \
    tests/unit/test_coils \
    tests/unit/test_crowds \
    tests/unit/test_turned \
    tests/unit/test_round_nets \
    tests/unit/test_round_profiles \
    tests/unit/test_formula \
    tests/unit/test_keyframes \
    tests/unit/test_maps \
    tests/unit/test_model \
    tests/unit/test_nested \
    tests/unit/test_net_models \
    tests/unit/test_nets \
    tests/unit/test_net_paraboloid \
    tests/unit/test_net_halves \
    tests/unit/test_net_offers \
    tests/unit/test_net_series \
    tests/unit/test_poses \
    tests/unit/test_set_values \
    tests/unit/test_steady_state \
    tests/unit/test_shapes \
    tests/unit/test_nurbs \
    tests/unit/test_shape_contacts \
    tests/unit/test_loop \
    tests/unit/test_subdivision \
    tests/unit/test_tightness

# What types are judged by, and instances of them.
type_oracle = tests/support/oracle_number.c tests/support/oracle_number.h \
    tests/support/type_oracle.c tests/support/type_oracle.h \
    tests/support/shape_oracle.c tests/support/shape_oracle.h \
    tests/support/polygons.c tests/support/polygons.h \
    tests/support/subdivision_oracle.c \
    tests/support/loop_oracle.c \
    tests/support/expression_oracle.c tests/support/expression_oracle.h \
    tests/support/map_oracle.c tests/support/map_oracle.h \
    tests/support/instance.c tests/support/instance.h
# All functions of the public headers.
tests_unit_test_api_SOURCES = tests/unit/test_api.c
nodist_tests_unit_test_api_SOURCES = tests/unit/api_table.h
tests/unit/test_api.$(OBJEXT): tests/unit/api_table.h
tests/unit/api_table.h: tests/support/api_table.awk $(core_include_HEADERS)
	@$(MKDIR_P) tests/unit
	$(AM_V_GEN)$(AWK) -f $(srcdir)/tests/support/api_table.awk \
	  $(core_include_HEADERS:%=$(srcdir)/%) >$@.part && mv $@.part $@
CLEANFILES += tests/unit/api_table.h
EXTRA_DIST += tests/support/api_table.awk
tests_unit_test_scene_judge_SOURCES = tests/unit/test_scene_judge.c tests/fuzz/scene_judge.c \
    tests/fuzz/scene_judge.h
# Scenes of many bodies, for programs and for the command.
tests_unit_test_parallel_SOURCES = tests/unit/test_parallel.c tools/bench/crowd.c tools/bench/crowd.h
tests_unit_test_crowds_SOURCES = tests/unit/test_crowds.c tools/bench/crowd.c tools/bench/crowd.h
tests_unit_test_parts_SOURCES = tests/unit/test_parts.c tools/bench/crowd.c tools/bench/crowd.h
tests_support_crowd_scene_SOURCES = tests/support/crowd_scene.c tools/bench/crowd.c
tests_support_crowd_scene_LDADD = -lm
check_PROGRAMS += tests/support/crowd_scene
tests_unit_test_mesh_SOURCES = tests/unit/test_mesh.c \
    tools/view/allowance.c tools/view/allowance.h tools/view/mesh.c tools/view/mesh.h \
    tools/view/mesh_cell.c tools/view/mesh_cell.h tools/view/mesh_grid.c tools/view/mesh_grid.h \
    tools/view/mesh_points.c tools/view/mesh_steps.c
tests_unit_test_palette_SOURCES = tests/unit/test_palette.c \
    tools/view/palette.c tools/view/palette.h tools/view/raster.h
tests_unit_test_keyframes_SOURCES = tests/unit/test_keyframes.c tests/support/map_images.h $(type_oracle)
tests_unit_test_nested_SOURCES = tests/unit/test_nested.c $(type_oracle) \
    tests/support/judge.c tests/support/judge.h \
    tests/support/sampling.c tests/support/sampling.h
tests_unit_test_nets_SOURCES = tests/unit/test_nets.c tests/support/netted.h \
    tests/support/oracle_number.c tests/support/judge.c tests/support/judge.h
tests_unit_test_net_paraboloid_SOURCES = tests/unit/test_net_paraboloid.c tests/support/netted.h \
    tests/support/oracle_number.c tests/support/judge.c tests/support/judge.h
tests_unit_test_net_halves_SOURCES = tests/unit/test_net_halves.c tests/support/netted.h \
    tests/support/oracle_number.c tests/support/judge.c tests/support/judge.h
tests_unit_test_net_offers_SOURCES = tests/unit/test_net_offers.c tests/support/netted.h \
    tests/support/oracle_number.c tests/support/judge.c tests/support/judge.h
tests_unit_test_net_models_SOURCES = tests/unit/test_net_models.c tests/support/netted.h \
    tests/support/oracle_number.c tests/support/judge.c tests/support/judge.h
tests_unit_test_net_series_SOURCES = tests/unit/test_net_series.c tests/support/netted.h \
    tests/support/oracle_number.c tests/support/judge.c tests/support/judge.h
tests_unit_test_poses_SOURCES = tests/unit/test_poses.c \
    tests/support/oracle_number.c tests/support/judge.c tests/support/judge.h
tests_unit_test_maps_SOURCES = tests/unit/test_maps.c tests/support/map_images.h $(type_oracle)
tests_unit_test_shapes_SOURCES = tests/unit/test_shapes.c $(type_oracle)
tests_unit_test_nurbs_SOURCES = tests/unit/test_nurbs.c $(type_oracle)
tests_unit_test_shape_contacts_SOURCES = tests/unit/test_shape_contacts.c $(type_oracle)
tests_unit_test_loop_SOURCES = tests/unit/test_loop.c $(type_oracle)
tests_unit_test_subdivision_SOURCES = tests/unit/test_subdivision.c $(type_oracle)
tests_unit_test_tightness_SOURCES = tests/unit/test_tightness.c $(type_oracle)
tests_unit_test_distances_SOURCES = tests/unit/test_distances.c $(type_oracle) \
    tests/support/nearest.c tests/support/nearest.h \
    tests/support/judge.c tests/support/judge.h \
    tests/support/sampling.c tests/support/sampling.h
tests_unit_test_plugins_SOURCES = tests/unit/test_plugins.c $(type_oracle) \
    tests/support/judge.c tests/support/judge.h \
    tests/support/sampling.c tests/support/sampling.h
# The checker's own arithmetic, which the command keeps to itself.
tests_unit_test_checker_SOURCES = tests/unit/test_checker.c \
    tests/support/expression_oracle.c tests/support/oracle_number.c
tests_unit_test_checker_LDADD = tools/libproof.la $(LDADD)
tests_unit_test_certificate_nets_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_unit_test_certificate_nets_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_kernel_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_certificates_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_unit_test_certificates_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_certificate_round_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_unit_test_certificate_round_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_certificate_turns_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_unit_test_certificate_turns_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_certificate_orbits_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_unit_test_certificate_orbits_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_certificate_parts_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_unit_test_certificate_parts_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_certificate_changes_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_unit_test_certificate_changes_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_expression_bounds_SOURCES = tests/unit/test_expression_bounds.c \
    tests/support/expression_oracle.c tests/support/oracle_number.c tests/support/judge.c tests/support/sampling.c
tests_unit_test_expression_bounds_LDADD = plugins/libexpression.la $(LDADD)
tests_unit_test_coils_LDADD = plugins/libexpression.la $(LDADD)
tests_unit_test_turned_LDADD = plugins/libexpression.la plugins/libcommon.la $(LDADD)
tests_unit_test_round_nets_LDADD = plugins/libpatch.la plugins/libcommon.la $(LDADD)
tests_unit_test_round_profiles_LDADD = plugins/libpatch.la plugins/libcommon.la $(LDADD)

# Command-line tests; the environment below tells them where things are.
bats_suites = \
    tests/cli/bench.bats \
    tests/cli/bezier_triangle.bats \
    tests/cli/bodies.bats \
    tests/cli/check.bats \
    tests/cli/check_manners.bats \
    tests/cli/check_proofs.bats \
    tests/cli/cli.bats \
    tests/cli/certificates.bats \
    tests/cli/certificates_kernel.bats \
    tests/cli/certificates_parameters.bats \
    tests/cli/clearance.bats \
    tests/cli/completion.bats \
    tests/cli/cli_batch.bats \
    tests/cli/cli_list.bats \
    tests/cli/cli_pair.bats \
    tests/cli/readme.bats \
    tests/cli/cli_solve.bats \
    tests/cli/files.bats \
    tests/cli/host.bats \
    tests/cli/host_cache.bats \
    tests/cli/host_lies.bats \
    tests/cli/hostile.bats \
    tests/cli/hostile_hangs.bats \
    tests/cli/json_errors.bats \
    tests/cli/matrix.bats \
    tests/cli/mesh.bats \
    tests/cli/mpi.bats \
    tests/cli/memory.bats \
    tests/cli/python.bats \
    tests/cli/page.bats \
    tests/cli/parameters.bats \
    tests/cli/parameters_view.bats \
    tests/cli/series.bats \
    tests/cli/simulate.bats \
    tests/cli/simulate_rest.bats \
    tests/cli/simulate_scenes.bats \
    tests/cli/subdivision.bats \
    tests/cli/tables.bats \
    tests/cli/times.bats \
    tests/cli/plot.bats \
    tests/cli/progress.bats \
    tests/cli/view.bats \
    tests/cli/why.bats

# Tests of the release, which take as long as all others and are run by check-all only.
release_suites = tests/cli/release.bats

# Tests of the sources, the scripts and the installation.
script_suites = \
    tests/cli/install.bats \
    tests/cli/manuals.bats \
    tests/cli/structure.bats \
    tests/cli/sdk.bats \
    tests/cli/sdk_abi.bats \
    tests/cli/sdk_build.bats \
    tests/cli/sdk_new.bats \
    tests/cli/preparation.bats

# Plugins for the tests of the loader, mostly faulty: tests/plugins/NAME.la is built from
# tests/plugins/NAME.c. Never installed; -rpath makes libtool build a shared object all the same.
check_LTLIBRARIES = \
    tests/plugins/bad_name.la \
    tests/plugins/bad_parameter_table.la \
    tests/plugins/bad_parts.la \
    tests/plugins/parts_unread.la \
    tests/plugins/constructor_aborts.la \
    tests/plugins/constructor_crashes.la \
    tests/plugins/constructor_exits.la \
    tests/plugins/constructor_hangs.la \
    tests/plugins/constructor_overwrites.la \
    tests/plugins/create_crashes.la \
    tests/plugins/create_fails.la \
    tests/plugins/create_null.la \
    tests/plugins/create_overflows.la \
    tests/plugins/create_rounds.la \
    tests/plugins/distance_infinite.la \
    tests/plugins/distance_nan.la \
    tests/plugins/symmetry_alone.la \
    tests/plugins/symmetry_nan.la \
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
    tests/plugins/hostile.la \
    tests/plugins/include_inverted.la \
    tests/plugins/include_lies.la \
    tests/plugins/include_sinks.la \
    tests/plugins/include_negative.la \
    tests/plugins/include_rounds.la \
    tests/plugins/kit.la \
    tests/plugins/liar_beyond.la \
    tests/plugins/liar_corners.la \
    tests/plugins/liar_counter.la \
    tests/plugins/liar_crash.la \
    tests/plugins/liar_distance.la \
    tests/plugins/liar_distance_remainder.la \
    tests/plugins/liar_symmetry.la \
    tests/plugins/tube_of_v.la \
    tests/plugins/liar_tube.la \
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
    tests/plugins/liar_net.la \
    tests/plugins/liar_percent.la \
    tests/plugins/liar_range.la \
    tests/plugins/liar_refusal.la \
    tests/plugins/liar_remainder.la \
    tests/plugins/liar_renew.la \
    tests/plugins/renew_leaks.la \
    tests/plugins/renew_notes.la \
    tests/plugins/renew_overflows.la \
    tests/plugins/renew_rounds_up.la \
    tests/plugins/liar_rounding.la \
    tests/plugins/liar_sign.la \
    tests/plugins/liar_single.la \
    tests/plugins/liar_spot.la \
    tests/plugins/liar_time.la \
    tests/plugins/liar_truthful.la \
    tests/plugins/liar_truthful_distance.la \
    tests/plugins/liar_truthful_symmetry.la \
    tests/plugins/liar_truthful_tube.la \
    tests/plugins/liar_truthful_screw.la \
    tests/plugins/liar_screw_hand.la \
    tests/plugins/liar_screw_crack.la \
    tests/plugins/liar_screw_wavy.la \
    tests/plugins/liar_screw_slit.la \
    tests/plugins/liar_screw.la \
    tests/plugins/liar_truthful_net.la \
    tests/plugins/map_rate_negative.la \
    tests/plugins/mistakes_bounds.la \
    tests/plugins/mistakes_distance.la \
    tests/plugins/mistakes_manners.la \
    tests/plugins/mistakes_map.la \
    tests/plugins/mistakes_pieces.la \
    tests/plugins/mistakes_parts.la \
    tests/plugins/mistakes_pose.la \
    tests/plugins/mistakes_formula.la \
    tests/plugins/mistakes_stated.la \
    tests/plugins/net_nan.la \
    tests/plugins/newer_minor.la \
    tests/plugins/no_entry.la \
    tests/plugins/no_factory.la \
    tests/plugins/no_note.la \
    tests/plugins/note_disagrees.la \
    tests/plugins/null_callback.la \
    tests/plugins/null_string.la \
    tests/plugins/pieces.la \
    tests/plugins/pieces_change.la \
    tests/plugins/pieces_half.la \
    tests/plugins/pieces_lie.la \
    tests/plugins/pieces_many.la \
    tests/plugins/pieces_none.la \
    tests/plugins/pieces_null.la \
    tests/plugins/pieces_times.la \
    tests/plugins/pipe_absent.la \
    tests/plugins/rate_infinite.la \
    tests/plugins/rate_lies.la \
    tests/plugins/rate_negative.la \
    tests/plugins/twin.la \
    tests/plugins/undefined_symbol.la \
    tests/plugins/wrong_abi_major.la \
    tests/support/fail_allocation.la
test_plugin_ldflags = -module -avoid-version -shared -rpath /nowhere
tests_plugins_fast_math_la_LDFLAGS = $(test_plugin_ldflags) -Wc,-ffast-math
tests_support_fail_allocation_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_bad_name_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_bad_parameter_table_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_bad_parts_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_parts_unread_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_constructor_aborts_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_constructor_crashes_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_constructor_exits_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_constructor_hangs_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_constructor_overwrites_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_create_crashes_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_create_fails_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_create_null_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_create_overflows_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_create_rounds_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_distance_infinite_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_distance_nan_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_symmetry_alone_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_symmetry_nan_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_domain_crashes_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_domain_nan_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_domain_rounds_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_eval_aborts_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_eval_crashes_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_eval_error_negative_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_eval_exits_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_eval_hangs_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_eval_nan_late_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_eval_overflows_stack_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_eval_rounds_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_fp_mode_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_half_bad_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_hostile_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_include_inverted_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_include_lies_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_include_sinks_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_include_negative_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_include_rounds_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_kit_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_beyond_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_corners_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_counter_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_crash_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_distance_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_distance_remainder_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_symmetry_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_tube_of_v_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_tube_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_errno_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_error_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_exports_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_factory_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_grid_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_hang_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_renew_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_renew_leaks_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_renew_notes_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_renew_overflows_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_renew_rounds_up_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_leak_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_map_rate_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_model_time_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_nan_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_net_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_percent_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_range_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_refusal_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_remainder_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_rounding_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_sign_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_single_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_spot_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_time_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_truthful_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_truthful_distance_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_truthful_symmetry_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_truthful_tube_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_truthful_screw_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_screw_hand_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_screw_crack_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_screw_wavy_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_screw_slit_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_screw_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_liar_truthful_net_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_map_rate_negative_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_bounds_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_distance_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_manners_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_map_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_pieces_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_parts_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_pose_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_formula_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_mistakes_stated_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_net_nan_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_newer_minor_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_no_entry_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_no_factory_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_no_note_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_note_disagrees_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_null_callback_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_null_string_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pieces_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pieces_change_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pieces_half_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pieces_lie_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pieces_many_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pieces_none_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pieces_null_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pieces_times_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_pipe_absent_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_rate_infinite_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_rate_lies_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_rate_negative_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_twin_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_undefined_symbol_la_LDFLAGS = $(test_plugin_ldflags)
tests_plugins_wrong_abi_major_la_LDFLAGS = $(test_plugin_ldflags)
$(check_LTLIBRARIES): LIBS = -lm

# Suites that fail every allocation in turn.
alloc_failure_ldflags = -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=free \
    -Wl,--wrap=strdup,--wrap=strndup
tests_unit_test_alloc_failure_SOURCES = tests/unit/test_alloc_failure.c tests/support/alloc_failure.c
tests_unit_test_alloc_failure_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_linked_in_SOURCES = tests/unit/test_linked_in.c tests/support/alloc_failure.c
tests_unit_test_linked_in_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_aside_SOURCES = tests/unit/test_aside.c tests/support/alloc_failure.c
tests_unit_test_aside_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_held_SOURCES = tests/unit/test_held.c tests/support/alloc_failure.c
tests_unit_test_held_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_set_values_SOURCES = tests/unit/test_set_values.c tests/support/alloc_failure.c
tests_unit_test_set_values_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_steady_state_SOURCES = tests/unit/test_steady_state.c tests/support/alloc_failure.c \
    tools/check/malloc_watch.c
tests_unit_test_steady_state_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_half_planes_SOURCES = tests/unit/test_half_planes.c tests/support/alloc_failure.c
tests_unit_test_half_planes_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_proof_memory_SOURCES = tests/unit/test_proof_memory.c tests/support/alloc_failure.c
tests_unit_test_proof_memory_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_unit_test_proof_memory_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_proof_memory_LDADD = tools/libverify.la $(LDADD)
tests_unit_test_query_memory_SOURCES = tests/unit/test_query_memory.c tests/support/alloc_failure.c
tests_unit_test_query_memory_LDFLAGS = $(alloc_failure_ldflags)

# The language of formulas.
tests_unit_test_expression_SOURCES = tests/unit/test_expression.c tests/support/expression_kit.h \
    tests/support/alloc_failure.c
tests_unit_test_expression_LDFLAGS = $(alloc_failure_ldflags)
tests_unit_test_impacts_LDADD = tools/libtools.a $(LDADD)
tests_unit_test_lanes_LDADD = plugins/libpatch.la $(LDADD)
tests_unit_test_mesh_files_LDADD = plugins/libmesh.la $(LDADD)
tests_unit_test_gltf_files_LDADD = plugins/libmesh.la $(LDADD)
tests_unit_test_mesh_text_LDADD = plugins/libmesh.la $(LDADD)
tests_unit_test_expression_LDADD = plugins/libexpression.la $(LDADD)
tests_unit_test_expression_faults_LDADD = plugins/libexpression.la $(LDADD)

# One scene told in many ways.
tests_unit_test_clearance_SOURCES = tests/unit/test_clearance.c tests/support/scene_variants.c
tests_unit_test_clearance_required_SOURCES = tests/unit/test_clearance_required.c \
    tests/support/scene_variants.c
tests_unit_test_clearance_steps_SOURCES = tests/unit/test_clearance_steps.c \
    tests/support/scene_variants.c
tests_unit_test_time_descent_SOURCES = tests/unit/test_time_descent.c tests/support/scene_variants.c
tests_unit_test_guarantees_SOURCES = tests/unit/test_guarantees.c tests/support/scene_variants.c
tests_unit_test_metamorphic_SOURCES = tests/unit/test_metamorphic.c tests/support/scene_variants.c
tests_unit_test_steps_SOURCES = tests/unit/test_steps.c tests/support/scene_variants.c

# Models and their exact meaning, side by side.
tests_unit_test_formula_SOURCES = tests/unit/test_formula.c tests/support/oracle.c
tests_unit_test_model_SOURCES = tests/unit/test_model.c tests/support/oracle.c

noinst_HEADERS += \
    tests/plugins/liar.h \
    tests/plugins/tiny.h \
    tests/support/alloc_failure.h \
    tests/support/array_scene.h \
    tests/support/ball_queries.h \
    tests/support/box_stacks.h \
    tests/support/built_plugins.h \
    tests/support/chain_helpers.h \
    tests/support/clearance_helpers.h \
    tests/support/comma_locale.h \
    tests/support/compose.h \
    tests/support/edge_nodes.h \
    tests/support/failing_query.h \
    tests/support/formula_surface.h \
    tests/support/isolated_bowl.h \
    tests/support/kit_registry.h \
    tests/support/made_certificate.h \
    tests/support/made_texts.h \
    tests/support/meeting.h \
    tests/support/meeting_nodes.h \
    tests/support/mesh_bytes.h \
    tests/support/model_value.h \
    tests/support/net_distance.h \
    tests/support/oracle.h \
    tests/support/pose_descent.h \
    tests/support/query_helpers.h \
    tests/support/read_statement.h \
    tests/support/rough_sheets.h \
    tests/support/same_json.h \
    tests/support/sandbox.h \
    tests/support/scene_text.h \
    tests/support/scene_variants.h \
    tests/support/shape_points.h \
    tests/support/side_trial.h \
    tests/support/slip_helpers.h \
    tests/support/solid_helpers.h \
    tests/support/sphere_scenes.h \
    tests/support/suite.h \
    tests/support/survey_helpers.h \
    tests/support/survey_scenes.h \
    tests/support/told_boxes.h
noinst_HEADERS += \
    tests/plugins/coil.h \
    tests/plugins/mistakes.h \
    tests/plugins/pipe.h \
    tests/plugins/slab.h \
    tests/plugins/slack_net.h \
    tests/plugins/stack.h

# Fuzz targets, run on the inputs of their folders; tests/fuzz/run searches for more.
# Plugins call its __cxa_finalize.
tests_fuzz_elf_LDFLAGS = $(AM_LDFLAGS) -export-dynamic
tests_fuzz_elf_SOURCES = tests/fuzz/elf.c tests/fuzz/elf_changes.c tests/fuzz/elf_changes.h \
    tests/fuzz/replay.c tests/fuzz/fuzz.h
tests_fuzz_api_SOURCES = tests/fuzz/api.c tests/fuzz/replay.c tests/fuzz/fuzz_registry.h
tests_fuzz_array_SOURCES = tests/fuzz/array.c tests/fuzz/replay.c tests/fuzz/fuzz_file.h
tests_fuzz_array_LDADD = $(LDADD) $(JANSSON_LIBS)
tests_fuzz_cache_SOURCES = tests/fuzz/cache.c tests/fuzz/replay.c tests/fuzz/fuzz_mutate.h
tests_fuzz_certificate_SOURCES = tests/fuzz/certificate.c tests/fuzz/replay.c
tests_fuzz_certificate_CPPFLAGS = $(AM_CPPFLAGS) -DPROOF_DOUBLE
tests_fuzz_certificate_LDADD = tools/libverify.la $(LDADD)
tests_fuzz_kernel_SOURCES = tests/fuzz/kernel.c tests/fuzz/replay.c
tests_fuzz_kernel_LDADD = tools/libverify.la $(LDADD)
tests_fuzz_csv_SOURCES = tests/fuzz/csv.c tests/fuzz/replay.c tests/fuzz/fuzz_file.h
tests_fuzz_csv_LDADD = plugins/libcommon.la $(LDADD)
tests_fuzz_json_SOURCES = tests/fuzz/json.c tests/fuzz/replay.c tests/support/same_json.h
tests_fuzz_json_LDADD = $(LDADD) $(JANSSON_LIBS)
tests_fuzz_mesh_SOURCES = tests/fuzz/mesh.c tests/fuzz/replay.c
tests_fuzz_mesh_LDADD = plugins/libsubdivision.la plugins/libpatch.la plugins/libmesh.la $(LDADD)
tests_fuzz_picture_SOURCES = tests/fuzz/picture.c tests/fuzz/replay.c
tests_fuzz_picture_LDADD = $(tools_libs)
tests_fuzz_picture_LDFLAGS = $(AM_LDFLAGS) -Wl,--wrap=build_tree_data
tests_fuzz_pipeline_SOURCES = tests/fuzz/pipeline.c tests/fuzz/replay.c tests/fuzz/fuzz_registry.h
tests_fuzz_pipeline_LDADD = $(LDADD) $(JANSSON_LIBS)
tests_fuzz_proof_SOURCES = tests/fuzz/proof.c tests/fuzz/replay.c
tests_fuzz_proof_LDADD = plugins/libexpression.la tools/libproof.la $(LDADD)
tests_fuzz_formula_SOURCES = tests/fuzz/formula.c tests/fuzz/replay.c
tests_fuzz_formula_LDADD = plugins/libexpression.la tools/libproof.la $(LDADD)
tests_fuzz_scene_SOURCES = tests/fuzz/scene.c tests/fuzz/scene_judge.c tests/fuzz/scene_judge.h \
    tests/fuzz/replay.c

# What tests/fuzz/run builds: libraries that tell libFuzzer what runs, and plugins that do not.
.PHONY: fuzz-libraries fuzz-plugins
fuzz_verify =
if HAVE_MPFI
fuzz_verify += tools/libverify.la tools/libkernel.la
endif
fuzz-libraries: core/libcore.la tools/libproof.la $(fuzz_verify) plugins/libexpression.la \
    plugins/libcommon.la \
    plugins/libmesh.la plugins/libsubdivision.la plugins/libpatch.la tools/libtools.a \
    tools/built-data/page.html $(plugin_LTLIBRARIES)
fuzz-plugins: $(check_LTLIBRARIES)
EXTRA_DIST += \
    tests/fuzz/api.d/distance \
    tests/fuzz/api.d/divided \
    tests/fuzz/api.d/random \
    tests/fuzz/api.d/refined \
    tests/fuzz/array.d/columns \
    tests/fuzz/array.d/deflated \
    tests/fuzz/array.d/lists \
    tests/fuzz/array.d/plain \
    tests/fuzz/array.d/stored \
    tests/fuzz/array.d/whole \
    tests/fuzz/array.dict \
    tests/fuzz/cache.d/codes \
    tests/fuzz/cache.d/cut \
    tests/fuzz/cache.d/empty \
    tests/fuzz/cache.d/large_numbers \
    tests/fuzz/cache.d/no_reason \
    tests/fuzz/cache.d/nul \
    tests/fuzz/cache.d/other_version \
    tests/fuzz/cache.d/relative \
    tests/fuzz/cache.d/tabs \
    tests/fuzz/cache.d/two_lines \
    tests/fuzz/cache.dict \
    tests/fuzz/certificate.d/balls \
    tests/fuzz/certificate.d/bowl \
    tests/fuzz/certificate.d/door \
    tests/fuzz/certificate.d/huge \
    tests/fuzz/certificate.d/many_splits \
    tests/fuzz/certificate.d/parts \
    tests/fuzz/certificate.d/roofs \
    tests/fuzz/certificate.d/unsaid \
    tests/fuzz/certificate.d/values \
    tests/fuzz/certificate.dict \
    tests/fuzz/csv.d/blanks \
    tests/fuzz/csv.d/by_name \
    tests/fuzz/csv.d/empty \
    tests/fuzz/csv.d/few \
    tests/fuzz/csv.d/long_number \
    tests/fuzz/csv.d/mark \
    tests/fuzz/csv.d/nul \
    tests/fuzz/csv.d/old_line_ends \
    tests/fuzz/csv.d/overflow \
    tests/fuzz/csv.d/plain \
    tests/fuzz/csv.d/quotes \
    tests/fuzz/csv.d/word \
    tests/fuzz/csv.dict \
    tests/fuzz/elf.d/calls_malloc \
    tests/fuzz/elf.d/class \
    tests/fuzz/elf.d/constructor_wrong \
    tests/fuzz/elf.d/constructor_wrong_too \
    tests/fuzz/elf.d/cut \
    tests/fuzz/elf.d/cut_header \
    tests/fuzz/elf.d/cut_to_nothing \
    tests/fuzz/elf.d/dynamic_address \
    tests/fuzz/elf.d/dynamic_gone \
    tests/fuzz/elf.d/dynamic_hash \
    tests/fuzz/elf.d/dynamic_init \
    tests/fuzz/elf.d/dynamic_strtab \
    tests/fuzz/elf.d/dynamic_tag \
    tests/fuzz/elf.d/entry \
    tests/fuzz/elf.d/handle_lost \
    tests/fuzz/elf.d/kind \
    tests/fuzz/elf.d/machine \
    tests/fuzz/elf.d/magic \
    tests/fuzz/elf.d/note_major \
    tests/fuzz/elf.d/note_name \
    tests/fuzz/elf.d/note_size \
    tests/fuzz/elf.d/order \
    tests/fuzz/elf.d/overlap \
    tests/fuzz/elf.d/overlap_two_files \
    tests/fuzz/elf.d/phentsize \
    tests/fuzz/elf.d/phnum \
    tests/fuzz/elf.d/phoff \
    tests/fuzz/elf.d/relocation_addend \
    tests/fuzz/elf.d/relocation_constructor \
    tests/fuzz/elf.d/relocation_far \
    tests/fuzz/elf.d/relocation_kind \
    tests/fuzz/elf.d/segment_address \
    tests/fuzz/elf.d/segment_align \
    tests/fuzz/elf.d/segment_size \
    tests/fuzz/elf.d/segment_type \
    tests/fuzz/elf.d/segment_wraps \
    tests/fuzz/elf.d/shnum \
    tests/fuzz/elf.d/shoff \
    tests/fuzz/elf.d/symbol_name \
    tests/fuzz/elf.d/symbol_name_far \
    tests/fuzz/elf.d/symbol_value \
    tests/fuzz/elf.d/text \
    tests/fuzz/elf.d/unchanged \
    tests/fuzz/elf.d/version \
    tests/fuzz/formula.d/deep.txt \
    tests/fuzz/formula.d/functions.txt \
    tests/fuzz/formula.d/kinks.txt \
    tests/fuzz/formula.d/lines.txt \
    tests/fuzz/formula.d/more.txt \
    tests/fuzz/formula.d/open.txt \
    tests/fuzz/formula.d/overflow.txt \
    tests/fuzz/formula.d/smooth.txt \
    tests/fuzz/formula.d/steep_power.txt \
    tests/fuzz/formula.d/zero.txt \
    tests/fuzz/formula.dict \
    tests/fuzz/json.d/nested \
    tests/fuzz/json.d/numbers \
    tests/fuzz/json.d/refused \
    tests/fuzz/json.d/scene \
    tests/fuzz/json.d/strings \
    tests/fuzz/json.d/twice \
    tests/fuzz/json.dict \
    tests/fuzz/kernel.d/balls \
    tests/fuzz/kernel.d/bowl \
    tests/fuzz/kernel.d/bowl_elaborated \
    tests/fuzz/kernel.d/huge \
    tests/fuzz/kernel.d/many_splits \
    tests/fuzz/kernel.d/parts \
    tests/fuzz/kernel.d/roofs \
    tests/fuzz/kernel.d/roofs_elaborated \
    tests/fuzz/kernel.dict \
    tests/fuzz/mesh.d/empty \
    tests/fuzz/mesh.d/glb_plain \
    tests/fuzz/mesh.d/gltf_cycle \
    tests/fuzz/mesh.d/gltf_text \
    tests/fuzz/mesh.d/obj_back \
    tests/fuzz/mesh.d/obj_bent \
    tests/fuzz/mesh.d/obj_beyond \
    tests/fuzz/mesh.d/obj_concave \
    tests/fuzz/mesh.d/obj_continued \
    tests/fuzz/mesh.d/obj_cube \
    tests/fuzz/mesh.d/obj_ears \
    tests/fuzz/mesh.d/obj_huge_index \
    tests/fuzz/mesh.d/obj_nan \
    tests/fuzz/mesh.d/obj_nul \
    tests/fuzz/mesh.d/obj_patch \
    tests/fuzz/mesh.d/obj_plain \
    tests/fuzz/mesh.d/obj_star \
    tests/fuzz/mesh.d/obj_two_fans \
    tests/fuzz/mesh.d/off_cut \
    tests/fuzz/mesh.d/off_huge_count \
    tests/fuzz/mesh.d/off_huge_face \
    tests/fuzz/mesh.d/off_more \
    tests/fuzz/mesh.d/off_one_line_head \
    tests/fuzz/mesh.d/off_plain \
    tests/fuzz/mesh.d/ply_big \
    tests/fuzz/mesh.d/ply_huge_list \
    tests/fuzz/mesh.d/ply_little \
    tests/fuzz/mesh.d/ply_text \
    tests/fuzz/mesh.d/stl_binary \
    tests/fuzz/mesh.d/stl_binary_count \
    tests/fuzz/mesh.d/stl_binary_cut \
    tests/fuzz/mesh.d/stl_binary_nan \
    tests/fuzz/mesh.d/stl_text \
    tests/fuzz/mesh.d/stl_text_cut \
    tests/fuzz/mesh.dict \
    tests/fuzz/picture.d/cut \
    tests/fuzz/picture.d/events_html \
    tests/fuzz/picture.d/far_svg \
    tests/fuzz/picture.d/meet_glb \
    tests/fuzz/picture.d/meet_html \
    tests/fuzz/picture.d/meet_obj \
    tests/fuzz/picture.d/meet_png \
    tests/fuzz/picture.d/meet_svg \
    tests/fuzz/picture.d/meet_vtu \
    tests/fuzz/picture.d/result \
    tests/fuzz/picture.d/sheet_glb \
    tests/fuzz/picture.d/sheet_html \
    tests/fuzz/pipeline.d/all_kinds.txt \
    tests/fuzz/pipeline.d/blanks.txt \
    tests/fuzz/pipeline.d/brackets.txt \
    tests/fuzz/pipeline.d/creates.txt \
    tests/fuzz/pipeline.d/empty_stage.txt \
    tests/fuzz/pipeline.d/huge.txt \
    tests/fuzz/pipeline.d/liberties.txt \
    tests/fuzz/pipeline.d/no_value.txt \
    tests/fuzz/pipeline.d/not_utf8.txt \
    tests/fuzz/pipeline.d/open.txt \
    tests/fuzz/pipeline.d/stage_map.txt \
    tests/fuzz/pipeline.d/twice.txt \
    tests/fuzz/pipeline.d/unknown.txt \
    tests/fuzz/pipeline.dict \
    tests/fuzz/proof.d/bad.txt \
    tests/fuzz/proof.d/composed.txt \
    tests/fuzz/proof.d/constants.txt \
    tests/fuzz/proof.d/deep.txt \
    tests/fuzz/proof.d/definitions.txt \
    tests/fuzz/proof.d/divisor_small.txt \
    tests/fuzz/proof.d/edges.txt \
    tests/fuzz/proof.d/kinks.txt \
    tests/fuzz/proof.d/overflow.txt \
    tests/fuzz/proof.d/parts.txt \
    tests/fuzz/proof.d/parts_bad.txt \
    tests/fuzz/proof.d/powers.txt \
    tests/fuzz/proof.d/signs.txt \
    tests/fuzz/proof.d/smooth.txt \
    tests/fuzz/proof.d/underflow.txt \
    tests/fuzz/proof.d/varying_exponent.txt \
    tests/fuzz/proof.d/whole_exponents.txt \
    tests/fuzz/proof.dict \
    tests/fuzz/scene.d/all_kinds.json \
    tests/fuzz/scene.d/bad_shapes.json \
    tests/fuzz/scene.d/bar.txt \
    tests/fuzz/scene.d/deep.json \
    tests/fuzz/scene.d/formula_sheet.txt \
    tests/fuzz/scene.d/huge.txt \
    tests/fuzz/scene.d/kit.txt \
    tests/fuzz/scene.d/nested_maps.txt \
    tests/fuzz/scene.d/not_utf8.json \
    tests/fuzz/scene.d/numbers.txt \
    tests/fuzz/scene.d/patch.json \
    tests/fuzz/scene.d/quotes.txt \
    tests/fuzz/scene.d/sphere.txt \
    tests/fuzz/scene.d/tiny_gap.txt \
    tests/fuzz/scene.d/two_pipelines.txt \
    tests/fuzz/scene.d/undefined.txt \
    tests/fuzz/scene.dict \
    tests/fuzz/run

LDADD = core/libcore.la $(CHECK_LIBS) $(MPFI_LIBS) -lm

TESTS =
without_check =
without_mpfi =
without_bats =
# The longest first, so that no processor waits for them at the end.
if HAVE_CHECK
if HAVE_MPFI
check_PROGRAMS += $(mpfi_suites)
TESTS += $(mpfi_suites)
else
without_mpfi += $(mpfi_suites)
endif
endif
if HAVE_BATS
TESTS += $(script_suites) $(bats_suites)
else
without_bats += $(bats_suites) $(script_suites)
endif
if HAVE_CHECK
check_PROGRAMS += $(check_suites)
TESTS += $(check_suites)
else
without_check += $(check_suites) $(mpfi_suites)
endif

check-local:
	@for suite in $(without_check); do echo "SKIP: $$suite (Check not found)"; done
	@for suite in $(without_mpfi); do echo "SKIP: $$suite (MPFI not found)"; done
	@for suite in $(without_bats); do echo "SKIP: $$suite (bats or jq not found)"; done

# IMPINGE is the command to test: the program itself, which starts in a tenth of the time of libtool's script
# before it. The user's own plugins stay out of it. Property tests draw a quarter of what check-all draws.
TEST_EXTENSIONS = .bats
suite_timed = $(top_srcdir)/tests/support/timed
LOG_COMPILER = $(suite_timed)
BATS_LOG_COMPILER = $(suite_timed) $(BATS) --tap
AM_TESTS_ENVIRONMENT = \
    IMPINGE='$(abs_top_builddir)/tools/impinge'; \
    if test -x '$(abs_top_builddir)/tools/.libs/impinge'; then \
      IMPINGE='$(abs_top_builddir)/tools/.libs/impinge'; \
      LD_LIBRARY_PATH='$(abs_top_builddir)/.libs'; export LD_LIBRARY_PATH; \
    fi; export IMPINGE; \
    IMPINGE_TEST_MULTIPLIER="$${IMPINGE_TEST_MULTIPLIER-0.25}"; export IMPINGE_TEST_MULTIPLIER; \
    top_srcdir='$(abs_top_srcdir)'; export top_srcdir; \
    top_builddir='$(abs_top_builddir)'; export top_builddir; \
    CC='$(CC)'; export CC; \
    MAKE='$(MAKE)'; export MAKE; \
    PYTHON3='$(PYTHON3)'; export PYTHON3; \
    XDG_DATA_HOME='$(abs_top_builddir)/tests/no-user-data'; export XDG_DATA_HOME; \
    XDG_CACHE_HOME='$(abs_top_builddir)/tests/cache'; export XDG_CACHE_HOME; \
    NODE_PATH="$${NODE_PATH-$(abs_top_srcdir)/build/npm/node_modules}"; export NODE_PATH; \
    unset IMPINGE_PLUGIN_PATH;

# Impinge as its users have it, for suites that use it from elsewhere: configured for a prefix of its own,
# built without optimization, which halves the time, and installed. `files` lists what is installed. Where
# the source folder is configured itself, a copy of it is built.
installed = tests/installed
tests/cli/install.log tests/cli/manuals.log tests/cli/release.log tests/cli/sdk.log \
    tests/cli/sdk_abi.log tests/cli/sdk_build.log tests/cli/sdk_new.log: $(installed)/files
.PHONY: $(installed)/files
$(installed)/files:
	$(AM_V_GEN)unset DESTDIR; source='$(abs_top_srcdir)'; $(MKDIR_P) $(installed)/build && \
	  if test -f "$$source/config.status"; then \
	    source='$(abs_top_builddir)/$(installed)/source' && $(MAKE) -s distdir distdir="$$source"; \
	  fi && cd $(installed)/build && \
	  { test -f config.status || "$$source/configure" -q -C \
	      --prefix='$(abs_top_builddir)/$(installed)/prefix' CC='$(CC)' CFLAGS=-O0; } && \
	  rm -rf ../prefix && $(MAKE) -s install && cd ../prefix && find . | sort >../files

# What suites leave behind.
clean-local: clean-manuals
	rm -rf python-packages
	test ! -d $(installed) || chmod -R u+w $(installed)
	rm -rf $(installed) tests/cache tests/no-user-data

EXTRA_DIST += \
    tests/peers/fcl_overlaps.cc \
    tests/peers/kinematics.py \
    tests/peers/robot_certificates.py \
    tests/peers/robot_speed.py \
    tests/peers/test_robots.py \
    tests/python/support.py \
    tests/python/test_hostile.py \
    tests/python/test_impinge.py \
    tests/python/test_pictures.py \
    tests/python/test_parameters.py \
    tests/python/test_robot.py \
    tests/python/test_robot_command.py \
    tests/python/test_robot_files.py \
    tests/python/test_robot_matrix.py \
    tests/python/test_text.py \
    tests/python/typed.py
EXTRA_DIST += tests/variants tests/distributions tests/support/timed
EXTRA_DIST += $(bats_suites) $(script_suites) $(release_suites) tests/support/include_order \
    tests/support/cli_helper.bash \
    tests/support/comma_locale \
    tests/support/coq_goals.py \
    tests/support/check_helper.bash tests/support/host_helper.bash \
    tests/support/hostile_helper.bash tests/support/sdk_helper.bash \
    tests/support/simulate_helper.bash \
    tests/support/page.js \
    tests/support/schema.jq

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

# The parts of tools/test --all: half of all draws of property tests and the release in the first, a tenth
# with sanitizers, which look for other faults than bounds. With clang the suites in C, which compare bits
# and bounds. With sanitizers also those scripts whose input reaches C in ways of its own: certificates, looks
# of pictures, pages, terminals, files, budgets and many processes are the first part's; suites in C and
# tests/fuzz read certificates and draw pictures with sanitizers. AddressSanitizer handles stack overflows and
# ends of threads itself, before the command can.
# test_lanes.c has all kernels a second time: it takes more than a minute to compile with sanitizers,
# which see these kernels in all other suites. test_tightness.c and test_loosened.c judge how good bounds are:
# these bounds are computed with sanitizers in the suites of types and of queries.
# Sanitizers and clang see no less in programs that are not optimized, which take two thirds of the time to
# compile: what only test programs consist of is made so, once all else is made with the flags of the build.
all_suites = $(if $(filter $(script_suites),$(TESTS)),$(release_suites)) $(TESTS)
clang_suites = $(filter-out %.bats,$(TESTS))
not_sanitized = tests/unit/test_lanes tests/unit/test_loosened tests/unit/test_tightness
sanitized_suites = $(filter-out $(script_suites) $(not_sanitized) \
    $(patsubst %,tests/cli/%.bats,bench certificates certificates_parameters check check_manners \
      check_proofs cli cli_list completion files hostile hostile_hangs host host_cache host_lies matrix mpi \
      page parameters_view plot progress series simulate_rest simulate_scenes view),$(TESTS))
.PHONY: check-all check-clang check-sanitized check-threads
check-all:
	IMPINGE_TEST_MULTIPLIER=$${IMPINGE_TEST_MULTIPLIER-0.5} $(MAKE) check TESTS='$(all_suites)'
check-clang: all
	$(MAKE) CFLAGS='$(CFLAGS) -O0' $(check_PROGRAMS)
	$(MAKE) check TESTS='$(clang_suites)'
check-sanitized: all
	$(MAKE) CFLAGS='$(CFLAGS) -O0' $(filter-out $(not_sanitized),$(check_PROGRAMS))
	IMPINGE_TEST_MULTIPLIER=$${IMPINGE_TEST_MULTIPLIER-0.1} $(MAKE) check TESTS='$(sanitized_suites)' \
	    check_PROGRAMS='$(filter-out $(not_sanitized),$(check_PROGRAMS))'

# How many suites each of these runs, for tools/test.
.PHONY: count-check count-check-all count-check-clang count-check-sanitized
count-check:
	@echo $(words $(TESTS))
count-check-all:
	@echo $(words $(all_suites))
count-check-clang:
	@echo $(words $(clang_suites))
count-check-sanitized:
	@echo $(words $(sanitized_suites))

# With configure --enable-sanitizers=thread: what threads share. Only what these suites need is made. A
# copy made by fork leaves threads unjoined, which are its original's.
thread_suites = tests/unit/test_threads tests/unit/test_isolated_threads tests/unit/test_parallel
thread_types = bezier ellipsoid ripple rotate scale sphere superellipsoid torus translate triangle twist
check-threads: $(thread_types:%=plugins/%.la) $(thread_suites)
	TSAN_OPTIONS="report_thread_leaks=0 $$TSAN_OPTIONS" \
	  $(MAKE) check-TESTS TESTS='$(thread_suites)' check_PROGRAMS= check_LTLIBRARIES=

# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Rooms, bottom-up: a file includes only its own room and rooms above it in this list, which
# tests/support/include_order checks.

core_common = \
    core/common/array.h \
    core/common/c_locale.h \
    core/common/capabilities.c core/common/capabilities.h \
    core/common/child.c core/common/child.h \
    core/common/child_process.c core/common/child_process.h \
    core/common/clock.h \
    core/common/fp_control.h \
    core/common/search_path.c core/common/search_path.h \
    core/common/sha256.c core/common/sha256.h \
    core/common/spelling.c core/common/spelling.h \
    core/common/json_size.h \
    core/common/random.h \
    core/common/system_error.h \
    core/common/tunable.h

core_base = \
    core/impinge/baseline.h core/impinge/examine.h core/impinge/impinge.h \
    core/base/active_callback.c core/base/active_callback.h \
    core/base/arena.c core/base/arena.h \
    core/base/arena_store.c core/base/arena_store.h \
    core/base/file_state.c core/base/file_state.h \
    core/base/file_text.c core/base/file_text.h \
    core/base/hash.h \
    core/base/named_files.c core/base/named_files.h \
    core/base/fp_mode.h \
    core/base/limit_watch.h \
    core/base/json_text.c core/base/json_text.h \
    core/base/place.c core/base/place.h \
    core/base/rounding.h \
    core/base/sized.h \
    core/base/status.c core/base/status.h \
    core/base/text.c core/base/text.h \
    core/base/unconst.h \
    core/base/union_find.c core/base/union_find.h

core_surface = \
    core/surface/aside.c core/surface/aside.h \
    core/surface/aside_look.c core/surface/aside_search.h \
    core/surface/carried.c core/surface/carried.h \
    core/surface/clocked.c core/surface/clocked.h \
    core/surface/commute.c core/surface/commute.h \
    core/surface/formula_text.c core/surface/formula_text.h \
    core/surface/held.c core/surface/held.h core/surface/held_place.c \
    core/surface/held_values.c core/surface/held_values.h \
    core/surface/instance.c core/surface/instance.h \
    core/surface/instance_words.c \
    core/surface/region.c core/surface/region.h \
    core/surface/slip.h core/surface/slip_screw.c \
    core/surface/surface_status.c \
    core/surface/surface.c core/surface/surface.h \
    core/surface/surface_distance.c \
    core/surface/surface_include.c core/surface/surface_internal.h \
    core/surface/surface_motion.c core/surface/surface_net.c core/surface/surface_pose.c \
    core/surface/course.h core/surface/course_line.c core/surface/course_line.h \
    core/surface/feature.c core/surface/feature.h \
    core/surface/glance.c core/surface/glance.h \
    core/surface/half_plane.c core/surface/half_plane.h core/surface/screw_piece.c \
    core/surface/screw_piece.h core/surface/screw_rest.c core/surface/screw_section.c \
    core/surface/screws.h \
    core/surface/surface_course.c core/surface/surface_orbit.c core/surface/surface_pair_slip.c \
    core/surface/surface_rate.c core/surface/surface_slip.c \
    core/surface/time_model.h core/surface/surface_shift.c core/surface/surface_shift.h \
    core/surface/surface_spread.c core/surface/surface_spread.h \
    core/surface/surface_symmetry.c core/surface/surface_tube.c

core_tree = \
    core/tree/bound_audit.c core/tree/bound_audit.h \
    core/tree/distance_audit.c core/tree/distance_audit.h \
    core/tree/hierarchy_build.c core/tree/hierarchy_internal.h \
    core/tree/hierarchy.c core/tree/hierarchy.h \
    core/tree/model_lanes.h \
    core/tree/net.c core/tree/net.h core/tree/net_rows.h \
    core/tree/net_series.c core/tree/net_series.h \
    core/tree/node.c core/tree/node.h \
    core/tree/node_bounds.c \
    core/tree/node_model.c core/tree/node_model.h \
    core/tree/node_net.c \
    core/tree/pose.c core/tree/pose.h core/tree/posed_terms.h \
    core/tree/posing.c core/tree/posing.h \
    core/tree/tree.c core/tree/tree_internal.h \
    core/tree/triple.h \
    core/tree/vec.h

core_plugin = \
    core/plugin/array_file.c core/plugin/array_file.h \
    core/plugin/channel.h \
    core/plugin/elf_dynamic.c core/plugin/elf_dynamic.h \
    core/plugin/elf_file.c core/plugin/elf_file.h \
    core/plugin/elf_places.c \
    core/plugin/elf_probe.c core/plugin/elf_probe.h \
    core/plugin/elf_relocations.c \
    core/plugin/elf_segments.c core/plugin/elf_segments.h \
    core/plugin/elf_symbols.c \
    core/plugin/elf_tables.c core/plugin/elf_tables.h core/plugin/elf_tables_internal.h \
    core/plugin/file_trust.c core/plugin/file_trust.h \
    core/plugin/isolate.c core/plugin/isolate.h core/plugin/isolate_internal.h \
    core/plugin/isolate_ahead.c core/plugin/isolate_stand_in.c \
    core/plugin/json_describe.c core/plugin/json_describe.h \
    core/plugin/kept_instances.c core/plugin/kept_instances.h \
    core/plugin/load_cache.c core/plugin/open_file.h \
    core/plugin/load_probe.c core/plugin/load_probe.h \
    core/plugin/npy_head.c core/plugin/npy_head.h \
    core/plugin/output_guard.c core/plugin/output_guard.h \
    core/plugin/parameter_default.c \
    core/plugin/parameter_numbers.c core/plugin/parameter_numbers.h \
    core/plugin/parameter_table.c core/plugin/parameter_table.h \
    core/plugin/parameter_value.c \
    core/plugin/parameters.c core/plugin/parameters.h core/plugin/parameters_internal.h \
    core/plugin/plugin_check.c core/plugin/plugin_check.h \
    core/plugin/plugin_check_row.c core/plugin/plugin_check_row.h \
    core/plugin/plugin_file.c core/plugin/plugin_file.h \
    core/plugin/reading_limits.h \
    core/plugin/registry.c core/plugin/registry.h \
    core/plugin/registry_internal.h \
    core/plugin/registry_scan.c \
    core/plugin/start_vectors.c core/plugin/start_vectors.h \
    core/plugin/type_view.h \
    core/plugin/value_bytes.c core/plugin/value_bytes.h \
    core/plugin/worker.c core/plugin/worker.h \
    core/plugin/worker_pool.c core/plugin/worker_pool.h \
    core/plugin/worker_create.c core/plugin/worker_internal.h \
    core/plugin/worker_serve.c \
    core/plugin/zip_member.c core/plugin/zip_member.h

core_scene = \
    core/scene/assembly.c core/scene/assembly.h \
    core/scene/default_times.c core/scene/default_times.h \
    core/scene/key_pairs.c core/scene/key_pairs.h \
    core/scene/map_index.c core/scene/map_index.h \
    core/scene/pair_count.c \
    core/scene/posed_scene.c core/scene/posed_scene.h \
    core/scene/scene.c core/scene/scene.h \
    core/scene/scene_change.c core/scene/scene_change.h \
    core/scene/scene_spares.c \
    core/scene/scene_memory.c \
    core/scene/scene_options.c \
    core/scene/scene_formula.c \
    core/scene/scene_groups.c core/scene/scene_internal.h \
    core/scene/scene_parameters.c core/scene/scene_parameters.h \
    core/scene/scene_pieces.c \
    core/scene/scene_remarks.c core/scene/scene_remarks.h \
    core/scene/scene_trees.c core/scene/scene_trees.h \
    core/scene/tolerances.c core/scene/tolerances.h

core_solid = \
    core/solid/closure.c \
    core/solid/components.c core/solid/components.h \
    core/solid/copies.c core/solid/copies.h \
    core/solid/cell_hash.h \
    core/solid/edges.c core/solid/edges.h \
    core/solid/inside.c core/solid/inside.h \
    core/solid/nesting.c \
    core/solid/patches.c core/solid/patches.h \
    core/solid/shared.c core/solid/shared.h \
    core/solid/shell_winding.c core/solid/shell_winding.h \
    core/solid/shells.c core/solid/shells.h \
    core/solid/solid.c core/solid/solid.h core/solid/solid_internal.h \
    core/solid/solid_angle.c core/solid/solid_angle.h \
    core/solid/winding.c core/solid/winding.h

core_bounds = \
    core/bounds/convex_line.c core/bounds/convex_line.h \
    core/bounds/claim_audit.c core/bounds/claim_audit.h \
    core/bounds/difference.c core/bounds/difference.h \
    core/bounds/distance.c core/bounds/distance.h \
    core/bounds/piece_sides.c core/bounds/piece_sides.h \
    core/bounds/piece_corners.c core/bounds/piece_parting.c \
    core/bounds/piece_planes.c core/bounds/piece_planes.h \
    core/bounds/piece_shadow.c core/bounds/piece_shadow.h core/bounds/piece_rings.c \
    core/bounds/distance_ball.c core/bounds/distance_sides.c \
    core/bounds/distance_halving.c core/bounds/distance_halving.h \
    core/bounds/distance_start.c \
    core/bounds/fixed_axes.c core/bounds/fixed_axes.h \
    core/bounds/gap_lines.c core/bounds/gap_lines.h \
    core/bounds/gjk.h \
    core/bounds/gjk_axis.c core/bounds/gjk_axis.h \
    core/bounds/linear_contact.c core/bounds/linear_contact.h \
    core/bounds/moving_boxes.c core/bounds/moving_boxes.h \
    core/bounds/net_axis.c core/bounds/net_axis.h \
    core/bounds/divided_heights.h core/bounds/paraboloid_frame.h \
    core/bounds/net_paraboloid.c core/bounds/net_paraboloid.h \
    core/bounds/net_halves.c core/bounds/net_halves.h \
    core/bounds/net_hull.h \
    core/bounds/net_model_axis.c core/bounds/net_model_axis.h \
    core/bounds/normal_field.c core/bounds/normal_field.h \
    core/bounds/normal_height.c core/bounds/normal_height.h \
    core/bounds/normal_turn.c core/bounds/normal_turn.h \
    core/bounds/dividing_choice.c core/bounds/dividing_choice.h \
    core/bounds/dividing_surface.c core/bounds/dividing_surface.h core/bounds/tangent_forms.h \
    core/bounds/quadratic.h \
    core/bounds/separation.c core/bounds/separation.h \
    core/bounds/spine.c core/bounds/spine.h \
    core/bounds/spine_part.c core/bounds/spine_radius.c core/bounds/spine_reduce.c \
    core/bounds/strategy.c core/bounds/strategy.h \
    core/bounds/time_window.c core/bounds/time_window.h \
    core/bounds/trial_rate.h \
    core/bounds/tuning.h \
    core/bounds/window_lanes.h

core_witness = \
    core/witness/contact_paraboloid.c core/witness/contact_paraboloid.h \
    core/witness/contact_estimate.c core/witness/contact_estimate.h \
    core/witness/time_descent.c core/witness/time_descent.h \
    core/witness/net_eval.c core/witness/net_eval.h \
    core/witness/newton.c core/witness/newton.h \
    core/witness/search.c core/witness/search.h \
    core/witness/tube_search.c core/witness/tube_search.h \
    core/witness/wide_search.c core/witness/wide_search.h \
    core/witness/witness.c core/witness/witness.h

core_broad_phase = \
    core/broad_phase/broad_phase.c core/broad_phase/broad_phase.h \
    core/broad_phase/candidate.c core/broad_phase/candidate.h \
    core/broad_phase/candidates.c core/broad_phase/candidates.h \
    core/broad_phase/candidates_part.c \
    core/broad_phase/candidates_rest.c core/broad_phase/candidates_rest.h \
    core/broad_phase/candidates_more.c \
    core/broad_phase/later_pairs.c core/broad_phase/later_pairs.h \
    core/broad_phase/collect_aside.c \
    core/broad_phase/collect_frames.c core/broad_phase/collect_glances.c \
    core/broad_phase/collect_half_planes.c core/broad_phase/collect_holds.c \
    core/broad_phase/frame_list.h \
    core/broad_phase/collect_pairs.c \
    core/broad_phase/collect_roots.c \
    core/broad_phase/collect_surfaces.c \
    core/broad_phase/collection.h \
    core/broad_phase/examined_times.c core/broad_phase/examined_times.h \
    core/broad_phase/parallel.c core/broad_phase/parallel.h \
    core/broad_phase/strips.c core/broad_phase/strips.h

core_proof = \
    core/proof/proof_copy.c \
    core/proof/proof_file.c core/proof/proof_file.h \
    core/proof/proof_log.c core/proof/proof_log.h \
    core/proof/proof_pairs.c core/proof/proof_pairs.h \
    core/proof/proof_tree.c core/proof/proof_tree.h

core_solver = \
    core/solver/clearance.c core/solver/clearance.h \
    core/solver/contradiction.c core/solver/contradiction.h \
    core/solver/clearance_distance.c \
    core/solver/clearance_divide.c \
    core/solver/clearance_inside.c \
    core/solver/clearance_internal.h \
    core/solver/clearance_proof.c \
    core/solver/clearance_task.c \
    core/solver/clearance_violation.c \
    core/solver/expand_pair.c core/solver/expand_pair.h \
    core/solver/explanation.c core/solver/explanation.h \
    core/solver/impact.c core/solver/impact.h \
    core/solver/query_inside.c \
    core/solver/min_distance.c core/solver/min_distance.h \
    core/solver/pair_heap.c core/solver/pair_heap.h \
    core/solver/pair_meeting.c core/solver/pair_meeting.h \
    core/solver/pair_note.h \
    core/solver/pair_spread.c core/solver/pair_spread.h \
    core/solver/pair_step.c core/solver/pair_step.h \
    core/solver/pair_test.c core/solver/pair_test.h core/solver/pair_tubes.c core/solver/pair_tubes.h \
    core/solver/piece_walk.c core/solver/piece_walk.h \
    core/solver/query.c \
    core/solver/query_answer.c \
    core/solver/query_clearance.c \
    core/solver/query_collect.c \
    core/solver/query_contact.c \
    core/solver/query_divide.c \
    core/solver/query_explain.c \
    core/solver/query_internal.h \
    core/solver/query_limits.c \
    core/solver/query_proof.c core/solver/query_proof.h \
    core/solver/query_refine.c \
    core/solver/split_pair.c core/solver/split_pair.h \
    core/solver/subdivision.c core/solver/subdivision.h \
    core/solver/time_of_impact.c core/solver/time_of_impact.h \
    core/solver/upper_time.c core/solver/upper_time.h \
    core/solver/world.c core/solver/world.h

core_survey = \
    core/survey/box_contact.c \
    core/survey/box_distance.c \
    core/survey/box_query.c \
    core/survey/box_question.h \
    core/survey/box_queue.c core/survey/box_queue.h \
    core/survey/survey.c \
    core/survey/survey_answer.c \
    core/survey/survey_cost.c \
    core/survey/survey_refine.c \
    core/survey/survey_box.c \
    core/survey/survey_internal.h \
    core/survey/survey_records.c \
    core/survey/survey_measure.c \
    core/survey/survey_pairs.c \
    core/survey/survey_claim.c \
    core/survey/survey_proof.c core/survey/survey_proof.h \
    core/survey/survey_spread.c \
    core/survey/survey_state.c

core_reader = \
    core/reader/arguments.c core/reader/arguments.h \
    core/reader/builder.c core/reader/builder_internal.h \
    core/reader/builder_stages.c \
    core/reader/examine.c \
    core/reader/json_keys.c core/reader/json_keys.h \
    core/reader/json_quick.c core/reader/json_quick.h \
    core/reader/instance_table.c core/reader/instance_table.h \
    core/reader/pipeline.c core/reader/pipeline.h \
    core/reader/pipeline_value.c core/reader/pipeline_value.h \
    core/reader/reading_budget.c core/reader/reading_budget.h \
    core/reader/required_plugins.c core/reader/required_plugins.h \
    core/reader/scene_bodies.c core/reader/scene_bodies.h \
    core/reader/scene_build.c core/reader/scene_build.h \
    core/reader/scene_file.c core/reader/scene_file.h \
    core/reader/scene_definitions.c \
    core/reader/scene_instances.c core/reader/scene_instances.h \
    core/reader/scene_pair.c \
    core/reader/scene_parts.c core/reader/scene_parts.h \
    core/reader/scene_json.c core/reader/scene_json.h \
    core/reader/scene_label.c core/reader/scene_label.h \
    core/reader/scene_shared.c \
    core/reader/scene_sources.c \
    core/reader/scene_values.c

# What the library and the command share; each links its own copy.
noinst_LTLIBRARIES += core/libcommon.la
core_libcommon_la_SOURCES = $(core_common)

# Everything, internal symbols included: what the Check suites link.
noinst_LTLIBRARIES += core/libcore.la
core_libcore_la_SOURCES = $(core_base) $(core_surface) $(core_tree) $(core_plugin) $(core_scene) \
    $(core_solid) $(core_bounds) $(core_witness) $(core_broad_phase) $(core_proof) \
    $(core_solver) $(core_survey) $(core_reader)
core_libcore_la_CFLAGS = $(AM_CFLAGS) $(UNROLL_CFLAGS)
core_libcore_la_LIBADD = core/libcommon.la $(JANSSON_LIBS) $(ZLIB_LIBS) -lm

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
if HAVE_VERSION_SCRIPT
libimpinge_exports = -Wl,--version-script=$(top_srcdir)/core/libimpinge.map
else
libimpinge_exports = -export-symbols-regex '^imp_'
endif
libimpinge_la_LDFLAGS = -shared -version-info 0:0:0 -no-undefined $(libimpinge_exports)
EXTRA_libimpinge_la_DEPENDENCIES = core/libimpinge.map

# For programs that link everything in. One object, whose internal symbols are local: in an archive of
# many they would be the program's too, and collide with its own.
archivedir = $(libdir)
archive_DATA = libimpinge.a
libimpinge.a: core/libcore.la
	$(AM_V_GEN)$(LD) -r -o core/impinge.o --whole-archive core/.libs/libcore.a && \
	  $(OBJCOPY) --localize-hidden core/impinge.o && rm -f $@ && $(AR) cr $@ core/impinge.o && \
	  $(RANLIB) $@
CLEANFILES += libimpinge.a core/impinge.o

core_includedir = $(pkgincludedir)
core_include_HEADERS = core/impinge/baseline.h core/impinge/examine.h core/impinge/impinge.h

pkgconfig_DATA += core/impinge.pc

# For CMake: find_package(Impinge).
cmakedir = $(libdir)/cmake/Impinge
cmake_DATA = core/ImpingeConfig.cmake core/ImpingeConfigVersion.cmake
$(cmake_DATA): %: %.in Makefile
	$(AM_V_GEN)$(MKDIR_P) $(@D) && sed -e 's|@libdir[@]|$(libdir)|g' \
	  -e 's|@includedir[@]|$(includedir)|g' -e 's|@plugindir[@]|$(plugindir)|g' \
	  -e 's|@PACKAGE_VERSION[@]|$(PACKAGE_VERSION)|g' -e 's|@CMAKE_LIBS[@]|$(LIBS)|g' \
	  -e 's|@zlib_package[@]|$(zlib_package)|g' $< >$@
CLEANFILES += $(cmake_DATA)
EXTRA_DIST += $(cmake_DATA:%=%.in)

EXTRA_DIST += core/CERTIFICATE.md core/MEASUREMENTS.md core/PROOF.md core/README core/libimpinge.map

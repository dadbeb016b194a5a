# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# One .so per type: plugins/NAME.la from plugins/surfaces/NAME.c or plugins/maps/NAME.c.

plugin_LTLIBRARIES = \
    plugins/bend.la \
    plugins/bezier.la \
    plugins/bezier-triangle.la \
    plugins/box.la \
    plugins/capsule.la \
    plugins/cone.la \
    plugins/cylinder.la \
    plugins/disc.la \
    plugins/ellipsoid.la \
    plugins/extrusion.la \
    plugins/ffd.la \
    plugins/formula.la \
    plugins/keyframes.la \
    plugins/map-formula.la \
    plugins/mesh.la \
    plugins/motion-formula.la \
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
    plugins/subdivision.la \
    plugins/superellipsoid.la \
    plugins/supertoroid.la \
    plugins/sweep.la \
    plugins/taper.la \
    plugins/thread.la \
    plugins/tolerance.la \
    plugins/torus.la \
    plugins/trajectory.la \
    plugins/translate.la \
    plugins/triangle.la \
    plugins/twist.la \
    plugins/wave.la

# Modules that export one symbol.
if HAVE_VERSION_SCRIPT
plugin_exports = -Wl,--version-script=$(top_srcdir)/plugins/plugin.map -Wl,--gc-sections
else
plugin_exports = -export-symbols-regex '^impinge_plugin$$'
endif
plugin_ldflags = -module -avoid-version -shared $(plugin_exports)
EXTRA_DIST += plugins/plugin.map

plugins_bend_la_SOURCES = plugins/maps/bend.c
plugins_bend_la_LDFLAGS = $(plugin_ldflags)
plugins_bezier_la_SOURCES = plugins/surfaces/bezier.c
plugins_bezier_la_LDFLAGS = $(plugin_ldflags)
plugins_bezier_triangle_la_SOURCES = plugins/surfaces/bezier-triangle.c
plugins_bezier_triangle_la_LDFLAGS = $(plugin_ldflags)
plugins_box_la_SOURCES = plugins/surfaces/box.c
plugins_box_la_LDFLAGS = $(plugin_ldflags)
plugins_capsule_la_SOURCES = plugins/surfaces/capsule.c
plugins_capsule_la_LDFLAGS = $(plugin_ldflags)
plugins_cone_la_SOURCES = plugins/surfaces/cone.c
plugins_cone_la_LDFLAGS = $(plugin_ldflags)
plugins_cylinder_la_SOURCES = plugins/surfaces/cylinder.c
plugins_cylinder_la_LDFLAGS = $(plugin_ldflags)
plugins_disc_la_SOURCES = plugins/surfaces/disc.c
plugins_disc_la_LDFLAGS = $(plugin_ldflags)
plugins_ellipsoid_la_SOURCES = plugins/surfaces/ellipsoid.c
plugins_ellipsoid_la_LDFLAGS = $(plugin_ldflags)
plugins_extrusion_la_SOURCES = plugins/surfaces/extrusion.c
plugins_extrusion_la_LDFLAGS = $(plugin_ldflags)
plugins_ffd_la_SOURCES = plugins/maps/ffd.c
plugins_ffd_la_LDFLAGS = $(plugin_ldflags)
plugins_formula_la_SOURCES = plugins/surfaces/formula.c
plugins_formula_la_LDFLAGS = $(plugin_ldflags)
plugins_keyframes_la_SOURCES = plugins/maps/keyframes.c
plugins_keyframes_la_LDFLAGS = $(plugin_ldflags)
plugins_map_formula_la_SOURCES = plugins/maps/map-formula.c
plugins_map_formula_la_LDFLAGS = $(plugin_ldflags)
plugins_mesh_la_SOURCES = plugins/surfaces/mesh.c
plugins_mesh_la_LDFLAGS = $(plugin_ldflags)
plugins_motion_formula_la_SOURCES = plugins/maps/motion-formula.c
plugins_motion_formula_la_LDFLAGS = $(plugin_ldflags)
plugins_nurbs_la_SOURCES = plugins/surfaces/nurbs.c
plugins_nurbs_la_LDFLAGS = $(plugin_ldflags)
plugins_plane_la_SOURCES = plugins/surfaces/plane.c
plugins_plane_la_LDFLAGS = $(plugin_ldflags)
plugins_point_la_SOURCES = plugins/surfaces/point.c
plugins_point_la_LDFLAGS = $(plugin_ldflags)
plugins_product_la_SOURCES = plugins/surfaces/product.c
plugins_product_la_LDFLAGS = $(plugin_ldflags)
plugins_revolution_la_SOURCES = plugins/surfaces/revolution.c
plugins_revolution_la_LDFLAGS = $(plugin_ldflags)
plugins_ripple_la_SOURCES = plugins/surfaces/ripple.c
plugins_ripple_la_LDFLAGS = $(plugin_ldflags)
plugins_rotate_la_SOURCES = plugins/maps/rotate.c
plugins_rotate_la_LDFLAGS = $(plugin_ldflags)
plugins_scale_la_SOURCES = plugins/maps/scale.c
plugins_scale_la_LDFLAGS = $(plugin_ldflags)
plugins_screw_la_SOURCES = plugins/maps/screw.c
plugins_screw_la_LDFLAGS = $(plugin_ldflags)
plugins_segment_la_SOURCES = plugins/surfaces/segment.c
plugins_segment_la_LDFLAGS = $(plugin_ldflags)
plugins_sphere_la_SOURCES = plugins/surfaces/sphere.c
plugins_sphere_la_LDFLAGS = $(plugin_ldflags)
plugins_spike_la_SOURCES = plugins/surfaces/spike.c
plugins_spike_la_LDFLAGS = $(plugin_ldflags)
plugins_subdivision_la_SOURCES = plugins/surfaces/subdivision.c
plugins_subdivision_la_LDFLAGS = $(plugin_ldflags)
plugins_superellipsoid_la_SOURCES = plugins/surfaces/superellipsoid.c
plugins_superellipsoid_la_LDFLAGS = $(plugin_ldflags)
plugins_supertoroid_la_SOURCES = plugins/surfaces/supertoroid.c
plugins_supertoroid_la_LDFLAGS = $(plugin_ldflags)
plugins_sweep_la_SOURCES = plugins/surfaces/sweep.c
plugins_sweep_la_LDFLAGS = $(plugin_ldflags)
plugins_taper_la_SOURCES = plugins/maps/taper.c
plugins_taper_la_LDFLAGS = $(plugin_ldflags)
plugins_thread_la_SOURCES = plugins/surfaces/thread.c
plugins_thread_la_LDFLAGS = $(plugin_ldflags)
plugins_tolerance_la_SOURCES = plugins/maps/tolerance.c
plugins_tolerance_la_LDFLAGS = $(plugin_ldflags)
plugins_torus_la_SOURCES = plugins/surfaces/torus.c
plugins_torus_la_LDFLAGS = $(plugin_ldflags)
plugins_trajectory_la_SOURCES = plugins/maps/trajectory.c
plugins_trajectory_la_LDFLAGS = $(plugin_ldflags)
plugins_translate_la_SOURCES = plugins/maps/translate.c
plugins_translate_la_LDFLAGS = $(plugin_ldflags)
plugins_triangle_la_SOURCES = plugins/surfaces/triangle.c
plugins_triangle_la_LDFLAGS = $(plugin_ldflags)
plugins_twist_la_SOURCES = plugins/maps/twist.c
plugins_twist_la_LDFLAGS = $(plugin_ldflags)
plugins_wave_la_SOURCES = plugins/maps/wave.c
plugins_wave_la_LDFLAGS = $(plugin_ldflags)

# What they share; private, never installed.
noinst_HEADERS += \
    plugins/common/capped.h \
    plugins/common/near.h \
    plugins/common/coil.h plugins/common/squares.h \
    plugins/common/polynomial.h \
    plugins/common/publish.h \
    plugins/patch/bernstein.h \
    plugins/patch/chebyshev.h \
    plugins/patch/parameters.h \
    plugins/patch/rows.h

# What surfaces and maps have in common. Its files that a type does not need are dropped by the linker
# (plugin_ldflags).
noinst_LTLIBRARIES += plugins/libcommon.la
plugins_libcommon_la_SOURCES = \
    plugins/common/axis.c plugins/common/axis.h \
    plugins/common/cone_distance.c plugins/common/cone_distance.h \
    plugins/common/round_distance.c plugins/common/round_distance.h \
    plugins/common/course.c plugins/common/course.h \
    plugins/common/course_internal.h \
    plugins/common/course_table.c \
    plugins/common/csv.c plugins/common/csv.h \
    plugins/common/csv_cell.c plugins/common/csv_cell.h \
    plugins/common/csv_head.c plugins/common/csv_head.h \
    plugins/common/units.c plugins/common/units.h \
    plugins/common/facet.c plugins/common/facet.h \
    plugins/common/frame.c plugins/common/frame.h \
    plugins/common/keys.c plugins/common/keys.h \
    plugins/common/linear.c plugins/common/linear.h \
    plugins/common/linear_bounds.c plugins/common/linear_internal.h \
    plugins/common/prism.c plugins/common/prism.h \
    plugins/common/quaternion.c plugins/common/quaternion.h \
    plugins/common/sinc.c plugins/common/sinc.h \
    plugins/common/spin.c plugins/common/spin.h \
    plugins/common/spin_across.c plugins/common/spin_across.h \
    plugins/common/spin_text.c plugins/common/spin_text.h \
    plugins/common/spline.c plugins/common/spline.h plugins/common/spline_set.c \
    plugins/common/spline_text.c \
    plugins/common/superquadric.c plugins/common/superquadric.h
plugins_libcommon_la_CFLAGS = $(AM_CFLAGS) $(UNROLL_CFLAGS)
plugins_libcommon_la_LDFLAGS =
plugins_bend_la_LIBADD = plugins/libcommon.la
plugins_box_la_LIBADD = plugins/libcommon.la
plugins_capsule_la_LIBADD = plugins/libcommon.la
plugins_cone_la_LIBADD = plugins/libcommon.la
plugins_disc_la_LIBADD = plugins/libcommon.la
plugins_keyframes_la_LIBADD = plugins/libcommon.la
plugins_plane_la_LIBADD = plugins/libcommon.la
plugins_point_la_LIBADD = plugins/libcommon.la
plugins_rotate_la_LIBADD = plugins/libcommon.la
plugins_scale_la_LIBADD = plugins/libcommon.la
plugins_screw_la_LIBADD = plugins/libcommon.la
plugins_segment_la_LIBADD = plugins/libcommon.la
plugins_superellipsoid_la_LIBADD = plugins/libcommon.la
plugins_supertoroid_la_LIBADD = plugins/libcommon.la
plugins_taper_la_LIBADD = plugins/libcommon.la
plugins_trajectory_la_LIBADD = plugins/libcommon.la
plugins_translate_la_LIBADD = plugins/libcommon.la
plugins_triangle_la_LIBADD = plugins/libcommon.la
plugins_twist_la_LIBADD = plugins/libcommon.la
plugins_wave_la_LIBADD = plugins/libcommon.la

# Patches of control points, and what is built of them.
noinst_LTLIBRARIES += plugins/libpatch.la
plugins_libpatch_la_SOURCES = \
    plugins/patch/box_patch.c plugins/patch/box_patch.h \
    plugins/patch/box_stencil.h \
    plugins/patch/box_tables.c \
    plugins/patch/cell_net.c plugins/patch/cell_net.h \
    plugins/patch/curve.c plugins/patch/curve.h \
    plugins/patch/ffd_model.c plugins/patch/ffd_model.h \
    plugins/patch/knots.c plugins/patch/knots.h \
    plugins/patch/lattice.c plugins/patch/lattice.h \
    plugins/patch/nurbs_cells.c plugins/patch/nurbs_cells.h \
    plugins/patch/nurbs_surface.c plugins/patch/nurbs_surface.h \
    plugins/patch/outline.c plugins/patch/outline.h \
    plugins/patch/patch.c plugins/patch/patch.h \
    plugins/patch/patch_include.c plugins/patch/patch_include.h \
    plugins/patch/patch_net.c plugins/patch/patch_net.h \
    plugins/patch/patch_rate.c plugins/patch/patch_rate.h \
    plugins/patch/patch_series.c plugins/patch/patch_series.h \
    plugins/patch/patch_text.c plugins/patch/patch_text.h \
    plugins/patch/pieces.c plugins/patch/pieces.h \
    plugins/patch/rough_points.c plugins/patch/rough_points.h \
    plugins/patch/ring_net.c plugins/patch/ring_net.h \
    plugins/patch/round_net.c plugins/patch/round_net.h \
    plugins/patch/round_profile.c plugins/patch/round_profile.h \
    plugins/patch/spline_patch.c plugins/patch/spline_patch.h \
    plugins/patch/triangle.c plugins/patch/triangle.h
plugins_libpatch_la_CFLAGS = $(AM_CFLAGS) $(UNROLL_CFLAGS)
plugins_libpatch_la_LDFLAGS =
plugins_bezier_la_LIBADD = plugins/libpatch.la plugins/libcommon.la
plugins_bezier_triangle_la_LIBADD = plugins/libpatch.la plugins/libcommon.la
plugins_extrusion_la_LIBADD = plugins/libpatch.la plugins/libcommon.la
plugins_ffd_la_LIBADD = plugins/libpatch.la plugins/libcommon.la
plugins_nurbs_la_LIBADD = plugins/libpatch.la plugins/libcommon.la
plugins_product_la_LIBADD = plugins/libpatch.la plugins/libcommon.la
plugins_revolution_la_LIBADD = plugins/libpatch.la plugins/libcommon.la
plugins_sweep_la_LIBADD = plugins/libpatch.la plugins/libcommon.la

# Files of triangles and polygons.
noinst_LTLIBRARIES += plugins/libmesh.la
plugins_libmesh_la_SOURCES = \
    plugins/mesh/mesh_bytes.c plugins/mesh/mesh_bytes.h \
    plugins/mesh/mesh_file.c plugins/mesh/mesh_file.h \
    plugins/mesh/mesh_gltf.c \
    plugins/mesh/mesh_gltf_data.c plugins/mesh/mesh_gltf_data.h \
    plugins/mesh/mesh_gltf_place.c plugins/mesh/mesh_gltf_place.h \
    plugins/mesh/mesh_obj.c \
    plugins/mesh/mesh_off.c \
    plugins/mesh/mesh_parameters.c plugins/mesh/mesh_parameters.h \
    plugins/mesh/mesh_ply.c \
    plugins/mesh/mesh_ply_head.c plugins/mesh/mesh_ply_head.h \
    plugins/mesh/mesh_scalar.c plugins/mesh/mesh_scalar.h \
    plugins/mesh/mesh_stl.c \
    plugins/mesh/mesh_text.c plugins/mesh/mesh_text.h \
    plugins/mesh/polygon.c plugins/mesh/polygon.h \
    plugins/mesh/triangles.c plugins/mesh/triangles.h
plugins_libmesh_la_LDFLAGS =
plugins_libmesh_la_LIBADD = $(JANSSON_LIBS)
plugins_mesh_la_LIBADD = plugins/libmesh.la plugins/libcommon.la

# Control meshes, and the surfaces over their quads.
noinst_LTLIBRARIES += plugins/libsubdivision.la
plugins_libsubdivision_la_SOURCES = \
    plugins/subdivision/control_build.h \
    plugins/subdivision/control_mesh.c plugins/subdivision/control_mesh.h \
    plugins/subdivision/control_refine.c \
    plugins/subdivision/control_smooth.c \
    plugins/subdivision/corner.c plugins/subdivision/corner.h \
    plugins/subdivision/corner_build.h \
    plugins/subdivision/corner_quad.c \
    plugins/subdivision/corner_triangle.c \
    plugins/subdivision/face.c plugins/subdivision/face.h \
    plugins/subdivision/face_text.c \
    plugins/subdivision/gauge.c \
    plugins/subdivision/quarter.h \
    plugins/subdivision/quarter_box.c \
    plugins/subdivision/quarter_spline.c \
    plugins/subdivision/walk.c plugins/subdivision/walk.h
plugins_libsubdivision_la_LDFLAGS =
plugins_subdivision_la_LIBADD = plugins/libsubdivision.la plugins/libpatch.la plugins/libmesh.la
plugins_subdivision_la_LIBADD += plugins/libcommon.la

# The language of formulas, for the types that take formulas as text.
noinst_LTLIBRARIES += plugins/libexpression.la
plugins_libexpression_la_SOURCES = \
    plugins/expression/builder.c plugins/expression/builder.h \
    plugins/expression/coil_form.c plugins/expression/coil_form.h \
    plugins/expression/coil_surface.c plugins/expression/coil_surface.h \
    plugins/expression/expression.c plugins/expression/expression.h \
    plugins/expression/functions.h \
    plugins/expression/motion_text.c plugins/expression/motion_text.h \
    plugins/expression/names.c plugins/expression/names.h \
    plugins/expression/operation.c plugins/expression/operation.h \
    plugins/expression/parser.c plugins/expression/parser.h \
    plugins/expression/rules.c plugins/expression/rules.h \
    plugins/expression/text_form.h \
    plugins/expression/token.c plugins/expression/token.h \
    plugins/expression/turned_form.c plugins/expression/turned_form.h \
    plugins/expression/turned_surface.c plugins/expression/turned_surface.h \
    plugins/expression/zeros.c plugins/expression/zeros.h
noinst_HEADERS += plugins/expression/type.h
plugins_libexpression_la_LDFLAGS =
plugins_formula_la_LIBADD = plugins/libexpression.la plugins/libcommon.la
plugins_map_formula_la_LIBADD = plugins/libexpression.la plugins/libcommon.la
plugins_motion_formula_la_LIBADD = plugins/libexpression.la plugins/libcommon.la

# They link with libm, and those that read JSON with jansson (plugins/libmesh.la), whatever configure
# found for the host.
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

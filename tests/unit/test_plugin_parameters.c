/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/built_plugins.h"

/* What types say about themselves, and about parameters that no table can check. */

static const char *const other_surface = "sphere";

/* A scene of one type and a sphere; a map is put on a sphere. NULL on error. */
static imp_scene *scene_of(imp_registry *registry, bool is_map, const char *text, imp_error *error)
{
    char stage[1000];
    snprintf(stage, sizeof stage, "%s%s", is_map ? "sphere ! " : "", text);
    return imp_scene_from_pair(registry, stage, other_surface, error);
}

START_TEST(every_example_makes_a_surface_with_points)
{
    imp_registry *registry = built_registry();
    imp_type_info info;
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i) {
        imp_error error = {.text = ""};
        double lo[3], hi[3], x[3], slip[3];
        imp_scene *scene = scene_of(registry, info.kind == IMP_TYPE_MAP, info.example, &error);
        ck_assert_msg(scene != NULL, "%s: %s", info.example, error.text);
        imp_scene_domain(scene, 0, 0, lo, hi);
        double p[3] = {lo[0] + (hi[0] - lo[0]) / 3, (lo[1] + hi[1]) / 2, fmax(lo[2], 0)};
        ck_assert_int_eq(imp_scene_eval(scene, 0, 0, 1, p, x, slip, &error), IMP_SUCCESS);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

static bool starts_with(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

START_TEST(every_type_says_what_it_is)
{
    imp_registry *registry = built_registry();
    imp_type_info info;
    imp_plugin_refusal refusal;
    ck_assert_msg(!imp_registry_refusal(registry, 0, &refusal), "%s", refusal.reason);
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i) {
        ck_assert_msg(strlen(info.summary) >= 10, "%s: summary", info.name);
        ck_assert_msg(strlen(info.equation) >= 10, "%s: equation", info.name);
        ck_assert_msg(starts_with(info.example, info.name), "%s: %s", info.name, info.example);
        ck_assert_str_eq(info.version, PACKAGE_VERSION);
        for (size_t k = 0; k < info.parameter_count; ++k)
            ck_assert_msg(strlen(info.parameters[k].doc) >= 5, "%s %s: doc", info.name,
                          info.parameters[k].name);
    }
    imp_registry_free(registry);
}
END_TEST

/* --- Refusals --------------------------------------------------------------------------------- */

static const struct refusal {
    const char *text;  /* a stage of a pipeline */
    const char *place; /* the parameter blamed; NULL: the type as a whole */
    const char *saying;
} refusals[] = {
    {"sphere radius=0", "radius", "> 0"},
    {"sphere radius=-1", "radius", "> 0"},
    {"sphere radius=1e999", "radius", ""},
    {"sphere center=0,0", "center", "3"},
    {"torus minor_radius=0", "minor_radius", "> 0"},
    {"spike width=0", "width", "1e-100"},
    {"spike width=4", "width", "3.14"},
    {"spike spikes=[]", "spikes", ""},
    {"spike spikes=[[0,0,0]]", "spikes", "2"},
    {"bezier degree=[1,1]", "points", "missing"},
    {"bezier degree=[0,1] points=[[0,0,0],[1,0,0]]", "degree", "1"},
    {"bezier degree=[21,1] points=[[0,0,0]]", "degree", "20"},
    {"bezier degree=[1.5,1] points=[[0,0,0]]", "degree", "whole"},
    {"bezier degree=[1,1] points=[[0,0,0],[1,0,0],[0,1,0]]", "points", "(1+1)*(1+1) = 4"},
    {"bezier degree=[1,1] points=[[0,0,0],[1,0,0],[0,1,0],[1,1,0]] velocities=[[0,0,0]]",
     "velocities", "4 control points"},
    {"bezier degree=[1,1] points=[[0,0,0],[1,0,0],[0,1,0],[1,1,0]] weights=[1,1,1]", "weights",
     "3 given"},
    {"bezier degree=[1,1] points=[[0,0,0],[1,0,0],[0,1,0],[1,1,0]] weights=[1,1,0,1]", "weights",
     ""},
    {"bezier degree=[1,1] points=[[0,0,0],[1,0,0],[0,1,0],[1,1,1e101]]", "points", "1e+100"},
    {"bezier-triangle degree=0", "degree", "1"},
    {"bezier-triangle degree=11", "degree", "10"},
    {"bezier-triangle degree=3", "points",
     "6 given, but a triangle of degree 3 has (3+1)*(3+2)/2 = 10"},
    {"bezier-triangle weights=1,2,3", "weights", "3 given for 6 points"},
    {"bezier-triangle velocities=[[0,0,0]]", "velocities", "1 given for 6 points"},
    {"bezier-triangle faces=[[0,1,2]]", "faces", "3 numbers a face, must be 6"},
    {"bezier-triangle faces=[[0,1,2,3,4,5],[0,1,2,3,4,6]]", "faces/1",
     "point 6 is not there: points are numbered from 0 to 5"},
    {"bezier-triangle faces=[[0,1,2,3,4,-1]]", "faces", "0"},
    {"formula x=sin(w)", "x", "line 1, column 5: unknown name 'w'; known: u, v, t, pi, e"},
    {"formula y=\"u+\\nfloor(v)\"", "y", "line 2, column 1: 'floor' is discontinuous"},
    {"formula z=\"\"", "z", "line 1, column 1"},
    {"formula z=log(-1-u^2)", "z", "undefined everywhere"},
    {"formula domain=[[1,0],[0,1]]", "domain/0", "[1,0] ends before it begins"},
    {"formula domain=[[0,1]]", "domain", "2"},
    {"formula time=1,0", "time", "ends before it begins"},
    {"formula constants={\"sin\":1}", "constants", "'sin' is a function already"},
    {"formula constants={\"t\":1}", "constants", "'t' is a variable already"},
    {"formula constants={\"a\":1e999}", "constants", ""},
    {"formula constants=[1]", "constants", "an object of numbers"},
    {"! map-formula x=u", "x", "unknown name 'u'; known: x, y, z, t, pi, e"},
    {"! map-formula time=2,1", "time", "ends before it begins"},
    {"! motion-formula angle=y*t constants={\"y\":1}", "constants", "it is a coordinate"},
    {"! motion-formula angle=x", "angle", "unknown name 'x'; known: t, pi, e"},
    {"! motion-formula offset=[\"0\",\"0\",\"z\"]", "offset/2",
     "unknown name 'z'; known: t, pi, e"},
    {"! motion-formula offset=[\"t\",\"sqrt(-2-t^2)\",\"t\"]", "offset/1", "undefined everywhere"},
    {"! motion-formula offset=[\"0\",\"0\"]", "offset", "2"},
    {"! motion-formula angle=t axis=0,0,0", "axis", "direction"},
    {"! motion-formula angle=t constants={\"t\":1}", "constants", "'t' is a variable already"},
    {"! motion-formula time=2,1", "time", "ends before it begins"},
    {"ellipsoid radii=1,0,1", "radii", "> 0"},
    {"ellipsoid radii=1,1", "radii", "3"},
    {"cylinder height=0", "height", "> 0"},
    {"box size=1,0,1", "size/1", "must be in (0"},
    {"box size=1e-3,1,1 center=1e30,0,0", "size/0", "lost in the rounding"},
    {"disc axis=0,0,0", "axis", "has no direction"},
    {"capsule radius=0", "radius", "> 0"},
    {"capsule from=0,0,0 to=0,0,1e-200", "to", "or the same point"},
    {"extrusion vector=1,1,0", "vector/2", "out of the plane"},
    {"extrusion profile=[[0,0]]", "profile", "2 or more"},
    {"extrusion degree=6", "profile", "more than the degree, 6"},
    {"extrusion knots=[0,0,1,1]", "knots", "without degree"},
    {"extrusion degree=2 knots=[0,0,0,1,1,1]", "knots", "6 points of degree 2 have 9"},
    {"extrusion degree=2 knots=[0,0,0,1,2,1,4,4,4]", "knots/5", "must not fall"},
    {"extrusion weights=[1,1]", "weights", "each of the 6 points"},
    {"extrusion weights=[1,1,1,1,1,0]", "weights/5", "must be in [1e-50, 1e+50]"},
    {"extrusion profile=[[0,0],[1,0],[1,1]] ends=true", "profile", "must end at its first point"},
    {"extrusion degree=2 knots=[0,1,2,3,4,5,6,7,8] ends=true", "knots", "degree + 1 times"},
    {"extrusion center=5,0 ends=true", "center", "must be a point in it"},
    {"cone radius=-1", "radius", "> 0"},
    {"plane edge_u=0,0,0", "edge_u", "any vector but 0"},
    {"plane edge_u=1,2,3 edge_v=-0.1,-0.2,-0.3", "edge_v", "parallel to edge_u"},
    {"plane origin=1e101,0,0", "origin", "1e+100"},
    {"point position=1,2", "position", "3"},
    {"segment points=[[0,0,0]]", "points", "2"},
    {"triangle points=[[0,0,0],[1,0,0],[0,1,0]] velocities=[[0,0,0],[0,0,0]]", "velocities", "3"},
    {"superellipsoid exponents=0,1", "exponents", "> 0"},
    {"superellipsoid exponents=1,2.0000001", "exponents/1", "Lipschitz"},
    {"supertoroid exponents=3,1", "exponents/0", "must be in (0, 2]"},
    {"thread pitch=0", "pitch", "any length but 0"},
    {"thread pitch=1e-101", "pitch", "1e-100"},
    {"thread radius=0.1", "profile", "the radius, 0.1, or more"},
    {"thread profile=0.5,-0.5", "profile", "must be less"},
    {"thread profile="
     "0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0",
     "profile", "33 amplitudes given, at most 32"},
    {"thread starts=0", "starts", "1"},
    {"thread starts=1.5", "starts", "whole"},
    {"ripple wavelength=0", "wavelength", "1e-100"},
    {"ripple size=0,1", "size/0", "(0, "},
    {"ripple direction=0,0", "direction", "any vector but 0"},
    {"revolution profile=[[1,0]]", "profile", "2 to 21"},
    {"revolution profile=[[1,0],[1,1]] weights=1,2,3", "weights", "3 weights for 2 control points"},
    {"revolution profile=[[1,0],[1,1]] weights=1,0", "weights", ""},
    {"sweep path=[[0,0,0]]", "path", "2 to 21"},
    {"sweep profile_weights=[1,1]", "profile_weights", "2 weights for 3"},
    {"product c=[[0,0,0],[1,1,1]]", "c/0", "2"},
    {"product d_weights=[1]", "d_weights", "1 weights for 6"},
    {"nurbs degree=0,1", "degree", "1"},
    {"nurbs points=[[0,0,0]]", "points", "4 along u times 4 along v"},
    {"nurbs weights=1,1,1", "weights", "got 3"},
    {"nurbs weights=[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,-1]", "weights/15", ""},
    {"nurbs velocities=[[0,0,0]]", "velocities", "got 1"},
    {"nurbs knots_u=0,0,0,1,1", "knots_u", "at least 2 * degree + 2 = 6"},
    {"nurbs knots_u=0,0,0,2,1,3,3", "knots_u/4", "must not fall"},
    {"nurbs knots_v=0,0,1,1,1,2,2", "knots_v", "empty"},
    {"nurbs knots_v=0,0,0,1,1,1,2,2,2", "knots_v/3", "tears"},
    {"nurbs knots=[[0,0,0,1,2,2,2],[0,0,0,1,0,2,2]]", "knots/1", "must not fall"},
    {"nurbs knots_u=0,0,0,1e-200,2,2,2", "knots_u/3", "apart"},
    {"! translate", NULL, "velocity"},
    {"! translate velocity=1,0,0 offset=[[0,0,0]]", "offset", "velocity"},
    {"! rotate", NULL, "angle"},
    {"! rotate rate=1 angle=[0,1]", "angle", "rate"},
    {"! rotate axis=0,0,0 rate=1", "axis", "direction"},
    {"! rotate axis=0,1e-200,0 rate=1", "axis", "direction"},
    {"! scale", NULL, "factors"},
    {"! scale factor=1 factors=[[1]]", "factors", "factor"},
    {"! scale factor=1,2", "factor", "2 numbers"},
    {"! scale factors=[[1,2,3,4]]", "factors", "4 numbers"},
    {"! scale factors=[[1],[1,2,3]]", "factors", ""},
    {"! screw axis=0,0,0 rate=1", "axis", "direction"},
    {"! screw", NULL, "angle"},
    {"! tolerance offset=-1", "offset", "-1"},
    {"! tolerance angle=1.6", "angle", "1.6"},
    {"! tolerance angle=-0.1", "angle", "-0.1"},
    {"! tolerance center=0,0", "center", "2"},
    {"! taper axis=0,0,0", "axis", "direction"},
    {"! taper range=1,1", "range", "greater"},
    {"! taper range=2,1", "range", "[2,1]"},
    {"! taper range=0,1,2", "range", "2"},
    {"! twist axis=0,0,0", "axis", "direction"},
    {"! twist rate=[]", "rate", ""},
    {"! bend axis=0,0,0", "axis", "direction"},
    {"! bend along=0,0,0", "along", "direction"},
    {"! bend axis=0,0,1 along=0,0,-2", "along", "parallel"},
    {"! bend range=1,-1", "range", "greater"},
    {"! wave", NULL, "amplitude"},
    {"! wave amplitude=0,0,1 amplitudes=[[0,0,1]]", "amplitudes", "amplitude"},
    {"! wave amplitude=0,0,1 wave_vector=0,0,0", "wave_vector", "direction"},
    {"! keyframes positions=[[0,0,0],[1,0,0]]", "times", "missing"},
    {"! keyframes times=0,1", NULL, "positions"},
    {"! keyframes times=[0] positions=[[0,0,0]]", "times", "two or more"},
    {"! keyframes times=0,1,1 positions=[[0,0,0],[1,0,0],[2,0,0]]", "times/2", "increase"},
    {"! keyframes times=0,1 positions=[[0,0,0]]", "positions", "1 positions for 2 times"},
    {"! keyframes times=0,1 rotations=[[1,0,0,0]]", "rotations", "1 rotations for 2 times"},
    {"! keyframes times=0,1 rotations=[[1,0,0],[1,0,0]]", "rotations", "4"},
    {"! keyframes times=0,1 rotations=[[1,0,0,0],[1,0,0,0.1]]", "rotations/1", "length 1.00498"},
    {"! keyframes times=0,1 rotations=[[0,0,0,0],[1,0,0,0]]", "rotations/0", "length 0"},
    {"! keyframes times=0,1 rotations=[[1,0,0,0],[0,1,0,0]]", "rotations/1", "180 degrees"},
    {"! keyframes times=0,1e-300 positions=[[0,0,0],[1e50,0,0]]", "positions/1", "too far"},
    {"! trajectory times=0,1", "positions", "missing"},
    {"! trajectory times=[0] positions=[[0,0,0]]", "times", "two or more"},
    {"! trajectory times=0,0 positions=[[0,0,0],[1,0,0]]", "times/1", "increase"},
    {"! trajectory times=0,1 positions=[[0,0,0]]", "positions",
     "1 positions for 2 times; must be 2"},
    {"! trajectory times=0,1 positions=[[0,0,0],[1,0,0]] accelerations=[[0,0,1],[0,0,1]]",
     "accelerations", "must be 1"},
    {"! trajectory times=0,1 positions=[[0,0,0],[1,0,0]] spins=[[0,0,1]]", "spins", "together"},
    {"! trajectory times=0,1 positions=[[0,0,0],[1,0,0]] rotations=[[1,0,0,0],[1,0,0,0]]"
     " spins=[[0,0,1],[0,0,1]]",
     "spins", "must be 1"},
    {"! trajectory times=0,1 positions=[[0,0,0],[1,0,0]] rotations=[[1,0,0,0],[1,0,0,0]]"
     " spins=[[0,0,1]]",
     "rotations/1", "spin leads to"},
    {"! trajectory times=0,1 positions=[[0,0,0],[1,0,0]] rotations=[[1,0,0,0],[1,0,0,0.1]]"
     " spins=[[0,0,0]]",
     "rotations/1", "length 1.00498"},
    {"! trajectory times=0,1 positions=[[0,0,0],[1,0,0]] rotations=[[1,0,0,0],[1,0,0,0]]"
     " spins=[[0,0,1e-200]]",
     "spins/0", "must be 0"},
    {"! trajectory times=0,1e-300 positions=[[0,0,0],[1e50,0,0]]", "positions/1", "too far"},
    {"! ffd", "points", "missing"},
    {"! ffd points=[[0,0,0]]", "points", "must be 8"},
    {"! ffd lattice=1,2,2 points=[[0,0,0]]", "lattice", "2"},
    {"! ffd lattice=17,2,2 points=[[0,0,0]]", "lattice", "16"},
    {"! ffd lattice=2,2.5,2 points=[[0,0,0]]", "lattice", "whole"},
    {"! ffd lo=0,0,0 hi=1,0,1 points=[[0,0,0]]", "hi/1", "greater"},
    {"! ffd points=[[0,0,0],[0,0,1],[0,1,0],[0,1,1],[1,0,0],[1,0,1],[1,1,0],[1,1,1]]"
     " velocities=[[0,0,0]]",
     "velocities", "must be 8"},
};

START_TEST(wrong_parameters_are_refused_by_name_and_reason)
{
    imp_registry *registry = built_registry();
    for (size_t k = 0; k < sizeof refusals / sizeof refusals[0]; ++k) {
        const struct refusal *wrong = &refusals[k];
        bool is_map = wrong->text[0] == '!';
        imp_error error = {.text = ""};
        imp_scene *scene = scene_of(registry, is_map, wrong->text + (is_map ? 2 : 0), &error);
        ck_assert_msg(scene == NULL, "%s: was taken", wrong->text);
        ck_assert_msg(error.code == IMP_ERROR_SCENE, "%s: %s", wrong->text, error.text);
        ck_assert_msg(wrong->place == NULL || strstr(error.text, wrong->place) != NULL, "%s: %s",
                      wrong->text, error.text);
        ck_assert_msg(strstr(error.text, wrong->saying) != NULL, "%s: %s", wrong->text, error.text);
    }
    imp_registry_free(registry);
}
END_TEST

/* The sum of as many sines, and their product, have all of them in common. */
static void write_waves(FILE *to, int count, char sign)
{
    for (int k = 1; k <= count; ++k) {
        if (k > 1) fputc(sign, to);
        fprintf(to, "sin(%d*t)", k);
    }
}

START_TEST(a_motion_of_too_many_common_parts_is_refused)
{
    enum { WAVES = 600 };
    imp_registry *registry = built_registry();
    imp_error error = {.text = ""};
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    ck_assert_ptr_nonnull(to);
    fputs("sphere ! motion-formula offset=[\"", to);
    write_waves(to, WAVES, '-');
    fputs("\",\"", to);
    write_waves(to, WAVES, '*');
    fputs("\",\"0\"]", to);
    ck_assert_int_eq(fclose(to), 0);
    ck_assert_ptr_null(imp_scene_from_pair(registry, text, other_surface, &error));
    ck_assert_msg(strstr(error.text, "common parts") != NULL, "%s", error.text);
    free(text);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("plugin parameters", every_example_makes_a_surface_with_points,
           every_type_says_what_it_is, wrong_parameters_are_refused_by_name_and_reason,
           a_motion_of_too_many_common_parts_is_refused)

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/scene/scene.h"
#include "core/surface/region.h"
#include "core/tree/vec.h"
#include "tests/support/query_helpers.h"

/* Surfaces that turn and slide along a plane of any direction, nearly: no point rises above the
 * plane, from one moment to another, by more than the slip; and where the axes of all turns are the
 * plane's normal and all shifts go across it, the slip is rounding. */

enum { SCENES = 400, POINTS = 20, TEXT = 2000 };

typedef struct trial {
    vec3 axis;   /* of the plane */
    double tilt; /* of the maps' axes and shifts, about; 0: as good as none */
    surface_plane plane;
    imp_region times;
    double moment;
    char text[2][TEXT];
    imp_scene *scene;
    const surface *s[2];
} trial;

static vec3 draw(uint64_t *random)
{
    vec3 x;
    for (int i = 0; i < 3; ++i) x.x[i] = random_between(random, -1, 1);
    return x;
}

static vec3 across(vec3 axis, vec3 x) { return vec3_sub(x, vec3_scale(axis, vec3_dot(axis, x))); }

static vec3 tilted(const trial *y, vec3 x, uint64_t *random)
{
    return vec3_add(x, vec3_scale(draw(random), y->tilt));
}

/* Some turns about the axis at any places, and shifts across it. */
static void add_maps(const trial *y, uint64_t *random, char *text)
{
    for (int k = (int)(random_bits(random) % 4); k > 0; --k) {
        text += strlen(text);
        const vec3 n = tilted(y, y->axis, random), c = draw(random),
                   v = tilted(y, across(y->axis, draw(random)), random);
        const double *m = random_bits(random) % 2 ? n.x : v.x;
        if (m == n.x)
            sprintf(text, " ! rotate axis=%.17g,%.17g,%.17g center=%.17g,%.17g,%.17g rate=%.17g",
                    m[0], m[1], m[2], c.x[0], c.x[1], c.x[2], random_between(random, -4, 4));
        else
            sprintf(text, " ! translate velocity=%.17g,%.17g,%.17g", m[0], m[1], m[2]);
    }
}

static void open_trial(trial *y, imp_registry *registry, uint64_t *random)
{
    imp_error error;
    const double t0 = random_between(random, -1, 1), t1 = t0 + random_power(random, -6, 0);
    y->axis = draw(random);
    y->axis = vec3_scale(y->axis, 1 / vec3_norm(y->axis));
    y->tilt = random_bits(random) % 2 ? random_power(random, -30, -12) : 0;
    y->times = region_make((double[3]){0, 0, t0}, (double[3]){0, 0, t1});
    y->moment = random_between(random, t0, t1);
    for (int k = 0; k < 2; ++k) {
        strcpy(y->text[k], "sphere");
        add_maps(y, random, y->text[k]);
    }
    y->scene = imp_scene_from_pair(registry, y->text[0], y->text[1], &error);
    ck_assert_msg(y->scene != NULL, "%s | %s: %s", y->text[0], y->text[1], error.text);
    for (int k = 0; k < 2; ++k) y->s[k] = scene_surface(y->scene, (size_t)k, 0);
    memcpy(y->plane.axis, y->axis.x, sizeof y->plane.axis);
    const vec3 center = draw(random);
    memcpy(y->plane.center, center.x, sizeof y->plane.center);
}

/* How high a point of a is above the plane of b. */
static double height(const trial *y, const double from[3], double t)
{
    double x[3], foot[6], h = 0;
    memcpy(x, from, sizeof x);
    for (int i = 0; i < 3; ++i) {
        foot[i] = y->plane.center[i];
        foot[3 + i] = foot[i] + y->plane.axis[i];
    }
    ck_assert_int_eq(surface_move_outward(y->s[0], 0, t, 1, x), IMP_STATUS_OK);
    ck_assert_int_eq(surface_move_outward(y->s[1], 0, t, 2, foot), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) h += (foot[3 + i] - foot[i]) * (x[i] - foot[i]);
    return h;
}

typedef struct tally {
    int known, exact, wanted, refuted;
    double sharpest;
} tally;

static void judge(const trial *y, double slip, uint64_t *random, tally *of)
{
    for (int k = 0; k < POINTS; ++k) {
        const double t = random_between(random, y->times.lo[2], y->times.hi[2]);
        vec3 from = draw(random);
        for (int i = 0; i < 3; ++i) from.x[i] = from.x[i] < 0 ? -1 : 1;
        const double rise = fabs(height(y, from.x, t) - height(y, from.x, y->moment));
        of->refuted += rise > slip + 1e-13;
        if (slip > 1e-8 && rise / slip > of->sharpest) of->sharpest = rise / slip;
    }
}

/* Slips times `factor`. */
static tally try_all(double factor)
{
    uint64_t random = suite_seed();
    imp_registry *registry = query_registry();
    tally of = {0};
    for (int k = 0; k < suite_times_at_least(SCENES); ++k) {
        trial y;
        imp_model bare[3];
        double slip;
        open_trial(&y, registry, &random);
        for (int i = 0; i < 3; ++i) bare[i] = imp_between(-1, 1);
        ck_assert_int_eq(
            surface_slip_along(y.s[0], y.s[1], &y.plane, bare, &y.times, y.moment, 0, &slip),
            IMP_STATUS_OK);
        of.wanted += y.tilt == 0;
        of.exact += y.tilt == 0 && slip < 0x1p-36;
        of.known += slip < INFINITY;
        if (slip < INFINITY) judge(&y, factor * slip, &random, &of);
        imp_scene_free(y.scene);
    }
    imp_registry_free(registry);
    return of;
}

START_TEST(no_point_rises_above_a_plane_by_more_than_the_slip)
{
    const tally of = try_all(1);
    ck_assert_msg(of.refuted == 0, "%d are refuted", of.refuted);
    ck_assert_msg(of.exact == of.wanted, "%d of %d are exact", of.exact, of.wanted);
    ck_assert_msg(of.known > of.exact && of.sharpest > 0.3, "%d are known, %g of one is shown",
                  of.known, of.sharpest);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(slips_along_a_plane_that_are_too_small_are_found)
{
    const tally of = try_all(0.25);
    ck_assert_int_gt(of.refuted, 0);
}
END_TEST

SUITE_MAIN("slip_planes", no_point_rises_above_a_plane_by_more_than_the_slip,
           slips_along_a_plane_that_are_too_small_are_found)

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <stdlib.h>
#include <string.h>

#include "core/bounds/piece_shadow.h"
#include "core/common/random.h"
#include "core/scene/scene.h"
#include "tests/support/side_trial.h"

/* Surfaces of many pieces that turn about a line, slide, or lie still inside and beside others:
 * points are where the course says, and at no moment are points nearer than what was claimed of all
 * pieces at once. */

enum { SCENES = 120, MOMENTS = 6, POINTS = 60, STEPS = 60, TEXT = TRIAL_TEXT };

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }

static void close_registry(void) { imp_registry_free(registry); }

/* --- Scenes ----------------------------------------------------------------------------------- */

/* A closed prism or drum of flat sides about z, its radii drawn anew at each height, as a mesh. */
static void add_drum(uint64_t *random, double radius, char text[TEXT])
{
    const int sides = 3 + (int)(random_bits(random) % 6), rows = 2 + (int)(random_bits(random) % 2);
    char *at = text;
    const double turn = 3 * random_part(random);
    at += sprintf(at, "mesh points=[");
    for (int k = 0; k < rows; ++k) {
        const double r = radius * (k == 0 ? 1 : random_between(random, 0.6, 1));
        for (int j = 0; j < sides; ++j)
            at += sprintf(at, "%s[%.17g,%.17g,%.17g]", k + j > 0 ? "," : "",
                          r * cos(turn + 2 * 3.14159265358979 * j / sides),
                          r * sin(turn + 2 * 3.14159265358979 * j / sides), 0.8 * k - 0.4);
    }
    at += sprintf(at, "] faces=[");
    for (int k = 0; k + 1 < rows; ++k)
        for (int j = 0; j < sides; ++j) {
            const int a = k * sides + j, b = k * sides + (j + 1) % sides;
            at += sprintf(at, "%s[%d,%d,%d],[%d,%d,%d]", k + j > 0 ? "," : "", a, b, a + sides, b,
                          b + sides, a + sides);
        }
    sprintf(at, "]");
}

/* Inside of the first shape, beside it, above it, or anywhere near. */
static const char *const shapes[] = {"box size=2,1,0.6 center=0,0,0.8",
                                     "box size=3,3,0.2 center=0,0,-0.55",
                                     "cylinder radius=1.5 height=2 center=0,0,-1",
                                     "cone radius=2 height=3 center=0,0,-1",
                                     "torus major_radius=2 minor_radius=0.5",
                                     "box size=4,4,2",
                                     "plane origin=-2,-2,0.7 edge_u=4,0,0 edge_v=0,4,0",
                                     "plane origin=1.3,-2,-2 edge_u=0,4,0 edge_v=0,0,4",
                                     "sphere radius=0.5 center=1.9,0.1,0.2",
                                     "sphere radius=2",
                                     "cylinder radius=1.3 height=2 ends=true",
                                     "cylinder radius=0.4 height=0.5 center=1.6,0.1,0 ends=true",
                                     "cylinder radius=0.3 height=2 center=0,0,1.6 ends=true",
                                     "cylinder radius=0.3 height=2 ! rotate axis=1,0,0 angle=1",
                                     "cone radius=0.5 height=0.6 center=0,0,0.6 ends=true",
                                     "torus major_radius=0.5 minor_radius=0.2 center=0,0,0.8",
                                     "disc radius=0.7 center=0.1,0,0.6"};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static void add_turn(uint64_t *random, char *text)
{
    const bool is_off = random_bits(random) % 4 == 0;
    sprintf(text + strlen(text), " ! rotate axis=%.17g,0,1 center=%.17g,0,0 angle=%.17g,%.17g",
            is_off ? 0.2 * random_part(random) : 0, is_off ? 0.2 * random_part(random) : 0,
            random_part(random), random_power(random, -3, 7) * (random_bits(random) % 2 ? 1 : -1));
}

static void add_shift(uint64_t *random, char *text)
{
    const bool is_along = random_bits(random) % 4 != 0;
    sprintf(text + strlen(text), " ! translate offset=[[0,0,0],[%.17g,%.17g,%.17g],[0,0,%.17g]]",
            is_along ? 0 : 0.2 * random_part(random), is_along ? 0 : 0.2 * random_part(random),
            0.4 * random_part(random), 0.2 * random_part(random));
}

static void add_place(uint64_t *random, char *text)
{
    sprintf(text + strlen(text),
            " ! rotate axis=%.17g,%.17g,1 angle=%.17g ! translate offset=[[%.17g,2,3]]",
            random_part(random), random_part(random), 3 * random_part(random), random_part(random));
}

/* Puts both shapes so that z points anywhere, nearly; a then turns about that direction and slides
 * across it. */
static void add_turned_motion(uint64_t *random, char a[TEXT], char b[TEXT])
{
    const vec3 z = {{0, 0, 1}};
    vec3 n = {{random_part(random), random_part(random), random_part(random)}},
         v = {{random_part(random), random_part(random), 0}};
    n = vec3_scale(n, 1 / vec3_norm(n));
    const vec3 to = vec3_cross(z, n);
    for (int k = 0; k < 2; ++k)
        sprintf((k == 0 ? a : b) + strlen(k == 0 ? a : b),
                " ! rotate axis=%.17g,%.17g,0 angle=%.17g ! translate offset=[[%.17g,0,0]]",
                to.x[0], to.x[1], acos(n.x[2]), k * 0.2 * random_part(random));
    v = vec3_sub(v, vec3_scale(n, vec3_dot(v, n)));
    if (random_bits(random) % 4 == 0) v = vec3_add(v, vec3_scale(n, 0.1 * random_part(random)));
    sprintf(a + strlen(a),
            " ! rotate axis=%.17g,%.17g,%.17g rate=%.17g ! translate velocity=%.17g,%.17g,%.17g",
            n.x[0], n.x[1], n.x[2], 3 * random_part(random), v.x[0], v.x[1], v.x[2]);
}

static void draw_scene(uint64_t *random, char a[TEXT], char b[TEXT])
{
    char place[TEXT] = "";
    add_drum(random, random_between(random, 0.5, 1), a);
    if (random_bits(random) % 3)
        strcpy(b, shapes[random_bits(random) % SHAPES]);
    else
        add_drum(random, random_between(random, 1.5, 3), b);
    if (random_bits(random) % 4 == 0) strcat(a, " ! scale factor=[0.9,0.8,0.9]");
    if (random_bits(random) % 4 == 0) {
        add_turned_motion(random, a, b);
        return;
    }
    if (random_bits(random) % 4) add_turn(random, a);
    if (random_bits(random) % 8 == 0) add_turn(random, b);
    if (random_bits(random) % 4) add_shift(random, random_bits(random) % 2 ? a : b);
    if (random_bits(random) % 2) add_place(random, place);
    strcat(a, place);
    if (random_bits(random) % 8) strcat(b, place);
}

static void trial_begin(trial *y, uint64_t *random)
{
    draw_scene(random, y->text[0], y->text[1]);
    const double t0 = random_fraction(random), t1 = t0 + random_power(random, -8, 0);
    trial_open(y, registry, t0, t1);
}

/* --- Distances at a moment -------------------------------------------------------------------- */

enum { GRID = 4, SPOTS = GRID * GRID, BEST = 4 };

/* A point of a piece. */
typedef struct spot {
    size_t piece;
    double at[2], x[3];
} spot;

typedef struct near_spots {
    const spot *s[2];
    double apart;
} near_spots;

static spot *spots_of(const surface *s, double t, size_t *count)
{
    *count = SPOTS * surface_part_count(s);
    spot *all = calloc(*count, sizeof *all);
    ck_assert_ptr_nonnull(all);
    for (size_t k = 0; k < *count; ++k) {
        all[k].piece = k / SPOTS;
        all[k].at[0] = (double)(k % GRID) / (GRID - 1);
        all[k].at[1] = (double)(k / GRID % GRID) / (GRID - 1);
        place_at(surface_part(s, all[k].piece), all[k].at, t, all[k].x);
    }
    return all;
}

/* The distance of two pieces near two points of them, from above. */
static double step_near(const trial *y, const near_spots *from, double t)
{
    double best = from->apart, at[2][2], step = 0.2;
    for (int j = 0; j < 2; ++j) memcpy(at[j], from->s[j]->at, sizeof at[j]);
    for (int k = 0; k < STEPS; ++k) {
        bool found = false;
        for (int d = 0; d < 8; ++d) {
            double to[2][2], x[2][3];
            memcpy(to, at, sizeof to);
            double *moved = &to[d / 4][d / 2 % 2];
            *moved += d % 2 ? step : -step;
            *moved = *moved < 0 ? 0 : *moved > 1 ? 1 : *moved;
            for (int j = 0; j < 2; ++j)
                place_at(surface_part(y->s[j], from->s[j]->piece), to[j], t, x[j]);
            if (!(query_distance(x[0], x[1]) < best)) continue;
            best = query_distance(x[0], x[1]), found = true;
            memcpy(at, to, sizeof at);
        }
        if (!found) step *= 0.5;
    }
    return best;
}

/* Nearly the distance at a time, from above: near some of the nearest pairs of points. */
static double nearly_apart(const trial *y, double t)
{
    near_spots best[BEST];
    size_t count[2];
    spot *const all[2] = {spots_of(y->s[0], t, &count[0]), spots_of(y->s[1], t, &count[1])};
    double least = INFINITY;
    for (int k = 0; k < BEST; ++k) best[k].apart = INFINITY;
    for (size_t i = 0; i < count[0]; ++i)
        for (size_t j = 0; j < count[1]; ++j) {
            near_spots here = {{&all[0][i], &all[1][j]}, query_distance(all[0][i].x, all[1][j].x)};
            for (int k = 0; k < BEST && here.apart < best[BEST - 1].apart; ++k) {
                if (!(here.apart < best[k].apart)) continue;
                const near_spots other = best[k];
                best[k] = here, here = other;
            }
        }
    for (int k = 0; k < BEST && best[k].apart < INFINITY; ++k) {
        const double found = step_near(y, &best[k], t);
        if (found < least) least = found;
    }
    for (int k = 0; k < 2; ++k) free(all[k]);
    return least;
}

typedef struct tally {
    int apart, cut, bounded, refuted, too_far;
} tally;

static void try_scene(double share, uint64_t *random, tally *sum)
{
    trial y;
    imp_error error;
    double found[MOMENTS], t[MOMENTS], least = INFINITY;
    trial_begin(&y, random);
    for (int k = 0; k < MOMENTS; ++k) {
        const double f = k == 0 ? 0 : k == 1 ? 1 : random_fraction(random);
        t[k] = y.times.lo + f * (y.times.hi - y.times.lo);
        found[k] = share * nearly_apart(&y, t[k]) + 1e-12;
        if (found[k] < least) least = found[k];
    }
    const double near = random_bits(random) % 2 ? least : found[random_bits(random) % MOMENTS];
    const double gamma_clear = near * (1 + random_power(random, -20, -1) * random_part(random));
    distance_outcome seen = distance_outcome_none(&y.times);
    ck_assert_int_eq(piece_sides_cut(&y.of, 1, gamma_clear, &seen, &error), IMP_SUCCESS);
    sum->apart += seen.is_apart;
    sum->cut += !seen.is_apart && (seen.left.lo > y.times.lo || seen.left.hi < y.times.hi);
    sum->bounded += seen.lower > 0;
    for (int k = 0; k < MOMENTS; ++k) {
        const bool is_cut_off = seen.is_apart || t[k] < seen.left.lo || t[k] > seen.left.hi;
        if (is_cut_off && found[k] < gamma_clear) sum->refuted += 1;
        if (found[k] < seen.lower) sum->too_far += 1;
        if (share == 1)
            ck_assert_msg(!(is_cut_off && found[k] < gamma_clear) && !(found[k] < seen.lower),
                          "%s | %s: %.17g at %.17g, %.17g claimed, gamma_clear %.17g", y.text[0],
                          y.text[1], found[k], t[k], seen.lower, gamma_clear);
    }
    trial_end(&y);
}

START_TEST(no_points_are_nearer_than_is_claimed_of_all_pieces)
{
    uint64_t random = suite_seed();
    tally sum = {0, 0, 0, 0, 0};
    for (int k = 0; k < suite_times_from(SCENES, SCENES / 3); ++k) try_scene(1, &random, &sum);
    ck_assert_msg(sum.apart + sum.cut > 0 && sum.bounded > 0, "%d apart, %d cut, %d bounded",
                  sum.apart, sum.cut, sum.bounded);
}
END_TEST

/* The test above must be able to fail: of distances that are a little less it does. */
START_TEST(claims_that_are_too_large_are_found)
{
    uint64_t random = suite_seed();
    tally sum = {0, 0, 0, 0, 0};
    for (int k = 0; k < 20 * SCENES && (sum.refuted == 0 || sum.too_far == 0); ++k)
        try_scene(1 - 2e-2, &random, &sum);
    ck_assert_msg(sum.refuted > 0 && sum.too_far > 0, "%d refuted, %d too far", sum.refuted,
                  sum.too_far);
}
END_TEST

/* --- Courses ---------------------------------------------------------------------------------- */

/* x before the surface's maps, which are exact rotations and shifts: by its images of 4 points. */
static void take_back(const double frame[4][3], const double x[3], double out[3])
{
    for (int j = 0; j < 3; ++j) {
        out[j] = 0;
        for (int i = 0; i < 3; ++i)
            out[j] += (frame[j + 1][i] - frame[0][i]) * (x[i] - frame[0][i]);
    }
}

static void frame_at(const surface *s, double t, double frame[4][3])
{
    for (int k = 0; k < 4; ++k) {
        memset(frame[k], 0, sizeof frame[k]);
        if (k > 0) frame[k][k - 1] = 1;
    }
    ck_assert_int_eq(surface_move_outward(s, surface_inner_maps(s), t, 4, frame[0]), IMP_STATUS_OK);
}

/* Along the line and beside it. */
static void places(const surface_course *c, const double x[3], double place[2])
{
    vec3 from;
    for (int i = 0; i < 3; ++i) from.x[i] = x[i] - c->center[i];
    const vec3 axis = vec3_from(c->axis);
    place[0] = vec3_dot(from, axis);
    place[1] = vec3_norm(vec3_cross(from, axis));
}

static void judge_course(const trial *y, const surface_course *c, const imp_region *times,
                         const imp_model bare[3], uint64_t *random)
{
    for (int k = 0; k < POINTS; ++k) {
        const double w = random_part(random), t = times->c[2] + w * times->d[2];
        double from[3], now[3], frame[2][4][3], x[3], z[3], off = c->off + 1e-11;
        for (int i = 0; i < 3; ++i) from[i] = random_between(random, bare[i].lo, bare[i].hi);
        frame_at(y->s[0], t, frame[0]);
        frame_at(y->s[1], t, frame[1]);
        for (int i = 0; i < 3; ++i) {
            now[i] = frame[1][0][i];
            for (int j = 0; j < 3; ++j) now[i] += (frame[1][j + 1][i] - frame[1][0][i]) * from[j];
        }
        take_back((const double(*)[3])frame[0], now, x);
        for (int i = 0; i < 3; ++i) {
            const imp_model *way = &c->way[i];
            const double moved = way->a + way->b[2] * w + way->q[IMP_TT] * w * w;
            z[i] = c->shift[i] + (c->spins ? 0 : moved);
            x[i] -= c->spins ? moved : 0;
            off += way->e;
            for (int j = 0; j < 3; ++j) z[i] += c->turn[i][j] * from[j];
        }
        if (!c->spins) {
            ck_assert_msg(query_distance(x, z) <= off, "%s | %s", y->text[0], y->text[1]);
            continue;
        }
        double at[2], was[2];
        places(c, x, at);
        places(c, z, was);
        const double beside = fabs(at[1] - was[1]) - c->wander;
        ck_assert_msg(hypot(at[0] - was[0], beside > 0 ? beside : 0) <= off,
                      "%s | %s at %.17g: %g %g, %g", y->text[0], y->text[1], t, at[0] - was[0],
                      at[1] - was[1], off);
    }
}

START_TEST(points_are_where_the_course_says)
{
    uint64_t random = suite_seed();
    int still = 0, spins = 0, slides = 0;
    for (int n = 0; n < suite_times_from(SCENES, SCENES / 3); ++n) {
        trial y;
        surface_course course;
        trial_begin(&y, &random);
        const double lo[3] = {-1, -1, y.times.lo}, hi[3] = {1, 1, y.times.hi};
        const imp_region times = region_make(lo, hi);
        const imp_model bare[3] = {imp_between(-1, 1), imp_between(-0.5, 1), imp_between(0, 2)};
        const double moment = random_between(&random, y.times.lo, y.times.hi);
        ck_assert_int_eq(surface_course_of(y.s[0], y.s[1], bare, &times, moment, &course),
                         IMP_STATUS_OK);
        still += course.is_known && !course.spins;
        spins += course.is_known && course.spins && course.off < 1e-6 && course.wander == 0;
        slides += course.is_known && course.off < 1e-6 && course.wander > 0;
        if (course.is_known) judge_course(&y, &course, &times, bare, &random);
        trial_end(&y);
    }
    ck_assert_msg(still > 0 && spins > 0 && slides > 0, "%d still, %d spin, %d slide", still, spins,
                  slides);
}
END_TEST

/* --- What a surface sweeps -------------------------------------------------------------------- */

enum { NORMALS = 8 };

/* n.x of b's point as a sees it, less what the shadow of b says of all its points: no less than 0.
 * Returns it. */
static double above_shadow(const trial *y, const piece_course *of, const piece_shadow *shadow,
                           vec3 n, double t, double w, uint64_t *random)
{
    const surface_course *c = &of->course;
    const size_t piece = random_bits(random) % surface_part_count(of->b);
    const double at[2] = {random_fraction(random), random_fraction(random)};
    double world[3], frame[4][3], x[3], off = c->off + of->other->slack + 1e-11;
    size_t cell = SIZE_MAX;
    place_at(surface_part(of->b, piece), at, t, world);
    frame_at(of->a, t, frame);
    take_back((const double(*)[3])frame, world, x);
    double height = 0;
    for (int i = 0; i < 3; ++i) {
        const imp_model *way = &c->way[i];
        const double moved = way->a + way->b[2] * w + way->q[IMP_TT] * w * w;
        height += n.x[i] * (x[i] - moved - (c->spins ? c->center[i] : 0));
        off += way->e;
    }
    if (c->spins) off += c->wander * vec3_norm(vec3_cross(n, vec3_from(c->axis)));
    const double above = height - piece_shadow_least(shadow, n, &cell);
    ck_assert_uint_lt(cell, of->other->count);
    ck_assert_msg(above >= -off, "%s | %s at %.17g: %g below", y->text[0], y->text[1], t, -above);
    return above;
}

static void judge_shadow(const trial *y, int side, uint64_t *random, int hoops[2], int *near)
{
    piece_corners corners[2];
    imp_error error;
    bool known[2];
    for (int k = 0; k < 2; ++k)
        ck_assert_int_eq(
            piece_corners_take(y->s[k], &y->times, SIZE_MAX, NULL, &corners[k], &known[k], &error),
            IMP_SUCCESS);
    const double lo[3] = {-1, -1, y->times.lo}, hi[3] = {1, 1, y->times.hi};
    piece_course of = {y->s[side],      y->s[!side], &corners[side],
                       &corners[!side], {0},         region_make(lo, hi)};
    const double far = corners[!side].reach + corners[!side].slack;
    const imp_model bare[3] = {imp_between(-far, far), imp_between(-far, far),
                               imp_between(-far, far)};
    ck_assert_int_eq(surface_course_of(of.a, of.b, bare, &of.times, of.times.c[2], &of.course),
                     IMP_STATUS_OK);
    piece_shadow shadow;
    const bool asked = known[0] && known[1] && of.course.is_known;
    if (asked) ck_assert_int_eq(piece_shadow_take(&of, &shadow, &error), IMP_SUCCESS);
    for (size_t k = 0; k < corners[!side].count && asked; ++k)
        hoops[of.course.spins] += corners[!side].of[k].is_hoop;
    for (int k = 0; k < NORMALS && asked; ++k) {
        vec3 n = {{random_part(random), random_part(random), random_part(random)}};
        n = vec3_scale(n, 1 / vec3_norm(n));
        for (int j = 0; j < POINTS; ++j) {
            const double w = random_part(random);
            const double above =
                above_shadow(y, &of, &shadow, n, of.times.c[2] + w * of.times.d[2], w, random);
            *near += above < 1e-2 * shadow.reach;
        }
    }
    if (asked) piece_shadow_clear(&shadow);
    for (int k = 0; k < 2; ++k) piece_corners_clear(&corners[k]);
}

/* Seen from either surface, which turns about some line, shifts, or rests. */
START_TEST(no_point_is_beyond_what_a_surface_sweeps)
{
    uint64_t random = suite_seed();
    int hoops[2] = {0, 0}, near = 0;
    for (int n = 0; n < suite_times_from(SCENES, SCENES / 3); ++n) {
        trial y;
        trial_begin(&y, &random);
        for (int side = 0; side < 2; ++side) judge_shadow(&y, side, &random, hoops, &near);
        trial_end(&y);
    }
    ck_assert_msg(hoops[0] > 0 && hoops[1] > 0 && near > 0, "%d and %d hoops, %d near", hoops[0],
                  hoops[1], near);
}
END_TEST

/* --- Far along a line ------------------------------------------------------------------------- */

enum { FAR_SCENES = 40, STAR_RAYS = 7 };

/* A star of triangles in a plane across an oblique line through 0, far along it, turns about the
 * line, and a ball is inside. What is along that line must not be mistaken for what is across. */
static void draw_far_star(uint64_t *random, char a[TEXT], char b[TEXT])
{
    vec3 axis = {{random_part(random), random_part(random), 1}};
    axis = vec3_scale(axis, 1 / vec3_norm(axis));
    const double far = random_power(random, 12, 17), radius = random_between(random, 0.2, 1);
    vec3 side = vec3_cross(axis, (vec3){{1, 0, 0}});
    side = vec3_scale(side, 1 / vec3_norm(side));
    const vec3 other = vec3_cross(axis, side), middle = vec3_scale(axis, far);
    char *at = a + sprintf(a, "mesh points=[");
    for (int k = 0; k < 2 * STAR_RAYS; ++k) {
        const double angle = 3.14159265358979 * k / STAR_RAYS, from = radius * (k % 2 == 0 ? 1 : 2);
        const vec3 across =
            vec3_add(vec3_scale(side, from * cos(angle)), vec3_scale(other, from * sin(angle)));
        const vec3 x = vec3_add(middle, across);
        at += sprintf(at, "%s[%.17g,%.17g,%.17g]", k > 0 ? "," : "", x.x[0], x.x[1], x.x[2]);
    }
    at += sprintf(at, "] faces=[");
    for (int j = 0; j < STAR_RAYS; ++j)
        at += sprintf(at, "%s[%d,%d,%d]", j > 0 ? "," : "", 2 * j + 1, 2 * j,
                      (2 * j + 2) % (2 * STAR_RAYS));
    sprintf(at, "] ! rotate axis=%.17g,%.17g,%.17g angle=0,2", axis.x[0], axis.x[1], axis.x[2]);
    sprintf(b, "sphere radius=%.17g center=%.17g,%.17g,%.17g", 0.4 * radius, middle.x[0],
            middle.x[1], middle.x[2]);
}

START_TEST(what_is_across_a_line_is_told_far_along_it)
{
    uint64_t random = suite_seed();
    int bounded = 0;
    for (int k = 0; k < FAR_SCENES; ++k) {
        trial y;
        imp_error error;
        draw_far_star(&random, y.text[0], y.text[1]);
        trial_open(&y, registry, 0, 1);
        distance_outcome seen = distance_outcome_none(&y.times);
        ck_assert_int_eq(piece_sides_cut(&y.of, 1, 1e9, &seen, &error), IMP_SUCCESS);
        const double apart = nearly_apart(&y, 0);
        bounded += seen.lower > 0.5 * apart;
        ck_assert_msg(seen.lower <= apart, "%s | %s: %.17g, %.17g claimed", y.text[0], y.text[1],
                      apart, seen.lower);
        trial_end(&y);
    }
    ck_assert_int_gt(bounded, 0);
}
END_TEST

/* The corner at (1.1, 0, h) turns through the plane x = 1.05, at heights whose products underflow,
 * too. */
START_TEST(places_that_are_almost_one_leave_out_no_corner)
{
    static const char *const heights[] = {"0.001", "1e-200", "1e-310", "5e-324"};
    for (size_t k = 0; k < sizeof heights / sizeof *heights; ++k) {
        char b[TEXT];
        const char *h = heights[k];
        snprintf(b, sizeof b,
                 "mesh points=[[0.5,0.2,0],[1,0,0],[0.4,0,0],[0.5,0.1,%s],[1.1,0,%s],[0.4,0.1,%s],"
                 "[0.5,0.3,%.17g],[1,0,%.17g],[0.4,0.1,%.17g]] faces=[[0,1,2],[3,4,5],[6,7,8]] ! "
                 "rotate rate=7",
                 h, h, h, 2 * strtod(h, NULL), 2 * strtod(h, NULL), 2 * strtod(h, NULL));
        imp_error error;
        imp_scene *scene = imp_scene_from_pair(
            registry, "mesh points=[[1.05,-2,-1],[1.05,2,-1],[1.05,0,2]] faces=[[0,1,2]]", b,
            &error);
        const imp_options options = imp_options_default(scene);
        imp_result r = {.struct_size = sizeof r};
        ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_SUCCESS);
        ck_assert_msg(r.verdict == IMP_VERDICT_CONTACT, "%s", b);
        imp_scene_free(scene);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {no_points_are_nearer_than_is_claimed_of_all_pieces,
                                  claims_that_are_too_large_are_found,
                                  points_are_where_the_course_says,
                                  no_point_is_beyond_what_a_surface_sweeps,
                                  what_is_across_a_line_is_told_far_along_it,
                                  places_that_are_almost_one_leave_out_no_corner};
    return suite_main_with("piece sides", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}

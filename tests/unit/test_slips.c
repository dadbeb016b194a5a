/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/formula.h>
#include <string.h>

#include "core/surface/region.h"
#include "core/surface/surface.h"
#include "tests/support/compose.h"
#include "tests/support/suite.h"

/* Surfaces that turn and move along another, nearly as its symmetry permits, under random chains of
 * rigid maps, some as far from rigid as they may be: a point is no farther than the slip from where
 * it was, but for a motion of the symmetry, and no nearer to the other than is claimed; found in
 * long double. */

enum { CASES = 3000, POINTS = 6, MAPS = 3 };

/* --- Maps ------------------------------------------------------------------------------------- */

/* x -> shift + way t + stretch(t) place spin(t) (x - pivot), spin by rate t about z, stretch(t) = 1
 * + swell t^2. */
typedef struct motion {
    double place[3][3]; /* a rotation, nearly */
    double rate, swell; /* rate: rad / time */
    double shift[3], way[3], pivot[3];
    bool is_placed; /* else place is 1, exactly */
} motion;

static imp_status pose_of(const void *self, const imp_model *t, imp_pose *pose)
{
    const motion *m = self;
    imp_model sine, cosine;
    imp_sincos(imp_scale(*t, m->rate), &sine, &cosine);
    const imp_model spin[3][3] = {{cosine, imp_neg(sine), imp_num(0)},
                                  {sine, cosine, imp_num(0)},
                                  {imp_num(0), imp_num(0), imp_num(1)}};
    const imp_model stretch = imp_shift(imp_scale(imp_sqr(*t), m->swell), 1);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            imp_model entry = spin[i][j];
            if (m->is_placed) {
                const imp_model row[3] = {imp_num(m->place[i][0]), imp_num(m->place[i][1]),
                                          imp_num(m->place[i][2])};
                const imp_model column[3] = {spin[0][j], spin[1][j], spin[2][j]};
                entry = imp_dot3(row, column);
            }
            pose->turn[i][j] = m->swell != 0 ? imp_mul(entry, stretch) : entry;
        }
        pose->shift[i] = imp_shift(imp_scale(*t, m->way[i]), m->shift[i]);
        pose->pivot[i] = m->pivot[i];
    }
    return IMP_STATUS_OK;
}

/* (x - pivot) turned and stretched. */
static void turned(const motion *m, long double t, const long double w[3], long double out[3])
{
    const long double c = cosl(m->rate * t), s = sinl(m->rate * t), stretch = 1 + m->swell * t * t;
    const long double spun[3] = {c * w[0] - s * w[1], s * w[0] + c * w[1], w[2]};
    for (int i = 0; i < 3; ++i) {
        out[i] = spun[i];
        if (m->is_placed)
            out[i] = m->place[i][0] * spun[0] + m->place[i][1] * spun[1] + m->place[i][2] * spun[2];
        out[i] *= stretch;
    }
}

static void apply(const motion *m, long double t, long double x[3])
{
    long double w[3], y[3];
    for (int i = 0; i < 3; ++i) w[i] = x[i] - m->pivot[i];
    turned(m, t, w, y);
    for (int i = 0; i < 3; ++i) x[i] = m->shift[i] + m->way[i] * t + y[i];
}

/* The inverse: as the turn is nearly a rotation, its transpose leaves a rest that shrinks in each
 * step. */
static void undo(const motion *m, long double t, long double x[3])
{
    const long double c = cosl(m->rate * t), s = sinl(m->rate * t);
    long double aim[3], found[3] = {0, 0, 0};
    for (int i = 0; i < 3; ++i) aim[i] = x[i] - m->shift[i] - m->way[i] * t;
    for (int step = 0; step < 8; ++step) {
        long double now[3], rest[3], back[3];
        turned(m, t, found, now);
        for (int i = 0; i < 3; ++i) rest[i] = aim[i] - now[i];
        for (int j = 0; j < 3; ++j) {
            back[j] = rest[j];
            if (m->is_placed)
                back[j] =
                    m->place[0][j] * rest[0] + m->place[1][j] * rest[1] + m->place[2][j] * rest[2];
        }
        found[0] += c * back[0] + s * back[1];
        found[1] += c * back[1] - s * back[0];
        found[2] += back[2];
    }
    for (int j = 0; j < 3; ++j) x[j] = m->pivot[j] + found[j];
}

static imp_status move(const void *self, size_t n, const double *p, double *x, double *error)
{
    for (size_t k = 0; k < n; ++k) {
        long double y[3] = {p[4 * k], p[4 * k + 1], p[4 * k + 2]};
        apply(self, p[4 * k + 3], y);
        for (size_t i = 0; i < 3; ++i) x[3 * k + i] = (double)y[i];
        for (size_t i = 0; i < 3 && error != NULL; ++i) error[3 * k + i] = INFINITY;
    }
    return IMP_STATUS_OK;
}

/* --- Types ------------------------------------------------------------------------------------ */

/* A ball, a torus, a cylinder and a plane, of radius 1 where they have one; the line is along z. */
static imp_model gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const imp_symmetry *s = self;
    const imp_model w[3] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1]),
                            imp_shift(z, -s->center[2])};
    const imp_model across = imp_sqrt(imp_add(imp_sqr(w[0]), imp_sqr(w[1]))),
                    ring = imp_shift(across, -2);
    (void)t;
    switch (s->kind) {
    case IMP_SYMMETRY_ABOUT_POINT:
        return imp_shift(imp_sqrt(imp_dot3(w, w)), -1);
    case IMP_SYMMETRY_ABOUT_LINE:
        return imp_shift(imp_sqrt(imp_add(imp_sqr(ring), imp_sqr(w[2]))), -1);
    case IMP_SYMMETRY_ALONG_LINE:
        return imp_shift(across, -1);
    default:
        return w[2];
    }
}
IMP_DISTANCE_FORMULA(gap)

static imp_status symmetry_of(const void *self, imp_symmetry *symmetry)
{
    *symmetry = *(const imp_symmetry *)self;
    return IMP_STATUS_OK;
}

static void whole(const void *self, double lo[3], double hi[3])
{
    (void)self;
    for (int j = 0; j < 3; ++j) lo[j] = j < 2 ? 0 : -INFINITY, hi[j] = j < 2 ? 1 : INFINITY;
}

static void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static void keep(void *self) { (void)self; }

static const imp_surface_type target = {.struct_size = sizeof(imp_surface_type),
                                        .name = "target",
                                        .domain = whole,
                                        .destroy = keep,
                                        .distance = gap_distance,
                                        .symmetry = symmetry_of};
static const imp_map_type nearly = {.struct_size = sizeof(imp_map_type),
                                    .name = "nearly",
                                    .time_domain = always,
                                    .destroy = keep,
                                    .eval = move,
                                    .rigid = pose_of};
static const imp_map_type exactly = {.struct_size = sizeof(imp_map_type),
                                     .flags = IMP_FLAG_TURNS_EXACTLY,
                                     .name = "exactly",
                                     .time_domain = always,
                                     .destroy = keep,
                                     .eval = move,
                                     .rigid = pose_of};

/* --- Trials ----------------------------------------------------------------------------------- */

typedef struct trial {
    imp_symmetry symmetry;
    motion own[2], placing, other;
    motion turn; /* of the other, before it is placed */
    size_t own_count, turns;
    bool is_placed;   /* both are, alike */
    bool moves_along; /* one moves as the symmetry permits, too */
    imp_region times;
    double stretch;       /* of the placing */
    double moment, reach; /* half the box around the points before the maps */
} trial;

static void draw_vector(uint64_t *random, double size, double x[3])
{
    for (int i = 0; i < 3; ++i) x[i] = size * random_between(random, -1, 1);
}

/* A rotation, times `stretch`. */
static void draw_place(uint64_t *random, double stretch, motion *m)
{
    double q[4], square = 0;
    for (int k = 0; k < 4; ++k) {
        q[k] = random_between(random, -1, 1);
        square += q[k] * q[k];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        m->place[i][i] = 1 - 2 * (q[j + 1] * q[j + 1] + q[k + 1] * q[k + 1]) / square;
        m->place[i][j] = 2 * (q[i + 1] * q[j + 1] - q[0] * q[k + 1]) / square;
        m->place[j][i] = 2 * (q[i + 1] * q[j + 1] + q[0] * q[k + 1]) / square;
    }
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) m->place[i][k] *= stretch;
    m->is_placed = true;
}

/* By a small angle about a line along x through the center, after the spin. */
static void tilt(const trial *y, double angle, motion *m)
{
    memset(m->place, 0, sizeof m->place);
    m->place[0][0] = 1;
    m->place[1][1] = m->place[2][2] = cos(angle);
    m->place[2][1] = sin(angle);
    m->place[1][2] = -sin(angle);
    m->is_placed = true;
    for (int i = 0; i < 3; ++i) m->pivot[i] = m->shift[i] = y->symmetry.center[i];
}

/* The own maps: a spin about a line along z that is off the symmetry's by as much as comes out, and
 * tilted by as much. */
static trial draw_trial(uint64_t *random)
{
    const double lo[3] = {0, 0, random_between(random, -1, 0)};
    const double hi[3] = {1, 1, lo[2] + random_power(random, -8, 0)};
    const double far = random_bits(random) % 2 ? random_power(random, 0, 8) : 1;
    trial y = {.times = region_make(lo, hi), .reach = random_power(random, -3, 3)};
    y.moment = lo[2] + (hi[2] - lo[2]) * random_between(random, 0, 1);
    y.symmetry.kind = 1 + (uint32_t)(random_bits(random) % 4);
    y.symmetry.axis[2] = random_power(random, -8, 8);
    draw_vector(random, far, y.symmetry.center);
    const double off = random_bits(random) % 3 ? y.reach * random_power(random, -40, -8) : 0;
    motion *spin = &y.own[0];
    spin->rate = random_between(random, -4, 4);
    spin->swell = random_bits(random) % 4 ? 0 : random_between(random, -3e-6, 3e-6);
    for (int i = 0; i < 3; ++i) {
        spin->pivot[i] = y.symmetry.center[i] + off * random_between(random, -1, 1);
        spin->shift[i] = spin->pivot[i];
        if (y.symmetry.kind != IMP_SYMMETRY_ABOUT_POINT && i == 2) spin->pivot[i] += far;
        spin->way[i] = off * random_between(random, -1, 1);
    }
    y.turns = random_bits(random) % 2;
    y.own_count = y.turns > 0 && random_bits(random) % 2 ? 0 : 2;
    y.turn = *spin;
    y.turn.rate = random_between(random, -4, 4);
    y.moves_along = random_bits(random) % 2;
    if (y.moves_along && y.symmetry.kind == IMP_SYMMETRY_ALONG_LINE) spin->way[2] = y.reach;
    if (y.moves_along && y.symmetry.kind == IMP_SYMMETRY_ACROSS_LINE)
        spin->way[0] = spin->way[1] = y.reach;
    if (off > 0 && random_bits(random) % 2) tilt(&y, off / y.reach, &y.own[1]);
    y.is_placed = random_bits(random) % 2;
    y.stretch = random_bits(random) % 2 ? 1 : 1 + random_between(random, -7e-6, 7e-6);
    draw_place(random, y.stretch, &y.placing);
    draw_vector(random, far, y.placing.shift);
    draw_vector(random, far, y.placing.pivot);
    if (random_bits(random) % 2) draw_vector(random, 1, y.placing.way);
    return y;
}

static surface *compose(imp_symmetry *self, motion *const maps[], size_t count)
{
    surface *s = surface_new(&target, self);
    ck_assert_ptr_nonnull(s);
    for (size_t k = 0; k < count; ++k) {
        const imp_map_type *type = maps[k]->swell != 0 || maps[k]->is_placed ? &nearly : &exactly;
        ck_assert_int_eq(surface_add_map(s, type, maps[k]), IMP_SUCCESS);
    }
    return s;
}

/* Where a point of a is at a time, seen from b. */
static void seen(const trial *y, long double t, const long double from[3], long double x[3])
{
    for (int i = 0; i < 3; ++i) x[i] = from[i];
    for (size_t k = 0; k < y->own_count; ++k) apply(&y->own[k], t, x);
    if (y->is_placed) apply(&y->placing, t, x);
    if (y->is_placed) undo(&y->other, t, x);
    if (y->turns > 0) undo(&y->turn, t, x);
}

/* Where a point is beside the center, but for motions of the symmetry. */
typedef struct orbit {
    long double along, across;
} orbit;

static orbit orbit_of(const imp_symmetry *of, const long double x[3])
{
    const long double along = x[2] - of->center[2];
    const long double across = hypotl(x[0] - of->center[0], x[1] - of->center[1]);
    switch (of->kind) {
    case IMP_SYMMETRY_ABOUT_POINT:
        return (orbit){0, hypotl(across, along)};
    case IMP_SYMMETRY_ABOUT_LINE:
        return (orbit){along, across};
    case IMP_SYMMETRY_ALONG_LINE:
        return (orbit){0, across};
    default:
        return (orbit){along, 0};
    }
}

static long double apart(const orbit *x, const orbit *y)
{
    return hypotl(x->along - y->along, x->across - y->across);
}

/* From the surface whose distance is the gap. */
static long double off(const imp_symmetry *of, const orbit *x)
{
    if (of->kind == IMP_SYMMETRY_ACROSS_LINE) return fabsl(x->along);
    if (of->kind == IMP_SYMMETRY_ABOUT_LINE) return fabsl(hypotl(x->across - 2, x->along) - 1);
    return fabsl(x->across - 1);
}

/* --- Judging ---------------------------------------------------------------------------------- */

typedef struct tally {
    int judged, refuted, known, exact;
    int too_far;     /* distances that are refuted */
    double sharpest; /* the greatest part of a slip that a point shows */
} tally;

/* What is claimed at all times of a point that is at x at the moment, after all maps. */
static long double claimed(const trial *y, const surface *b, double slip, const long double x[3])
{
    imp_model point[3], g;
    for (int i = 0; i < 3; ++i) point[i] = imp_known((double)x[i], 0x1p-52 * fabs((double)x[i]));
    const imp_status status =
        surface_distance_within(b, &y->times, y->turns + y->is_placed, point, y->moment, slip, &g);
    if (status != IMP_STATUS_OK) return 0;
    ck_assert(g.b[0] == 0 && g.b[1] == 0 && g.b[2] == 0);
    const double by_polynomial = fabs(g.a) - g.e, by_range = g.lo > -g.hi ? g.lo : -g.hi;
    return by_polynomial > by_range ? by_polynomial : by_range;
}

static void judge(const trial *y, const surface *b, double slip, uint64_t *random, tally *of)
{
    const long double size = 64 * (1 + y->reach) * 256, stretch = y->is_placed ? y->stretch : 1;
    for (int k = 0; k < POINTS; ++k) {
        const long double t = y->times.lo[2] + (y->times.hi[2] - y->times.lo[2]) *
                                                   (long double)random_fraction(random);
        long double from[3], now[3], then[3], world[3];
        for (int i = 0; i < 3; ++i) {
            const uint64_t end = random_bits(random) % 3;
            from[i] = end == 0   ? y->reach
                      : end == 1 ? -y->reach
                                 : y->reach * random_between(random, -1, 1);
            from[i] += y->symmetry.center[i];
        }
        seen(y, t, from, now);
        seen(y, y->moment, from, then);
        const orbit at = orbit_of(&y->symmetry, now), was = orbit_of(&y->symmetry, then);
        const long double shown = apart(&at, &was);
        for (int i = 0; i < 3; ++i) world[i] = then[i];
        if (y->turns > 0) apply(&y->turn, y->moment, world);
        if (y->is_placed) apply(&y->other, y->moment, world);
        of->judged += 1;
        of->refuted += shown > slip + 0x1p-58L * size;
        of->too_far +=
            claimed(y, b, slip, world) > stretch * off(&y->symmetry, &at) + 0x1p-58L * size;
        if (slip > 0x1p-30 * y->reach && shown / slip > of->sharpest)
            of->sharpest = (double)(shown / slip);
    }
}

/* Slips times `factor`. */
static tally try_all(double factor)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    for (int k = 0; k < suite_times(CASES); ++k) {
        trial y = draw_trial(&random);
        y.other = y.placing;
        motion *const of_a[] = {&y.own[0], &y.own[1], &y.placing}, *const of_b[] = {&y.turn,
                                                                                    &y.other};
        surface *a = compose(&y.symmetry, of_a + 2 - y.own_count, y.own_count + y.is_placed);
        surface *b = compose(&y.symmetry, of_b + 1 - y.turns, y.turns + y.is_placed);
        imp_model bare[3];
        double slip;
        for (int i = 0; i < 3; ++i)
            bare[i] = imp_between(y.symmetry.center[i] - y.reach, y.symmetry.center[i] + y.reach);
        ck_assert_int_eq(surface_slip(a, b, bare, &y.times, y.moment, &slip), IMP_STATUS_OK);
        if (slip < INFINITY) judge(&y, b, factor * slip, &random, &of);
        of.known += slip < INFINITY;
        of.exact += slip < 0x1p-36 * (y.reach + 256);
        surface_free(a);
        surface_free(b);
    }
    return of;
}

START_TEST(no_point_slips_farther_than_is_claimed)
{
    const tally of = try_all(1);
    ck_assert_msg(of.refuted == 0 && of.too_far == 0, "of %d %d are refuted, and %d distances",
                  of.judged, of.refuted, of.too_far);
    ck_assert_msg(of.sharpest > 0.8, "%g of the slip is shown at most", of.sharpest);
    ck_assert_msg(4 * of.known > suite_times(CASES), "%d are known", of.known);
    ck_assert_msg(10 * of.exact > suite_times(CASES), "%d are exact", of.exact);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(slips_that_are_too_small_are_found)
{
    const tally of = try_all(0.75);
    ck_assert(of.refuted > 0 && of.too_far > 0);
}
END_TEST

static imp_symmetry ball(void) { return (imp_symmetry){.kind = IMP_SYMMETRY_ABOUT_POINT}; }

/* The slip of a surface with one map along one without, over t in [0, 1]. */
static imp_status slip_of(motion *m, imp_symmetry *symmetry, double *slip)
{
    motion *const maps[] = {m};
    surface *a = compose(symmetry, maps, 1), *b = compose(symmetry, maps, 0);
    imp_model bare[3];
    for (int i = 0; i < 3; ++i) bare[i] = imp_between(-1, 1);
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
    const imp_status status = surface_slip(a, b, bare, &times, 0.5, slip);
    surface_free(a);
    surface_free(b);
    return status;
}

START_TEST(motions_within_the_symmetry_do_not_slip)
{
    double slip;
    motion m = {.rate = 3};
    imp_symmetry s = ball();
    ck_assert_int_eq(slip_of(&m, &s, &slip), IMP_STATUS_OK);
    ck_assert(slip < 0x1p-48);
    m.way[2] = 1;
    ck_assert_int_eq(slip_of(&m, &s, &slip), IMP_STATUS_OK);
    ck_assert(slip == INFINITY);
    s = (imp_symmetry){.kind = IMP_SYMMETRY_ALONG_LINE, .axis = {0, 0, 2}};
    ck_assert_int_eq(slip_of(&m, &s, &slip), IMP_STATUS_OK);
    ck_assert(slip < 0x1p-48);
    s.kind = IMP_SYMMETRY_ACROSS_LINE;
    ck_assert_int_eq(slip_of(&m, &s, &slip), IMP_STATUS_OK);
    ck_assert(slip == INFINITY);
}
END_TEST

START_TEST(symmetries_that_are_none_are_refused)
{
    motion m = {.rate = 3};
    double slip;
    imp_symmetry bad[4] = {{.kind = 0}, {.kind = 5}, {.kind = IMP_SYMMETRY_ABOUT_LINE}, ball()};
    bad[3].center[1] = NAN;
    for (int k = 0; k < 4; ++k) ck_assert_int_eq(slip_of(&m, &bad[k], &slip), SURFACE_BAD_SYMMETRY);
}
END_TEST

/* --- Pairs ------------------------------------------------------------------------------------ */

enum { CHAIN = 4 };

/* A point or a ball, and a torus. Each turns about itself, or the first about the axis of the
 * other, and both are placed and turned alike; but each may swell by itself. */
typedef struct pair_trial {
    imp_symmetry symmetry[2];
    motion map[2][CHAIN];
    size_t count[2];
    double reach; /* half the box of the first: 1 of a ball */
    imp_region times;
} pair_trial;

static motion spin_about(const double center[3], double rate)
{
    motion m = {.rate = rate};
    memcpy(m.pivot, center, sizeof m.pivot);
    memcpy(m.shift, center, sizeof m.shift);
    return m;
}

static void draw_pair(uint64_t *random, pair_trial *y)
{
    const double lo[3] = {0, 0, random_between(random, -1, 0)};
    const double hi[3] = {1, 1, lo[2] + random_power(random, -4, 0)};
    const bool is_ball = random_bits(random) % 2;
    double place[3];
    motion alike = {.rate = 0}, spun;
    *y = (pair_trial){.times = region_make(lo, hi), .count = {0, 0}};
    y->reach = is_ball ? 1 : random_power(random, -10, 0);
    y->symmetry[0].kind = IMP_SYMMETRY_ABOUT_POINT;
    y->symmetry[0].is_closed = is_ball;
    y->symmetry[1] = (imp_symmetry){.kind = IMP_SYMMETRY_ABOUT_LINE, .is_closed = 1};
    y->symmetry[1].axis[2] = 1;
    draw_vector(random, 1, y->symmetry[1].center);
    draw_vector(random, is_ball ? 4 : y->reach, y->symmetry[0].center);
    for (int i = 0; i < 3; ++i) y->symmetry[0].center[i] += y->symmetry[1].center[i];
    draw_place(random, 1, &alike);
    draw_vector(random, 1, alike.shift);
    draw_vector(random, 1, place);
    spun = spin_about(random_bits(random) % 2 ? alike.shift : place, random_between(random, -3, 3));
    memcpy(alike.pivot, y->symmetry[1].center, sizeof alike.pivot);
    for (int k = 0; k < 2; ++k) {
        motion *m = y->map[k];
        size_t n = 0;
        if (is_ball || k == 1)
            m[n++] = spin_about(y->symmetry[k].center, random_between(random, -3, 3));
        if (k == 0 && random_bits(random) % 2)
            m[n++] = spin_about(y->symmetry[1].center, random_between(random, -3, 3));
        m[n++] = alike;
        m[n] = spun;
        if (random_bits(random) % 2) m[n].swell = random_between(random, -3e-6, 3e-6);
        y->count[k] = n + 1;
    }
}

/* The distance in the world at a time: all that a map does beside turning is to stretch. */
static long double distance_at(const pair_trial *y, long double t)
{
    long double x[3], stretch[2] = {1, 1};
    for (int i = 0; i < 3; ++i) x[i] = y->symmetry[0].center[i];
    for (size_t k = 0; k < y->count[0]; ++k) apply(&y->map[0][k], t, x);
    for (size_t k = y->count[1]; k-- > 0;) undo(&y->map[1][k], t, x);
    for (int k = 0; k < 2; ++k)
        for (size_t j = 0; j < y->count[k]; ++j) stretch[k] *= 1 + y->map[k][j].swell * t * t;
    const orbit at = orbit_of(&y->symmetry[1], x);
    const long double from_center = stretch[1] * off(&y->symmetry[1], &at);
    return y->symmetry[0].is_closed ? from_center - stretch[0] : from_center;
}

static void judge_pair(const pair_trial *y, double slip, double factor, uint64_t *random, tally *of)
{
    const long double then = distance_at(y, y->times.lo[2]);
    if (!(slip < INFINITY)) return;
    of->known += 1;
    of->exact += slip < 0x1p-36;
    for (int k = 0; k < POINTS; ++k) {
        const double t = random_between(random, y->times.lo[2], y->times.hi[2]);
        const long double shown = fabsl(distance_at(y, t) - then);
        of->judged += 1;
        of->refuted += shown > factor * slip + 0x1p-46L;
        if (slip > 0x1p-30 && shown / slip > of->sharpest) of->sharpest = (double)(shown / slip);
    }
}

static tally try_pairs(double factor)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    for (int n = 0; n < suite_times(CASES); ++n) {
        pair_trial y;
        surface *s[2];
        imp_model bare[2][3];
        double slip;
        int asked;
        draw_pair(&random, &y);
        for (int k = 0; k < 2; ++k) {
            motion *maps[CHAIN];
            for (size_t j = 0; j < y.count[k]; ++j) maps[j] = &y.map[k][j];
            s[k] = compose(&y.symmetry[k], maps, y.count[k]);
            for (int i = 0; i < 3; ++i) {
                const double c = y.symmetry[k].center[i], r = k == 0 ? y.reach : i < 2 ? 3 : 1;
                bare[k][i] = imp_between(c - r, c + r);
            }
        }
        const surface *const both[2] = {s[0], s[1]};
        ck_assert_int_eq(surface_pair_slip(both, bare, &y.times, y.times.lo[2], &slip, &asked),
                         IMP_STATUS_OK);
        judge_pair(&y, slip, factor, &random, &of);
        surface_free(s[0]);
        surface_free(s[1]);
    }
    return of;
}

START_TEST(no_pair_comes_nearer_than_by_its_slip)
{
    const tally of = try_pairs(1);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(4 * of.known > suite_times(CASES), "%d are known", of.known);
    ck_assert_msg(100 * of.exact > suite_times(CASES), "%d are exact", of.exact);
    ck_assert_int_gt(try_pairs(of.sharpest / 2).refuted, 0);
}
END_TEST

/* --- Motion of centers, and orbits ------------------------------------------------------------ */

/* Maps that are rotations in exact arithmetic: spins about lines along z, shifts, and a turn that
 * takes each axis to the next. */
typedef struct chain {
    motion map[4];
    size_t count;
} chain;

static void draw_exact(uint64_t *random, const double center[3], motion *m)
{
    *m = (motion){.rate = 0};
    switch (random_bits(random) % 4) {
    case 0:
        *m = spin_about(center, random_between(random, -3, 3));
        break;
    case 1:
        m->rate = random_between(random, -2, 2);
        draw_vector(random, 2, m->pivot);
        memcpy(m->shift, m->pivot, sizeof m->shift);
        break;
    case 2:
        draw_vector(random, 2, m->way);
        break;
    default:
        m->place[0][1] = m->place[1][2] = m->place[2][0] = 1;
        m->is_placed = true;
        break;
    }
}

static void draw_chain(uint64_t *random, const double center[3], chain *c)
{
    c->count = 1 + random_bits(random) % 3;
    for (size_t k = 0; k < c->count; ++k) draw_exact(random, center, &c->map[k]);
}

static surface *compose_exactly(imp_symmetry *self, chain *c)
{
    surface *s = surface_new(&target, self);
    ck_assert_ptr_nonnull(s);
    for (size_t k = 0; k < c->count; ++k)
        ck_assert_int_eq(surface_add_map(s, &exactly, &c->map[k]), IMP_SUCCESS);
    return s;
}

/* Seen from before the maps of b. */
static void undo_all(const chain *c, long double t, long double x[3])
{
    for (size_t k = c->count; k-- > 0;) undo(&c->map[k], t, x);
}

static imp_region draw_times(uint64_t *random)
{
    const double from = random_between(random, -1, 1);
    return region_make((double[3]){0, 0, from},
                       (double[3]){1, 1, from + random_power(random, -6, 1)});
}

static imp_symmetry draw_symmetry(uint64_t *random)
{
    imp_symmetry s = {.kind = 1 + (uint32_t)(random_bits(random) % 4)};
    s.axis[2] = random_power(random, -4, 4);
    draw_vector(random, 1, s.center);
    return s;
}

/* The greatest |g| that is claimed at a time. */
static long double claimed_at(const imp_model *g, const imp_region *times, long double t)
{
    const long double w = (t - times->c[2]) / times->d[2];
    const long double value = g->a + (g->b[2] + g->q[IMP_TT] * w) * w;
    const long double by_range = g->lo > -g->hi ? g->lo : -g->hi;
    return fabsl(value) - g->e > by_range ? fabsl(value) - g->e : by_range;
}

/* A point that moves uniformly beside a surface that moves; the way of its center times `factor`.
 */
static void try_carry(uint64_t *random, double factor, tally *of)
{
    imp_symmetry symmetry = draw_symmetry(random);
    const imp_region times = draw_times(random);
    const carry_base base = {times.lo[2], random_bits(random) % 2};
    double start[3], speed[3], lo[3], hi[3], slip;
    chain c;
    imp_model way[3], point[3], g;
    draw_chain(random, symmetry.center, &c);
    draw_vector(random, 4, start);
    draw_vector(random, 2, speed);
    for (int i = 0; i < 3; ++i) lo[i] = -8, hi[i] = 8;
    surface *b = compose_exactly(&symmetry, &c);
    ck_assert_int_eq(surface_carry_slip(b, lo, hi, &times, &base, &slip), IMP_STATUS_OK);
    of->exact += slip < 0x1p-40;
    if (slip < 1 && surface_carry_way(b, &times, &base, way) == IMP_STATUS_OK) {
        for (int i = 0; i < 3; ++i) {
            const imp_model at = imp_shift(imp_scale(imp_param(&times, 2), speed[i]), start[i]);
            point[i] = imp_sub(at, imp_scale(way[i], factor));
        }
        const size_t maps = base.is_bare ? 0 : c.count;
        const imp_status status =
            surface_distance_within(b, &times, maps, point, base.moment, slip, &g);
        of->known += status == IMP_STATUS_OK;
        for (int k = 0; k < POINTS && status == IMP_STATUS_OK; ++k) {
            const long double t =
                times.lo[2] + (times.hi[2] - times.lo[2]) * (long double)random_fraction(random);
            long double x[3];
            for (int i = 0; i < 3; ++i) x[i] = start[i] + speed[i] * t;
            undo_all(&c, t, x);
            const orbit at = orbit_of(&symmetry, x);
            of->judged += 1;
            of->refuted += claimed_at(&g, &times, t) > off(&symmetry, &at) + 0x1p-46L;
        }
    }
    surface_free(b);
}

START_TEST(what_moves_as_its_center_does_is_as_far_as_is_claimed)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0}, wrong = {.judged = 0};
    for (int k = 0; k < suite_times(CASES / 4); ++k) try_carry(&random, 1, &of);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(4 * of.known > suite_times(CASES / 4), "%d are known", of.known);
    ck_assert_msg(4 * of.exact > suite_times(CASES / 4), "%d are exact", of.exact);
    for (int k = 0; k < suite_times(CASES / 4); ++k) try_carry(&random, 0.95, &wrong);
    ck_assert_int_gt(wrong.refuted, 0);
}
END_TEST

/* Two surfaces under one chain of maps, the first beside the other by as much as comes out; points
 * of one orbit of it. */
static void try_orbit(uint64_t *random, tally *of)
{
    imp_symmetry own = draw_symmetry(random), other = draw_symmetry(random);
    const imp_region times = draw_times(random);
    const double aside = random_bits(random) % 4 ? random_power(random, -40, -1) : 0;
    double lo[3], hi[3], slip;
    unsigned held;
    chain c;
    motion spin;
    own.is_closed = IMP_SYMMETRY_ORBIT_U;
    if (own.kind == IMP_SYMMETRY_ABOUT_POINT && random_bits(random) % 2)
        own.is_closed = IMP_SYMMETRY_ORBIT_ALL;
    for (int i = 0; i < 3; ++i) own.center[i] = other.center[i] + aside * (i - 1);
    if (random_bits(random) % 4 == 0) own.center[2] += 3;
    if (random_bits(random) % 4 == 0) own.axis[2] = -own.axis[2];
    draw_chain(random, other.center, &c);
    for (int i = 0; i < 3; ++i) lo[i] = -24, hi[i] = 24;
    chain of_b = {.map = {spin_about(other.center, 2)}, .count = c.count + 1};
    for (size_t k = 0; k < c.count; ++k) of_b.map[k + 1] = c.map[k];
    surface *a = compose_exactly(&own, &c), *b = compose_exactly(&other, &of_b);
    ck_assert_int_eq(surface_orbit_slip(a, b, lo, hi, &times, &held, &slip), IMP_STATUS_OK);
    of->known += slip < INFINITY;
    of->exact += slip < 0x1p-36;
    spin = spin_about(own.center, 1);
    for (int k = 0; k < POINTS && slip < INFINITY; ++k) {
        const double t = random_between(random, times.lo[2], times.hi[2]);
        long double x[3], y[3];
        for (int i = 0; i < 3; ++i) x[i] = own.center[i] + random_between(random, -2, 2);
        memcpy(y, x, sizeof y);
        apply(&spin, random_between(random, -3, 3), y);
        if (held == 3)
            for (int i = 0; i < 3; ++i) y[i] = 2 * own.center[i] - y[i];
        for (size_t j = 0; j < c.count; ++j) apply(&c.map[j], t, x), apply(&c.map[j], t, y);
        undo_all(&of_b, t, x);
        undo_all(&of_b, t, y);
        const orbit at = orbit_of(&other, x), was = orbit_of(&other, y);
        const long double shown = apart(&at, &was);
        of->judged += 1;
        of->refuted += shown > slip + 0x1p-44L;
        if (slip > 0x1p-30 && shown / slip > of->sharpest) of->sharpest = (double)(shown / slip);
    }
    surface_free(a);
    surface_free(b);
}

START_TEST(one_point_stands_for_its_orbit)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    for (int k = 0; k < suite_times(CASES / 4); ++k) try_orbit(&random, &of);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(4 * of.known > suite_times(CASES / 4), "%d are known", of.known);
    ck_assert_msg(20 * of.exact > suite_times(CASES / 4), "%d are exact", of.exact);
    ck_assert_msg(of.sharpest > 0.5, "%g of the slip is shown at most", of.sharpest);
}
END_TEST

static size_t two(const void *self)
{
    (void)self;
    return 2;
}

static const void *piece_of(const void *self, size_t k) { return (const imp_symmetry *)self + k; }

/* The type of a surface of pieces is asked for the first piece; motions of that within itself move
 * the others. */
START_TEST(the_symmetry_of_one_piece_is_not_that_of_all)
{
    imp_surface_type many = target;
    imp_symmetry symmetry[2] = {
        {.kind = IMP_SYMMETRY_ABOUT_LINE, .is_closed = 1, .axis = {0, 0, 1}}};
    imp_symmetry open = ball();
    motion spin = {.rate = 1}, *const none[] = {&spin};
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
    imp_model bare[2][3];
    double slip[2];
    int asked;
    many.piece_count = two;
    many.piece = piece_of;
    symmetry[1] = symmetry[0];
    symmetry[1].center[0] = 9;
    for (int i = 0; i < 3; ++i) bare[0][i] = bare[1][i] = imp_between(-12, 12);
    for (int k = 0; k < 2; ++k) {
        surface *turns = surface_new(k == 0 ? &target : &many, symmetry);
        surface *rests = compose(&open, none, 0);
        const surface *const both[2] = {rests, turns};
        ck_assert_int_eq(surface_add_map(turns, &exactly, &spin), IMP_SUCCESS);
        ck_assert_int_eq(surface_divide(turns), IMP_SUCCESS);
        ck_assert_int_eq(surface_pair_slip(both, bare, &times, 0, &slip[k], &asked), IMP_STATUS_OK);
        surface_free(turns);
        surface_free(rests);
    }
    ck_assert(slip[0] < 1e-3 && slip[1] == INFINITY);
}
END_TEST

SUITE_MAIN("slips", no_point_slips_farther_than_is_claimed, slips_that_are_too_small_are_found,
           motions_within_the_symmetry_do_not_slip, symmetries_that_are_none_are_refused,
           no_pair_comes_nearer_than_by_its_slip,
           what_moves_as_its_center_does_is_as_far_as_is_claimed, one_point_stands_for_its_orbit,
           the_symmetry_of_one_piece_is_not_that_of_all)

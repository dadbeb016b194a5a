/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SLIP_HELPERS_H
#define TESTS_SUPPORT_SLIP_HELPERS_H

#include <impinge/formula.h>
#include <string.h>

#include "core/surface/region.h"
#include "core/surface/surface.h"
#include "tests/support/compose.h"
#include "tests/support/suite.h"

/* Surfaces with a symmetry, under random chains of rigid maps, nearly as the symmetry permits, some
 * as far from rigid as they may be; and where their points are, in long double. */

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

static inline imp_status pose_of(const void *self, const imp_model *t, imp_pose *pose)
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
static inline void turned(const motion *m, long double t, const long double w[3],
                          long double out[3])
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

static inline void apply(const motion *m, long double t, long double x[3])
{
    long double w[3], y[3];
    for (int i = 0; i < 3; ++i) w[i] = x[i] - m->pivot[i];
    turned(m, t, w, y);
    for (int i = 0; i < 3; ++i) x[i] = m->shift[i] + m->way[i] * t + y[i];
}

/* The inverse: as the turn is nearly a rotation, its transpose leaves a rest that shrinks in each
 * step. */
static inline void undo(const motion *m, long double t, long double x[3])
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

static inline imp_status move(const void *self, size_t n, const double *p, double *x, double *error)
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
static inline imp_model gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
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

static inline imp_status symmetry_of(const void *self, imp_symmetry *symmetry)
{
    *symmetry = *(const imp_symmetry *)self;
    return IMP_STATUS_OK;
}

static inline void whole(const void *self, double lo[3], double hi[3])
{
    (void)self;
    for (int j = 0; j < 3; ++j) lo[j] = j < 2 ? 0 : -INFINITY, hi[j] = j < 2 ? 1 : INFINITY;
}

static inline void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static inline void keep(void *self) { (void)self; }

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

static inline void draw_vector(uint64_t *random, double size, double x[3])
{
    for (int i = 0; i < 3; ++i) x[i] = size * random_between(random, -1, 1);
}

/* A rotation, times `stretch`. */
static inline void draw_place(uint64_t *random, double stretch, motion *m)
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

static inline surface *compose(imp_symmetry *self, motion *const maps[], size_t count)
{
    surface *s = surface_new(&target, self);
    ck_assert_ptr_nonnull(s);
    for (size_t k = 0; k < count; ++k) {
        const imp_map_type *type = maps[k]->swell != 0 || maps[k]->is_placed ? &nearly : &exactly;
        ck_assert_int_eq(surface_add_map(s, type, maps[k]), IMP_SUCCESS);
    }
    return s;
}

/* Where a point is beside the center, but for motions of the symmetry. */
typedef struct orbit {
    long double along, across;
} orbit;

static inline orbit orbit_of(const imp_symmetry *of, const long double x[3])
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

static inline long double apart(const orbit *x, const orbit *y)
{
    return hypotl(x->along - y->along, x->across - y->across);
}

/* From the surface whose distance is the gap. */
static inline long double off(const imp_symmetry *of, const orbit *x)
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

static inline imp_symmetry ball(void) { return (imp_symmetry){.kind = IMP_SYMMETRY_ABOUT_POINT}; }

/* --- Pairs ------------------------------------------------------------------------------------ */

static inline motion spin_about(const double center[3], double rate)
{
    motion m = {.rate = rate};
    memcpy(m.pivot, center, sizeof m.pivot);
    memcpy(m.shift, center, sizeof m.shift);
    return m;
}

#endif

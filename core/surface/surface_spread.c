/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/surface_spread.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/clocked.h"
#include "core/surface/region.h"
#include "core/surface/surface_internal.h"

/* Lemma (ways)
 * ============
 * Let map j take x to shift + R (x - pivot), R an exact rotation, and let x_j be a point under the
 * first j maps. Over the range of its parameter, with s in [-1, 1], the models of a pose say
 *
 *   R(q) = R(c) + B s + X,  |X| <= |Q| + 2 E,  and likewise shift(q) = shift(c) + b s + y,
 *
 * since both R(q) and R(c) are within E of the polynomial. With d_j = x_j(p) - x_j(c), at one u, v
 * and time,
 *
 *   d_j = R(q) d_{j-1} + (R(q) - R(c)) (x_{j-1}(c) - pivot) + shift(q) - shift(c)
 *       = R(c) d_{j-1} + s g_j + [(R(q) - R(c)) d_{j-1} + X (x_{j-1}(c) - pivot) + y],
 *
 * where g_j = b + B (x_{j-1}(c) - pivot); a map that follows no parameter only turns d_{j-1}.
 * Rotations keep lengths. So d is sum_j s_j W_j g_j, W_j being the turn of the maps after j, plus
 * what is at most (by induction over j)
 *
 *   second = sum_j [ (|B| + |Q| + 2 E) |d_{j-1}| + (|Q| + 2 E) r_j + |q| + 2 e ],
 *
 * in which r_j >= |x_{j-1} - pivot| comes from the ball around the surface before the map, and
 * |d_{j-1}| <= sum of |g_i| + second_i of the maps before, |g_i| <= |b| + |B| r_i. Where maps
 * before the first that is taken are held, x(c) is the companion of x(p), so that d begins with the
 * slip of these, as the maps between stretch it, and second with as much.
 *
 * The ways are computed at one point z and time m: with z_{j-1} the point that the maps at m and
 * the middle values take to z. A point x within `radius` of z at m has x_{j-1}(m) within `radius`
 * of z_{j-1}, and at a time within `half` of m it is farther by at most half times its speed before
 * the map, `drift`. W_j turns by at most half times the sum of the later maps' spins. Hence
 *
 *   |W_j(t) g_j(x) - W_j(m) g_j(z)| <= |B| (drift half + radius) + spins half |g_j(z)|.
 *
 * Rounding. Poses at one time are refused unless their entries are known within 2^-36. Then d =
 * R^T (z - shift) is off by what z is off, plus 2^-30 (|z| + |shift| + |pivot|), which also covers
 * its sum with the pivot; W, a product of at most 64 such turns, by 2^-28; and products with it by
 * 2^-26 (|b| + |B| |d|). Sums of bounds have fewer than 4000 roundings. */
#define POSE_KNOWN 0x1p-36
#define STEP_OFF 0x1p-30
#define TURN_OFF 0x1p-26
enum { SUMS_PAD = 4096 };
PAD_COVERS(SUMS_PAD, 60 * SPREAD_MAPS_MAX);

static double size_of(const double x[3])
{
    return padded_upper(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), 8) + ROOT_UNDERFLOW;
}

/* Returns an upper bound of Frobenius' norm of a 3x3 matrix. */
static double size_of_matrix(const double *m)
{
    double sum = 0;
    for (int i = 0; i < 9; ++i) sum += m[i] * m[i];
    return padded_upper(sqrt(sum), 16) + ROOT_UNDERFLOW;
}

/* --- Making ----------------------------------------------------------------------------------- */

static bool pose_over(const spread_map *m, const imp_model *t, imp_pose *pose)
{
    memset(pose, 0, sizeof *pose);
    const surface_call call = surface_call_begin(m->type->name, "rigid");
    const imp_status status = m->type->rigid(m->self, t, pose);
    if (surface_call_end(call, status) != IMP_STATUS_OK) return false;
    double all = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const imp_model *x = &pose->turn[i][j];
            all += zero_if_finite(x->a) + zero_if_finite(x->b[2]) + zero_if_finite(x->q[IMP_TT]) +
                   zero_if_finite(x->e) + zero_if_finite(x->rate[2]);
        }
        const imp_model *x = &pose->shift[i];
        all += zero_if_finite(x->a) + zero_if_finite(x->b[2]) + zero_if_finite(x->q[IMP_TT]) +
               zero_if_finite(x->e) + zero_if_finite(pose->pivot[i]);
    }
    return all == 0;
}

/* Writes the pose at one time. False: it is not known well enough. */
static bool pose_at(const spread_map *m, double t, double turn[3][3], double shift[3],
                    double pivot[3], double *shift_off)
{
    const imp_model at = {.a = t, .lo = t, .hi = t};
    imp_pose pose;
    bool known = pose_over(m, &at, &pose);
    *shift_off = 0;
    for (int i = 0; i < 3 && known; ++i) {
        for (int j = 0; j < 3; ++j) {
            turn[i][j] = pose.turn[i][j].a;
            known = known && pose.turn[i][j].e <= POSE_KNOWN;
        }
        shift[i] = pose.shift[i].a;
        pivot[i] = pose.pivot[i];
        *shift_off += pose.shift[i].e;
    }
    return known;
}

/* The sums of the lemma up to a map. */
typedef struct spread_sums {
    double first, second, drift;
} spread_sums;

static bool take_parameter(const value_box *box, const map_reach *reach, const imp_pose *pose,
                           spread_map *m, spread_sums *sums)
{
    double rest[3][3], shift_rest[3], from_pivot[3];
    if (!pose_at(m, box->at[m->clock], m->turn, m->shift, m->pivot, &m->off)) return false;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const imp_model *x = &pose->turn[i][j];
            m->turn_by[i][j] = x->b[2];
            rest[i][j] = fabs(x->q[IMP_TT]) + 2 * x->e;
        }
        const imp_model *x = &pose->shift[i];
        m->shift_by[i] = x->b[2];
        shift_rest[i] = fabs(x->q[IMP_TT]) + 2 * x->e;
        if (pose->pivot[i] != m->pivot[i]) return false;
        from_pivot[i] = fabs(reach->centre[i] - m->pivot[i]);
    }
    const double far = size_of(from_pivot) + reach->radius, unknown = size_of_matrix(&rest[0][0]);
    m->steep = size_of_matrix(&m->turn_by[0][0]);
    sums->second +=
        (m->steep + unknown) * (sums->first + sums->second) + unknown * far + size_of(shift_rest);
    sums->first += size_of(m->shift_by) + m->steep * far;
    return true;
}

static bool take_time(const stage_range *range, const imp_pose *pose, spread_map *m)
{
    double rate[3][3], shifts = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) rate[i][j] = pose->turn[i][j].rate[2];
        shifts += pose->shift[i].rate[2];
    }
    m->spin = size_of_matrix(&rate[0][0]);
    m->moves = !(shifts == 0) || !(rate[0][0] + rate[0][1] + rate[0][2] + rate[1][0] + rate[1][1] +
                                       rate[1][2] + rate[2][0] + rate[2][1] + rate[2][2] ==
                                   0);
    if (!m->moves) m->spin = 0;
    return m->moves || pose_at(m, range->lo, m->turn, m->shift, m->pivot, &m->off);
}

static bool take_map(const surface *s, size_t j, const value_box *box, size_t swept,
                     const map_reach *reach, spread_map *m, spread_sums *sums)
{
    const mapping *map = &s->maps[j];
    const shared_instance *p = map->origin, *own = clocked_own(map->origin);
    const bool is_free = p->inner != NULL && p->clock != swept;
    const stage_range range = stage_range_of(p, box);
    *m = (spread_map){.type = own->map,
                      .self = own->self,
                      .clock = is_free ? p->clock : SIZE_MAX,
                      .drift = sums->drift};
    const mapping bare = {own->map, own->self, NULL};
    if (!IMP_OFFERS(own->map, rigid) || !map_turns_exactly(&bare)) return false;
    if (!(range.lo >= own->lo[2] && range.hi <= own->hi[2])) return false;
    const imp_region region = region_make((double[3]){0, 0, range.lo}, (double[3]){0, 0, range.hi});
    const imp_model t = surface_time(&region);
    imp_pose pose;
    if (!pose_over(m, &t, &pose)) return false;
    if (!is_free) return take_time(&range, &pose, m);
    return region.c[2] == box->at[p->clock] && take_parameter(box, reach, &pose, m, sums);
}

bool surface_spread_make(const surface *s, const surface_extent *extent, size_t left_out,
                         const value_box *box, size_t swept, const map_reach *reaches,
                         surface_spread *to)
{
    const size_t count = s->map_count - left_out;
    spread_sums sums = {.second = extent->held.slip, .drift = extent->speed};
    to->first = to->count = count;
    to->second = 0;
    if (count > SPREAD_MAPS_MAX || (s->origin->inner != NULL && s->origin->clock != swept))
        return false;
    for (size_t j = 0; j < count; ++j) {
        const shared_instance *p = s->maps[j].origin;
        const bool is_clocked = p->inner != NULL && p->clock != swept;
        const bool is_held = j < extent->held.count;
        if (is_clocked && !is_held && to->first == count) to->first = j;
        if (j >= to->first && !take_map(s, j, box, swept, &reaches[j], &to->maps[j], &sums))
            return false;
        sums.drift = sums.drift * reaches[j].stretch + (is_clocked ? 0 : reaches[j].speed);
        if (!is_held && to->first == count) sums.second *= reaches[j].stretch;
    }
    to->second = padded_upper(sums.second, SUMS_PAD);
    return to->second < INFINITY && sums.drift < INFINITY;
}

/* --- At a point ------------------------------------------------------------------------------- */

typedef struct spread_walk {
    double z[3], off;  /* the point, and how far it is off */
    double turn[3][3]; /* of the maps after */
    double spin;       /* theirs together */
    double rest;
} spread_walk;

static void add_way(const spread_map *m, const spread_place *place, const spread_walk *w,
                    const double d[3], double sign, double way[4], double *rest)
{
    double g[3];
    for (int i = 0; i < 3; ++i)
        g[i] = m->shift_by[i] + m->turn_by[i][0] * d[0] + m->turn_by[i][1] * d[1] +
               m->turn_by[i][2] * d[2];
    for (int i = 0; i < 3; ++i)
        way[i] += sign * (w->turn[i][0] * g[0] + w->turn[i][1] * g[1] + w->turn[i][2] * g[2]);
    *rest += m->steep * (m->drift * place->half + place->radius + w->off) +
             w->spin * place->half * size_of(g) +
             TURN_OFF * (size_of(m->shift_by) + m->steep * size_of(d));
}

/* Goes back through a map. */
static bool walk_back(const spread_map *m, const spread_place *place, double sign,
                      double (*ways)[4], spread_walk *w)
{
    double turn[3][3], shift[3], pivot[3], d[3], all[3][3], shift_off = m->off;
    if (!m->moves) {
        memcpy(turn, m->turn, sizeof turn);
        memcpy(shift, m->shift, sizeof shift);
        memcpy(pivot, m->pivot, sizeof pivot);
    } else if (!pose_at(m, place->t, turn, shift, pivot, &shift_off)) {
        return false;
    }
    w->off += STEP_OFF * (size_of(w->z) + size_of(shift) + size_of(pivot)) + shift_off;
    for (int j = 0; j < 3; ++j) {
        d[j] = 0;
        for (int i = 0; i < 3; ++i) d[j] += turn[i][j] * (w->z[i] - shift[i]);
    }
    if (m->clock != SIZE_MAX) add_way(m, place, w, d, sign, ways[m->clock], &w->rest);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            all[i][j] = w->turn[i][0] * turn[0][j] + w->turn[i][1] * turn[1][j] +
                        w->turn[i][2] * turn[2][j];
    memcpy(w->turn, all, sizeof all);
    for (int i = 0; i < 3; ++i) w->z[i] = d[i] + pivot[i];
    w->spin += m->spin;
    return true;
}

bool surface_spread_at(const surface_spread *spread, const surface *s, const spread_place *place,
                       double sign, double (*ways)[4], double *rest)
{
    if (place->left_out > s->map_count) return false;
    const size_t end = s->map_count - place->left_out;
    if (end > spread->count) return false;
    spread_walk w = {.z = {place->at[0], place->at[1], place->at[2]},
                     .turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     .rest = spread->second};
    for (size_t j = end; j > spread->first; --j)
        if (!walk_back(&spread->maps[j - 1], place, sign, ways, &w)) return false;
    *rest += padded_upper(w.rest, SUMS_PAD);
    return *rest < INFINITY;
}

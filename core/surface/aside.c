/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/aside_search.h"

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/carried.h"
#include "core/surface/region.h"

/* Lemma. Let all maps of a and b be exact rotations and shifts. Let L_a be the product of maps of
 * a, each of which is moved past all later ones that remain, K_a that of those that remain, and so
 * for b. If two neighbours X, Y have |X Y x - Y X x| <= c for all x, to exchange them moves images
 * by at most c, since the maps after them keep lengths. So M_a is within c_a, the sum of these, of
 * L_a K_a, and M_b within c_b of L_b K_b. For x = K_a p, y = K_b q,
 *
 *   | |L_a x - L_b y| - |x - y| | = | |L_a x - L_b y| - |L_a x - L_a y| | <= |L_b y - L_a y|.
 *
 * If that is at most d for all y, the distance of p and q under K_a and K_b differs from that under
 * all maps by at most c_a + c_b + d, at each time. x may take the part of y. */

static imp_status pose_of(const aside_part *p, const imp_region *times, imp_pose *pose)
{
    if (p->of.map_count > 0) return surface_pose_of_maps(&p->of, 0, p->of.map_count, times, pose);
    memset(pose, 0, sizeof *pose);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) pose->turn[i][j] = imp_num(i == j);
        pose->shift[i] = imp_num(0);
    }
    return IMP_STATUS_OK;
}

static bool are_same_maps(const aside_part p[2])
{
    bool same = p[0].of.map_count == p[1].of.map_count;
    for (size_t k = 0; k < p[0].of.map_count && same; ++k)
        same = p[0].maps[k].origin == p[1].maps[k].origin;
    return same;
}

/* --- What may be set aside -------------------------------------------------------------------- */

/* Bounds how far images move if each of these maps is moved past all later ones that remain. */
static double exchanges_upper(const aside_search *q, int side, uint32_t which)
{
    double sum = 0;
    for (size_t i = 0; i < q->s[side]->map_count; ++i)
        for (size_t j = i + 1; j < q->s[side]->map_count; ++j)
            if ((which >> i & 1u) != 0 && (which >> j & 1u) == 0)
                sum = sum_upper(sum, q->exchange[side][i][j]);
    return sum;
}

/* --- Whether both parts do the same ----------------------------------------------------------- */

/* Whether both parts seem to move points of this size alike, by a look at some moments: few do, and
 * bounds over time cost much. */
static bool seem_same(const aside_part p[2], const imp_region *times, double size, double enough)
{
    enum { POINTS = 4 };
    for (int k = 0; k < ASIDE_MOMENTS; ++k) {
        const double t = aside_moment(times, k);
        double x[2][3 * POINTS];
        for (int side = 0; side < 2; ++side) {
            memset(x[side], 0, sizeof x[side]);
            for (int i = 0; i < 3; ++i) x[side][3 * (i + 1) + i] = size;
            if (surface_move_outward(&p[side].of, 0, t, POINTS, x[side]) != IMP_STATUS_OK)
                return false;
        }
        for (int i = 0; i < 3 * POINTS; ++i)
            if (!(fabs(x[0][i] - x[1][i]) <= enough)) return false;
    }
    return true;
}

/* Bounds |L_a y - L_b y| for |y| <= far. With L x = r + R (x - p) it is |(r_a - R_a p_a) - (r_b -
 * R_b p_b) + (R_a - R_b) y|, and the sum of the squares of a matrix' entries bounds the square of
 * its norm. Roundings: squares 1, sums 8, halved by the root, root 1; product 1, sum 1. */
PAD_COVERS(16, 5 + 1 + 1 + 1);
static double difference_upper(const imp_pose pose[2], double far)
{
    imp_model from[2][3];
    double turn = 0;
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 3; ++i) {
            imp_model pivot[3];
            for (int j = 0; j < 3; ++j) pivot[j] = imp_num(pose[k].pivot[j]);
            from[k][i] = imp_sub(pose[k].shift[i], imp_dot3(pose[k].turn[i], pivot));
        }
    for (int i = 0; i < 3; ++i) {
        from[0][i] = imp_sub(from[0][i], from[1][i]);
        for (int j = 0; j < 3; ++j) {
            const imp_model apart = imp_sub(pose[0].turn[i][j], pose[1].turn[i][j]);
            const double most = imp_interval_mag(imp_model_range(&apart));
            turn += most * most;
        }
    }
    return padded_upper(surface_size_upper(from[0]) + (sqrt(turn) + ROOT_UNDERFLOW) * far, 16);
}

enum { DEPTH_MOST = 20 };

/* Whether the difference over a part of the times, as bounded, needs more than `spans` parts of all
 * of them. Models of poses have errors of third order in time, and halves an eighth of these; so n
 * parts of one that is 1 / k of all, with k n <= spans, reach apart / n^3. Two turns at rate w need
 * about w (far / (6 enough))^(1/3) for each unit of time. */
static bool needs_more(double part_of_times, double apart, double enough, size_t spans)
{
    const double n = part_of_times * (double)spans;
    return apart > enough * n * n * n && apart < INFINITY;
}

/* Halves the times until the difference is small enough over each part. *most: the greatest;
 * INFINITY: it is not known to be. */
static imp_status compare(const aside_search *q, const aside_part p[2], double far, double enough,
                          double *most)
{
    const double all = q->times->hi[2] - q->times->lo[2];
    const size_t spans = *q->spans;
    double from[DEPTH_MOST + 1][2];
    int left = 0;
    from[left][0] = q->times->lo[2], from[left++][1] = q->times->hi[2];
    *most = 0;
    while (left > 0) {
        const double a = from[left - 1][0], b = from[left - 1][1];
        const imp_region span = region_make((double[3]){0, 0, a}, (double[3]){0, 0, b});
        imp_pose pose[2];
        for (int side = 0; side < 2; ++side) {
            *q->asked = side;
            const imp_status status = pose_of(&p[side], &span, &pose[side]);
            if (status != IMP_STATUS_OK) return status;
        }
        const double apart = difference_upper(pose, far);
        if (apart <= enough) {
            *most = apart > *most ? apart : *most;
            --left;
        } else if (left > DEPTH_MOST || *q->spans == 0 ||
                   needs_more((b - a) / all, apart, enough, spans)) {
            *most = INFINITY;
            left = 0;
        } else {
            *q->spans -= 1;
            from[left - 1][0] = span.c[2], from[left][0] = a, from[left][1] = span.c[2];
            ++left;
        }
    }
    return IMP_STATUS_OK;
}

/* Bounds |y| for points of a surface under the maps that remain. */
static imp_status reach_upper(const aside_search *q, int side, uint32_t aside,
                              const imp_model bare[3], double *reach)
{
    aside_part kept;
    imp_pose pose;
    imp_model way[3];
    aside_part_of(q->s[side], ~aside, &kept);
    *q->asked = side;
    const imp_status status = pose_of(&kept, q->times, &pose);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) way[i] = imp_shift(bare[i], -pose.pivot[i]);
    *reach = sum_upper(surface_size_upper(pose.shift), surface_size_upper(way));
    return IMP_STATUS_OK;
}

static double exchanged_upper(const aside_search *q, const uint32_t which[2])
{
    return sum_upper(exchanges_upper(q, 0, which[0]), exchanges_upper(q, 1, which[1]));
}

/* Whether these maps may be set aside, as far as is known without bounds over time. */
static bool may_choose(const aside_search *q, const uint32_t which[2])
{
    return exchanged_upper(q, which) <= q->enough && !aside_images_differ(q, which);
}

/* Looks at one choice of maps. *slip INFINITY: they may not be set aside. */
static imp_status try_choice(const aside_search *q, const uint32_t which[2],
                             const imp_model bare[2][3], double *slip)
{
    aside_part p[2];
    double reach[2], most;
    *slip = INFINITY;
    const double exchanged = exchanged_upper(q, which);
    if (!may_choose(q, which)) return IMP_STATUS_OK;
    for (int side = 0; side < 2; ++side) aside_part_of(q->s[side], which[side], &p[side]);
    if (are_same_maps(p)) return *slip = exchanged, IMP_STATUS_OK;
    const double size = surface_size_upper(bare[0]) + surface_size_upper(bare[1]);
    if (!seem_same(p, q->times, size, q->enough)) return IMP_STATUS_OK;
    for (int side = 0; side < 2; ++side) {
        const imp_status status = reach_upper(q, side, which[side], bare[side], &reach[side]);
        if (status != IMP_STATUS_OK) return status;
    }
    const imp_status status = compare(q, p, imp_smaller(reach[0], reach[1]),
                                      difference_lower(q->enough, exchanged), &most);
    const double sum = sum_upper(exchanged, most);
    if (status == IMP_STATUS_OK && sum <= q->enough) *slip = sum;
    return status;
}

static int bits_of(unsigned choice)
{
    int bits = 0;
    for (; choice != 0; choice &= choice - 1) ++bits;
    return bits;
}

/* Sets the maps of either surface that are chosen among those that move. */
static void maps_of(const aside_search *q, unsigned choice, uint32_t which[2])
{
    which[0] = which[1] = 0;
    for (size_t k = 0; k < q->count; ++k)
        if ((choice >> k & 1u) != 0) which[q->moving[k].side] |= 1u << q->moving[k].map;
}

/* Tries the choices of the most maps first. */
static imp_status try_choices(const aside_search *q, const imp_model bare[2][3],
                              shared_aside *found)
{
    for (int bits = (int)q->count; bits > 1; --bits)
        for (unsigned choice = 1; choice < 1u << q->count; ++choice) {
            uint32_t which[2];
            double slip;
            if (bits_of(choice) != bits) continue;
            maps_of(q, choice, which);
            const imp_status status = try_choice(q, which, bare, &slip);
            if (status != IMP_STATUS_OK) return status;
            if (!(slip <= q->enough)) continue;
            *found = (shared_aside){{which[0], which[1]}, slip};
            return IMP_STATUS_OK;
        }
    return IMP_STATUS_OK;
}

/* Looks at the maps of both surfaces. *some false: they have none that might be set aside. */
static imp_status begin(aside_search *q, bool *some)
{
    *some = false;
    for (int side = 0; side < 2; ++side) {
        if (q->s[side]->map_count > ASIDE_MAPS_MOST || !carried_exactly(q->s[side]))
            return IMP_STATUS_OK;
        const imp_status status = aside_look_at_maps(q, side);
        if (status != IMP_STATUS_OK) return status;
    }
    *some = q->count >= 2 && q->count <= ASIDE_MOVING_MOST;
    return IMP_STATUS_OK;
}

bool surface_may_set_aside(const surface *const s[2], const imp_region *times, double enough,
                           aside_look *const looks[2])
{
    int asked;
    aside_search q = {.s = s, .times = times, .enough = enough, .looks = looks, .asked = &asked};
    bool some, may = false;
    if (begin(&q, &some) != IMP_STATUS_OK) return true; /* surface_shared_aside tells why */
    for (unsigned choice = 1; some && choice < 1u << q.count && !may; ++choice) {
        uint32_t which[2];
        maps_of(&q, choice, which);
        may = bits_of(choice) > 1 && may_choose(&q, which);
    }
    return may;
}

imp_status surface_shared_aside(const surface *const s[2], const imp_model bare[2][3],
                                const imp_region *times, double enough, size_t *spans,
                                aside_look *const looks[2], shared_aside *found, int *asked)
{
    aside_search q = {
        .s = s, .times = times, .enough = enough, .spans = spans, .looks = looks, .asked = asked};
    bool some;
    *found = (shared_aside){{0, 0}, 0};
    imp_status status = begin(&q, &some);
    if (status == IMP_STATUS_OK && some) status = try_choices(&q, bare, found);
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

/* --- The surface ------------------------------------------------------------------------------ */

surface *surface_new_aside(const surface *s, size_t maps, maps_aside aside)
{
    surface *made = surface_new_in(s->store, s->origin);
    bool ok = made != NULL;
    for (size_t k = 0; k < maps && ok; ++k)
        if (!maps_aside_has(aside, k))
            ok = surface_add_instance(made, s->maps[k].origin) == IMP_SUCCESS;
    return surface_finish(made, ok, s, aside.slip);
}

imp_status surface_move_from_aside(const surface *s, size_t maps, maps_aside aside, double t,
                                   double x[3])
{
    surface one = *s;
    one.map_count = maps < ASIDE_MAPS_MOST ? maps : ASIDE_MAPS_MOST;
    aside_part p;
    aside_part_of(&one, aside.which, &p);
    const imp_status status = surface_move_outward(&p.of, 0, t, 1, x);
    return status == IMP_STATUS_OK ? surface_move_outward(s, maps, t, 1, x) : status;
}

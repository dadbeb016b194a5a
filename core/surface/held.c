/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/held.h"

#include <string.h>

#include "core/surface/clocked.h"
#include "core/surface/slip.h"

/* --- Which maps are held ---------------------------------------------------------------------- */

/* The parameter along which rotations about the line take points to each other; -1: none. */
static int orbit_of(const surface *s)
{
    imp_symmetry found;
    if (surface_symmetry(s, &found) != IMP_STATUS_OK) return -1;
    if ((found.is_closed & IMP_SYMMETRY_CLOSED) == 0 || symmetry_is_screw(&found)) return -1;
    if ((found.is_closed & IMP_SYMMETRY_ORBIT_U) != 0) return 0;
    return (found.is_closed & IMP_SYMMETRY_ORBIT_V) != 0 ? 1 : -1;
}

/* Whether s is closed about one line, along whose circles each piece has a parameter. */
static bool is_round(const surface *s, imp_symmetry *line)
{
    const size_t count = surface_piece_count(s);
    if (surface_closed_symmetry(s, true, line) != IMP_STATUS_OK) return false;
    if (line->kind != IMP_SYMMETRY_ABOUT_LINE) return false;
    bool is = count > 0 || orbit_of(s) >= 0;
    for (size_t k = 0; k < count && is; ++k) is = orbit_of(surface_piece(s, k)) >= 0;
    return is;
}

enum { LINE_POINTS = 3, LINE_NUMBERS = 3 * LINE_POINTS };

/* Moves the center, the end of the axis, and a point beside the line by the first `maps` maps. */
static bool line_at(const surface *s, size_t maps, const imp_symmetry *line, double t,
                    double x[LINE_NUMBERS])
{
    surface first = *s;
    int least = 0;
    first.map_count = maps;
    for (int i = 0; i < 3; ++i) {
        x[i] = x[6 + i] = line->center[i];
        x[3 + i] = line->center[i] + line->axis[i];
        if (fabs(line->axis[i]) < fabs(line->axis[least])) least = i;
    }
    x[6 + least] += 1;
    return surface_move_outward(&first, 0, t, LINE_POINTS, x) == IMP_STATUS_OK;
}

#define SURELY_MOVED 0x1p-20

/* Whether some of the first maps seem to turn about the line, and keep it where it is, by a look at
 * three times: few do, and slips cost a hundred times as much. */
static bool seems_held(const surface *s, const imp_symmetry *line, const imp_region *times)
{
    const double at[3] = {times->lo[2], 0.63 * times->lo[2] + 0.37 * times->hi[2], times->hi[2]};
    bool seems = false;
    for (size_t maps = s->map_count; maps > 0 && !seems; --maps) {
        double x[3][LINE_NUMBERS], size = 0, most[LINE_POINTS] = {0, 0, 0};
        bool is_known = true;
        for (int k = 0; k < 3; ++k) is_known = is_known && line_at(s, maps, line, at[k], x[k]);
        for (int i = 0; i < LINE_NUMBERS && is_known; ++i) {
            const double moved = fabs(x[1][i] - x[0][i]) + fabs(x[2][i] - x[0][i]);
            size += fabs(x[0][i]);
            if (!(moved <= most[i / 3])) most[i / 3] = moved;
        }
        const double still = SURELY_MOVED * size;
        seems = !is_known || (most[0] <= still && most[1] <= still && most[2] > still);
    }
    return seems;
}

/* Counts the maps up to the last of the first `maps` that depends on time, if one of them turns. */
static imp_status count_moving(const surface *s, const imp_region *times, size_t maps,
                               size_t *count)
{
    bool turns = false;
    *count = 0;
    for (size_t k = 0; k < maps; ++k) {
        imp_pose pose;
        const imp_status status = surface_pose_of_maps(s, k, k + 1, times, &pose);
        if (status != IMP_STATUS_OK) return status;
        bool moves = pose_turns(&pose);
        turns = turns || moves;
        for (int i = 0; i < 3; ++i) moves = moves || pose.shift[i].depends != 0;
        if (moves) *count = k + 1;
    }
    if (!turns) *count = 0;
    return IMP_STATUS_OK;
}

double surface_held_moment(const surface *s)
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    return lo[2] > 0 ? lo[2] : hi[2] < 0 ? hi[2] : 0;
}

/* A slip below this part of the distance of points from the line is less than what the rounding of
 * a parameter moves them. */
#define ROUNDING_OF_PLACES 0x1p-44

/* The least power of two that is greater. */
static double power_above(double x)
{
    int exponent;
    frexp(x, &exponent);
    return x < INFINITY ? ldexp(1, exponent) : INFINITY;
}

/* The lemma of slip_first_maps says why P(t0) s may stand for P(t) s. */
imp_status surface_held_maps(const surface *s, const imp_model bare[3], const imp_region *times,
                             double enough, held_maps *held)
{
    const double moment = surface_held_moment(s);
    const imp_region then = slip_at_times(times, moment, moment);
    size_t maps = 0, moving = 0;
    double slip = 0;
    imp_symmetry line;
    *held = (held_maps){0, 0};
    if (!carried_exactly(s) || !is_round(s, &line) || !seems_held(s, &line, times))
        return IMP_STATUS_OK;
    imp_status status = count_moving(s, times, surface_map_count(s), &moving);
    if (status == IMP_STATUS_OK && moving > 0)
        status = slip_first_maps(s, true, bare, times, &then, &maps, &slip);
    if (status == IMP_STATUS_OK && maps > 0) status = count_moving(s, times, maps, &moving);
    const double more = power_above(slip + ROUNDING_OF_PLACES * surface_size_upper(bare));
    if (status == IMP_STATUS_OK && maps > 0 && moving > 0 && more <= enough)
        *held = (held_maps){moving, more};
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

/* --- The surface ------------------------------------------------------------------------------ */

static bool add_held(surface *made, shared_instance *map, double moment)
{
    shared_instance *held = clocked_new(map, 0, moment);
    if (held == NULL) return false;
    const bool is_added = surface_add_instance(made, held) == IMP_SUCCESS;
    instance_release(held);
    return is_added;
}

surface *surface_new_held(const surface *s, size_t maps, held_maps held)
{
    const double moment = surface_held_moment(s);
    surface *made = surface_new_in(s->store, s->origin);
    bool ok = made != NULL;
    for (size_t k = 0; k < maps && ok; ++k)
        ok = k < held.count ? add_held(made, s->maps[k].origin, moment)
                            : surface_add_instance(made, s->maps[k].origin) == IMP_SUCCESS;
    if (ok) memcpy(made->lo, s->lo, sizeof made->lo), memcpy(made->hi, s->hi, sizeof made->hi);
    ok = ok && surface_divide(made) == IMP_SUCCESS;
    if (ok) surface_set_body(made, s->body, s->index), made->held_slip = held.slip;
    if (ok) return made;
    surface_free(made);
    return NULL;
}

/* --- The same point under the maps ------------------------------------------------------------ */

/* One parameter of a surface at one time, along which a point is sought. */
typedef struct circle {
    const surface *s;
    int along;    /* 0: u, 1: v */
    double p[3];  /* u, v, t */
    double to[3]; /* where the point is */
    double lo, hi;
} circle;

static imp_status at_parameter(const circle *c, double w, double x[3])
{
    double p[3];
    memcpy(p, c->p, sizeof p);
    p[c->along] = w;
    return surface_eval(c->s, 1, p, x, NULL);
}

static double square_from(const circle *c, const double x[3])
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += (x[i] - c->to[i]) * (x[i] - c->to[i]);
    return sum;
}

enum { SAMPLES = 64, STEPS = 30 };

static imp_status nearest_sample(const circle *c, double *best, double *square)
{
    *square = INFINITY;
    for (int k = 0; k <= SAMPLES; ++k) {
        const double w = k == SAMPLES ? c->hi : c->lo + (c->hi - c->lo) / SAMPLES * k;
        double x[3];
        const imp_status status = at_parameter(c, w, x);
        if (status != IMP_STATUS_OK) return status;
        if (square_from(c, x) < *square) *square = square_from(c, x), *best = w;
    }
    return IMP_STATUS_OK;
}

/* Into the range, round its ends. */
static double wrapped(const circle *c, double w)
{
    if (w < c->lo) w += c->hi - c->lo;
    if (w > c->hi) w -= c->hi - c->lo;
    return w < c->lo ? c->lo : w > c->hi ? c->hi : w;
}

/* One of Gauss's steps, with the derivative by differences. *is_done: it leads no nearer. */
static imp_status step_nearer(const circle *c, double *best, double *square, bool *is_done)
{
    const double h = 0x1p-20 * (c->hi - c->lo), a = wrapped(c, *best - h),
                 b = wrapped(c, *best + h);
    const double from = a < b ? a : c->lo, to = a < b ? b : c->lo + 2 * h;
    double x[3], y[3], z[3], along = 0, size = 0;
    *is_done = true;
    imp_status status = at_parameter(c, *best, x);
    if (status == IMP_STATUS_OK) status = at_parameter(c, from, y);
    if (status == IMP_STATUS_OK) status = at_parameter(c, to, z);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) {
        const double slope = (z[i] - y[i]) / (to - from);
        along += slope * (c->to[i] - x[i]);
        size += slope * slope;
    }
    if (!(size > 0)) return IMP_STATUS_OK;
    const double next = wrapped(c, *best + along / size);
    status = at_parameter(c, next, x);
    if (status != IMP_STATUS_OK || !(square_from(c, x) < *square)) return status;
    *square = square_from(c, x);
    *best = next;
    *is_done = false;
    return IMP_STATUS_OK;
}

/* A point farther than this part of its coordinates is none of the surface. */
#define FOUND_WITHIN 0x1p-30

imp_status surface_held_place(const surface *s, size_t maps, double t, const double x[3], double *u,
                              double *v)
{
    const int along = orbit_of(s);
    circle c = {.s = s, .along = along, .p = {*u, *v, t}};
    double lo[3], hi[3], best = 0, square, size = 0;
    bool is_done = false;
    if (along < 0) return SURFACE_BAD_SYMMETRY;
    surface_domain(s, lo, hi);
    c.lo = lo[along], c.hi = hi[along];
    memcpy(c.to, x, sizeof c.to);
    imp_status status = surface_move_outward(s, maps, t, 1, c.to);
    for (int i = 0; i < 3; ++i) size += fabs(c.to[i]);
    if (status == IMP_STATUS_OK) status = nearest_sample(&c, &best, &square);
    for (int k = 0; k < STEPS && !is_done && status == IMP_STATUS_OK; ++k)
        status = step_nearer(&c, &best, &square, &is_done);
    if (status != IMP_STATUS_OK) return status;
    *(along == 0 ? u : v) = best;
    return sqrt(square) <= FOUND_WITHIN * size ? IMP_STATUS_OK : SURFACE_BAD_SYMMETRY;
}

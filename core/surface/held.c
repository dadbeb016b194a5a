/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/held.h"

#include "core/surface/clocked.h"
#include "core/surface/slip.h"

/* --- Which maps are held ---------------------------------------------------------------------- */

/* Whether s is closed about one line. */
static bool is_round(const surface *s, imp_symmetry *line)
{
    return surface_closed_symmetry(s, true, line) == IMP_STATUS_OK &&
           line->kind == IMP_SYMMETRY_ABOUT_LINE;
}

/* Whether each piece goes around the line along one of its parameters. */
static bool goes_around(const surface *s, const imp_symmetry *line)
{
    const size_t count = surface_piece_count(s);
    bool all = count > 0 || surface_around_line(s, line) >= 0;
    for (size_t k = 0; k < count && all; ++k)
        all = surface_around_line(surface_piece(s, k), line) >= 0;
    return all;
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
    if (status == IMP_STATUS_OK && maps > 0 && moving > 0 && more <= enough &&
        goes_around(s, &line))
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
    return surface_finish(made, ok, s, held.slip);
}

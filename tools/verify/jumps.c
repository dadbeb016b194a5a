/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/jumps.h"

#include <stdlib.h>

#include "core/common/array.h"

typedef struct ends {
    double *at;
    size_t count, room;
} ends;

static bool add_end(ends *e, double at)
{
    double *grown = array_reserve(e->at, e->count, &e->room, sizeof *grown);
    if (grown == NULL) return false;
    e->at = grown;
    e->at[e->count++] = at;
    return true;
}

static int compare(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

/* Notes where a part begins or ends within the claim, and where one of a map that only meets the
 * claim does. */
static bool add_part(const part *p, const scene_clock *clock, bool is_map, ends *inside,
                     ends *outside)
{
    for (int side = 0; side < 2; ++side) {
        const double at = side == 0 ? p->lo[T] : p->hi[T];
        const bool meets = is_map && at == (side == 0 ? clock->hi : clock->lo);
        if (clock->lo < at && at < clock->hi && !add_end(inside, at)) return false;
        if (meets && !add_end(outside, at)) return false;
    }
    return true;
}

/* Notes the ends of all parts of a chain that follow a clock, in order. */
static bool find_ends(const place *p, size_t clock, ends *inside, ends *outside)
{
    for (size_t k = 0; k <= p->maps; ++k) {
        const stage *g = &p->of->stages[p->chain->stages[k]];
        for (size_t i = 0; i < g->count && g->clock == clock; ++i)
            for (size_t j = 0; j < g->pieces[i].count; ++j)
                if (!add_part(&g->pieces[i].parts[j], &p->of->clocks[clock], k > 0, inside,
                              outside))
                    return false;
    }
    if (inside->count > 0) qsort(inside->at, inside->count, sizeof *inside->at, compare);
    return true;
}

static bool find(const place side[2], size_t clock, ends of[2], ends *both)
{
    for (int k = 0; k < 2; ++k)
        if (!find_ends(&side[k], clock, &of[k], both)) return false;
    for (size_t i = 0, k = 0; i < of[0].count && k < of[1].count;) {
        const double a = of[0].at[i], b = of[1].at[k];
        if (a == b && !add_end(both, a)) return false;
        i += a <= b, k += b <= a;
    }
    if (both->count > 0) qsort(both->at, both->count, sizeof *both->at, compare);
    return true;
}

bool jumps_find(const place side[2], jumps *found)
{
    bool good = true;
    *found = (jumps){.at = {NULL}};
    for (size_t clock = 0; clock < side[0].of->clock_count && good; ++clock) {
        ends of[2] = {{.at = NULL}, {.at = NULL}}, both = {.at = NULL};
        good = find(side, clock, of, &both);
        free(of[0].at);
        free(of[1].at);
        found->at[clock] = both.at;
        found->count[clock] = both.count;
    }
    return good;
}

void jumps_free(jumps *j)
{
    for (size_t k = 0; k < CLOCKS_MAX; ++k) free(j->at[k]);
}

bool jumps_has(const jumps *j, size_t clock, double at)
{
    return j->count[clock] > 0 &&
           bsearch(&at, j->at[clock], j->count[clock], sizeof at, compare) != NULL;
}

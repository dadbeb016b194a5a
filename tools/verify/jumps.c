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

static void sort(ends *e)
{
    if (e->count > 0) qsort(e->at, e->count, sizeof *e->at, compare);
}

/* Notes where parts of a stage begin or end within the claim; and in `both` the ends of the claim
 * that a part only meets. */
static bool add_stage(const stage *g, const scene_clock *clock, ends *inside, ends *both)
{
    bool good = true;
    for (size_t i = 0; i < g->count; ++i)
        for (size_t j = 0; j < g->pieces[i].count && good; ++j)
            for (int side = 0; side < 2 && good; ++side) {
                const part *p = &g->pieces[i].parts[j];
                const double at = side == 0 ? p->lo[T] : p->hi[T];
                if (clock->lo < at && at < clock->hi) good = add_end(inside, at);
                if (at == (side == 0 ? clock->hi : clock->lo)) good = add_end(both, at);
            }
    return good;
}

static bool find(const place side[2], size_t clock, ends of[2], ends *both)
{
    bool good = true;
    for (int s = 0; s < 2; ++s) {
        for (size_t k = 0; k <= side[s].maps && good; ++k) {
            const stage *g = &side[s].of->stages[side[s].chain->stages[k]];
            if (g->clock == clock) good = add_stage(g, &side[s].of->clocks[clock], &of[s], both);
        }
        sort(&of[s]);
    }
    for (size_t i = 0, k = 0; i < of[0].count && k < of[1].count && good;) {
        const double a = of[0].at[i], b = of[1].at[k];
        if (a == b) good = add_end(both, a);
        i += a <= b, k += b <= a;
    }
    sort(both);
    return good;
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

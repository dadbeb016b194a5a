/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/distance.h"
#include "core/surface/region.h"

/* How often the window is cut at most, into which part of the part before, and how many parts may
 * do without a later start: where the distance is inexact by itself, shorter times are of no use.
 * Remainders of third order are a 64th of those before. A window that begins close to the contact
 * needs short parts: after 8 of them in vain, such remainders are 2^-48 of what they were. */
enum { PARTS = 40, PARTS_IN_VAIN = 8 };
#define NEXT_PART 0.25

/* A start that is later by less than this part of what was looked at is as good as the same. */
#define LATER 0x1p-30

/* Looks at the first part of the window alone. */
static imp_code cut_part(const distance_question *q, time_window *part, distance_view *view,
                         imp_error *error)
{
    const imp_region *r = &q->a->region;
    node of_part = {.surface = q->a->surface};
    distance_question asked = *q;
    region_set(&of_part.region, (double[3]){r->lo[0], r->lo[1], part->lo},
               (double[3]){r->hi[0], r->hi[1], part->hi});
    asked.a = &of_part;
    return distance_cut(&asked, part, view, error);
}

/* Lemma. What distance_cut excludes of a part of the window holds for the window: a node with fewer
 * times has fewer points. Parts follow each other without a gap, so that what is left begins where
 * the last one that was excluded ends. */
imp_code distance_cut_start(const distance_question *q, time_window *window, bool *is_apart,
                            imp_error *error)
{
    double length = NEXT_PART * (window->hi - window->lo);
    *is_apart = false;
    for (int k = 0, in_vain = 0; k < PARTS && in_vain < PARTS_IN_VAIN && !*is_apart; ++k) {
        const double from = window->lo, to = from + length;
        time_window part = {from, to < window->hi ? to : window->hi};
        const double end = part.hi;
        distance_view view;
        if (!(part.lo < part.hi)) break;
        const imp_code code = cut_part(q, &part, &view, error);
        if (code != IMP_SUCCESS) return code;
        window->lo = view.is_apart ? end : part.lo;
        *is_apart = view.is_apart && !(end < window->hi);
        if (view.is_apart) continue;
        in_vain = window->lo - from > LATER * length ? 0 : in_vain + 1;
        length *= NEXT_PART;
    }
    return IMP_SUCCESS;
}

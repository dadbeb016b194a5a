/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/gap_lines.h"

#include <assert.h>

#include "core/base/rounding.h"

void gap_lines_begin(gap_lines *lines)
{
    lines->line[0] = (gap_line){0, 0};
    lines->count = 1;
}

/* Lemma. Dividing by a length that is not less than |n| keeps a bound true: where low + drift w is
 * positive it only falls, and where it is negative the distance, at least 0, is above it. Rounding,
 * in units of u (|q| + |e|), |w| <= 1: the quotients 1, the slack 1, the difference 1. */
enum { LINE_ROUNDING = 4 };
_Static_assert(1 + 1 + 1 <= LINE_ROUNDING, "rounding of a line");

void gap_lines_add(gap_lines *lines, double low, double drift, double length)
{
    if (!(low + fabs(drift) > 0 && length > 0)) return;
    assert(lines->count < GAP_LINES);
    const double q = low / length, e = drift / length;
    lines->line[lines->count++] =
        (gap_line){q - (fabs(q) + fabs(e)) * (LINE_ROUNDING * UNIT_ROUNDOFF), e};
}

static double line_at(const gap_line *l, double w) { return l->low + l->drift * w; }

static const gap_line *highest_at(const gap_lines *lines, double w)
{
    const gap_line *best = &lines->line[0];
    for (int k = 1; k < lines->count; ++k)
        if (line_at(&lines->line[k], w) > line_at(best, w)) best = &lines->line[k];
    return best;
}

/* Lemma (two lines). For any weights p, q >= 0 the distance times (p + q) is at least p times the
 * one line plus q times the other, which is a line, least at an end of the range. Here q = 1 - p is
 * rounded, so p + q <= 1 + u. Rounding, in units of u S, S = the sum of the |numbers| of both
 * lines: products and sums 4, the line at an end 3, p + q 1, the difference and S itself 2. */
enum { ENVELOPE_ROUNDING = 16 };
_Static_assert(4 + 3 + 1 + 2 <= ENVELOPE_ROUNDING, "rounding of two lines");

static double weighted_lower(const gap_line *l, const gap_line *m, double p, w_range range)
{
    const double q = 1 - p;
    const gap_line sum = {p * l->low + q * m->low, p * l->drift + q * m->drift};
    const double size = fabs(l->low) + fabs(l->drift) + fabs(m->low) + fabs(m->drift);
    const double start = line_at(&sum, range.lo), end = line_at(&sum, range.hi);
    const double least = (start < end ? start : end) - size * (ENVELOPE_ROUNDING * UNIT_ROUNDOFF);
    return least > 0 ? least : 0;
}

/* Finds the falling and the rising line that cross where the envelope is lowest: replaces one of
 * two lines by the line that is highest where they cross, until neither changes. Any two lines
 * prove a bound. */
double gap_lines_lower(const gap_lines *lines, w_range range, double *w)
{
    const gap_line *fall = highest_at(lines, range.lo), *rise = highest_at(lines, range.hi);
    *w = !(fall->drift < 0) ? range.lo : range.hi;
    if (!(fall->drift < 0)) return weighted_lower(fall, fall, 1, range);
    if (!(rise->drift > 0)) return weighted_lower(rise, rise, 1, range);
    double share = 1;
    for (int k = 0; k < GAP_LINES; ++k) {
        const double steep = rise->drift - fall->drift;
        share = rise->drift / steep;
        *w = (fall->low - rise->low) / steep;
        const gap_line *top = highest_at(lines, *w);
        if (!(line_at(top, *w) > line_at(fall, *w)) || top == rise) break;
        if (top->drift < 0)
            fall = top;
        else
            rise = top;
    }
    *w = *w < range.lo ? range.lo : *w > range.hi ? range.hi : *w;
    return weighted_lower(fall, rise, share, range);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/shell_winding.h"

#include <math.h>

#include "core/base/rounding.h"

/* Chords of edges are off by this part of their distance from x at first, and finer by the factor
 * FINER where the sum leaves two integers possible. */
#define FINENESS 0x1p-10
enum { FINER = 16, ATTEMPTS = 3 };

static imp_code sum_up(const shells *s, const patches *p, size_t shell, const winding_view *view,
                       winding_sum *sum, imp_error *error)
{
    *sum = (winding_sum){{0, 0}, INFINITY};
    for (size_t k = 0; k < p->count; ++k) {
        const imp_facing *f = &s->facing[k];
        if (f->sign == 0 || (shell != SIZE_MAX && f->shell != shell)) continue;
        const imp_code code = winding_add(view, &p->patch[k], f->sign, sum, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

imp_code shell_solid_angle(const shells *s, const patches *p, size_t shell, vec3 x,
                           winding_sum *sum, imp_error *error)
{
    const winding_view view = {.t = p->t, .x = x, .fineness = FINENESS};
    return sum_up(s, p, shell, &view, sum, error);
}

/* Lemma. A closed shell winds around x an integer number of times, which is in number -+ error: if
 * that is an interval of less than 1 around one integer, it is that one. It winds as often around
 * all points nearer to x than the shell is. Where it may not be closed, as edges that more than two
 * patches share leave open, only its number shows that: no integer. */
imp_code shell_wind(const shells *s, const patches *p, size_t shell, vec3 x, double off,
                    winding_number *found, imp_error *error)
{
    winding_view view = {.t = p->t, .x = x, .slack = s->slack, .fineness = FINENESS};
    *found = (winding_number){.is_whole = true};
    for (int k = 0; k < ATTEMPTS; ++k, view.fineness /= FINER) {
        winding_sum sum;
        const imp_code code = sum_up(s, p, shell, &view, &sum, error);
        if (code != IMP_SUCCESS) return code;
        found->number = sum.seen.angle / FULL_ANGLE;
        found->error =
            sum_upper(sum.seen.error / FULL_ANGLE, 8 * UNIT_ROUNDOFF * fabs(found->number));
        const double whole = rint(found->number), rest = fabs(found->number - whole);
        const bool is_known = sum_upper(rest, found->error) < 0.5;
        found->is_near = !is_known || !(sum.distance > off);
        found->is_whole = !(rest > found->error);
        found->times = is_known ? (long)whole : 0;
        if (is_known || !found->is_whole || !(sum.seen.error < FULL_ANGLE)) break;
    }
    return IMP_SUCCESS;
}

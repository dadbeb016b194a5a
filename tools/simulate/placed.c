/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/placed.h"

placed placed_at(const setup *s, size_t body, double t, const mover_state *state)
{
    const actor *a = &s->actors[body];
    placed p = {.still = s->still,
                .body = body,
                .t = a->outline.varies ? t : s->options.t_start,
                .moves = a->moves};
    if (!a->moves) return p;
    p.turn = mover_axes(state);
    p.position = state->position;
    p.center = a->center;
    return p;
}

vec placed_outward(const placed *p, vec x)
{
    if (!p->moves) return x;
    return vec_add(p->position, mat3_apply(&p->turn, vec_sub(x, p->center)));
}

vec placed_inward(const placed *p, vec x)
{
    if (!p->moves) return x;
    return vec_add(p->center, mat3_apply_transposed(&p->turn, vec_sub(x, p->position)));
}

imp_code placed_eval(const placed *p, imp_place place, size_t n, const double (*uv)[2], vec *x,
                     imp_error *why)
{
    double at[3 * PLACED_POINTS_MAX] = {0}, found[3 * PLACED_POINTS_MAX];
    for (size_t k = 0; k < n; ++k) {
        at[3 * k] = uv[k][0];
        at[3 * k + 1] = uv[k][1];
        at[3 * k + 2] = p->t;
    }
    const imp_code code = imp_piece_eval(p->still, place, n, at, found, NULL, why);
    for (size_t k = 0; k < n && code == IMP_SUCCESS; ++k)
        x[k] = placed_outward(p, vec_of(found + 3 * k));
    return code;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/time_descent.h"

#include "core/bounds/tuning.h"

/* A witness at a time, and the rate at which its gap changes there. */
typedef struct moment {
    double t, rate; /* length / time */
    witness seen;
} moment;

/* Time step of the differences that give velocities, as a part of the times searched. */
static const double VELOCITY_STEP = 0x1p-20;

/* Computes the rate normal.(v_b - v_a) by differences at fixed parameters. */
static imp_code find_rate(const node *const nodes[2], const time_window *times, moment *m,
                          imp_error *error)
{
    const double far = VELOCITY_STEP * (times->hi - times->lo);
    const double t = m->t + far <= times->hi ? m->t + far : m->t - far;
    double rate = 0;
    m->rate = 0;
    if (!m->seen.has_normal || !(t >= times->lo) || t == m->t) return IMP_SUCCESS;
    for (int side = 0; side < 2; ++side) {
        const double p[2][3] = {{m->seen.u[side], m->seen.v[side], m->t},
                                {m->seen.u[side], m->seen.v[side], t}};
        double eval_error[2];
        vec3 x[2];
        const imp_code code = witness_eval_errors(nodes[side]->surface, 2, p, eval_error, x, error);
        if (code != IMP_SUCCESS) return code;
        const double along = vec3_dot(m->seen.normal, vec3_sub(x[1], x[0])) / (t - m->t);
        rate += side == 0 ? -along : along;
    }
    if (rate - rate == 0) m->rate = rate;
    return IMP_SUCCESS;
}

/* Seeks the witness at *m's time from that at another. */
static imp_code look(const node *const nodes[2], const time_window *times, const witness *from,
                     moment *m, imp_error *error)
{
    m->seen = *from;
    const imp_code code = witness_polish(nodes, m->t, &m->seen, error);
    return code == IMP_SUCCESS ? find_rate(nodes, times, m, error) : code;
}

/* The time at which the line through both rates is 0, if that is between `from` and `end`, and not
 * next to either; else their middle, or `end` if that `is_open`, so was not looked at. */
static double root_between(const moment *x, const moment *y, double from, double end, bool is_open)
{
    const double way = end - from, least = 0x1p-6;
    const double t = x->t - x->rate * ((y->t - x->t) / (y->rate - x->rate));
    const double part = (t - from) / way;
    if (is_open && part > 1 - least) return end;
    if (!(part > 0 && part < 1)) return 0.5 * from + 0.5 * end;
    return from + way * (part < least ? least : part > 1 - least ? 1 - least : part);
}

/* `best` moves towards `end`, whose side is that of its rate. While no rate of the other sign is
 * known, the next time is that at which the rate would be 0; from then on, the bracket of both
 * shrinks. It ends where the bracket's rates promise less than `part` of the gap. */
imp_code witness_descend_in_time(const node *const nodes[2], const time_window *times, double part,
                                 double *t, witness *found, size_t *searches, imp_error *error)
{
    moment best = {.t = *t, .seen = *found};
    imp_code code = find_rate(nodes, times, &best, error);
    double end = best.rate > 0 ? times->lo : times->hi, next = 0.5 * best.t + 0.5 * end;
    bool is_open = true;
    for (int k = 0; code == IMP_SUCCESS && k < TUNING_DESCENT_STEPS; ++k) {
        const double gain = part * best.seen.gap_upper;
        if (!(fabs(best.rate) * fabs(end - best.t) > gain) || next == best.t) break;
        moment m = {.t = next};
        *searches += 1;
        code = look(nodes, times, &best.seen, &m, error);
        if (code != IMP_SUCCESS) break;
        const bool is_lower = m.seen.gap_upper < best.seen.gap_upper;
        const bool turns = (m.rate > 0) != (best.rate > 0);
        const moment last = best;
        if (is_lower) best = m;
        is_open = is_open && !turns && is_lower;
        if (turns || !is_lower) end = is_lower ? last.t : m.t;
        next = root_between(&last, &m, best.t, end, is_open);
        const double left = 0.5 * fabs(best.rate) * fabs(next - best.t);
        if (turns && !(left > part * best.seen.gap_upper)) break;
    }
    *t = best.t;
    *found = best.seen;
    return code;
}

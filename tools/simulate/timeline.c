/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/timeline.h"

#include <stdio.h>

static const char speaker[] = "simulate";

/* --- States and sums -------------------------------------------------------------------------- */

sums timeline_sums(const simulation *s, const mover_state *state)
{
    sums all = {0};
    for (size_t i = 0; i < s->setup->count; ++i) {
        const actor *a = &s->setup->actors[i];
        if (!a->moves) continue;
        const vec p = vec_scale(a->mass, state[i].velocity);
        all.energy += mover_kinetic_energy(&s->movers[i], &state[i]) -
                      a->mass * vec_dot(s->setup->gravity, state[i].position);
        all.momentum = vec_add(all.momentum, p);
        all.angular =
            vec_add(all.angular, vec_add(state[i].momentum, vec_cross(state[i].position, p)));
    }
    return all;
}

void timeline_states(const simulation *s, double t, mover_state *state)
{
    for (size_t i = 0; i < s->setup->count; ++i)
        if (s->setup->actors[i].moves) state[i] = mover_at(&s->movers[i], t);
}

void timeline_advance(simulation *s, double t)
{
    for (size_t i = 0; i < s->setup->count; ++i)
        if (s->setup->actors[i].moves)
            s->from_gravity = vec_along(s->from_gravity, s->setup->actors[i].mass * (t - s->t),
                                        s->movers[i].acceleration);
    s->t = t;
}

static const char *name_of(imp_reason reason)
{
    switch (reason) {
    case IMP_REASON_PAIRS:
        return "max-pairs";
    case IMP_REASON_SECONDS:
        return "max-seconds";
    case IMP_REASON_MEMORY:
        return "max-bytes";
    case IMP_REASON_RESOLUTION:
        return "resolution";
    default:
        return "cancelled";
    }
}

void timeline_cut(simulation *s, double t, imp_reason reason, const meeting *m)
{
    s->reason = name_of(reason);
    if (reason == IMP_REASON_RESOLUTION && m != NULL)
        snprintf(s->hint, sizeof s->hint,
                 "'%.80s' and '%.80s' keep touching, at gaps that rounding cannot tell from the "
                 "gamma_clear, %g; a greater --gamma helps",
                 s->setup->actors[m->body[0]].name, s->setup->actors[m->body[1]].name,
                 s->setup->options.gamma_clear);
    else if (reason != IMP_REASON_CANCELLED)
        snprintf(s->hint, sizeof s->hint, "a greater --%s goes on", s->reason);
    timeline_advance(s, t);
}

exit_status timeline_check(const simulation *s, size_t body)
{
    const double t = mover_overflow(&s->movers[body]);
    if (isnan(t)) return EXIT_ANSWERED;
    const value_place at = {s->setup->name, body, ""};
    return value_refuse(at,
                        "found that '%.80s' overflows at t = %g: places, velocities and spins must "
                        "stay below %g, and turns below %g rad; choose other units, or less time",
                        s->setup->actors[body].name, t, VALUE_MAX, TURN_MAX);
}

/* --- Meetings --------------------------------------------------------------------------------- */

/* Neither of the two moves before it is hit. */
static bool is_asleep(const simulation *s, const meeting *m)
{
    for (int k = 0; k < 2; ++k) {
        const actor *a = &s->setup->actors[m->body[k]];
        if (a->moves ? !s->rests[m->body[k]] : a->outline.varies) return false;
    }
    return true;
}

exit_status timeline_complain(const simulation *s)
{
    return complain_of(&s->search.error, speaker);
}

static void set_undecided(meeting *m, double t, imp_reason reason)
{
    m->kind = MEETING_UNDECIDED;
    m->reason = reason;
    m->t = t;
}

exit_status timeline_predict(simulation *s, meeting *m, double t, int least)
{
    meeting now;
    int level;
    m->kind = MEETING_NEVER;
    m->t = s->search.end;
    if (is_asleep(s, m)) return EXIT_ANSWERED;
    const imp_reason end = limits_reached(&s->search.limits);
    if (end != IMP_REASON_NONE) {
        set_undecided(m, t, end);
        return EXIT_ANSWERED;
    }
    imp_code code = meeting_make_scene(&s->search, m);
    if (code == IMP_SUCCESS) code = meeting_level(&s->search, m, t, least, &level, &now);
    if (code != IMP_SUCCESS) return timeline_complain(s);
    if (now.kind == MEETING_UNDECIDED) {
        *m = now;
    } else if (level == LEVEL_NONE) {
        set_undecided(m, t, IMP_REASON_RESOLUTION);
        m->level = level;
    } else if (meeting_find(&s->search, m, t, level) != IMP_SUCCESS) {
        return timeline_complain(s);
    }
    return EXIT_ANSWERED;
}

exit_status timeline_continue(simulation *s, meeting *m)
{
    const imp_reason end = limits_reached(&s->search.limits);
    if (end != IMP_REASON_NONE)
        set_undecided(m, m->t, end);
    else if (meeting_continue(&s->search, m) != IMP_SUCCESS)
        return timeline_complain(s);
    return EXIT_ANSWERED;
}

meeting *timeline_earliest(const simulation *s)
{
    meeting *first = NULL;
    for (size_t i = 0; i < s->meeting_count; ++i) {
        meeting *m = &s->meetings[i];
        if (m->kind != MEETING_NEVER && (first == NULL || m->t < first->t)) first = m;
    }
    return first;
}

/* Two bodies that no level parts. */
static exit_status refuse_overlap(const simulation *s, const meeting *m)
{
    return complain(
        EXIT_DATA, speaker,
        "%.300s: the bodies '%s' and '%s' are nearer than gamma_clear, %g, at the start, or one is "
        "inside the other, which is solid; move them apart, or make gamma smaller",
        s->setup->name, s->setup->actors[m->body[0]].name, s->setup->actors[m->body[1]].name,
        s->setup->options.gamma_clear);
}

exit_status timeline_predict_all(simulation *s)
{
    const double start = s->setup->options.t_start;
    for (size_t i = 0; i < s->meeting_count; ++i) {
        meeting *m = &s->meetings[i];
        const exit_status status = timeline_predict(s, m, start, 0);
        if (status != EXIT_ANSWERED) return status;
        if (m->level == LEVEL_NONE) return refuse_overlap(s, m);
    }
    return EXIT_ANSWERED;
}

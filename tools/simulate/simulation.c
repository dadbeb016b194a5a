/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/simulation.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/common/array.h"
#include "tools/cli/progress.h"
#include "tools/simulate/event.h"
#include "tools/simulate/timeline.h"

static const char speaker[] = "simulate";

/* L of response.h, and the time that a hop lasts. */
static void set_speeds(simulation *s)
{
    const imp_options *o = &s->setup->options;
    const double span = o->t_end - o->t_start;
    const double fall = vec_length(s->setup->gravity) + o->gamma / (span * span);
    s->lift = sqrt(2 * o->gamma * fall);
    s->search.window = 4 * s->lift / fall;
}

static exit_status begin(simulation *s, const setup *what, const arguments *args)
{
    const size_t n = what->count;
    const imp_options *o = &what->options;
    *s = (simulation){.setup = what,
                      .movers = calloc(n, sizeof *s->movers),
                      .memory = calloc(n, sizeof *s->memory),
                      .rests = calloc(n, sizeof *s->rests),
                      .held_now = calloc(n, sizeof *s->held_now),
                      .max_events = arguments_count(args, "max-events", 10000),
                      .t = o->t_start,
                      .log = json_array()};
    s->search =
        (searching){.setup = what, .movers = s->movers, .end = o->t_end, .limits = what->limits};
    set_speeds(s);
    if (s->movers == NULL || s->memory == NULL || s->rests == NULL || s->held_now == NULL ||
        s->log == NULL)
        return complain_of_memory(speaker);
    for (size_t i = 0; i < n; ++i) {
        s->memory[i].speed = INFINITY;
        if (!what->actors[i].moves) continue;
        if (!mover_begin(&s->movers[i], &what->actors[i], what->gravity, o->t_start, o->t_end))
            return complain_of_memory(speaker);
        const exit_status status = timeline_check(s, i);
        if (status != EXIT_ANSWERED) return status;
    }
    return EXIT_ANSWERED;
}

/* The time may be up, or the meetings may need more memory than is allowed. */
static imp_reason list_limit(const simulation *s)
{
    const uint64_t allowed = s->setup->options.max_bytes;
    if (allowed > 0 && s->meeting_count > allowed / sizeof *s->meetings) return IMP_REASON_MEMORY;
    return limits_reached(&s->search.limits);
}

/* One meeting of each two bodies of which one moves. Of tens of thousands of bodies there are so
 * many pairs that the limits hold here, too; *limit says whether one came first. */
static exit_status list_meetings(simulation *s, imp_reason *limit)
{
    const setup *what = s->setup;
    size_t capacity = 0;
    for (size_t i = 0; i < what->count; ++i) {
        *limit = list_limit(s);
        if (*limit != IMP_REASON_NONE) return EXIT_ANSWERED;
        for (size_t j = i + 1; j < what->count; ++j) {
            if (!what->actors[i].moves && !what->actors[j].moves) continue;
            if (imp_scene_ignores(what->still, i, j)) continue;
            meeting *grown = array_reserve(s->meetings, s->meeting_count, &capacity, sizeof *grown);
            if (grown == NULL) return complain_of_memory(speaker);
            s->meetings = grown;
            s->meetings[s->meeting_count++] = (meeting){.body = {i, j}};
        }
    }
    return EXIT_ANSWERED;
}

static exit_status run(simulation *s)
{
    imp_reason limit;
    exit_status status = list_meetings(s, &limit);
    if (status == EXIT_ANSWERED && limit != IMP_REASON_NONE) timeline_cut(s, s->t, limit, NULL);
    if (status == EXIT_ANSWERED && s->reason == NULL) status = timeline_predict_all(s);
    bool done = false;
    while (status == EXIT_ANSWERED && s->reason == NULL && !done) {
        meeting *first = timeline_earliest(s);
        if (first == NULL) {
            timeline_advance(s, s->search.end);
            done = true;
        } else if (first->kind == MEETING_OPEN) {
            status = timeline_continue(s, first);
        } else if (first->kind == MEETING_UNDECIDED) {
            timeline_cut(s, first->t, first->reason, first);
        } else if (s->events >= s->max_events) {
            s->reason = "max-events";
            snprintf(s->hint, sizeof s->hint, "a greater --max-events goes on");
            timeline_advance(s, first->t);
        } else {
            progress_show("t = %.6g, %zu events", first->t, s->events);
            status = event_handle(s, first->t);
        }
    }
    progress_wipe();
    return status;
}

exit_status simulation_run(simulation *s, const setup *what, const arguments *args)
{
    exit_status status = begin(s, what, args);
    if (status != EXIT_ANSWERED) return status;
    mover_state *state = calloc(what->count, sizeof *state);
    if (state == NULL) return complain_of_memory(speaker);
    timeline_states(s, s->t, state);
    s->start = timeline_sums(s, state);
    status = run(s);
    timeline_states(s, s->t, state);
    s->end = timeline_sums(s, state);
    free(state);
    return status;
}

void simulation_free(simulation *s)
{
    for (size_t i = 0; i < s->meeting_count; ++i) imp_scene_free(s->meetings[i].scene);
    for (size_t i = 0; s->movers != NULL && i < s->setup->count; ++i)
        if (s->setup->actors[i].moves) mover_free(&s->movers[i]);
    free(s->movers);
    free(s->memory);
    free(s->meetings);
    free(s->rests);
    free(s->held_now);
    json_decref(s->log);
}

double simulation_substep_error(const simulation *s)
{
    double most = 0;
    for (size_t i = 0; i < s->setup->count; ++i)
        if (s->setup->actors[i].moves) most = fmax(most, s->movers[i].substep_error);
    return most;
}

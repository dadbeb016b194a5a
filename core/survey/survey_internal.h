/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURVEY_SURVEY_INTERNAL_H
#define CORE_SURVEY_SURVEY_INTERNAL_H

#include <math.h>
#include <stdatomic.h>

#include "core/broad_phase/examined_times.h"
#include "core/scene/scene.h"
#include "core/scene/tolerances.h"
#include "core/solver/pair_spread.h"
#include "core/surface/surface_shift.h"
#include "core/survey/box_queue.h"

/* Surveys: branch and bound over the values of a scene's parameters
 * =================================================================
 * A box of values is decided by an ordinary query at its middle:
 *
 * Lemma. Let c be the middle of a box of values, and shift >= the sum of how far the points of two
 * bodies move when the parameters go from c to any p of the box, at any time in question
 * (surface_shift_upper; motions that both bodies share leave their distances as they are). Points
 * that are farther apart than d + shift at c are farther apart than d at p, by the triangle
 * inequality. So where the query at c, with gamma_clear + shift for its gamma_clear, proves that
 * nothing is near before t', nothing comes nearer than gamma_clear before t' at any p; and a least
 * distance at c, less the shift, bounds that at p.
 *
 * Nobody is inside a solid body at p who is not at c: on the way from c to p, which stays in the
 * box, no surfaces meet.
 *
 * A box that is not decided is halved along the parameter that shifts most. The one with the least
 * key is next, which is what makes the first answer the earliest, or the least. The search ends:
 * shifts go to 0 with the boxes, and where the shift is at most half of gamma - gamma_clear a
 * contact of the query at c is one of the scene.
 *
 * Where nothing of two bodies depends on time, the queries' time is the parameter that shifts most:
 * what follows it follows time, so that one query covers its whole range, by bounds that are better
 * than those of the lemma; the shift is that of the others. A contact is one at all times then.
 *
 * survey.c steps, survey_box.c and box_*.c decide one box (box_question.h), survey_measure.c bounds
 * how its parameters shift bodies, survey_pairs.c finds which bodies which parameters move,
 * survey_mark.c marks where the survey stands and hands boxes to the sink, survey_state.c saves
 * and loads, survey_answer.c and survey_cost.c return results. */

#define SURVEY_ALL_BODIES SIZE_MAX

/* Two bodies that parameters move relative to each other, or all pairs of bodies that none does:
 * body[0] is SURVEY_ALL_BODIES. */
typedef struct survey_pair {
    size_t body[2];
    size_t left_out;       /* last maps that both share */
    size_t swept;          /* the parameter that queries take for their time; SIZE_MAX: none */
    uint64_t boxes, pairs; /* asked about; tested by their queries */
    double proved;         /* share */
} survey_pair;

/* The contact, or the nearest points, known. */
typedef struct survey_incumbent {
    bool is_known;
    double t;        /* INFINITY: none */
    double distance; /* INFINITY: none */
    double *values;
    imp_result contact;
    imp_clearance nearest;
} survey_incumbent;

/* Where the survey stood before the box being asked about; it is kept if a limit interrupts a query
 * of that box. The answer uses what the interrupted query proved, but imp_survey_save writes the
 * mark: a survey that goes on from it asks about the box again, and answers like one that was not
 * interrupted. */
typedef struct survey_mark {
    survey_box *box; /* owned; NULL: none is interrupted */
    uint64_t boxes;
    double proved, settled;
    survey_incumbent best;
} survey_mark;

typedef struct survey_told survey_told; /* a box to be handed to the sink */

struct imp_survey {
    imp_scene *scene;
    imp_options options;
    imp_survey_options how;
    bool is_clearance; /* asked with clearance options, */
    bool is_distance;  /* for a bracket; else for the earliest contact, or any */
    imp_clearance_options asked;
    double gamma, gamma_clear; /* of the search for a contact */
    examined_times examined;
    size_t count;    /* of parameters */
    double *lo, *hi; /* their ranges, one block with the values of both incumbents, and the view */
    double *at, *shift[3]; /* of the box being asked about: its middle; shifts of both bodies and
                                  of one of their surfaces */
    size_t *first;         /* of each body, its first extent */
    surface_extent *extents;
    survey_pair *pairs;
    size_t pair_count, pair_capacity;
    box_queue queue;
    uint64_t made, boxes;
    uint64_t boxes_before; /* asked about by the surveys that this one goes on from */
    double key_asked;      /* of the box being asked about */
    survey_incumbent best;
    survey_mark mark;
    survey_told **told; /* kept back until the box being asked about is done */
    size_t told_count, told_capacity;
    bool told_failed; /* no memory for one */
    double settled;   /* least distance proved of boxes that are done with; length */
    double proved;    /* shares of all pairs together */
    uint64_t *cuts;   /* of boxes along each parameter */
    imp_stats stats;
    imp_verdict verdict;
    imp_reason reason;
    bool failed;
    double next_report, step_from[2]; /* seconds, as in a query */
    atomic_bool cancelled;
};

/* Finds the pairs, and makes room for their extents. */
imp_code survey_find_pairs(imp_survey *s, imp_error *error);

/* Chooses the parameter that is swept for each pair, and finds how large surfaces are before their
 * maps. */
imp_code survey_choose_swept(imp_survey *s, imp_error *error);

/* How far the values of a box shift the two bodies of its pair, at most. */
typedef struct survey_view {
    const double *lo, *hi; /* ranges of the parameters */
    double total;          /* >= shift of all parameters and both bodies together; length */
    double apart;          /* <= distance of the bodies at all values; length */
    double t_start, t_end; /* the times of its bounds */
    bool follows_time;
} survey_view;

/* Makes the view of a box over these times. s->at becomes the box's middle, followed by the ranges
 * that the view points to; s->shift[0][k] becomes the share of parameter k. */
imp_code survey_measure(imp_survey *s, const survey_box *box, size_t left_out, double t_start,
                        double t_end, survey_view *view, imp_error *error);

/* Makes the spread of the box that was measured last, of two bodies. It is to be cleared in any
 * case. */
imp_code survey_spread_make(imp_survey *s, const survey_box *box, const survey_view *view,
                            query_spread *to, imp_error *error);
void survey_spread_clear(query_spread *spread);

/* Adds the first box of each pair, with a key that is proved of all values. */
imp_code survey_add_roots(imp_survey *s, double key, imp_error *error);

/* Returns the time before which nothing is near at any values. */
double survey_time_lower(const imp_survey *s);

/* Adds a share of the box's pair that is proved. */
void survey_add_proved(imp_survey *s, const survey_box *box, double share);

/* Decides a box, which it takes over, or divides it; s->reason becomes other than RUNNING where
 * that ends the survey. */
imp_code survey_ask(imp_survey *s, survey_box *box, imp_error *error);

/* Marks where the survey stands before it asks about a box; forgets the mark. */
imp_code survey_mark_take(imp_survey *s, const survey_box *box, imp_error *error);
void survey_mark_drop(imp_survey *s);

/* Returns the box as it was before it was interrupted, if it was, else itself. */
const survey_box *survey_marked(const imp_survey *s, const survey_box *box);

/* Keeps a box over a part of time for the sink. What is kept goes there by survey_flush. */
void survey_tell(imp_survey *s, const survey_box *box, double t_start, double t_end,
                 imp_verdict verdict, double lower);

imp_code survey_flush(imp_survey *s, imp_error *error);
void survey_told_clear(imp_survey *s);

/* Goes on from what imp_survey_save returned: the first boxes of pairs give way to those left. */
imp_code survey_load(imp_survey *s, const char *text, imp_error *error);

/* Returns the distance from which on a box needs no further search. */
double survey_distance_enough(const imp_survey *s);

double survey_seconds(const imp_survey *s);

#endif

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
 * Maps that only turn a surface within itself shift none of it but by a slip, which is part of the
 * shift: each of its points at p has one at c within that (held_values.h).
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
 * survey_records.c hands boxes to the sink and keeps a snapshot for imp_survey_save,
 * survey_state.c saves and loads, survey_answer.c and survey_cost.c return results; survey_proof.c
 * keeps what certificates need, survey_claim.c writes them. */

#define SURVEY_ALL_BODIES SIZE_MAX

/* Two bodies that parameters move relative to each other, or all pairs of bodies that none does:
 * body[0] is SURVEY_ALL_BODIES. */
typedef struct survey_pair {
    size_t body[2];
    size_t left_out;       /* last maps that both share */
    size_t swept;          /* the parameter that queries take for their time; SIZE_MAX: none */
    double drift;          /* how far that parameter moves, as a time, what stands still; length */
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

/* What a survey counts. */
typedef struct survey_counts {
    uint64_t made;         /* boxes; numbers those that come */
    uint64_t boxes;        /* asked about, */
    uint64_t boxes_before; /* and by the surveys that this one goes on from */
    double proved;         /* sum of the shares of all pairs */
    double settled;        /* least distance proved of boxes that are done with; length */
    uint64_t *cuts;        /* of boxes along each parameter */
    imp_stats stats;       /* of all queries together */
} survey_counts;

/* The survey as it was before it asked about a box; it is kept if a limit interrupts a query of
 * that box. The answer uses what the interrupted query proved, but imp_survey_save writes the
 * snapshot: a survey that goes on from it asks about the box again, and answers like one that was
 * not interrupted. */
typedef struct survey_snapshot {
    survey_box *box; /* owned; NULL: none is interrupted */
    uint64_t boxes;
    double proved, settled;
    survey_incumbent best;
} survey_snapshot;

/* Boxes for the caller's sink, kept back until the box being asked about is done. */
typedef struct survey_record survey_record;
typedef struct survey_records {
    survey_record **at;
    size_t count, capacity;
    bool failed; /* no memory for one */
} survey_records;

typedef struct survey_proof survey_proof; /* survey_proof.h */

/* What is asked. */
typedef struct survey_question {
    imp_options options;
    imp_survey_options how;
    bool is_clearance; /* asked with clearance options, */
    imp_clearance_options clearance;
    bool is_distance;          /* for a bracket; else for the earliest contact, or any */
    double gamma, gamma_clear; /* of the search for a contact; length */
    examined_times examined;
} survey_question;

/* The pairs of bodies. */
typedef struct survey_pairs {
    survey_pair *at;
    size_t count, capacity;
} survey_pairs;

/* The surfaces before their maps. */
typedef struct survey_extents {
    size_t *first; /* of each body that is asked about, its first surface */
    surface_extent *of;
} survey_extents;

/* The box being asked about. */
typedef struct survey_asked_box {
    double key;
    double *middle;   /* followed by the ranges, lo of all parameters, then hi */
    double *shift[3]; /* by each parameter, at most: of both bodies together, of body 1, and of one
                         surface; length */
} survey_asked_box;

/* Seconds in a step, and when progress is reported next. */
typedef struct survey_clock {
    double next_report, step_from[2];
} survey_clock;

struct imp_survey {
    imp_scene *scene;
    survey_question question;
    size_t parameters; /* their number */
    double *lo, *hi;   /* their ranges; lo begins the block that holds all values */
    survey_pairs pairs;
    survey_extents extents;
    box_queue queue;
    survey_asked_box box;
    survey_incumbent best;
    survey_counts counts;
    survey_snapshot before;
    survey_records records;
    survey_clock clock;
    survey_proof *proof; /* NULL: none is kept */
    imp_verdict verdict;
    imp_reason reason;
    bool failed;
    atomic_bool cancelled;
};

/* Finds the pairs, and makes room for their extents. */
imp_code survey_find_pairs(imp_survey *s, imp_error *error);

/* Chooses the parameter that is swept for each pair, and finds how large surfaces are before their
 * maps. */
imp_code survey_choose_swept(imp_survey *s, imp_error *error);

/* What is known of a box before any query. */
typedef struct box_bounds {
    const double *lo, *hi; /* ranges of the parameters */
    double total;          /* >= shift of all parameters and both bodies together; length */
    double shifts;         /* the part of it that halves of the box have less of; length */
    double apart;          /* <= distance of the bodies at all values; length */
    double t_start, t_end; /* the times of these bounds */
    bool follows_time;     /* some surface does (surface_shift.h); else */
    double drift;          /* how far the times move both bodies, at most; length */
} box_bounds;

/* Bounds a box over these times. s->box.middle becomes the box's middle, followed by the ranges
 * that the bounds point to; s->box.shift[0][k] becomes the share of parameter k. */
imp_code survey_measure(imp_survey *s, const survey_box *box, size_t left_out, double t_start,
                        double t_end, box_bounds *bounds, imp_error *error);

/* Makes the spread of the box that was measured last, of two bodies, for a search with these
 * tolerances, {gamma, gamma_clear}, at all values. It is to be cleared in any case. */
imp_code survey_spread_make(imp_survey *s, const survey_box *box, const box_bounds *bounds,
                            const double gamma[2], query_spread *to, imp_error *error);
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

/* Keeps a snapshot of the survey before it asks about a box; drops it. */
imp_code survey_snapshot_take(imp_survey *s, const survey_box *box, imp_error *error);
void survey_snapshot_drop(imp_survey *s);

/* Returns the box as it was before it was interrupted, if it was, else itself. */
const survey_box *survey_box_before(const imp_survey *s, const survey_box *box);

/* Keeps a box over a part of time for the sink. survey_records_send hands over what is kept. */
void survey_record_box(imp_survey *s, const survey_box *box, double t_start, double t_end,
                       imp_verdict verdict, double lower);

imp_code survey_records_send(imp_survey *s, imp_error *error);
void survey_records_clear(survey_records *records);

/* Goes on from what imp_survey_save returned: the first boxes of pairs give way to those left. */
imp_code survey_load(imp_survey *s, const char *text, imp_error *error);

/* A quarter of what tolerances_nearly leaves: brackets as narrow decide a required distance. */
#define SURVEY_DECIDING_TOLERANCE 2.5e-7

/* Returns the distance from which on a box needs no further search. */
double survey_distance_enough(const imp_survey *s);

/* Returns the distance at which a bracket ends, however wide it is: gamma, or what is required if
 * that is less. */
double survey_distance_touching(const imp_survey *s);

double survey_seconds(const imp_survey *s);

#endif

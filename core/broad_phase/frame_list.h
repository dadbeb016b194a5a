/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_FRAME_LIST_H
#define CORE_BROAD_PHASE_FRAME_LIST_H

#include "core/bounds/time_window.h"
#include "core/broad_phase/collection.h"
#include "core/surface/aside.h"
#include "core/surface/glance.h"

/* Frames of candidates, for collect_frames.c, collect_glances.c and collect_half_planes.c. */

/* A surface in one frame: candidate `of` in the form `view`. */
typedef struct frame {
    size_t of;
    size_t next; /* of the same candidate, or NONE */
    surface_view view;
    candidate made;
    surface_glance seen; /* at the common times of a pair; from > to: not made yet */
    aside_look aside;    /* at the common times of a pair, for maps to set aside */
    bool is_looked_at;   /* for maps to hold */
    held_maps may_hold;  /* once looked at: surface_held_maps */
} frame;

#define NONE SIZE_MAX

typedef struct frame_list {
    arena_store *store; /* of the memory of all three */
    frame *at;
    size_t count, capacity;
    size_t *first;        /* of each candidate, or NONE */
    size_t (*of_pair)[2]; /* frames of its two sides */
} frame_list;

/* Returns room for one more frame, which is not counted yet. NULL: no memory. */
frame *frame_list_next(frame_list *frames);

/* Returns the candidate's frame, made now unless it exists. *found NONE: a limit was reached
 * first. */
imp_code frames_find(collection *all, frame_list *frames, const candidate *c,
                     const surface_view *view, size_t *found, imp_error *error);

/* Whether maps of the pair's surfaces may be set aside. */
bool frames_may_set_aside(const collection *all, const candidate_pair *p);

/* Gives pair k frames in which maps that both surfaces share, or that cancel, are set aside, and
 * adds what that slips to *slip. */
imp_code frames_set_aside(collection *all, frame_list *frames, size_t k, double *slip,
                          imp_error *error);

/* Whether maps of one of the pair's surfaces may be held. */
bool frames_may_be_held(const collection *all, const candidate_pair *p);

/* Gives pair k, unless it is searched at one moment, frames in which the first maps of surfaces
 * that these turn within themselves are held, and adds what that slips to *slip. */
imp_code frames_hold_pair(collection *all, frame_list *frames, size_t k, double *slip,
                          imp_error *error);

/* Makes the roots of the pair's frames. *times: those of both; lo > hi: there are none. */
imp_code frames_make_roots(collection *all, const frame_list *frames, size_t k, time_window *times,
                           imp_error *error);

/* Glances at both surfaces of pair k, with roots, over their common times, and notes which slips
 * are too large to be of use. *may_rest false: no point of a surface is known that its maps carry,
 * or both surely do not only turn within themselves. */
imp_code frames_look_at_pair(collection *all, frame_list *frames, size_t k,
                             const time_window *times, bool *may_rest, imp_error *error);

/* Whether the surfaces of pair k, glanced at, are closed about a line each, and not about one. */
bool frames_have_two_lines(const frame_list *frames, size_t k);

/* Whether the glances at pair k show that its surfaces are not closed about one line. */
bool frames_lack_common_line(const collection *all, const frame_list *frames, size_t k,
                             const time_window *times);

/* Whether both surfaces of the pair may be closed about one line. */
bool frames_may_have_half_planes(const collection *all, const candidate_pair *p);

/* Lets a half plane stand for all of pair k, if its surfaces are closed about one line. `slip` is
 * that of its moment. */
imp_code frames_halve_pair(collection *all, frame_list *frames, size_t k, double slip,
                           imp_error *error);

/* Computes how far two points of these surfaces, whose roots are made, are from each other at this
 * time, at most. */
imp_code frames_some_distance(tree *const t[2], double time, double *distance_upper,
                              imp_error *error);

/* Frees the half planes of frames that the list does not take. */
void frames_forget_half_planes(candidate_list *list, const frame_list *frames);

#endif

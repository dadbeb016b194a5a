/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_CANDIDATES_H
#define CORE_BROAD_PHASE_CANDIDATES_H

#include "core/broad_phase/candidate.h"

/* How a query begins: the broad phase
 * ===================================
 * Every surface that exists at any of the query's times gets a tree, whose root has a box around
 * all points that the surface sweeps. Two surfaces of different bodies are a candidate pair if
 * their boxes come within gamma_clear of each other, unless their bodies ignore each other.
 *
 * If each surface of a pair turns only within itself, or by a symmetry of the other, the pair has
 * trees of one moment, the first at which both exist: at any other time the distance of the
 * surfaces differs by at most the list's slip. Where both are closed about one line, nodes that
 * miss a half plane are left out: others are as near, but for the list's slip. A distance of c
 * proved for the list is one of c - slip for the surfaces. */

enum { CANDIDATES_AT_HAND = 3 }; /* stored in the list itself */

typedef struct candidate_list {
    arena_store *store;    /* of its memory; NULL: the heap */
    candidate *candidates; /* in the order of the scene */
    candidate at_hand[CANDIDATES_AT_HAND];
    size_t count;
    candidate_pair *pairs; /* by body of a, body of b, surface of a, surface of b */
    size_t pair_count, pair_capacity;
    double slip; /* >= surface_pair_slip of each pair whose trees hold one moment, with the slip of
                    surface_half_plane where that is used; length */
    size_t half_planes;
    bool complete;
    bool owns_trees;           /* else they are the scene's */
    struct later_pairs *later; /* pairs that are not in `pairs` yet; NULL: there are none */
} candidate_list; /* begins as {0} or with its store, and stays where it is once filled;
                     candidates_clear frees */

/* The caller's limits. is_reached is called after every few surfaces and boxes, with the bytes that
 * the list and the new trees hold, and returns whether a limit of the query is reached. is_near is
 * called in between, and by threads that work ahead, with the bytes and pairs made since then; it
 * returns whether a limit is so near that is_reached has to be called, or that the threads should
 * stop. [is_near: any thread] */
typedef struct candidate_limit {
    bool (*is_reached)(void *context, uint64_t bytes, uint64_t pairs);
    bool (*is_near)(void *context, uint64_t bytes, uint64_t pairs);
    void *context;
} candidate_limit;

/* Which pairs are collected, and how. */
typedef struct candidate_search {
    double gamma_clear;
    bool is_nearest; /* pairs may be left out that are farther than another pair at all times */
    /* Slices of the query's times are searched, each by itself: pairs that turn within themselves,
     * or are screwed along a thread, get trees of one moment, and sections of threads, for each
     * slice (candidates_rest). */
    bool in_slices;
    double slip_most; /* of the list, at most; length */
    /* Slips of surfaces along each other that are larger than this are of no use; length. */
    double slip_useful;
    bool may_halve; /* nodes that miss a half plane may be left out: each pair that is left need
                       not be near all points that it stands for (proofs, spreads) */
    bool may_wait;  /* only the first contact is sought, so that pairs that are apart at first may
                       be left to candidates_more */
    bool in_parts;  /* candidates_frame is asked for frames and missing roots, for some pairs at a
                      time, so that the first pairs are searched before the last are prepared */
} candidate_search;

/* Fills an empty list with the scene's trees; the nodes made for it are added to `stats`. If a
 * limit ends it, the list is empty again and not complete; after that, or a failure, it may be
 * filled again. */
imp_code candidates_find(candidate_list *list, imp_scene *scene, const imp_options *options,
                         const candidate_search *search, const candidate_limit *limit,
                         imp_stats *stats, imp_error *error);

/* Returns the number of its pairs, with those that it lacks so far (candidates_more). */
size_t candidates_pairs_in_all(const candidate_list *list);

/* Returns the time up to which the pairs that the list lacks so far are farther apart than twice
 * the query's gamma; INFINITY: it lacks none. */
double candidates_apart_until(const candidate_list *list);

/* Adds the pairs that come near each other next, so that candidates_apart_until is a later time; no
 * more than `until` is of use, which is later. The pairs of two bodies are added together. *done
 * false: a limit came first, and nothing was added. */
imp_code candidates_more(candidate_list *list, imp_scene *scene, const imp_options *options,
                         const candidate_search *search, const candidate_limit *limit, double until,
                         imp_stats *stats, bool *done, imp_error *error);

/* Fills an empty list with `count` pairs of the same two bodies, from `first` on, of a list
 * collected `in_parts`, with the scene's trees in the frames of these pairs. `whole` is only read,
 * possibly by several threads. What it adds to the scene's trees is added to `stats`. */
imp_code candidates_frame(candidate_list *list, const candidate_list *whole, size_t first,
                          size_t count, imp_scene *scene, const imp_options *options,
                          const candidate_search *search, const candidate_limit *limit,
                          imp_stats *stats, imp_error *error);

/* Fills an empty list with `count` pairs of another from `first` on and with its own trees, one for
 * each side on which a surface occurs. `whole` is only read, possibly by several threads. Bytes are
 * added to `stats`. */
imp_code candidates_part(candidate_list *list, const candidate_list *whole, size_t first,
                         size_t count, imp_stats *stats, imp_error *error);

uint64_t candidates_bytes(const candidate_list *list);

void candidates_clear(candidate_list *list);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_MEETING_H
#define TOOLS_SIMULATE_MEETING_H

#include "tools/simulate/mover.h"
#include "tools/simulate/touch.h"

/* When two bodies meet next, with proof
 * =====================================
 * The promise: no two bodies are ever nearer than Gc, gamma_clear, and what is reported as
 * contact is no farther apart than G, gamma. After a contact the two are within G of each other, so
 * that a search with the same numbers would end where it begins. Hence a ladder of levels between
 * Gc and G:
 *
 *     h_k = (G - Gc) / 2^k,   gamma_k = Gc + h_k,   clear_k = Gc + 3/4 h_k
 *
 * A search at level k looks for gaps up to gamma_k and proves that no gap is below clear_k >= Gc.
 * So whatever the levels, searches that cover all times prove the promise. Lemma: when a search at
 * level k ends with a contact at t, the bodies are at least clear_k apart then (they were at all
 * times before, and move continuously), and clear_k = Gc + 3/2 h_(k+1) is above gamma_(k+1): the
 * next search, from t on at level k + 1, begins with no contact, and has h_(k+1) / 4 to prove it
 * with. Whether a level may begin at some time is itself asked of the library, for that moment
 * alone, so it rests on no memory: `meeting_level`.
 *
 * Once the bodies have parted by more than G, the search goes on at level 0: at the middle of the
 * time until the contact at level k, if they are apart enough then. Up to there the search at level
 * k has proved its gamma_clear, from there on that of level 0 has.
 *
 * Level LEVEL_LASTING is reached by bodies that met so often without parting by more than G.
 * LEVEL_MAX is the end: the margin clear_k - Gc, which also covers what rounding does to a
 * trajectory when it is cut at an event, is then (G - Gc) / 2^20. */

enum { LEVEL_LASTING = 8, LEVEL_MAX = 20, LEVEL_NONE = LEVEL_MAX + 1 };

enum { MEETING_PLACES = 3 };

typedef enum meeting_kind {
    MEETING_NEVER,    /* not before the end */
    MEETING_CONTACT,  /* at t */
    MEETING_OPEN,     /* not before t; how it goes on is not searched yet */
    MEETING_UNDECIDED /* a budget ended the search: clear until t */
} meeting_kind;

typedef struct meeting {
    size_t body[2];   /* of the setup; the first is lower */
    imp_scene *scene; /* the two as they move from now on; NULL: to be made */
    meeting_kind kind;
    imp_reason reason; /* of UNDECIDED */
    double t;
    double window; /* of OPEN: how long a time is searched next */
    int level;
    imp_side side[2];               /* of the contact; their bodies are 0 and 1 */
    bool stale;                     /* a body has another path */
    witness places[MEETING_PLACES]; /* where the two touched last, the latest first */
    size_t place_count;
} meeting;

/* What all searches share: limits, and what has been spent. */
typedef struct searching {
    const setup *setup;
    const mover *movers; /* by body; those that move */
    double end;
    double window; /* time for which a path may last where bodies touch, about */
    limits limits;
    uint64_t searches;
    imp_error error;
} searching;

/* Makes the scene, unless it is made and not stale. Codes of the library; `error` says more. */
imp_code meeting_make_scene(searching *s, meeting *m);

/* The least level, from `least` on, at which a search may begin at t; LEVEL_NONE: the bodies are
 * nearer than all of them. *now: CONTACT with the two sides if the bodies are within the gap of a
 * level tried, UNDECIDED if a budget ended it, and then *level says nothing. The scene is made. */
imp_code meeting_level(searching *s, const meeting *m, double t, int least, int *level,
                       meeting *now);

/* Searches for the next meeting from t on, at that level. Bodies that have touched may move along
 * each other, which is hard to search over a long time, and soon change their paths: for them the
 * search covers a first window in time and leaves the meeting open. The scene is made. */
imp_code meeting_find(searching *s, meeting *m, double t, int level);

/* Searches the next window of an open meeting, at a lower level if the bodies have parted. */
imp_code meeting_continue(searching *s, meeting *m);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_ALLOWANCE_H
#define TOOLS_VIEW_ALLOWANCE_H

#include <impinge/impinge.h>

#include "tools/cli/message.h"

/* What a picture may cost
 * =======================
 * --max-seconds and --max-bytes hold for a whole verb: reading, searching, drawing and writing.
 * Time is counted from allowance_begin. The search may take half of it, the nearest approach a
 * quarter, and triangles are refined until a tenth is left for drawing, so that a picture comes out
 * coarser before none comes out. Memory is what the process has come to hold. Whoever makes or
 * draws many things asks allowance_check now and then; a signal that interrupts ends the work in
 * the same way. */

typedef struct allowance {
    double seconds;            /* 0: no limit */
    uint64_t bytes;            /* 0: no limit */
    double begun;              /* clock */
    uint64_t held;             /* bytes held when it began */
    double next;               /* clock: when memory is looked at next */
    bool (*interrupted)(void); /* whether a signal came; NULL: none is heard */
    bool heard;                /* a signal ended the search, and the drawing goes on all the same */
    const char *what;          /* what was being made when a limit was reached; NULL: none was */
} allowance;

void allowance_begin(allowance *l, double seconds, uint64_t bytes);

/* Between search and drawing: a signal that came before ends the search alone. */
void allowance_begin_drawing(allowance *l);

/* Seconds of the share (0 to 1) of all that is not spent yet; at least a little, since 0 would be
 * no limit; 0 without a limit. */
double allowance_left(const allowance *l, double share);

/* Whether to refine no further. */
bool allowance_is_near(const allowance *l);

/* IMP_SUCCESS while there is time and memory; then an error that says while what was made which
 * limit was reached. `l` may be NULL: no limits. */
imp_code allowance_check(allowance *l, const char *what, imp_error *error);

/* allowance_check, where so many bytes are about to be held. */
imp_code allowance_check_bytes(allowance *l, size_t bytes, const char *what, imp_error *error);

/* Whether an error came from allowance_check; what the verb then answers is EXIT_UNDECIDED. */
bool allowance_ended(const allowance *l);

/* While a scene is read, which nothing interrupts, an alarm ends the program with the message and
 * EXIT_UNDECIDED when its time is over. */
void allowance_watch_reading(const allowance *l, const char *verb);
void allowance_unwatch_reading(void);

#endif

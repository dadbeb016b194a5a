/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_ALLOWANCE_H
#define TOOLS_VIEW_ALLOWANCE_H

#include <impinge/impinge.h>

#include "tools/cli/message.h"

/* Limits of time and memory for a picture
 * =======================================
 * --max-seconds and --max-bytes hold for a whole verb: reading, searching, drawing and writing.
 * Time is counted from allowance_begin. The search may take half of it, the nearest approach a
 * quarter, and triangles are refined until a tenth is left for drawing, so that a picture gets
 * coarser before there is none. Memory is that of the whole process. Loops that make or draw many
 * things call allowance_check now and then; a signal that interrupts ends the work in the same
 * way. */

typedef struct allowance {
    double seconds;            /* 0: no limit */
    uint64_t bytes;            /* 0: no limit */
    double begun;              /* clock */
    uint64_t held;             /* bytes held when it began */
    double next;               /* clock: when memory is looked at next */
    bool (*interrupted)(void); /* whether a signal came; NULL: none is heard */
    bool heard;                /* a signal ended the search; drawing continues */
    const char *what;          /* the work during which a limit was reached; NULL: none was */
} allowance;

void allowance_begin(allowance *l, double seconds, uint64_t bytes);

/* Call it between search and drawing: a signal before this ends only the search. */
void allowance_begin_drawing(allowance *l);

/* Seconds of the share (0 to 1) of all that is not spent yet; at least a little, since 0 would be
 * no limit; 0 without a limit. */
double allowance_left(const allowance *l, double share);

/* Returns whether to refine no further. */
bool allowance_is_near(const allowance *l);

/* Returns IMP_SUCCESS while there is time and memory; then an error that names the limit and the
 * work, `what`. `l` may be NULL: no limits. */
imp_code allowance_check(allowance *l, const char *what, imp_error *error);

/* Like allowance_check, before this many bytes are allocated. */
imp_code allowance_check_bytes(allowance *l, size_t bytes, const char *what, imp_error *error);

/* Returns whether allowance_check returned an error; the verb's status is then EXIT_UNDECIDED. */
bool allowance_ended(const allowance *l);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_PROGRESS_H
#define TOOLS_CLI_PROGRESS_H

#include <impinge/impinge.h>

/* How far a long answer has come, on standard error
 * =================================================
 * For people: one line that is written over, from the command's second second on, where standard
 * error is a terminal. For programs (--progress=json): one JSON object a line, the first at once,
 * then at most two a second, and the last count at the end. Functions that show may be called by
 * any thread. */

typedef enum progress_mode { PROGRESS_AUTO, PROGRESS_JSON, PROGRESS_NONE } progress_mode;

/* The command begins now; AUTO until something else is chosen. */
void progress_begin(void);

/* Seconds of the clock since then. */
double progress_seconds(void);
void progress_choose(progress_mode mode);

/* Whether anything may be shown at all. */
bool progress_is_wanted(void);

/* Any text; for people alone. */
void progress_show(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* One search: pairs tested and waiting, and what is proved or found so far. Nothing while answers
 * are counted. */
void progress_search(const imp_progress *progress);

/* Answers are counted from now on; `done` of them were there before. total 0: unknown. `noun` is
 * kept. */
void progress_count_from(uint64_t done, uint64_t total, const char *noun);
void progress_count(uint64_t done);

/* Takes the line away, so that what comes stands at its own beginning. */
void progress_wipe(void);

/* Takes the line away at the command's end. */
void progress_end(void);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_PROGRESS_H
#define TOOLS_CLI_PROGRESS_H

#include <impinge/impinge.h>

/* Progress of a long command, on standard error
 * =============================================
 * For people: one line that is overwritten, after the first second, if standard error is a
 * terminal. For programs (--progress=json): one JSON object a line, the first at once, then at most
 * two a second, and the last count at the end. Functions that show may be called by any thread. */

typedef enum progress_mode { PROGRESS_AUTO, PROGRESS_JSON, PROGRESS_NONE } progress_mode;

/* Starts the clock; the mode is AUTO until another is chosen. */
void progress_begin(void);

/* Seconds of the clock since then. */
double progress_seconds(void);
void progress_choose(progress_mode mode);

/* Whether anything may be shown at all. */
bool progress_is_wanted(void);

/* Shows any text, to people only. */
void progress_show(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Shows one search: pairs tested and on the heap, and the bounds so far. It shows nothing while
 * answers are counted. */
void progress_search(const imp_progress *progress);

/* Answers are counted from now on; `done` of them were there before. total 0: unknown. `noun` is
 * kept. */
void progress_count_from(uint64_t done, uint64_t total, const char *noun);
void progress_count(uint64_t done);

/* Erases the line, so that other output begins on an empty line. */
void progress_wipe(void);

/* Takes the line away at the command's end. */
void progress_end(void);

#endif

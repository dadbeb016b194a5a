/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BATCH_H
#define TOOLS_CLI_BATCH_H

#include "tools/cli/batch_resume.h"

/* A batch: a stream of scenes, one a line, and of answers, one a line, in the same order
 * ======================================================================================
 * A line that cannot be answered is answered by its error; the rest goes on. Lines are read by one
 * thread and answered by any. Who owns the batch decides where answers go: verb_batch.c to standard
 * output, from a pool of threads; tools/mpi to a file, from many processes. */

enum { BATCH_ITEMS_PER_THREAD = 16 }; /* under way: a slow line leaves no other thread idle */

typedef struct batch {
    const arguments *args;
    imp_registry *registry;
    FILE *file;
    const char *name; /* of the input, for messages */
    size_t line;      /* number of the last line read, from 1 */
    size_t scenes;    /* lines that are not blank, read so far */
    bool input_failed;
    batch_shard shard;
    batch_resume resume;
    uint64_t passed_over; /* so many scenes of ours have answers that somebody else looks at */
    size_t failures;      /* lines answered by an error */
    size_t answered;      /* number of the last line answered */
    uint64_t done;        /* scenes answered, by earlier runs too */
    exit_status worst;
    bool over; /* nothing more is printed */
} batch;

/* One line under way; begins as zeros. */
typedef struct batch_item {
    input_text text;
    size_t line;
    char *answer;       /* a line of JSON; NULL: none, or no memory */
    exit_status status; /* what the answer stands for */
    bool failed, interrupted;
} batch_item;

/* Checks what is asked and opens the input; then, when the output is there, the plugins. Complains.
 * batch_end in any case. */
exit_status batch_begin(batch *b, const arguments *args);
exit_status batch_prepare(batch *b);
void batch_end(batch *b);

/* How many scenes of the input are ours; 0: unknown, or nobody is to be told. */
uint64_t batch_scene_count(const batch *b);

/* Reads on to the next scene of ours that has no answer yet. False: there is none, the input cannot
 * be read, the output that is resumed does not fit it, or a signal came. */
bool batch_next_line(batch *b, batch_item *item);

/* Solves the line. [any thread] */
void batch_answer(const batch *b, batch_item *item);

/* An answer that has come to its place in the output. */
void batch_count(batch *b, const batch_item *item);

void batch_keep_worst(batch *b, exit_status status);

/* Complains of what was not as it should be. */
void batch_sum_up(batch *b);

#endif

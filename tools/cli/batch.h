/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BATCH_H
#define TOOLS_CLI_BATCH_H

#include "tools/cli/batch_resume.h"

/* A batch: a stream of scenes, one a line, and of answers, one a line, in the same order
 * ======================================================================================
 * The result of a scene that cannot be solved is its error; the batch continues. One thread reads
 * the lines, any thread solves them. The owner of the batch writes the results: verb_batch.c to
 * standard output, from a pool of threads; tools/mpi to a file, from many processes. */

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
    uint64_t passed_over; /* number of our scenes whose results the caller checks itself */
    size_t failures;      /* number of lines whose result is an error */
    size_t answered;      /* number of the last line that has its result */
    uint64_t done;        /* number of results, including those of earlier runs */
    exit_status worst;
    bool over; /* nothing more is printed */
} batch;

/* One line that is being solved; begins as zeros. */
typedef struct batch_item {
    input_text text;
    size_t line;
    char *answer;       /* a line of JSON; NULL: none, or no memory */
    exit_status status; /* exit status of the result */
    bool failed, interrupted;
} batch_item;

/* Check the options and open the input; then, once the output is open, load the plugins. They
 * complain. Call batch_end in any case. */
exit_status batch_begin(batch *b, const arguments *args);
exit_status batch_prepare(batch *b);
void batch_end(batch *b);

/* Returns how many scenes of the input are ours, for progress; 0: unknown or not needed. */
uint64_t batch_scene_count(const batch *b);

/* Reads up to the next scene of ours that has no result yet. False: there is none, the input cannot
 * be read, the output that is resumed does not match it, or a signal came. */
bool batch_next_line(batch *b, batch_item *item);

/* Solves the line. [any thread] */
void batch_answer(const batch *b, batch_item *item);

/* Counts a result once it is written. */
void batch_count(batch *b, const batch_item *item);

void batch_keep_worst(batch *b, exit_status status);

/* Reports what went wrong in the whole batch. */
void batch_sum_up(batch *b);

#endif

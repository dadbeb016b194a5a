/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_RUN_H
#define TOOLS_VERIFY_RUN_H

#include "tools/verify/rewrite.h"

/* Proving a file by one process or several */

enum { THREADS_MAX = 256 };

typedef struct request {
    const char *path, *scene, *plugin_path;
    const char *output; /* of --tighten, --coq or --elaborate; NULL: none */
    bool is_coq, is_elaborate;
    unsigned long goals, seed;
    unsigned threads;
    unsigned long effort;
    bool text, quiet;
    rewrite *rewrite; /* NULL: nothing is written */
} request;

/* What one process has found; sent through a pipe. */
typedef struct outcome {
    bool refused;
    uint64_t at, bytes, leaves, pairs, tests;
    char text[1400];    /* why it is refused */
    char assumed[1000]; /* names of types */
} outcome;

/* Tells on a terminal that standard error is how many bytes have been read. */
typedef void run_progress(uint64_t bytes);
run_progress *run_progress_of(const request *asked); /* NULL: it is no terminal, or --quiet */
void run_progress_end(run_progress *progress);

/* Proves what is read, or the share of it that is process number `share`'s. */
void run_verify(const request *asked, input *in, statement *s, unsigned share, outcome *found);

/* Proves the whole file. False: it cannot be opened, and errno says why. */
bool run_all(const request *asked, statement *s, outcome *all);

#endif

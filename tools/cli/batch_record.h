/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BATCH_RECORD_H
#define TOOLS_CLI_BATCH_RECORD_H

#include "core/common/sha256.h"
#include "tools/cli/arguments.h"

/* OUT.options: what the answers in OUT were asked with
 * ====================================================
 * One line of JSON in a file beside the output of `batch --resume OUT`: the options that change
 * results, such as --gamma, not limits, threads and the like; and the SHA-256 of the first scene,
 * which tells another input whose scenes have no ids. It is locked while OUT is written, so
 * that of two runs on one output the second is refused. OUT itself cannot be: an MPI library opens
 * and closes it, which would end the lock. */

typedef struct batch_record {
    int descriptor; /* -1: none */
    char *path;
    bool is_known;           /* it has the options of earlier results */
    char scene[SHA256_TEXT]; /* hash of the first scene; "": not known */
} batch_record;

/* Opens and locks the record of the output `out`. Complains, and returns the status, if another
 * process has it, or the results were made with other options. Call batch_record_close in any
 * case. */
exit_status batch_record_open(batch_record *record, const char *out, const arguments *args);

/* Writes it, unless it is known. */
exit_status batch_record_write(batch_record *record, const arguments *args);

/* Unlocks it, and removes it where nothing was written. */
void batch_record_close(batch_record *record);

#endif

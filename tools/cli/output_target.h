/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_OUTPUT_TARGET_H
#define TOOLS_CLI_OUTPUT_TARGET_H

#include <stdbool.h>
#include <sys/stat.h>

/* What the name of an output leads to
 * ===================================
 * Symbolic links are followed, the last one too, even where it leads to a file that does not exist
 * yet: the link stays, and the file it names is written. */

typedef enum output_kind {
    OUTPUT_STANDARD,   /* "-", /dev/stdout, /dev/fd/1: our standard output */
    OUTPUT_DESCRIPTOR, /* /dev/stderr, /dev/fd/N: descriptor `number`, if the caller has it open */
    OUTPUT_STREAM,     /* a device, a pipe, or an open file without a name */
    OUTPUT_NEW,        /* no file is there */
    OUTPUT_FILE,       /* a regular file, described by `there` */
    OUTPUT_REFUSED     /* errno says why */
} output_kind;

typedef struct output_target {
    output_kind kind;
    int number;
    char *path; /* of NEW and FILE, links followed; the caller frees it; NULL for the others */
    struct stat there;
} output_target;

output_target output_target_of(const char *path);

/* Whether the name leads to standard output. */
bool output_is_standard(const char *path);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_REWRITE_H
#define TOOLS_VERIFY_REWRITE_H

#include "tools/cli/output_file.h"
#include "tools/verify/tighten.h"

/* A file that is written while a certificate is proved
 * ====================================================
 * It is written to a temporary file first, and put in its place only if the certificate holds. */

typedef struct rewrite {
    const char *path;    /* of the output; NULL: nothing is written */
    FILE *draft;         /* what is written meanwhile */
    output_file out;     /* locked meanwhile */
    tightening *tighten; /* made by rewrite_watch */
    uint64_t leaves;     /* written */
    long size;           /* bytes written */
} rewrite;

/* Opens the output. False: it cannot be written, or is the certificate itself; complained of. */
bool rewrite_begin(rewrite *r, const char *path, const char *certificate);

/* Has the walk, whose input nothing has been read of, write. False: the input tells why. */
bool rewrite_watch(rewrite *r, walk *w);

/* Ends what is written, from the beginning of which the draft can be read then. */
bool rewrite_end(rewrite *r);

/* Puts the file in its place if `keep`; else nothing is left of it. */
bool rewrite_finish(rewrite *r, bool keep);

#endif

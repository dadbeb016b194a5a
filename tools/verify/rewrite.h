/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_REWRITE_H
#define TOOLS_VERIFY_REWRITE_H

#include "tools/cli/output_file.h"
#include "tools/verify/coq.h"
#include "tools/verify/tighten.h"

/* A file that is written while a certificate is proved
 * ====================================================
 * It is written to a temporary file first, and put in its place only if the certificate holds. */

typedef struct rewrite {
    const char *path;    /* of the output; NULL: nothing is written */
    FILE *draft;         /* what is written meanwhile */
    output_file out;     /* locked meanwhile */
    bool is_coq;         /* goals for Coq; else a shorter certificate */
    size_t goals;        /* of these, */
    uint64_t seed;       /* drawn with this */
    tightening *tighten; /* made by rewrite_watch */
    coq *coq;            /* or this */
    uint64_t leaves;     /* written */
    uint64_t known;      /* leaves that Coq can be told */
    long size;           /* bytes written */
    bool is_ended;       /* by rewrite_end: the draft is whole */
} rewrite;

/* Opens the output. False: it cannot be written, or is the certificate itself; complained of. */
bool rewrite_begin(rewrite *r, const char *path, const char *certificate);

/* Has the walk, whose input nothing has been read of, write. False: the input tells why. */
bool rewrite_watch(rewrite *r, walk *w);

/* Ends what is written while the statement is still there; the draft can be read then. False:
 * complained of. */
bool rewrite_end(rewrite *r);

/* Puts the file in its place if `keep`; else nothing is left of it. */
bool rewrite_finish(rewrite *r, bool keep);

#endif

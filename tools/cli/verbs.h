/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_VERBS_H
#define TOOLS_CLI_VERBS_H

#include "tools/cli/arguments.h"

/* The verbs of the command: one file each (verb_NAME.c), one row each in verbs.c. */

typedef struct verb {
    const char *name;
    const char *operands; /* as in the usage line; "" if none */
    const char *summary;  /* one line */
    const char *details;  /* paragraphs for `impinge help VERB`, each line ended */
    const char *example;  /* a complete command line that works */
    size_t operand_min, operand_max;
    uint64_t max_pairs;           /* limit of a query without --max-pairs; 0: none */
    const option *const *options; /* tables, NULL-terminated */
    exit_status (*run)(const arguments *args);
    bool is_hidden; /* for programs alone: `impinge help` does not list it */
    /* Word `index` that an operand may be, or NULL past the last; NULL: there are no such words. */
    const char *(*operand_word)(size_t index);
} verb;

/* Returns all verbs in the order of help, NULL-terminated. */
const verb *const *verbs_all(void);

/* Returns the verb of that name, or NULL. */
const verb *verb_find(const char *name);

/* Complains about a verb there is not, with the nearest there is. */
exit_status verb_unknown(const char *speaker, const char *name);

/* Print `impinge help` and `impinge help VERB` to standard output. */
void help_overview(void);
void help_verb(const verb *v);

#endif

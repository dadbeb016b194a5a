/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_EXPLAIN_H
#define TOOLS_CLI_EXPLAIN_H

#include <impinge/examine.h>
#include <jansson.h>

/* Where the pairs of a search went, and what would help
 * ===================================================== */

/* What a query asks for, which decides what else would help. */
typedef enum explain_goal {
    EXPLAIN_CONTACT,
    EXPLAIN_DISTANCE,   /* a bracket */
    EXPLAIN_REQUIREMENT /* a verdict about a distance */
} explain_goal;

/* What is explained. */
typedef struct explain_asked {
    const imp_scene *scene; /* of the query */
    imp_reason why;         /* the reason of its answer */
    explain_goal goal;
    double reached; /* the tolerance that a bracket meets so far; NAN: none, or not of a bracket */
} explain_asked;

explain_asked explain_asked_of_contact(const imp_scene *scene, const imp_result *result);
explain_asked explain_asked_of_clearance(const imp_scene *scene, const imp_clearance *answer);

enum { EXPLAIN_ADVICE_BYTES = 512 };

typedef struct explanation {
    imp_explanation *row; /* surfaces whose pairs were divided, those with most first */
    size_t count;
    bool is_counted;                   /* of the whole search; else of pairs that wait */
    char advice[EXPLAIN_ADVICE_BYTES]; /* one sentence; empty: nothing is known to help */
} explanation;                         /* explain_free frees */

/* Reads a query's counts. False: no memory. */
bool explain_query(const imp_query *query, const explain_asked *asked, explanation *e);
void explain_free(explanation *e);

/* Returns the advice about a query, which the caller frees; NULL: there is none, or no memory. [any
 * thread] */
char *explain_advice(const imp_query *query, const explain_asked *asked);

/* Prints the table, then the advice, each with a label. Without counts there is no table. */
void explain_print(const imp_scene *scene, const explanation *e);

/* Adds "advice" and, of what was counted, "explanation". False: no memory. */
bool explain_set_json(json_t *object, const imp_scene *scene, const explanation *e);

#endif

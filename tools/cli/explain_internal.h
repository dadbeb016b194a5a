/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_EXPLAIN_INTERNAL_H
#define TOOLS_CLI_EXPLAIN_INTERNAL_H

#include "tools/cli/explain.h"

/* What the obstacles have in common: which side's, and of which kind. */
typedef enum explain_cause {
    CAUSE_REMAINDER,
    CAUSE_TIME,
    CAUSE_BOUNDS,
    CAUSE_DISTANCE,
    CAUSE_RESOLUTION,
    CAUSE_SIZE
} explain_cause;

typedef struct explain_kind {
    explain_cause cause;
    int side;
    const char *name, *text; /* of --json; for people, followed by the surface's type */
} explain_kind;

extern const explain_kind explain_kinds[IMP_OBSTACLES];

/* Writes e->advice; the rows are sorted. */
void explain_advise(const explain_asked *asked, explanation *e);

#endif

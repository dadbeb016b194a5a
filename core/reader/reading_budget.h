/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_READING_BUDGET_H
#define CORE_READER_READING_BUDGET_H

#include "core/base/place.h"
#include "core/plugin/registry.h"

/* What making one scene may take
 * ==============================
 * Time and memory of one scene that is made of text, within the limits of its registry
 * (imp_registry_limit_reading). Bytes are those of the text, of the values parsed from it, and of
 * the instances made so far; what create holds is added while it runs. */
typedef struct reading_budget {
    reading_limits limits;
    double start;   /* on the clock of the thread */
    uint64_t bytes; /* held so far */
    reading_end end;
} reading_budget;

reading_budget reading_budget_begin(const imp_registry *registry);

/* Whether it goes on with `more` bytes; else notes the limit. NULL: no limits. */
bool reading_budget_allows(reading_budget *b, uint64_t more);

/* Counts bytes that the scene keeps; NULL: no limits. */
void reading_budget_take(reading_budget *b, uint64_t bytes);

/* Returns what is left of the limits, for another process. NULL: no limits. */
reading_limits reading_budget_rest(const reading_budget *b);

/* Whether a limit was reached. */
bool reading_budget_is_over(const reading_budget *b);

/* Fills the error with the limit that was reached, and returns IMP_ERROR_LIMIT. */
imp_code reading_budget_refuse(const reading_budget *b, const place *at, imp_error *error);

#endif

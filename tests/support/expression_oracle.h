/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_EXPRESSION_ORACLE_H
#define TESTS_SUPPORT_EXPRESSION_ORACLE_H

#include "tests/support/oracle_number.h"

/* The language of formulas once more, in another way: two stacks instead of a grammar, numbers of
 * 200 bits instead of models, evaluated while reading. Only for texts that are right; aborts at
 * others. */

/* What the names mean, beside pi and e. */
typedef struct oracle_names {
    size_t count;
    const char *const *name;
    const number *value;
} oracle_names;

/* Not bounded (num_is_bounded): undefined, or too near to where it is. */
number expression_oracle(const char *text, const oracle_names *names);

#endif

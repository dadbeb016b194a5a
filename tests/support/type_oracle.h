/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_TYPE_ORACLE_H
#define TESTS_SUPPORT_TYPE_ORACLE_H

#include "core/plugin/parameters.h"
#include "tests/support/oracle_number.h"

/* What every type should be
 * =========================
 * One row per type: the formula once more, written for these tests in numbers of 200 bits, and
 * instances to try it on. test_plugins.c does the rest. */

/* The parameters of an instance, by name. */
typedef struct type_arguments {
    parameter_table table;
    const imp_value *value;
} type_arguments;

const imp_value *argument(const type_arguments *arguments, const char *name);

/* Number `index` of a parameter that is there. */
number argument_at(const type_arguments *arguments, const char *name, size_t index);

typedef struct type_oracle {
    const char *type;

    /* The surface at p = (u, v, t), or the map at p = (x, y, z, t). One is NULL. */
    void (*surface)(const type_arguments *arguments, const number p[3], number x[3]);
    void (*map)(const type_arguments *arguments, const number p[4], number x[3]);

    /* Parameters as JSON, in which a number may stand as '?' (drawn from [-1, 1]) or as '+' (drawn
     * from [1/4, 4]), and @5[...] for five arrays like it, with commas. NULL ends the list. */
    const char *instances[14];
} type_oracle;

extern const type_oracle oracles[];
extern const size_t oracle_count;

#endif

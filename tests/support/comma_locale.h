/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_COMMA_LOCALE_H
#define TESTS_SUPPORT_COMMA_LOCALE_H

#include <locale.h>
#include <stdbool.h>

#include "tests/support/sandbox.h"

/* A locale in which 0.5 is written "0,5", in a sandbox: most machines have none of their own. */

#define COMMA_LOCALE "comma_XX"

/* Makes it, for setlocale. False: that cannot be done here. */
static inline bool comma_locale_make(const sandbox *box)
{
    const char *top = getenv("top_srcdir");
    char command[1200];
    snprintf(command, sizeof command, "'%s/tests/support/comma_locale' '%s'",
             top != NULL ? top : ".", box->path);
    setenv("LOCPATH", box->path, 1);
    return system(command) == 0;
}

/* Whether it can; also outside of tests. */
static inline bool comma_locale_can(void)
{
    return system("folder=$(mktemp -d) && { \"${top_srcdir:-.}\"/tests/support/comma_locale "
                  "\"$folder\";"
                  " made=$?; rm -r \"$folder\"; exit $made; }") == 0;
}

static inline void comma_locale_remove(const sandbox *box)
{
    char command[700];
    setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
    snprintf(command, sizeof command, "rm -r '%s'", box->path);
    ck_assert_int_eq(system(command), 0);
}

#endif

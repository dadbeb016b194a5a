/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_C_LOCALE_H
#define CORE_COMMON_C_LOCALE_H

#include <locale.h>

/* The C locale for this thread, for a while
 * =========================================
 * A program may have chosen a locale in which 0.5 is written "0,5". Numbers in our texts have a
 * point, and so have those that we read. The C locale needs no memory in glibc and musl; where
 * another library finds none, the locale stays as it is. */

typedef struct c_locale {
    locale_t own, callers;
} c_locale;

static inline c_locale c_locale_enter(void)
{
    const locale_t own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return (c_locale){own, own != (locale_t)0 ? uselocale(own) : (locale_t)0};
}

static inline void c_locale_leave(const c_locale *entered)
{
    if (entered->own == (locale_t)0) return;
    uselocale(entered->callers);
    freelocale(entered->own);
}

#endif

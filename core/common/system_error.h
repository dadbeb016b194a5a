/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_SYSTEM_ERROR_H
#define CORE_COMMON_SYSTEM_ERROR_H

#include <errno.h>
#include <string.h>

/* Like strerror, with the cure if the error is a limit of the process or the system. */
static inline const char *system_error_text(int number)
{
    switch (number) {
    case EMFILE:
        return "the limit on open files of this process is reached; raise it (ulimit -n)";
    case ENFILE:
        return "the limit on open files of the whole system is reached";
    default:
        return strerror(number);
    }
}

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "check_answer.h"

#include <stdarg.h>
#include <stdio.h>

static void write_text(check_answer *answer, check_verdict verdict, const char *format,
                       va_list list)
{
    answer->verdict = verdict;
    vsnprintf(answer->text, sizeof answer->text, format, list);
}

void answer_pass(check_answer *answer, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (answer->verdict != CHECK_FAIL) write_text(answer, CHECK_PASS, format, list);
    va_end(list);
}

void answer_skip(check_answer *answer, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (answer->verdict != CHECK_FAIL) write_text(answer, CHECK_SKIP, format, list);
    va_end(list);
}

bool answer_fail(check_answer *answer, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (answer->verdict != CHECK_FAIL) write_text(answer, CHECK_FAIL, format, list);
    va_end(list);
    return false;
}

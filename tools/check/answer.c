/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/answer.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

__attribute__((format(printf, 3, 0))) static void
write_text(check_answer *answer, check_verdict verdict, const char *format, va_list list)
{
    answer->verdict = verdict;
    vsnprintf(answer->text, sizeof answer->text, format, list);
}

void answer_prefix(check_answer *answer, const char *words)
{
    char text[sizeof answer->text];
    memcpy(text, answer->text, sizeof text);
    snprintf(answer->text, sizeof answer->text, "%.200s: %.1390s", words, text);
}

void answer_pass(check_answer *answer, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (answer->verdict != CHECK_FAIL && answer->verdict != CHECK_NOTE)
        write_text(answer, CHECK_PASS, format, list);
    va_end(list);
}

void answer_skip(check_answer *answer, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (answer->verdict != CHECK_FAIL) write_text(answer, CHECK_SKIP, format, list);
    va_end(list);
}

void answer_note(check_answer *answer, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    if (answer->verdict != CHECK_FAIL) write_text(answer, CHECK_NOTE, format, list);
    va_end(list);
}

__attribute__((format(printf, 3, 0))) static bool
write_failure(check_answer *answer, unsigned faults, const char *format, va_list list)
{
    if (answer->verdict == CHECK_FAIL) return false;
    write_text(answer, CHECK_FAIL, format, list);
    answer->faults = faults;
    return false;
}

bool answer_fail(check_answer *answer, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    write_failure(answer, 0, format, list);
    va_end(list);
    return false;
}

bool answer_fail_for(check_answer *answer, unsigned faults, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    write_failure(answer, faults, format, list);
    va_end(list);
    return false;
}

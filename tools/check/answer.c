/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/answer.h"

#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

__attribute__((format(printf, 3, 0))) static void
write_text(check_answer *answer, check_verdict verdict, const char *format, va_list list)
{
    answer->verdict = verdict;
    vsnprintf(answer->text, sizeof answer->text, format, list);
}

void answer_forget(check_answer *answer)
{
    answer->verdict = CHECK_PASS;
    answer->text[0] = '\0';
    answer->faults = 0;
    answer->blamed = 0;
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
    if (answer->blamed == 0) {
        const unsigned of_claims = FAULT_RATE | FAULT_RANGE | FAULT_REMAINDER | FAULT_ERROR;
        const bool is_claim = (faults & of_claims) != 0 && (faults & FAULT_VALUE) == 0;
        answer->blamed = is_claim && answer->claim_call > 0 ? answer->claim_call : answer->calls;
    }
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

/* --- Calls ------------------------------------------------------------------------------------ */

/* A process that is traced has a tracer other than 0. */
static bool is_traced(void)
{
    char line[200];
    int tracer = 0;
    FILE *status = fopen("/proc/self/status", "r");
    while (status != NULL && tracer == 0 && fgets(line, sizeof line, status) != NULL)
        sscanf(line, "TracerPid: %d", &tracer);
    if (status != NULL) fclose(status);
    return tracer != 0;
}

void answer_count_call(check_answer *answer)
{
    const char *name = answer->call.name;
    ++answer->calls;
    if (strcmp(name, "eval") != 0) answer->claim_call = answer->calls;
    if (strcmp(name, "rate") == 0) answer->rate_call = answer->calls;
    if (answer->calls != answer->stop_at) return;
    fprintf(stderr, "call %llu comes next, of %s\n", (unsigned long long)answer->calls, name);
    if (is_traced()) raise(SIGTRAP);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/reading_limit.h"

#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <time.h>

#include "core/common/json_size.h"
#include "tools/cli/crash.h"
#include "tools/cli/verbs.h"

/* The alarm of a thread. Other threads' handlers read it once it is over. */
typedef struct alarm_of_thread {
    timer_t timer;
    atomic_bool is_set;
    char message[384]; /* what the handler says */
} alarm_of_thread;

static _Thread_local alarm_of_thread own;

static void end_reading(int number, siginfo_t *info, void *context)
{
    (void)number, (void)context;
    const alarm_of_thread *a = info->si_value.sival_ptr;
    if (info->si_code == SI_TIMER && atomic_load(&a->is_set))
        crash_end_with(a->message, EXIT_UNDECIDED);
}

/* Without a timer reading ends at the limit where types ask for it (imp_goes_on). */
static void set_alarm(double seconds)
{
    struct sigevent event = {
        .sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGPROF, .sigev_value = {.sival_ptr = &own}};
    const struct itimerspec when = {
        .it_value = {(time_t)floor(seconds), (long)(1e9 * (seconds - floor(seconds)))}};
    const struct sigaction action = {.sa_sigaction = end_reading,
                                     .sa_flags = SA_SIGINFO | SA_RESTART | SA_ONSTACK};
    sigaction(SIGPROF, &action, NULL);
    if (timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &own.timer) != 0) return;
    atomic_store(&own.is_set, true);
    timer_settime(own.timer, 0, &when, NULL);
}

enum { LONGEST = 1000000000 }; /* seconds; longer limits are none */

static double limit_of(const arguments *args)
{
    const double limit = arguments_number(args, "max-seconds", 0);
    return limit > 0 && limit < LONGEST ? limit : 0;
}

void reading_limit_begin(const arguments *args, const char *scene)
{
    const double limit = limit_of(args);
    if (limit == 0) return;
    snprintf(own.message, sizeof own.message,
             "%s: --max-seconds %g was over while %.150s was read; allow more (0: no limit)%s",
             args->verb->name, limit, scene != NULL ? scene : "the scene",
             scene != NULL
                 ? ", or give --isolate, so that a type that takes too long costs its line alone"
                 : "");
    for (char *c = own.message; *c != '\0'; ++c)
        if ((unsigned char)*c < ' ') *c = '?';
    set_alarm(1.1 * limit + 0.2);
}

void reading_limit_end(void)
{
    if (!atomic_exchange(&own.is_set, false)) return;
    timer_delete(own.timer);
}

/* Returns --max-bytes; 0: no limit. */
static uint64_t most_bytes(const arguments *args)
{
    const uint64_t usual = (uint64_t)1 << 30; /* as imp_options_get_default has it */
    return arguments_count(args, "max-bytes", usual);
}

size_t reading_limit_most(const arguments *args)
{
    const uint64_t most = most_bytes(args);
    return most < SIZE_MAX ? (size_t)most : 0;
}

exit_status reading_limit_check(const arguments *args, const input_text *text, unsigned times)
{
    const uint64_t most = most_bytes(args);
    if (most == 0 || times * (text->length + json_size_parsed(text->text, text->length)) <= most)
        return EXIT_ANSWERED;
    return complain(EXIT_UNDECIDED, args->verb->name,
                    "%s: --max-bytes %llu is not enough to read this; allow more (0: no limit)",
                    input_name(args->operands[0]), (unsigned long long)most);
}

imp_code reading_limit_share(const arguments *args, imp_registry *registry, imp_error *error)
{
    const char *attached;
    if (arguments_find(args->verb, "--max-bytes", &attached) == NULL) return IMP_SUCCESS;
    const double seconds = limit_of(args);
    const uint64_t bytes = most_bytes(args), more = bytes / 10;
    return imp_registry_limit_reading(registry, seconds > 0 ? 1.1 * seconds + 0.1 : 0,
                                      bytes < UINT64_MAX - more ? bytes + more : 0, error);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/reading_limit.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <sys/time.h>

#include "tools/cli/crash.h"
#include "tools/cli/verbs.h"

/* What the handler says: there is one alarm in a process. */
static char message[256];

static void end_reading(int signal)
{
    (void)signal;
    crash_end_with(message, EXIT_UNDECIDED);
}

static void set_alarm(double seconds)
{
    const struct itimerval when = {
        .it_value = {(time_t)floor(seconds), (suseconds_t)(1e6 * (seconds - floor(seconds)))}};
    setitimer(ITIMER_PROF, &when, NULL);
}

void reading_limit_begin(const arguments *args)
{
    enum { LONGEST = 1000000000 }; /* seconds; longer limits set no alarm */
    const double limit = arguments_number(args, "max-seconds", 0);
    if (!(limit > 0 && limit < LONGEST)) return;
    snprintf(message, sizeof message,
             "%s: --max-seconds %g was over while the scene was read; allow more (0: no limit)",
             args->verb->name, limit);
    const struct sigaction action = {.sa_handler = end_reading};
    sigaction(SIGPROF, &action, NULL);
    set_alarm(1.1 * limit + 0.2);
}

void reading_limit_end(void) { set_alarm(0); }

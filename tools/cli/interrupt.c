/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/interrupt.h"

#include <signal.h>
#include <stdatomic.h>

#include "tools/cli/crash.h"

/* Global, since a signal handler has no context argument; lock-free. */
static atomic_bool came;

static void on_signal(int number)
{
    signal(number, crash_interrupted);
    atomic_store(&came, true);
}

/* Without SA_RESTART, so that a read that waits for the next scene ends too. */
void interrupt_prepare(void)
{
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_ONSTACK};
    sigemptyset(&action.sa_mask);
    const int numbers[] = {SIGINT, SIGTERM};
    for (int i = 0; i < 2; ++i) {
        struct sigaction before;
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        sigaction(numbers[i], &action, NULL);
    }
}

bool interrupt_came(void) { return atomic_load(&came); }

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "interrupt.h"

#include <signal.h>
#include <stdatomic.h>

/* A signal handler has no arguments of ours: the only two variables of file scope in the command.
 * Atomic and lock-free, so that the handler sees a whole pointer. */
static _Atomic(imp_query *) watched;
static atomic_bool came;

static void on_signal(int number)
{
    (void)number;
    atomic_store(&came, true);
    imp_query *query = atomic_load(&watched);
    if (query != NULL) imp_query_cancel(query);
}

/* No SA_RESTART: a read that waits for the next scene ends too. */
void interrupt_prepare(void)
{
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    const int numbers[] = {SIGINT, SIGTERM};
    for (int i = 0; i < 2; ++i) {
        struct sigaction before;
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        sigaction(numbers[i], &action, NULL);
    }
}

void interrupt_watch(imp_query *query) { atomic_store(&watched, query); }

bool interrupt_came(void) { return atomic_load(&came); }

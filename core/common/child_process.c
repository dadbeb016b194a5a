/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

/* What a terminal, a shell or `kill NAME` sends is the host's business: it ends its children. */
static void reset_signals(void)
{
    static const int ignored[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    sigset_t none;
    sigemptyset(&none);
    for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
    for (size_t k = 0; k < sizeof ignored / sizeof *ignored; ++k) signal(ignored[k], SIG_IGN);
    sigprocmask(SIG_SETMASK, &none, NULL);
}

/* Needs no descriptor beside those that are there: the host may have used up its own. */
static void leave_descriptors(int kept, int errors)
{
    if (errors >= 0 && dup2(errors, STDERR_FILENO) < 0) _exit(1);
    if (kept != CHILD_DESCRIPTOR && dup2(kept, CHILD_DESCRIPTOR) < 0) _exit(1);
    close_range(CHILD_DESCRIPTOR + 1, ~0u, 0);
    close(STDIN_FILENO);
    if (open("/dev/null", O_RDWR) != STDIN_FILENO) _exit(1);
    dup2(STDIN_FILENO, STDOUT_FILENO);
    if (errors < 0) dup2(STDIN_FILENO, STDERR_FILENO);
}

/* Registered last, so run first: nothing else is run, and no stream of the host is flushed. */
static void leave_at_once(int status, void *unused)
{
    (void)unused;
    _exit(status);
}

void child_process_detach(int kept, int errors)
{
    const struct rlimit no_core = {0, 0};
    setpgid(0, 0);
    reset_signals();
    leave_descriptors(kept, errors);
    setrlimit(RLIMIT_CORE, &no_core);
    on_exit(leave_at_once, NULL);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/active_callback.h"
#include "core/common/child_process.h"
#include "core/common/clock.h"
#include "core/plugin/worker.h"
#include "core/surface/surface.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Seconds between looks at whether the worker lives; and beyond the time of all, for a type that
 * stops by itself. */
static const double glance = 0.1, late_slack = 0.05;

/* --- In the new process ----------------------------------------------------------------------- */

/* The kernel sends SIGKILL to the whole group when the other end is closed: unlike a signal at the
 * parent's death (PR_SET_PDEATHSIG) this does not depend on the thread that forked. It may have
 * been closed before. */
static void follow_lifeline(void)
{
    struct pollfd lifeline = {.fd = CHILD_DESCRIPTOR, .events = POLLIN};
    if (fcntl(CHILD_DESCRIPTOR, F_SETOWN, -getpid()) != 0 ||
        fcntl(CHILD_DESCRIPTOR, F_SETSIG, SIGKILL) != 0 ||
        fcntl(CHILD_DESCRIPTOR, F_SETFL, O_ASYNC) != 0 || poll(&lifeline, 1, 0) != 0)
        _exit(1);
}

/* The worker begins as a copy of the host, so the limit counts from what that has mapped. */
static void limit_memory(void)
{
    struct rlimit limit;
    unsigned long pages;
    FILE *in = fopen("/proc/self/statm", "re");
    const int read = in != NULL ? fscanf(in, "%lu", &pages) : 0;
    if (in != NULL) fclose(in);
    if (read != 1 || getrlimit(RLIMIT_AS, &limit) != 0) return;
    const rlim_t wanted = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + WORKER_MEMORY;
    if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= wanted) return;
    limit.rlim_cur = wanted;
    setrlimit(RLIMIT_AS, &limit);
}

_Noreturn static void run(worker_type type, channel *c, int lifeline)
{
    child_process_detach(lifeline, -1);
    follow_lifeline();
    limit_memory();
    worker_serve(c, type);
}

/* --- In the host: start and end --------------------------------------------------------------- */

static channel *channel_new(void)
{
    channel *c = mmap(NULL, sizeof *c, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (c == MAP_FAILED) return NULL;
    sem_init(&c->requested, 1, 0);
    sem_init(&c->replied, 1, 0);
    return c;
}

static void channel_free(channel *c)
{
    sem_destroy(&c->requested);
    sem_destroy(&c->replied);
    munmap(c, sizeof *c);
}

static pid_t fork_worker(worker_type type, channel *c, int *lifeline)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return -1;
    const pid_t process = fork();
    if (process == 0) {
        close(ends[1]);
        run(type, c, ends[0]);
    }
    const int error = errno;
    close(ends[0]);
    if (process < 0) close(ends[1]);
    if (process > 0) setpgid(process, process); /* whoever of the two is first */
    *lifeline = ends[1];
    errno = error;
    return process;
}

worker *worker_start(worker_type type)
{
    worker *w = calloc(1, sizeof *w);
    channel *c = w != NULL ? channel_new() : NULL;
    const pid_t process = c != NULL ? fork_worker(type, c, &w->lifeline) : -1;
    if (process < 0) {
        const int error = errno;
        if (c != NULL) channel_free(c);
        free(w);
        errno = error;
        return NULL;
    }
    w->type = type;
    w->channel = c;
    w->process = process;
    w->owner = getpid();
    pthread_mutex_init(&w->lock, NULL);
    return w;
}

/* What has become of the process: end->si_pid is 0 while nothing has. False: it is not ours any
 * more, since the host has its children reaped by someone else. */
static bool find_end(const worker *w, int states, siginfo_t *end)
{
    *end = (siginfo_t){.si_pid = 0};
    return waitid(P_PID, (id_t)w->process, end, states | WNOHANG | WNOWAIT) == 0;
}

/* Ends the process. Its number is not used again while it is ours to reap. */
static void kill_process(worker *w)
{
    siginfo_t end;
    if (w->process == 0) return;
    if (find_end(w, WEXITED, &end)) kill(-w->process, SIGKILL);
    close(w->lifeline);
    while (waitpid(w->process, NULL, 0) < 0 && errno == EINTR) continue;
    w->process = 0;
}

void worker_end(worker *w)
{
    if (w->owner == getpid())
        kill_process(w);
    else if (w->process != 0)
        close(w->lifeline);
    pthread_mutex_destroy(&w->lock);
    channel_free(w->channel);
    free(w);
}

/* --- In the host: requests -------------------------------------------------------------------- */

static imp_status end_with(worker *w, const void *user, imp_status end)
{
    kill_process(w);
    w->culprit = user;
    return w->end = end;
}

/* The worker's end, if it has come. No plugin sends itself SIGKILL by mistake. */
static imp_status look(const worker *w)
{
    siginfo_t end;
    if (!find_end(w, WEXITED, &end)) return SURFACE_CRASHED;
    if (end.si_pid == 0) return IMP_STATUS_OK;
    return end.si_code != CLD_EXITED && end.si_status == SIGKILL ? SURFACE_KILLED : SURFACE_CRASHED;
}

/* When the answer must be there, and what it is if it is not. */
typedef struct deadline {
    double until;
    imp_status end;
} deadline;

static deadline deadline_of_request(void)
{
    const double until = active_callback_own()->until;
    const deadline usual = {clock_seconds() + WORKER_DEADLINE_S, SURFACE_HUNG};
    const deadline of_all = {until + late_slack, SURFACE_LATE};
    return until > 0 && of_all.until < usual.until ? of_all : usual;
}

/* A stopped process is not the plugin's fault either. */
static imp_status look_at_deadline(const worker *w, imp_status late)
{
    siginfo_t end;
    return find_end(w, WSTOPPED, &end) && end.si_pid != 0 ? SURFACE_KILLED : late;
}

static struct timespec next_look(double until)
{
    const double at = fmin(clock_seconds() + glance, until), whole = floor(at);
    return (struct timespec){(time_t)whole, (long)(1e9 * (at - whole))};
}

static imp_status await_reply(worker *w, const void *user)
{
    const channel *c = w->channel;
    const deadline last = deadline_of_request();
    struct timespec until = next_look(last.until);
    do {
        if (sem_clockwait(&w->channel->replied, CLOCK_MONOTONIC, &until) == 0) {
            if (atomic_load(&c->answering) == c->number) return c->work.status;
        } else if (errno == ETIMEDOUT) {
            const imp_status end = look(w);
            if (end != IMP_STATUS_OK) return end_with(w, user, end);
        }
        until = next_look(last.until);
    } while (clock_seconds() < last.until);
    return end_with(w, user, look_at_deadline(w, last.end));
}

bool worker_runs(worker *w)
{
    pthread_mutex_lock(&w->lock);
    const bool runs = w->end == IMP_STATUS_OK;
    pthread_mutex_unlock(&w->lock);
    return runs;
}

imp_status worker_enter(worker *w, const void *user)
{
    if (w->owner != getpid()) return SURFACE_FORKED;
    pthread_mutex_lock(&w->lock);
    if (w->end == IMP_STATUS_OK) return IMP_STATUS_OK;
    const imp_status end = w->culprit == user ? w->end : SURFACE_LOST;
    pthread_mutex_unlock(&w->lock);
    return end;
}

void worker_leave(worker *w) { pthread_mutex_unlock(&w->lock); }

imp_status worker_request(worker *w, const void *user, channel_request what)
{
    w->channel->work.request = what;
    w->channel->number += 1;
    sem_post(&w->channel->requested);
    return await_reply(w, user);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "fp_mode.h"
#include "isolate.h"

#include <errno.h>
#include <semaphore.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum {
    BATCH = 64,      /* points a call carries */
    DEADLINE_S = 5,  /* for one call */
    GLANCE_MS = 100, /* between looks at whether the child lives */
};

typedef enum order {
    ORDER_CREATE,
    ORDER_EVAL,
    ORDER_RATE,
    ORDER_INCLUDE, /* a map: apply */
} order;

/* What parent and child share. Only one of them is at it at a time: `request` and `reply` hand it
 * over. */
typedef struct board {
    sem_t request, reply;
    order order;
    imp_status status;
    imp_complaint why;
    double lo[3], hi[3]; /* domain, after ORDER_CREATE; a map: times in [0] */
    size_t n;
    int wants_error;
    double p[4 * BATCH], x[3 * BATCH], error[3 * BATCH];
    imp_region region;
    imp_box4 box;
    imp_rate_matrix rates;
    imp_map_rates map_rates;
    imp_model in[4], out[3];
} board;

struct isolated {
    const imp_surface_type *surface; /* one of the two is NULL */
    const imp_map_type *map;
    imp_surface_type surface_stand_in;
    imp_map_type map_stand_in;
    board *board;
    pid_t child;    /* 0: none */
    imp_status end; /* IMP_OK while the child lives */
};

/* --- The child ------------------------------------------------------------------------------ */

static imp_status child_create(const isolated *i, const imp_value *values, void **self)
{
    board *b = i->board;
    const imp_status status = i->surface != NULL ? i->surface->create(values, self, &b->why)
                                                 : i->map->create(values, self, &b->why);
    if (status != IMP_OK) return status;
    if (*self == NULL) return IMP_INTERNAL;
    if (i->surface != NULL)
        i->surface->domain(*self, b->lo, b->hi);
    else
        i->map->time_domain(*self, &b->lo[0], &b->hi[0]);
    return IMP_OK;
}

static imp_status child_obey(const isolated *i, void *self)
{
    board *b = i->board;
    double *error = b->wants_error ? b->error : NULL;
    switch (b->order) {
    case ORDER_EVAL:
        return i->surface != NULL ? i->surface->eval(self, b->n, b->p, b->x, error)
                                  : i->map->eval(self, b->n, b->p, b->x, error);
    case ORDER_RATE:
        return i->surface != NULL ? i->surface->rate(self, &b->region, &b->rates)
                                  : i->map->rate(self, &b->box, &b->map_rates);
    case ORDER_INCLUDE:
        return i->surface != NULL ? i->surface->include(self, &b->region, b->out)
                                  : i->map->apply(self, b->in, b->out);
    default:
        return IMP_INTERNAL;
    }
}

/* A plugin that exits must not run what the host left for its own end, nor flush its streams. */
static void leave_at_once(void) { _exit(1); }

static void child_live(const isolated *i, const imp_value *values)
{
    const struct rlimit none = {0, 0};
    const int fatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM};
    atexit(leave_at_once);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setrlimit(RLIMIT_CORE, &none);
    for (size_t k = 0; k < sizeof fatal / sizeof *fatal; ++k) signal(fatal[k], SIG_DFL);
    signal(SIGINT, SIG_IGN); /* the parent's business */
    void *self = NULL;
    const fp_mode mode = fp_mode_read();
    imp_status status = child_create(i, values, &self);
    for (;;) {
        i->board->status = fp_mode_kept(mode) ? status : SURFACE_CHANGED_MODE;
        sem_post(&i->board->reply);
        while (sem_wait(&i->board->request) != 0)
            if (errno != EINTR) _exit(1);
        status = child_obey(i, self);
    }
}

/* --- The parent ------------------------------------------------------------------------------- */

static struct timespec in_a_glance(void)
{
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    t.tv_nsec += GLANCE_MS * 1000000L;
    t.tv_sec += t.tv_nsec / 1000000000L;
    t.tv_nsec %= 1000000000L;
    return t;
}

static imp_status give_up(isolated *i, imp_status end)
{
    kill(i->child, SIGKILL);
    while (waitpid(i->child, NULL, 0) < 0 && errno == EINTR) continue;
    i->child = 0;
    return i->end = end;
}

/* Waits for the child's answer, looking now and then whether there still is a child. */
static imp_status await(isolated *i)
{
    for (int glance = 0; glance < DEADLINE_S * 1000 / GLANCE_MS; ++glance) {
        const struct timespec until = in_a_glance();
        int answer;
        do answer = sem_timedwait(&i->board->reply, &until);
        while (answer != 0 && errno == EINTR);
        if (answer == 0) return i->board->status;
        siginfo_t ended = {.si_pid = 0};
        if (waitid(P_PID, (id_t)i->child, &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
            ended.si_pid != 0)
            return give_up(i, SURFACE_CRASHED);
    }
    return give_up(i, SURFACE_HUNG);
}

static imp_status ask(isolated *i, order what)
{
    if (i->end != IMP_OK) return i->end;
    i->board->order = what;
    sem_post(&i->board->request);
    return await(i);
}

static board *board_new(void)
{
    board *b = mmap(NULL, sizeof *b, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (b == MAP_FAILED) return NULL;
    sem_init(&b->request, 1, 0);
    sem_init(&b->reply, 1, 0);
    return b;
}

imp_status isolate_create(isolated *i, const imp_value *values, imp_complaint *why)
{
    i->board = board_new();
    if (i->board == NULL) return IMP_INTERNAL;
    i->board->why = *why;
    i->child = fork();
    if (i->child == 0) child_live(i, values);
    if (i->child < 0) {
        i->child = 0;
        return IMP_INTERNAL;
    }
    i->end = IMP_OK;
    const imp_status status = await(i);
    *why = i->board->why;
    return status;
}

void isolate_destroy(void *self)
{
    isolated *i = self;
    if (i == NULL) return;
    if (i->child > 0) give_up(i, SURFACE_CRASHED);
    if (i->board != NULL) {
        sem_destroy(&i->board->request);
        sem_destroy(&i->board->reply);
        munmap(i->board, sizeof *i->board);
    }
    free(i);
}

/* --- The stand-ins' callbacks
 * --------------------------------------------------------------------- */

/* The rest of core sees an instance that never changes; the board behind it does. */
static isolated *behind(const void *self) { return (isolated *)(uintptr_t)self; }

static imp_status points(isolated *i, size_t n, size_t width, const double *p, double *x,
                         double *error)
{
    board *b = i->board;
    for (size_t from = 0; from < n; from += BATCH) {
        const size_t count = n - from < BATCH ? n - from : BATCH;
        b->n = count;
        b->wants_error = error != NULL;
        memcpy(b->p, p + width * from, width * count * sizeof *p);
        const imp_status status = ask(i, ORDER_EVAL);
        if (status != IMP_OK) return status;
        memcpy(x + 3 * from, b->x, 3 * count * sizeof *x);
        if (error != NULL) memcpy(error + 3 * from, b->error, 3 * count * sizeof *error);
    }
    return IMP_OK;
}

static void surface_domain_of(const void *self, double lo[3], double hi[3])
{
    memcpy(lo, behind(self)->board->lo, 3 * sizeof *lo);
    memcpy(hi, behind(self)->board->hi, 3 * sizeof *hi);
}

static imp_status surface_eval_of(const void *self, size_t n, const double *p, double *x,
                                  double *error)
{
    return points(behind(self), n, 3, p, x, error);
}

static imp_status surface_rate_of(const void *self, const imp_region *region,
                                  imp_rate_matrix *rates)
{
    behind(self)->board->region = *region;
    const imp_status status = ask(behind(self), ORDER_RATE);
    *rates = behind(self)->board->rates;
    return status;
}

static imp_status surface_include_of(const void *self, const imp_region *region, imp_model model[3])
{
    behind(self)->board->region = *region;
    const imp_status status = ask(behind(self), ORDER_INCLUDE);
    memcpy(model, behind(self)->board->out, 3 * sizeof *model);
    return status;
}

static void map_times_of(const void *self, double *lo, double *hi)
{
    *lo = behind(self)->board->lo[0];
    *hi = behind(self)->board->hi[0];
}

static imp_status map_eval_of(const void *self, size_t n, const double *p, double *x, double *error)
{
    return points(behind(self), n, 4, p, x, error);
}

static imp_status map_rate_of(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    behind(self)->board->box = *box;
    const imp_status status = ask(behind(self), ORDER_RATE);
    *rates = behind(self)->board->map_rates;
    return status;
}

static imp_status map_apply_of(const void *self, const imp_model in[4], imp_model out[3])
{
    memcpy(behind(self)->board->in, in, 4 * sizeof *in);
    const imp_status status = ask(behind(self), ORDER_INCLUDE);
    memcpy(out, behind(self)->board->out, 3 * sizeof *out);
    return status;
}

isolated *isolate_surface(const imp_surface_type *type)
{
    isolated *i = calloc(1, sizeof *i);
    if (i == NULL) return NULL;
    i->surface = type;
    i->end = SURFACE_CRASHED;
    i->surface_stand_in = (imp_surface_type){.struct_size = sizeof i->surface_stand_in,
                                             .name = type->name,
                                             .destroy = isolate_destroy,
                                             .domain = surface_domain_of,
                                             .eval = surface_eval_of,
                                             .rate = surface_rate_of,
                                             .include = type->include ? surface_include_of : NULL};
    return i;
}

isolated *isolate_map(const imp_map_type *type)
{
    isolated *i = calloc(1, sizeof *i);
    if (i == NULL) return NULL;
    i->map = type;
    i->end = SURFACE_CRASHED;
    i->map_stand_in = (imp_map_type){.struct_size = sizeof i->map_stand_in,
                                     .name = type->name,
                                     .destroy = isolate_destroy,
                                     .time_domain = map_times_of,
                                     .eval = map_eval_of,
                                     .rate = map_rate_of,
                                     .apply = type->apply ? map_apply_of : NULL};
    return i;
}

const imp_surface_type *isolate_surface_type(const isolated *i) { return &i->surface_stand_in; }

const imp_map_type *isolate_map_type(const isolated *i) { return &i->map_stand_in; }

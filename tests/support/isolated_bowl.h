/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_ISOLATED_BOWL_H
#define TESTS_SUPPORT_ISOLATED_BOWL_H

#include "core/plugin/isolate.h"
#include "core/surface/region.h"

#include <impinge/formula.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/suite.h"

/* A type that commits the sin its parameter names, served by a process of its own. */

enum {
    CRASH_IN_CREATE = 1,
    CRASH_IN_EVAL,
    EXIT_IN_RATE,
    HANG_IN_EVAL,
    TRAP_IN_INCLUDE,
    FORK_IN_EVAL,
    PID_IN_EVAL, /* x is the number of the process */
    ALLOCATE_IN_EVAL,
    THREAD_EXIT_IN_EVAL,
    KILLED_IN_EVAL,
    STOPPED_IN_EVAL,
    EXIT_IN_DESTROY,
    HANG_IN_DESTROY,
    KILLED_IN_DESTROY
};

static inline imp_status make(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    if (values->number[0] == CRASH_IN_CREATE) raise(SIGSEGV);
    *self = malloc(sizeof(double));
    memcpy(*self, values->number, sizeof(double));
    return IMP_STATUS_OK;
}

static inline imp_status complain(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values;
    (void)self;
    why->parameter = 0;
    strcpy(why->text, "too red");
    return IMP_STATUS_PARAMETER;
}

static inline void bowl_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                imp_model out[3])
{
    (void)self;
    out[0] = u;
    out[1] = v;
    out[2] = imp_add(imp_add(imp_sqr(u), imp_sin(v)), t);
}
IMP_SURFACE_FORMULA(bowl_formula)

/* Address space, not memory: nothing is touched. More than 64 GiB is more than any limit. */
static inline imp_status allocate(void)
{
    for (int k = 0; k < 256; ++k)
        if (mmap(NULL, 1 << 28, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
                 -1, 0) == MAP_FAILED)
            return IMP_STATUS_INTERNAL;
    return IMP_STATUS_OK;
}

static inline imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const double sin = *(const double *)self;
    if (sin == CRASH_IN_EVAL) raise(SIGSEGV);
    while (sin == HANG_IN_EVAL) pause();
    const bool is_copy = sin == FORK_IN_EVAL && fork() == 0;
    volatile double *late = x; /* what a copy writes while the next requests are answered */
    for (int k = 0; is_copy && k < 1 << 20; ++k) late[0] = -1 - k;
    if (sin == ALLOCATE_IN_EVAL) return allocate();
    if (sin == THREAD_EXIT_IN_EVAL) pthread_exit(NULL);
    if (sin == KILLED_IN_EVAL) raise(SIGKILL);
    if (sin == STOPPED_IN_EVAL) raise(SIGSTOP);
    const imp_status status = bowl_formula_eval(self, n, p, x, error);
    if (sin == PID_IN_EVAL) x[0] = getpid();
    return status;
}

static inline void destroy(void *self)
{
    const double sin = *(const double *)self;
    if (sin == EXIT_IN_DESTROY) exit(0);
    while (sin == HANG_IN_DESTROY) pause();
    if (sin == KILLED_IN_DESTROY) raise(SIGKILL);
    free(self);
}

static inline imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    if (*(const double *)self == EXIT_IN_RATE) _exit(0);
    return bowl_formula_rate(self, region, rates);
}

/* Subnormals off, as -ffast-math does it. */
static inline void change_mode(void)
{
#if defined(__x86_64__)
    __builtin_ia32_ldmxcsr(0x1f80 | 0x8000);
#endif
}

static inline imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    if (*(const double *)self == TRAP_IN_INCLUDE) change_mode();
    return bowl_formula_include(self, region, model);
}

static inline void domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    memcpy(lo, (double[3]){-1, -2, -INFINITY}, 3 * sizeof *lo);
    memcpy(hi, (double[3]){1, 2, INFINITY}, 3 * sizeof *hi);
}

static inline imp_status net(const void *self, const imp_region *region, imp_net *out)
{
    (void)self;
    for (int k = 0; k < IMP_NET_POINTS; ++k) out->point[2][k] = region->lo[0] / (k + 1);
    out->error[1] = region->hi[2];
    return region->lo[0] < 0.5 ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

static inline imp_status distance(const void *self, const imp_model point[4], imp_model *out)
{
    (void)self;
    *out = imp_sub(imp_add(point[0], point[3]), imp_mul(point[1], point[2]));
    return point[3].a < 0.75 ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

static const imp_surface_type bowl = {.struct_size = sizeof bowl,
                                      .name = "bowl",
                                      .parameter_count = 1,
                                      .create = make,
                                      .destroy = destroy,
                                      .domain = domain,
                                      .eval = eval,
                                      .rate = rate,
                                      .include = include,
                                      .net = net,
                                      .distance = distance};
static const imp_surface_type fussy = {.name = "fussy",
                                       .create = complain,
                                       .destroy = free,
                                       .domain = domain,
                                       .eval = eval,
                                       .rate = rate};

static worker_pool *pool;

static inline void open_pool(void)
{
    pool = worker_pool_new();
    ck_assert_ptr_nonnull(pool);
}

static inline void close_pool(void) { worker_pool_free(pool); }

static inline isolated *isolated_bowl(double sin, imp_status expected)
{
    const imp_value value = {.count = 1, .extent = {1, 1, 1}, .number = &sin};
    imp_create_error why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    isolated *i = isolate_surface(pool, &bowl);
    ck_assert_ptr_nonnull(i);
    ck_assert_int_eq(isolate_create(i, &value, &why), expected);
    return i;
}

static inline imp_status eval_at_zero(isolated *i, double x[3])
{
    const double p[3] = {0, 0, 0};
    return isolate_surface_type(i)->eval(i, 1, p, x, NULL);
}

enum { MANY = 50000 };

/* IMP_STATUS_OK if the values are those of values_of_every_kind_arrive. */
static inline imp_status compare(const imp_value *values, void **self, imp_create_error *why)
{
    static char instance;
    (void)why;
    *self = &instance;
    bool good = values[0].count == MANY && values[0].extent[0] == MANY / 2;
    for (size_t k = 0; good && k < MANY; ++k) good = values[0].number[k] == (double)k / 3;
    good = good && values[1].count == 0 && values[1].number == NULL && values[1].string == NULL;
    good = good && values[2].count == 1 && strcmp(values[2].string[0], "of 9 bytes") == 0;
    good = good && values[3].count == 2 && strcmp(values[3].string[1], "") == 0;
    return good && values[3].number[1] == -7 ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static inline void keep(void *self) { (void)self; }

static const imp_surface_type comparing = {.name = "comparing",
                                           .parameter_count = 4,
                                           .create = compare,
                                           .destroy = keep,
                                           .domain = domain,
                                           .eval = eval,
                                           .rate = rate};

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "slab.h"

/* Commits the sin that the environment asks for, in the phase that it asks for:
 * HOSTILE="eval exit". Without it a slab like any other. */

/* Returns only where the stack ends at 0. */
static size_t use_stack(size_t depth)
{
    volatile char room[4096];
    room[depth % sizeof room] = 1;
    return room[0] != 2 && depth > 0 ? use_stack(depth - 1) + (size_t)room[0] : depth;
}

static void leave_child(void)
{
    if (fork() != 0) return;
    sleep(1000);
    _exit(0);
}

static void commit(const char *sin)
{
    if (strcmp(sin, "crash") == 0) raise(SIGSEGV);
    if (strcmp(sin, "abort") == 0) abort();
    if (strcmp(sin, "overflow") == 0) use_stack(SIZE_MAX);
    if (strcmp(sin, "exit") == 0) exit(0);
    if (strcmp(sin, "_exit") == 0) _exit(0);
    if (strcmp(sin, "_Exit") == 0) _Exit(0);
    if (strcmp(sin, "quick_exit") == 0) quick_exit(0);
    if (strcmp(sin, "pthread_exit") == 0) pthread_exit(NULL);
    if (strcmp(sin, "hang") == 0) sleep(1000);
    if (strcmp(sin, "fork") == 0) fork();
    if (strcmp(sin, "child") == 0) leave_child();
    if (strcmp(sin, "print") == 0) puts("{\"verdict\": \"printed\"}"), fflush(stdout);
    if (strcmp(sin, "write") == 0) (void)!write(1, "{\"verdict\": \"written\"}\n", 23);
}

/* Once in each phase: a second time would hide what the first one did. */
static void enter(const char *phase)
{
    static char done[20];
    const char *wanted = getenv("HOSTILE");
    const size_t length = strlen(phase);
    if (wanted == NULL || strncmp(wanted, phase, length) != 0 || wanted[length] != ' ') return;
    if (strcmp(done, phase) == 0) return;
    snprintf(done, sizeof done, "%s", phase);
    commit(wanted + length + 1);
}

__attribute__((constructor)) static void construct(void) { enter("constructor"); }
__attribute__((destructor)) static void destruct(void) { enter("destructor"); }

static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    enter("create");
    return slab_create(values, self, why);
}

static void destroy(void *self)
{
    enter("destroy");
    slab_destroy(self);
}

static void domain(const void *self, double lo[3], double hi[3])
{
    enter("domain");
    slab_domain(self, lo, hi);
}

static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    enter("eval");
    return slab_eval(self, n, p, x, error);
}

static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    enter("rate");
    return slab_rate(self, region, rates);
}

static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    enter("include");
    return slab_include(self, region, model);
}

static const imp_surface_type type = {
    .struct_size = sizeof type,
    .parameter_count = 1,
    .parameter_size = sizeof(imp_parameter),
    .name = "hostile",
    .summary = "slab",
    .equation = "(u, v, height + t)",
    .example = "hostile",
    .parameters = slab_table,
    .create = create,
    .destroy = destroy,
    .domain = domain,
    .eval = eval,
    .rate = rate,
    .include = include,
};
static const imp_surface_type *const types[] = {&type};
static const imp_surface_factory factory = {sizeof factory, 1, types};

static const void *get_factory(const char *id)
{
    enter("get_factory");
    return strcmp(id, IMP_SURFACE_FACTORY) == 0 ? &factory : NULL;
}

IMPINGE_PLUGIN("hostile", "1.0", "Apache-2.0", "tests", get_factory);

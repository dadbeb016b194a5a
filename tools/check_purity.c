/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "check_purity.h"

#include <impinge/formula.h>

#include <errno.h>
#include <fenv.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

/* --- Everything a type answers about some points and regions ------------------------------- */

enum { POINTS = 96, BOXES = 32, THREADS = 4 };

typedef struct questions {
    double p[POINTS * BOX_DIMS];
    box where[BOXES];
} questions;

/* Compared as bytes, so it must have no padding: doubles, then models, whose layout is frozen. */
typedef struct answers {
    double x[POINTS * 3], error[POINTS * 3];
    double rate[BOXES][3][BOX_DIMS];
    imp_model model[BOXES][3];
    double status[1 + 2 * BOXES];
} answers;

static void draw_questions(const subject *s, uint64_t *random, questions *q)
{
    memset(q, 0, sizeof *q);
    for (int k = 0; k < POINTS; ++k) draw_point(random, &s->domain, s->n, q->p + k * s->n);
    for (int k = 0; k < BOXES; ++k) q->where[k] = draw_box(random, &s->domain, s->n);
}

/* What a map's apply is asked: models of the box's x, y, z alone, as if they were u, v, t. */
static void box_models(const box *where, imp_model in[4])
{
    const imp_region region = imp_region_between(where->lo, where->hi);
    for (int i = 0; i < 3; ++i) in[i] = imp_param(&region, i);
    in[3] = imp_between(where->lo[3], where->hi[3]);
}

static imp_status ask_models(const subject *s, const box *where, imp_model model[3])
{
    imp_model in[4];
    const imp_region region = imp_region_between(where->lo, where->hi);
    memset(model, 0, 3 * sizeof *model);
    if (s->n == 3)
        return s->instance->surface->include != NULL ? subject_include(s, &region, model) : IMP_OK;
    box_models(where, in);
    return s->instance->map->apply != NULL ? subject_apply(s, in, model) : IMP_OK;
}

static void ask(const subject *s, const questions *q, answers *a)
{
    memset(a, 0, sizeof *a);
    a->status[0] = subject_eval(s, POINTS, q->p, a->x, a->error);
    for (int k = 0; k < BOXES; ++k) {
        a->status[1 + 2 * k] = subject_rate(s, &q->where[k], a->rate[k]);
        a->status[2 + 2 * k] = ask_models(s, &q->where[k], a->model[k]);
    }
}

/* --- Determinism ------------------------------------------------------------------------- */

static bool same(const subject *s, const answers *a, const answers *b, const char *when)
{
    const char *differs = memcmp(a->x, b->x, sizeof a->x) != 0               ? "eval's points"
                          : memcmp(a->error, b->error, sizeof a->error) != 0 ? "eval's errors"
                          : memcmp(a->rate, b->rate, sizeof a->rate) != 0    ? "the rates"
                          : memcmp(a->model, b->model, sizeof a->model) != 0 ? "the models"
                          : memcmp(a->status, b->status, sizeof a->status)   ? "the statuses"
                                                                             : NULL;
    s->answer->tests += POINTS + 2 * BOXES;
    return differs == NULL || answer_fail(s->answer, "%s differ %s", differs, when);
}

/* A call for each point. */
static void ask_singly(const subject *s, const questions *q, answers *a)
{
    for (int k = 0; k < POINTS; ++k)
        subject_eval(s, 1, q->p + k * s->n, a->x + 3 * k, a->error + 3 * k);
}

typedef struct job {
    pthread_t thread;
    check_answer note; /* each thread notes its own calls */
    subject s;
    const questions *q;
    answers a;
} job;

static void *work(void *data)
{
    job *j = data;
    for (int k = 0; k < 8; ++k) ask(&j->s, j->q, &j->a);
    return NULL;
}

static bool same_in_threads(const subject *s, const questions *q, const answers *a)
{
    static job jobs[THREADS];
    int started = 0;
    for (; started < THREADS; ++started) {
        job *j = &jobs[started];
        j->s = *s;
        j->s.answer = &j->note;
        j->q = q;
        if (pthread_create(&j->thread, NULL, work, j) != 0) break;
    }
    for (int k = 0; k < started; ++k) pthread_join(jobs[k].thread, NULL);
    for (int k = 0; k < started; ++k)
        if (!same(s, a, &jobs[k].a, "when several threads ask at once")) return false;
    return true;
}

void determinism_check(const subject *s, uint64_t *random, double effort)
{
    static questions q;
    static answers first, other;
    (void)effort;
    subject brother = *s;
    brother.instance = s->twin;
    draw_questions(s, random, &q);
    ask(s, &q, &first);
    ask(s, &q, &other);
    if (!same(s, &first, &other, "from call to call")) return;
    ask_singly(s, &q, &other);
    if (!same(s, &first, &other, "between points asked for together and one by one")) return;
    ask(&brother, &q, &other);
    if (!same(s, &first, &other, "between instances of the same parameters")) return;
    same_in_threads(s, &q, &first);
}

/* --- Environment ---------------------------------------------------------------------------- */

/* Rounding mode, and where we know how: subnormals and traps. The sticky exception flags are
 * nobody's business. */
typedef struct environment {
    int rounding, error;
    unsigned control;
} environment;

static environment read_environment(void)
{
    environment e = {fegetround(), errno, 0};
#if defined(__x86_64__)
    e.control = __builtin_ia32_stmxcsr() & ~0x3fu;
#endif
    return e;
}

static bool is_kept(const subject *s, const environment *before, const char *call)
{
    const environment now = read_environment();
    ++s->answer->tests;
    if (now.rounding != before->rounding)
        return answer_fail(s->answer, "%s changes the rounding mode", call);
    if (now.control != before->control)
        return answer_fail(s->answer,
                           "%s changes how subnormal numbers are treated, or traps (MXCSR %#x, "
                           "before %#x)",
                           call, now.control, before->control);
    if (now.error != before->error)
        return answer_fail(s->answer, "%s sets errno to %d", call, now.error);
    return true;
}

void environment_check(const subject *s, uint64_t *random, double effort)
{
    double x[3], error[3], rate[3][BOX_DIMS];
    imp_model model[3];
    static questions q;
    (void)effort;
    draw_questions(s, random, &q);
    errno = 0;
    const environment before = read_environment();
    for (int k = 0; k < POINTS; ++k) {
        subject_eval(s, 1, q.p + k * s->n, x, error);
        if (!is_kept(s, &before, "eval")) return;
    }
    for (int k = 0; k < BOXES; ++k) {
        subject_rate(s, &q.where[k], rate);
        if (!is_kept(s, &before, "rate")) return;
        ask_models(s, &q.where[k], model);
        if (!is_kept(s, &before, s->n == 3 ? "include" : "apply")) return;
    }
}

/* --- Buffers ------------------------------------------------------------------------------ */

enum { GUARD = 64 }; /* bytes on either side */
#define CANARY 0xa5

typedef struct guarded {
    unsigned char before[GUARD];
    union {
        double number[POINTS * BOX_DIMS];
        imp_model model[3];
        imp_rate_matrix rates;
        imp_map_rates map_rates;
        unsigned char byte[POINTS * BOX_DIMS * sizeof(double)];
    } in;
} guarded;

static void guard(guarded *g) { memset(g, CANARY, sizeof *g); }

/* Everything but the first `used` bytes inside is untouched. */
static bool is_whole(const guarded *g, size_t used)
{
    for (size_t k = 0; k < GUARD; ++k)
        if (g->before[k] != CANARY) return false;
    for (size_t k = used; k < sizeof g->in; ++k)
        if (g->in.byte[k] != CANARY) return false;
    return true;
}

static bool eval_keeps_buffers(const subject *s, const questions *q, size_t count)
{
    static guarded x, error;
    static questions copy;
    copy = *q;
    guard(&x);
    guard(&error);
    subject_eval(s, count, copy.p, x.in.number, error.in.number);
    ++s->answer->tests;
    if (!is_whole(&x, 3 * count * sizeof(double)) || !is_whole(&error, 3 * count * sizeof(double)))
        return answer_fail(s->answer, "eval writes beyond its outputs when asked for %zu points",
                           count);
    if (memcmp(&copy, q, sizeof copy) != 0)
        return answer_fail(s->answer, "eval changes the points it is given");
    static guarded alone;
    guard(&alone);
    subject_eval(s, count, copy.p, alone.in.number, NULL);
    if (memcmp(&alone, &x, sizeof x) != 0)
        return answer_fail(s->answer, "eval gives other points when no errors are asked for");
    return true;
}

static bool bounds_keep_buffers(const subject *s, const box *where)
{
    static guarded rates, models;
    const imp_instance *i = s->instance;
    const imp_region region = imp_region_between(where->lo, where->hi);
    imp_region copy = region;
    imp_model in[4];
    guard(&rates);
    guard(&models);
    s->answer->call = (check_call){.name = "rate, include or apply"};
    if (i->surface != NULL) {
        i->surface->rate(i->self, &copy, &rates.in.rates);
        if (i->surface->include != NULL) i->surface->include(i->self, &copy, models.in.model);
    } else {
        imp_box4 space;
        memcpy(&space, where, sizeof space);
        box_models(where, in);
        i->map->rate(i->self, &space, &rates.in.map_rates);
        if (i->map->apply != NULL) i->map->apply(i->self, in, models.in.model);
    }
    s->answer->call.name = NULL;
    ++s->answer->tests;
    if (memcmp(&copy, &region, sizeof copy) != 0)
        return answer_fail(s->answer, "rate or include changes the region it is given");
    if (!is_whole(&rates, s->n == 3 ? sizeof(imp_rate_matrix) : sizeof(imp_map_rates)))
        return answer_fail(s->answer, "rate writes beyond its output");
    if (!is_whole(&models, sizeof models.in.model))
        return answer_fail(s->answer, "%s writes beyond its three models",
                           s->n == 3 ? "include" : "apply");
    return true;
}

void buffers_check(const subject *s, uint64_t *random, double effort)
{
    static questions q;
    (void)effort;
    draw_questions(s, random, &q);
    for (size_t count = 0; count < POINTS / 2; count += count < 6 ? 1 : 7)
        if (!eval_keeps_buffers(s, &q, count)) return;
    for (int k = 0; k < BOXES; ++k)
        if (!bounds_keep_buffers(s, &q.where[k])) return;
}

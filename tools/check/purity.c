/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/purity.h"

#include <impinge/formula.h>

#include <math.h>
#include <pthread.h>
#include <string.h>

/* --- All results of a type for some points and regions ---------------------------------------- */

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
    imp_pose pose[BOXES];
    double status[1 + 3 * BOXES];
} answers;

static void draw_questions(const subject *s, uint64_t *random, questions *q)
{
    memset(q, 0, sizeof *q);
    for (int k = 0; k < POINTS; ++k) draw_point(random, &s->domain, s->n, q->p + k * s->n);
    for (int k = 0; k < BOXES; ++k) q->where[k] = draw_box(random, &s->domain, s->n);
}

static void ask(const subject *s, const questions *q, answers *a)
{
    memset(a, 0, sizeof *a);
    a->status[0] = subject_eval(s, POINTS, q->p, a->x, a->error);
    for (int k = 0; k < BOXES; ++k) {
        a->status[1 + 2 * k] = subject_rate(s, &q->where[k], a->rate[k]);
        a->status[2 + 2 * k] = subject_model(s, q->where[k], a->model[k]);
        if (!subject_is_rigid(s)) continue;
        const imp_region span = subject_span(&q->where[k]);
        a->status[1 + 2 * BOXES + k] = subject_pose(s, &span, &a->pose[k]);
    }
}

/* --- Determinism ------------------------------------------------------------------------------ */

static bool same(const subject *s, const answers *a, const answers *b, const char *when)
{
    const char *differs = memcmp(a->x, b->x, sizeof a->x) != 0               ? "eval's points"
                          : memcmp(a->error, b->error, sizeof a->error) != 0 ? "eval's errors"
                          : memcmp(a->rate, b->rate, sizeof a->rate) != 0    ? "the rates"
                          : memcmp(a->model, b->model, sizeof a->model) != 0 ? "the models"
                          : memcmp(a->pose, b->pose, sizeof a->pose) != 0    ? "the poses"
                          : memcmp(a->status, b->status, sizeof a->status)   ? "the statuses"
                                                                             : NULL;
    s->answer->tests += POINTS + 2 * BOXES;
    return differs == NULL || answer_fail_for(s->answer, FAULT_ANY, "%s differ %s", differs, when);
}

/* Asks with a call for each point. */
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
        if (!same(s, a, &jobs[k].a, "when several threads call at once")) return false;
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
    if (!same(s, &first, &other, "between points evaluated together and one by one")) return;
    ask(&brother, &q, &other);
    if (!same(s, &first, &other, "between instances of the same parameters")) return;
    same_in_threads(s, &q, &first);
}

/* --- Two instances ---------------------------------------------------------------------------- */

/* The net over a box, and the distance of its centre in space; of statuses that fail, zeros. */
typedef struct offers {
    imp_net net;
    imp_model distance;
    imp_status status[2];
} offers;

static void ask_offers(const subject *s, const box *where, offers *o)
{
    const imp_surface_type *type = s->instance->surface;
    memset(o, 0, sizeof *o);
    if (type == NULL) return;
    const imp_region region = imp_region_between(where->lo, where->hi);
    if (IMP_OFFERS(type, net)) o->status[0] = subject_net(s, &region, &o->net);
    if (o->status[0] != IMP_STATUS_OK) memset(&o->net, 0, sizeof o->net);
    if (!subject_has_distance(s)) return;
    imp_model point[4];
    for (int j = 0; j < 3; ++j) point[j] = imp_param(&region, j);
    point[3] = imp_param(&region, 2);
    o->status[1] = subject_distance(s, point, &o->distance);
    if (o->status[1] != IMP_STATUS_OK) memset(&o->distance, 0, sizeof o->distance);
}

bool purity_are_alike(const subject *s, const subject *other, uint64_t *random, const char *when)
{
    static questions q;
    static answers first, second;
    offers x, y;
    draw_questions(s, random, &q);
    ask(s, &q, &first);
    ask(other, &q, &second);
    if (!same(s, &first, &second, when)) return false;
    for (int k = 0; k < BOXES; ++k) {
        ask_offers(s, &q.where[k], &x);
        ask_offers(other, &q.where[k], &y);
        s->answer->tests += 1;
        if (memcmp(&x, &y, sizeof x) != 0)
            return answer_fail(s->answer, "nets or distances differ %s", when);
    }
    return true;
}

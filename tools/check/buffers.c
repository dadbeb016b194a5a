/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/buffers.h"

#include <impinge/formula.h>

#include <string.h>

#include "tools/check/guard.h"

/* --- Canaries --------------------------------------------------------------------------------- */

enum { POINTS = 48, BOXES = 32 };

typedef struct questions {
    double p[POINTS * BOX_DIMS];
} questions;

enum { MARGIN = 64 }; /* bytes on either side */
#define CANARY 0xa5

typedef struct canaried {
    unsigned char before[MARGIN];
    union {
        double number[POINTS * BOX_DIMS];
        imp_model model[3];
        imp_rate_matrix rates;
        imp_map_rates map_rates;
        unsigned char byte[POINTS * BOX_DIMS * sizeof(double)];
    } in;
} canaried;

static void surround(canaried *g) { memset(g, CANARY, sizeof *g); }

/* Everything but the first `used` bytes inside is untouched. */
static bool is_whole(const canaried *g, size_t used)
{
    for (size_t k = 0; k < MARGIN; ++k)
        if (g->before[k] != CANARY) return false;
    for (size_t k = used; k < sizeof g->in; ++k)
        if (g->in.byte[k] != CANARY) return false;
    return true;
}

static bool eval_keeps_buffers(const subject *s, const questions *q, size_t count)
{
    static canaried x, error;
    static questions copy;
    copy = *q;
    surround(&x);
    surround(&error);
    subject_eval(s, count, copy.p, x.in.number, error.in.number);
    ++s->answer->tests;
    if (!is_whole(&x, 3 * count * sizeof(double)) || !is_whole(&error, 3 * count * sizeof(double)))
        return answer_fail(s->answer, "eval writes beyond its outputs when asked for %zu points",
                           count);
    if (memcmp(&copy, q, sizeof copy) != 0)
        return answer_fail(s->answer, "eval changes the points it is given");
    static canaried alone;
    surround(&alone);
    subject_eval(s, count, copy.p, alone.in.number, NULL);
    if (memcmp(&alone, &x, sizeof x) != 0)
        return answer_fail_for(s->answer, FAULT_ANY,
                               "eval gives other points when no errors are asked for");
    return true;
}

static bool bounds_keep_buffers(const subject *s, const box *where)
{
    static canaried rates, models;
    const imp_instance *i = s->instance;
    const imp_region region = imp_region_between(where->lo, where->hi);
    imp_region copy = region;
    imp_model in[4];
    surround(&rates);
    surround(&models);
    subject_note_call(s->answer, "rate, include or apply", NULL);
    if (i->surface != NULL) {
        i->surface->rate(i->self, &copy, &rates.in.rates);
        if (i->surface->include != NULL) i->surface->include(i->self, &copy, models.in.model);
    } else {
        imp_box4 space;
        memcpy(&space, where, sizeof space);
        subject_operands(where, in);
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

/* --- Ends of memory --------------------------------------------------------------------------- */

#define HINT "whose arrays end where readable memory ends: it goes past the end of one"

typedef struct pages {
    guard points, x, error, operand;
} pages;

static bool pages_make(pages *g)
{
    return guard_make(&g->points, POINTS * BOX_DIMS * sizeof(double)) &&
           guard_make(&g->x, POINTS * 3 * sizeof(double)) &&
           guard_make(&g->error, POINTS * 3 * sizeof(double)) &&
           guard_make(&g->operand, 4 * sizeof(imp_model));
}

static void pages_free(pages *g)
{
    guard_free(&g->points);
    guard_free(&g->x);
    guard_free(&g->error);
    guard_free(&g->operand);
}

static void eval_at_end(const subject *s, pages *g, const questions *q, size_t count)
{
    const size_t size = 3 * count * sizeof(double);
    const double *p = guard_place(&g->points, q->p, (size_t)s->n * count * sizeof *p);
    s->answer->call.hint = HINT;
    subject_eval(s, count, p, guard_place(&g->x, NULL, size), guard_place(&g->error, NULL, size));
    subject_eval(s, count, p, guard_place(&g->x, NULL, size), NULL);
    s->answer->call.hint = NULL;
    ++s->answer->tests;
}

static void surface_at_end(const imp_instance *i, pages *g, const box *where)
{
    const imp_region region = imp_region_between(where->lo, where->hi);
    const imp_region *r = guard_place(&g->operand, &region, sizeof region);
    i->surface->rate(i->self, r, guard_place(&g->x, NULL, sizeof(imp_rate_matrix)));
    if (i->surface->include != NULL)
        i->surface->include(i->self, r, guard_place(&g->error, NULL, 3 * sizeof(imp_model)));
}

static void map_at_end(const imp_instance *i, pages *g, const box *where)
{
    imp_box4 space;
    imp_model in[4];
    memcpy(&space, where, sizeof space);
    const imp_box4 *b = guard_place(&g->operand, &space, sizeof space);
    i->map->rate(i->self, b, guard_place(&g->x, NULL, sizeof(imp_map_rates)));
    if (i->map->apply == NULL) return;
    subject_operands(where, in);
    const imp_model *operands = guard_place(&g->operand, in, sizeof in);
    i->map->apply(i->self, operands, guard_place(&g->error, NULL, 3 * sizeof(imp_model)));
}

static void bounds_at_end(const subject *s, pages *g, const box *where)
{
    subject_note_call(s->answer, "rate, include or apply", HINT);
    if (s->n == 3)
        surface_at_end(s->instance, g, where);
    else
        map_at_end(s->instance, g, where);
    subject_note_call(s->answer, NULL, NULL);
    ++s->answer->tests;
}

/* ---------------------------------------------------------------------------------------------- */

void buffers_check(const subject *s, uint64_t *random, double effort)
{
    static questions q;
    box where[BOXES];
    pages g = {.points = {NULL, 0}};
    (void)effort;
    for (int k = 0; k < POINTS; ++k) draw_point(random, &s->domain, s->n, q.p + k * s->n);
    for (int k = 0; k < BOXES; ++k) where[k] = draw_box(random, &s->domain, s->n);
    for (size_t count = 0; count < POINTS; count += count < 6 ? 1 : 7)
        if (!eval_keeps_buffers(s, &q, count)) return;
    for (int k = 0; k < BOXES; ++k)
        if (!bounds_keep_buffers(s, &where[k])) return;
    if (pages_make(&g)) {
        for (size_t count = 1; count < POINTS; count += 5) eval_at_end(s, &g, &q, count);
        for (int k = 0; k < BOXES; ++k) bounds_at_end(s, &g, &where[k]);
    } else {
        answer_skip(s->answer, "no memory for pages that cannot be read");
    }
    pages_free(&g);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/proof_text.h"

#include <math.h>
#include <stdio.h>

/* "the rate of x by u, 2, over u in ..." */
typedef struct claim_text {
    char text[480];
} claim_text;

static claim_text text_of(const branch_field *field, const branch_claims *c,
                          const branch_outcome *o)
{
    claim_text t;
    const imp_model *g = &c->model[o->i];
    const char x = "xyz"[o->i];
    int used = 0;
    if (o->kind == BRANCH_RATE)
        used = snprintf(t.text, sizeof t.text, "the rate of %c by %c, %.17g", x,
                        (field->n == 3 ? "uvt" : "xyzt")[o->j], c->rate[o->i][o->j]);
    else if (o->kind == BRANCH_RANGE)
        used = snprintf(t.text, sizeof t.text, "the range of %c, [%.17g, %.17g]", x, g->lo, g->hi);
    else
        used = snprintf(t.text, sizeof t.text, "the remainder of %c, %.17g", x, g->e);
    snprintf(t.text + used, sizeof t.text - (size_t)used, ", over %s",
             subject_box_text(field->n, c->where.lo, c->where.hi).text);
    return t;
}

/* "; 1.5 ulp too little: ..." if rounding explains it, else empty. */
static claim_text advice(const branch_claims *c, const branch_outcome *o)
{
    claim_text t = {""};
    const imp_model *g = &c->model[o->i];
    const ld_interval there = o->there, size = ld_interval_abs(there);
    const bool below = o->kind == BRANCH_RANGE && there.hi < g->lo;
    const double claimed = o->kind == BRANCH_RATE        ? c->rate[o->i][o->j]
                           : o->kind == BRANCH_REMAINDER ? g->e
                           : below                       ? g->lo
                                                         : g->hi;
    const long double least = o->kind != BRANCH_RANGE ? size.lo : below ? -there.hi : there.lo;
    const long double beyond = least - (below ? -(long double)claimed : (long double)claimed);
    const double ulp = nextafter(fabs(claimed), INFINITY) - fabs(claimed);
    if (beyond < 16 * (long double)ulp)
        snprintf(t.text, sizeof t.text, "; that is %.2Lg ulp too little: round it outward",
                 beyond / ulp);
    return t;
}

bool proof_refute(const subject *s, const branch_field *field, const branch_claims *c,
                  const branch_outcome *o)
{
    static const char *const what[] = {"the derivative", "the coordinate",
                                       "the distance from the quadratic"};
    double at[BOX_DIMS];
    for (int j = 0; j < BOX_DIMS; ++j) at[j] = (double)o->p[j];
    if (o->kind == BRANCH_RATE && field->n == s->n) s->answer->blamed = s->answer->rate_call;
    static const unsigned faults[] = {FAULT_RATE, FAULT_RANGE, FAULT_REMAINDER};
    return answer_fail_for(
        s->answer, faults[o->kind], "%s: by the formula %s at %s is surely in [%.20Lg, %.20Lg]%s",
        text_of(field, c, o).text, what[o->kind], subject_point_text(field->n, at).text,
        o->there.lo, o->there.hi, advice(c, o).text);
}

void proof_tell_open(const subject *s, const branch_field *field, const branch_claims *c,
                     const branch_outcome *o)
{
    check_proof *sum = &s->answer->proof;
    if (sum->open[0] != '\0') return;
    snprintf(sum->open, sizeof sum->open, "%s", text_of(field, c, o).text);
}

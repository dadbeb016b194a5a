/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "core/surface/region.h"
#include "plugins/expression/expression.h"
#include "tests/fuzz/fuzz.h"
#include "tools/proof/formula.h"

#include <math.h>
#include <string.h>

/* Whatever a text is made of, the language of formulas and the checker's own reader of it read or
 * refuse it, both alike; and what a formula's model says over a region holds for points of it. */

const char fuzz_target[] = "formula";

static const char *const variables[3] = {"u", "v", "t"};

/* Boxes of u, v, t: a point, narrow, at zero, wide. */
static const double boxes[][3][2] = {
    {{0.25, 0.25}, {-1, -1}, {0.5, 0.5}},
    {{0.5, 0.5 + 0x1p-20}, {0.25, 0.375}, {0, 0}},
    {{0, 1}, {0, 1}, {0, 1}},
    {{-3, 5}, {-0.001, 2}, {-1, 1}},
};

enum { POINTS = 16 };

static imp_region region_of(const double ends[3][2])
{
    const double lo[3] = {ends[0][0], ends[1][0], ends[2][0]};
    const double hi[3] = {ends[0][1], ends[1][1], ends[2][1]};
    return region_make(lo, hi);
}

static uint64_t random_state;

/* In [-1, 1], often an end or the middle. */
static double draw_s(void)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    const unsigned k = (unsigned)(random_state >> 60);
    return k < 6 ? (double)(k % 3) - 1 : (double)(int64_t)random_state * 0x1p-63;
}

static double value_at(const imp_model *m, const double s[3])
{
    double sum = m->a;
    for (int j = 0, jk = 0; j < 3; ++j) {
        sum += m->b[j] * s[j];
        for (int k = j; k < 3; ++k) sum += m->q[jk++] * s[j] * s[k];
    }
    return sum;
}

/* 2^-45 of all terms covers the rounding of value_at and of its s. */
static double size_of(const imp_model *m)
{
    double sum = fabs(m->a);
    for (int j = 0; j < 3; ++j) sum += fabs(m->b[j]);
    for (int jk = 0; jk < 6; ++jk) sum += fabs(m->q[jk]);
    return sum;
}

static void judge(const expression_program *program, const double ends[3][2])
{
    imp_model given[3], out[3];
    const imp_region region = region_of(ends);
    for (int j = 0; j < 3; ++j) given[j] = imp_param(&region, j);
    expression_models(program, given, out);
    for (int k = 0; k < POINTS; ++k) {
        double s[3], p[3], x[3], error[3];
        for (int j = 0; j < 3; ++j) {
            p[j] = region.c[j] + region.d[j] * draw_s();
            if (!(p[j] >= region.lo[j] && p[j] <= region.hi[j])) p[j] = region.c[j];
            /* Take s from p as it was rounded: in a narrow box that shifts s by more than 2^-45. */
            s[j] = region.d[j] > 0 ? (p[j] - region.c[j]) / region.d[j] : 0;
        }
        if (expression_point(program, p, x, error) != IMP_STATUS_OK) continue;
        for (int i = 0; i < 3; ++i) {
            const double off = fabs(x[i] - value_at(&out[i], s));
            const double slack = error[i] + 0x1p-45 * size_of(&out[i]) + 0x1p-1000;
            FUZZ_REQUIRE(!(x[i] + slack < out[i].lo) && !(x[i] - slack > out[i].hi));
            if (isfinite(size_of(&out[i])) && isfinite(out[i].e))
                FUZZ_REQUIRE(!(off > out[i].e + slack));
        }
    }
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    char *text = strndup((const char *)bytes, length);
    if (text == NULL) return 0;
    imp_model whole[3];
    const imp_region all = region_of((const double[3][2]){{-8, 8}, {-8, 8}, {-8, 8}});
    for (int j = 0; j < 3; ++j) whole[j] = imp_param(&all, j);
    const expression_scope scope = {.variable = variables, .whole = whole, .variable_count = 3};
    const char *const texts[3] = {text, "v", "t"};
    expression_program *program = NULL;
    expression_error error;
    char fault[240];
    const imp_status status = expression_compile(&scope, texts, &program, &error);
    formula *proof = formula_read(&(formula_scope){.variables = "uvt"}, texts, fault, sizeof fault);
    random_state = length;
    if (status == IMP_STATUS_OK) {
        FUZZ_REQUIRE(proof != NULL);
        for (size_t k = 0; k < sizeof boxes / sizeof *boxes; ++k) judge(program, boxes[k]);
        expression_free(program);
    }
    formula_free(proof);
    free(text);
    return 0;
}

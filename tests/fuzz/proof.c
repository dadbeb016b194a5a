/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "plugins/expression/expression.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_mutate.h"
#include "tools/proof/formula.h"

#include <math.h>
#include <string.h>

/* The checker's reader takes or refuses any three texts; what it says of a box holds for points of
 * it: values and slopes, as the language of formulas evaluates them, which shares no code with it.
 * The texts are the input's first three lines; where a line is missing, "v" and "t". And the input
 * as a whole may be a text in parts, as types state it. */

const char fuzz_target[] = "proof";

FUZZ_MUTATE_TEXT

enum { POINTS = 12, CONSTANTS = 3 };
static const char *const variables[3] = {"u", "v", "t"};
static const char *const constant_names[CONSTANTS] = {"radius", "center0", "q"};
static const double constant_values[CONSTANTS] = {0.5, -2, 1e-3};

static const double boxes[][3][2] = {
    {{0.25, 0.25}, {-1, -1}, {0.5, 0.5}},
    {{0.5, 0.5 + 0x1p-20}, {0.25, 0.375}, {0, 0}},
    {{0, 1}, {0, 1}, {0, 1}},
    {{-3, 5}, {-0.001, 2}, {-1, 1}},
};

static uint64_t random_state;

static double draw(const double ends[2])
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    const unsigned kind = (unsigned)(random_state >> 61);
    const double s = (double)(random_state >> 11) * 0x1p-53;
    const double x = kind < 2 ? ends[kind] : ends[0] + s * (ends[1] - ends[0]);
    return x >= ends[0] && x <= ends[1] ? x : ends[0];
}

typedef struct point {
    double p[3], x[3], error[3];
} point;

static bool draw_point(const expression_program *program, const double ends[3][2], point *at)
{
    for (int j = 0; j < 3; ++j) at->p[j] = draw(ends[j]);
    return expression_point(program, at->p, at->x, at->error) == IMP_STATUS_OK;
}

static void judge_value(const jet *f, double x, double error)
{
    const long double slack = (long double)error + 0x1p-1000L;
    FUZZ_REQUIRE(!((long double)x + slack < f->v.lo) && !((long double)x - slack > f->v.hi));
}

/* f(p) - f(q) = sum_j d_j (p_j - q_j) for slopes d_j of the box. */
static void judge_slopes(const jet *f, const point *p, const point *q, int i)
{
    ld_interval sum = ld_interval_of(0);
    for (int j = 0; j < 3; ++j) {
        const ld_interval step = ld_interval_sub(ld_interval_of(p->p[j]), ld_interval_of(q->p[j]));
        if (!ld_interval_is(step, 0)) sum = ld_interval_add(sum, ld_interval_mul(f->d[j], step));
    }
    const long double slack = (long double)p->error[i] + q->error[i] +
                              0x1p-60L * (fabsl(p->x[i]) + fabsl(q->x[i])) + 0x1p-1000L;
    const long double rise = (long double)p->x[i] - q->x[i];
    FUZZ_REQUIRE(!(rise + slack < sum.lo) && !(rise - slack > sum.hi));
}

static void judge(formula *proof, const expression_program *program, const double ends[3][2])
{
    jet given[3], out[3];
    for (int j = 0; j < 3; ++j)
        given[j] = jet_variable(3, j, ld_interval_make(ends[j][0], ends[j][1]));
    formula_jets(proof, given, out);
    point before, at;
    bool has_before = false;
    for (int k = 0; k < POINTS; ++k) {
        if (!draw_point(program, ends, &at)) continue;
        for (int i = 0; i < 3; ++i) {
            judge_value(&out[i], at.x[i], at.error[i]);
            if (has_before) judge_slopes(&out[i], &at, &before, i);
        }
        before = at, has_before = true;
    }
}

/* Whatever is taken is computed, also where the language of formulas is stricter. */
static void compute(formula *proof)
{
    for (size_t k = 0; k < sizeof boxes / sizeof *boxes; ++k) {
        jet given[3], out[3];
        for (int j = 0; j < 3; ++j)
            given[j] = jet_variable(3, j, ld_interval_make(boxes[k][j][0], boxes[k][j][1]));
        formula_jets(proof, given, out);
        for (int i = 0; i < 3; ++i) FUZZ_REQUIRE(out[i].v.lo <= out[i].v.hi);
    }
}

static expression_program *compile(const char *const texts[3])
{
    imp_model whole[3];
    imp_region all;
    for (int j = 0; j < 3; ++j) all.lo[j] = -8, all.hi[j] = 8, all.c[j] = 0, all.d[j] = 8;
    for (int j = 0; j < 3; ++j) whole[j] = imp_param(&all, j);
    const expression_scope scope = {.variable = variables,
                                    .whole = whole,
                                    .variable_count = 3,
                                    .constant = constant_names,
                                    .constant_value = constant_values,
                                    .constant_count = CONSTANTS};
    expression_program *program = NULL;
    expression_error error;
    return expression_compile(&scope, texts, &program, &error) == IMP_STATUS_OK ? program : NULL;
}

/* The whole input as a text of a type: whatever part is taken is computed, and its ranges are
 * numbers in order. */
static void read_parts(const formula_scope *scope, const char *text)
{
    char fault[240];
    formula_range range[BOX_DIMS];
    for (const char *at = text; at != NULL; at = formula_next_part(at)) {
        formula *part = formula_read_part(scope, at, range, fault, sizeof fault);
        FUZZ_REQUIRE((part == NULL) == (fault[0] != '\0'));
        for (int j = 0; j < BOX_DIMS && part != NULL; ++j)
            FUZZ_REQUIRE(!range[j].is_said || range[j].lo.lo <= range[j].hi.hi);
        if (part != NULL) compute(part);
        formula_free(part);
        if (part == NULL) return;
    }
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    char *text = strndup((const char *)bytes, length);
    if (text == NULL) return 0;
    const formula_scope scope = {"uvt", CONSTANTS, constant_names, constant_values};
    read_parts(&scope, text);
    const char *texts[3] = {text, "v", "t"};
    char *next = text;
    for (int i = 1; i < 3 && (next = strchr(next, '\n')) != NULL; ++i) {
        *next++ = '\0';
        texts[i] = next;
    }
    char fault[240] = "";
    formula *proof = formula_read(&scope, texts, fault, sizeof fault);
    FUZZ_REQUIRE((proof == NULL) == (fault[0] != '\0'));
    if (proof != NULL) {
        compute(proof);
        expression_program *program = compile(texts);
        random_state = length;
        for (size_t k = 0; program != NULL && k < sizeof boxes / sizeof *boxes; ++k)
            judge(proof, program, boxes[k]);
        expression_free(program);
    }
    formula_free(proof);
    free(text);
    return 0;
}

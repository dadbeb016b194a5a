/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/check/heap_growth.h"
#include "tools/check/values.h"
#include "tools/cli/catalogue.h"

/* --- Trying values ---------------------------------------------------------------------------- */

typedef struct trial {
    imp_registry *registry;
    const imp_type_info *type;
    const char *text;
    check_answer *answer;
    bool tries_points; /* of accepted instances */
} trial;

/* Creates the instance and destroys it again; the status of create. */
static imp_code try_stage(const trial *t, const char *stage, imp_error *error)
{
    imp_instance made;
    const imp_code code =
        subject_create(t->registry, t->type->kind, stage, &made, error, t->answer);
    if (code == IMP_SUCCESS) subject_destroy(&made, stage, t->answer);
    ++t->answer->tests;
    return code;
}

/* An accepted instance has points, unless it has no domain here. False, and the check fails, if
 * not. */
static bool has_points(const trial *t, const char *stage)
{
    imp_instance made;
    imp_error error;
    subject s;
    uint64_t random = draw_stream(1, "points", "");
    if (subject_create(t->registry, t->type->kind, stage, &made, &error, t->answer) != IMP_SUCCESS)
        return true;
    bool sane = subject_make(&s, &made, &made, 0, t->answer);
    for (int k = 0; k < 16 && sane; ++k) {
        double p[BOX_DIMS], x[3], error_of[3];
        draw_point(&random, &s.domain, s.n, p);
        sane = subject_eval_sane(&s, 1, p, x, error_of);
    }
    subject_destroy(&made, stage, t->answer);
    return sane;
}

/* Accepted, or rejected as an error of the user, not of the plugin. */
static bool is_handled(const trial *t, const char *parameter, const char *value)
{
    imp_error error;
    char *stage = stage_with(t->registry, t->type->kind, t->text, parameter, value);
    const imp_code code = stage != NULL ? try_stage(t, stage, &error) : IMP_ERROR_MEMORY;
    if (code != IMP_SUCCESS && code != IMP_ERROR_SCENE)
        answer_fail(t->answer, "%s=%.80s: %s", parameter, value, error.text);
    if (code == IMP_SUCCESS && t->tries_points && !has_points(t, stage)) {
        char words[200];
        snprintf(words, sizeof words, "create accepts %s=%.80s", parameter, value);
        answer_prefix(t->answer, words);
    }
    free(stage);
    return t->answer->verdict != CHECK_FAIL;
}

static bool is_refused(const trial *t, const char *parameter, const char *value)
{
    imp_error error;
    char *stage = stage_with(t->registry, t->type->kind, t->text, parameter, value);
    const imp_code code = stage != NULL ? try_stage(t, stage, &error) : IMP_ERROR_MEMORY;
    free(stage);
    if (code == IMP_ERROR_SCENE) return true;
    if (code == IMP_SUCCESS)
        return answer_fail(t->answer, "%s=%.80s is accepted, though it is not allowed", parameter,
                           value);
    return answer_fail(t->answer, "%s=%.80s: %s", parameter, value, error.text);
}

/* --- Values as text --------------------------------------------------------------------------- */

enum { VALUE_TEXT = 4096 };

/* An array of the row's shape, filled with the number; false where its extents are free or many. */
static bool fill(const imp_parameter *p, uint32_t depth, const char *number, char *to, size_t size)
{
    size_t used = strlen(to);
    if (depth == p->rank)
        return (size_t)snprintf(to + used, size - used, "%s", number) < size - used;
    if (p->extent[depth] == 0 && !(p->flags & IMP_PARAMETER_SCALAR_OK)) return false;
    const uint32_t count = p->extent[depth] != 0 ? p->extent[depth] : 1;
    for (uint32_t k = 0; k < count; ++k) {
        used = strlen(to);
        if (used + 2 >= size) return false;
        strcat(to, k == 0 ? "[" : ",");
        if (!fill(p, depth + 1, number, to, size - 1)) return false;
    }
    strcat(to, "]");
    return true;
}

typedef bool judge_value(const trial *t, const char *parameter, const char *value);

static bool try_text(const trial *t, const imp_parameter *p, const char *text, judge_value *judge)
{
    char value[VALUE_TEXT] = "";
    return !fill(p, 0, text, value, sizeof value) || judge(t, p->name, value);
}

static bool try_number(const trial *t, const imp_parameter *p, double number, judge_value *judge)
{
    char text[40];
    snprintf(text, sizeof text, "%.17g", number);
    return try_text(t, p, text, judge);
}

/* --- Rows ------------------------------------------------------------------------------------- */

/* The last number on this side of the row's range, and the first beyond it. */
static bool try_end(const trial *t, const imp_parameter *p, double end, bool open, double outwards)
{
    if (!isfinite(end)) return true;
    const double step =
        p->kind == IMP_KIND_INTEGER ? end + (outwards > 0 ? 1 : -1) : nextafter(end, outwards);
    const double inwards =
        p->kind == IMP_KIND_INTEGER ? end - (outwards > 0 ? 1 : -1) : nextafter(end, -outwards);
    const double last = open ? inwards : end, beyond = open ? end : step;
    if (last >= p->min && last <= p->max && !try_number(t, p, last, is_handled)) return false;
    return !isfinite(beyond) || try_number(t, p, beyond, is_refused);
}

static bool try_row(const trial *t, const imp_parameter *p)
{
    static const char *const nonsense[] = {"NaN", "-NaN", "Infinity", "1e999", "{}", "null"};
    if (p->kind == IMP_KIND_STRING) return true; /* nearly every text is one */
    if (p->kind != IMP_KIND_NUMBER && p->kind != IMP_KIND_INTEGER)
        return is_refused(t, p->name, "[[[[1]]]]");
    for (size_t k = 0; k < sizeof nonsense / sizeof *nonsense; ++k)
        if (!try_text(t, p, nonsense[k], is_refused)) return false;
    if (p->kind == IMP_KIND_INTEGER && !try_text(t, p, "1.5", is_refused)) return false;
    return try_end(t, p, p->min, (p->flags & IMP_PARAMETER_MIN_OPEN) != 0, -INFINITY) &&
           try_end(t, p, p->max, (p->flags & IMP_PARAMETER_MAX_OPEN) != 0, INFINITY);
}

void parameters_check(imp_registry *registry, const imp_type_info *type, const char *text,
                      check_answer *answer)
{
    trial t = {registry, type, text, answer, false};
    imp_error error;
    if (try_stage(&t, text, &error) != IMP_SUCCESS) {
        answer_fail(answer, "'%.300s' does not work: %s", text, error.text);
        return;
    }
    t.tries_points = has_points(&t, text);
    if (answer->verdict == CHECK_FAIL)
        answer_forget(answer); /* the check of that name reports it */
    if (!is_refused(&t, "no_such_parameter", "1")) return;
    for (size_t k = 0; k < type->parameter_count; ++k)
        if (!try_row(&t, catalogue_parameter(type, k))) return;
    answer_pass(answer, "%llu values of %zu parameter%s are accepted or rejected as they should be",
                (unsigned long long)answer->tests, type->parameter_count,
                type->parameter_count == 1 ? "" : "s");
}

/* --- Memory ----------------------------------------------------------------------------------- */

enum { ROUNDS = 256, REFUSED_ROUNDS = 64 };

/* Lives of an instance, for heap_growth_lower: false if it is impossible. */
static bool one_life(const void *of)
{
    const trial *t = of;
    imp_instance i;
    imp_error error;
    subject s;
    double rate[3][BOX_DIMS], x[3], e[3];
    if (subject_create(t->registry, t->type->kind, t->text, &i, &error, t->answer) != IMP_SUCCESS)
        return answer_fail(t->answer, "'%.300s' does not work: %s", t->text, error.text);
    if (subject_make(&s, &i, &i, 0, t->answer)) {
        subject_eval(&s, 1, s.domain.lo, x, e);
        subject_rate(&s, &s.domain, rate);
    }
    subject_destroy(&i, t->text, t->answer);
    return t->answer->verdict != CHECK_FAIL;
}

/* Any result of create is accepted. */
static bool one_try(const void *of)
{
    const trial *t = of;
    imp_error error;
    try_stage(t, t->text, &error);
    return true;
}

/* --- Memory of rejected values ---------------------------------------------------------------- */

/* False, and the answer fails, if creates of the stage with that value leave memory behind. create
 * may reject what the table allows. */
static bool is_let_go(const trial *t, const char *parameter, const char *value)
{
    trial other = *t;
    char *stage = stage_with(t->registry, t->type->kind, t->text, parameter, value);
    if (stage == NULL) return answer_fail(t->answer, "memory ran out");
    other.text = stage;
    const double grown = heap_growth_lower(one_try, &other, REFUSED_ROUNDS);
    free(stage);
    return grown < HEAP_BLOCK_LEAST * REFUSED_ROUNDS ||
           answer_fail(t->answer, "%d times %s=%.80s, rejected or destroyed, leak %.0f bytes",
                       REFUSED_ROUNDS, parameter, value, grown);
}

static bool refusals_are_let_go(const trial *t)
{
    static const char *const numbers[] = {"0", "1", "-1", "1e6", "1e300"};
    for (size_t k = 0; k < t->type->parameter_count; ++k) {
        const imp_parameter *p = catalogue_parameter(t->type, k);
        const bool is_number = p->kind == IMP_KIND_NUMBER || p->kind == IMP_KIND_INTEGER;
        if (p->kind == IMP_KIND_STRING && p->rank == 0 && !is_let_go(t, p->name, "\"(\""))
            return false;
        for (size_t n = 0; is_number && n < sizeof numbers / sizeof *numbers; ++n)
            if (!try_text(t, p, numbers[n], is_let_go)) return false;
    }
    return true;
}

void memory_check(imp_registry *registry, const imp_type_info *type, const char *text,
                  check_answer *answer)
{
    const trial t = {registry, type, text, answer, false};
    const double grown = heap_growth_lower(one_life, &t, ROUNDS);
    answer->tests += ROUNDS;
    if (grown < 0)
        answer_skip(answer, "this system's malloc does not report how much is in use");
    else if (grown >= HEAP_BLOCK_LEAST * ROUNDS)
        answer_fail(answer, "%d instances, created, used and destroyed, leak %.0f bytes", ROUNDS,
                    grown);
    else if (refusals_are_let_go(&t))
        answer_pass(answer,
                    "instances and refusals free all their memory, as far as malloc reports");
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/formulas.h"

#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/check/own_formula.h"
#include "tools/check/values.h"
#include "tools/cli/catalogue.h"

enum {
    VARIATIONS = 8,     /* instances with other numbers */
    PIECES = 4,         /* of an instance, at random, beside the first and the last */
    POINTS = 160,       /* of an instance or piece */
    PARTS_SAMPLED = 64, /* parts in which points are chosen, beside those of the whole domain */
    POINTS_OF_PART = 3
};

/* What is compared, and what was found so far. */
typedef struct comparison {
    const subject *s;
    const own_formula *f;
    uint64_t *random;
    uint64_t *values, *proved, *parts; /* counts of all instances */
} comparison;

static const char *variables_of(const subject *s) { return s->n == 3 ? "uvt" : "xyzt"; }

/* --- Values ----------------------------------------------------------------------------------- */

static double size_of(const subject *s, int j)
{
    return fabs(s->domain.lo[j]) + fabs(s->domain.hi[j]);
}

static bool holds(const comparison *c, const own_part *part, const double *p)
{
    for (int j = 0; j < c->s->n; ++j)
        if (!own_range_holds(&part->range[j], p[j], size_of(c->s, j))) return false;
    return true;
}

static bool compare_value(const comparison *c, int i, ld_interval value, const double *p, double x,
                          double error)
{
    const ld_interval off = ld_interval_abs(ld_interval_sub(value, ld_interval_of(x)));
    *c->values += 1;
    *c->proved += off.hi <= error;
    c->s->answer->tests += 1;
    return off.lo <= error ||
           answer_fail(c->s->answer,
                       "eval gives %c = %.17g with the error %.9g at %s, but by the type's formula "
                       "it is surely %.9Lg off",
                       "xyz"[i], x, error, subject_point_text(c->s->n, p).text, off.lo);
}

static bool compare_part(const comparison *c, const own_part *part, const double *p,
                         const double x[3], const double error[3])
{
    jet variables[BOX_DIMS], value[3];
    fesetround(FE_TONEAREST); /* another check reports a plugin that changes it */
    for (int j = 0; j < c->s->n; ++j) variables[j] = jet_constant(0, ld_interval_of(p[j]));
    formula_jets(part->f, variables, value);
    for (int i = 0; i < 3; ++i)
        if (!compare_value(c, i, value[i].v, p, x[i], error[i])) return false;
    return true;
}

/* The point lies in the domain, so in some part. */
static bool compare_point(const comparison *c, const double *p)
{
    double x[3], error[3];
    size_t found = 0;
    if (!subject_eval_sane(c->s, 1, p, x, error)) return c->s->answer->verdict != CHECK_FAIL;
    for (size_t k = 0; k < c->f->count; ++k) {
        if (!holds(c, &c->f->parts[k], p)) continue;
        ++found;
        if (!compare_part(c, &c->f->parts[k], p, x, error)) return false;
    }
    return found > 0 || answer_fail(c->s->answer, "no part of the type's formula holds for %s",
                                    subject_point_text(c->s->n, p).text);
}

/* --- Ranges ----------------------------------------------------------------------------------- */

/* All parts together. False: some part does not say it, so that it is all numbers. */
static bool joined_range(const own_formula *f, int j, long double *lo, long double *hi)
{
    *lo = INFINITY, *hi = -INFINITY;
    for (size_t k = 0; k < f->count; ++k) {
        const formula_range *r = &f->parts[k].range[j];
        if (!r->is_said) return false;
        *lo = fminl(*lo, r->lo.lo);
        *hi = fmaxl(*hi, r->hi.hi);
    }
    return true;
}

static bool is_near(long double said, double end, double size)
{
    return said == end || fabsl(said - end) <= own_end_slack(size);
}

/* Space is not restricted for maps; times may be infinite. */
static bool compare_ranges(const comparison *c)
{
    const subject *s = c->s;
    for (int j = s->n == 3 ? 0 : 3; j < s->n; ++j) {
        const bool is_time = j == s->n - 1;
        const double from = is_time ? s->ends[0] : s->domain.lo[j];
        const double to = is_time ? s->ends[1] : s->domain.hi[j];
        const double size = (isfinite(from) ? fabs(from) : 0) + (isfinite(to) ? fabs(to) : 0);
        long double lo = -INFINITY, hi = INFINITY;
        const bool is_said = joined_range(c->f, j, &lo, &hi);
        s->answer->tests += 1;
        if (!is_said && !is_time)
            return answer_fail(s->answer, "the type's formula does not say the range of %c",
                               variables_of(s)[j]);
        if (!is_said) lo = -INFINITY, hi = INFINITY;
        if (!is_near(lo, from, size) || !is_near(hi, to, size))
            return answer_fail(s->answer,
                               "by the type's formula %c is in [%.17Lg, %.17Lg], but the domain "
                               "is [%.17g, %.17g]",
                               variables_of(s)[j], lo, hi, from, to);
    }
    return true;
}

/* --- Instances -------------------------------------------------------------------------------- */

static bool compare_points(const comparison *c)
{
    double p[BOX_DIMS];
    for (int k = 0; k < POINTS; ++k) {
        draw_point(c->random, &c->s->domain, c->s->n, p);
        if (!compare_point(c, p)) return false;
    }
    const size_t sampled = c->f->count < PARTS_SAMPLED ? c->f->count : PARTS_SAMPLED;
    for (size_t k = 0; k < sampled; ++k) {
        const box where = own_part_box(&c->f->parts[k * c->f->count / sampled], c->s);
        for (int i = 0; i < POINTS_OF_PART; ++i) {
            draw_point(c->random, &where, c->s->n, p);
            if (!compare_point(c, p)) return false;
        }
    }
    return true;
}

/* Piece k of an instance, or the instance. False: stop. */
static bool compare_piece(comparison *c, imp_registry *registry, const imp_type_info *type,
                          const char *stage, const imp_instance *made, size_t k,
                          check_answer *answer)
{
    char fault[480];
    subject s;
    if (!subject_make(&s, made, made, k, answer)) return false;
    own_formula f =
        own_formula_read(registry, type, stage, s.instance, answer, fault, sizeof fault);
    if (fault[0] != '\0') return answer_fail(answer, "the type's formula: %s", fault);
    c->s = &s;
    c->f = &f;
    *c->parts += f.count;
    const bool good = f.count == 0 || (compare_ranges(c) && compare_points(c));
    own_formula_free(&f);
    return good;
}

static bool compare_instance(comparison *c, imp_registry *registry, const imp_type_info *type,
                             const char *stage, const imp_instance *made, check_answer *answer)
{
    const size_t count = subject_piece_count(made, answer);
    bool good = compare_piece(c, registry, type, stage, made, 0, answer);
    if (good && count > 1) good = compare_piece(c, registry, type, stage, made, count - 1, answer);
    for (int k = 0; k < PIECES && good && count > 2; ++k)
        good = compare_piece(c, registry, type, stage, made, draw_index(c->random, count), answer);
    return good;
}

/* --- Other numbers ---------------------------------------------------------------------------- */

/* Numbers of any depth, near those given. */
static json_t *varied(const json_t *value, uint64_t *random)
{
    if (json_is_array(value)) {
        json_t *list = json_array();
        for (size_t k = 0; k < json_array_size(value); ++k)
            json_array_append_new(list, varied(json_array_get(value, k), random));
        return list;
    }
    if (!json_is_number(value)) return json_deep_copy(value);
    const double x = json_number_value(value), way = random_between(random, -0.25, 0.25);
    return json_real(x == 0 ? way : x * (1 + way));
}

/* Returns the stage with other numbers; of booleans, perhaps, the other. NULL: it has none. */
static char *varied_stage(const imp_registry *registry, const imp_type_info *type,
                          const char *stage, uint64_t *random)
{
    json_t *values = stage_values(registry, type->kind, stage);
    for (size_t k = 0; k < type->parameter_count && values != NULL; ++k) {
        const imp_parameter *row = catalogue_parameter(type, k);
        json_t *value = stage_value(values, row);
        if (value != NULL && row->kind == IMP_KIND_NUMBER)
            json_object_set_new(values, row->name, varied(value, random));
        else if (json_is_boolean(value) && random_bits(random) % 2 == 0)
            json_object_set_new(values, row->name, json_boolean(!json_is_true(value)));
        json_decref(value);
    }
    char *text = values != NULL ? stage_print(values) : NULL;
    json_decref(values);
    return text;
}

/* Numbers that create rejects are of no interest. */
static bool compare_variation(comparison *c, imp_registry *registry, const imp_type_info *type,
                              const char *stage, check_answer *answer)
{
    imp_instance made = {NULL, NULL, NULL};
    imp_error error;
    bool good = true;
    char *text = varied_stage(registry, type, stage, c->random);
    if (text != NULL &&
        subject_create(registry, type->kind, text, &made, &error, answer) == IMP_SUCCESS) {
        good = compare_instance(c, registry, type, text, &made, answer);
        if (!good) answer_prefix(answer, text);
        subject_destroy(&made, text, answer);
    }
    free(text);
    return good;
}

void formula_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                   check_answer *answer)
{
    uint64_t random = draw_stream(1, "formula", stage), values = 0, proved = 0, parts = 0;
    comparison c = {.random = &random, .values = &values, .proved = &proved, .parts = &parts};
    imp_instance made = {NULL, NULL, NULL};
    imp_error error;
    if (subject_create(registry, type->kind, stage, &made, &error, answer) != IMP_SUCCESS) {
        answer_fail(answer, "'%.300s' does not work: %s", stage, error.text);
        return;
    }
    bool good = compare_instance(&c, registry, type, stage, &made, answer);
    for (int k = 0; k < VARIATIONS && good; ++k)
        good = compare_variation(&c, registry, type, stage, answer);
    subject_destroy(&made, stage, answer);
    if (!good) return;
    if (parts == 0)
        answer_skip(answer, "the type states no formula, or none with these parameters");
    else if (proved == 0)
        answer_fail(answer, "the type's formula has no bounded value at any point");
    else
        answer_pass(answer,
                    "%llu of %llu values of %llu parts are proved to be eval's within its error; "
                    "none differs",
                    (unsigned long long)proved, (unsigned long long)values,
                    (unsigned long long)parts);
}

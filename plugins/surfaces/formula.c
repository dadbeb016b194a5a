/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/expression/coil_surface.h"
#include "plugins/expression/text_form.h"
#include "plugins/expression/turned_surface.h"
#include "plugins/expression/type.h"

#include <impinge/formula.h>

enum { DOMAIN = TEXT_ROWS };

static const imp_parameter parameters[] = {
    [TEXT_X] = ROW_TEXT("x", "\"u\"", "x as a formula in u, v, t"),
    [TEXT_Y] = ROW_TEXT("y", "\"v\"", "y as a formula in u, v, t"),
    [TEXT_Z] = ROW_TEXT("z", "\"0\"", "z as a formula in u, v, t"),
    [CONSTANTS] = ROW_CONSTANTS("x, y and z"),
    [TIME] = ROW_TIME("[t0,t1]: times at which it exists; default: all times"),
    [DOMAIN] = IMP_ROW("domain", "1", "[[0,1],[0,1]]", 0, 2, 2, 2, -INFINITY, INFINITY,
                       "[[u0,u1],[v0,v1]]: ranges of u and v; x, y and z must be defined there; "
                       "numbers, no expressions: 6.283185307179586, not 2*pi"),
};

typedef struct formula_instance {
    expression_program *program;
    expression_program *section; /* of `coil` or `turned`, or NULL */
    char *text;                  /* what it prints */
    double lo[3], hi[3];
    text_kind kind;
    coil_surface coil; /* the one of both that `kind` names */
    turned_surface turned;
} formula_instance;

static imp_status read_domain(const imp_value *values, formula_instance *s, imp_create_error *why)
{
    const double *given = values[DOMAIN].number;
    for (int j = 0; j < 2; ++j) {
        s->lo[j] = given[2 * j];
        s->hi[j] = given[2 * j + 1];
        if (!(s->lo[j] <= s->hi[j]))
            return imp_reject(why, DOMAIN, j, "[%g,%g] ends before it begins", s->lo[j], s->hi[j]);
    }
    return read_time(values, TIME, &s->lo[2], &s->hi[2], why);
}

static imp_status compile(const imp_value *values, formula_instance *s, imp_create_error *why)
{
    static const char *const names[] = {"u", "v", "t"};
    imp_model whole[3];
    for (int j = 0; j < 3; ++j) whole[j] = whole_range(s->lo[j], s->hi[j], j);
    expression_scope scope = {.variable = names, .whole = whole, .variable_count = 3};
    text_form form = {.kind = TEXT_PLAIN};
    const imp_status status = compile_texts(values, &scope, &s->program, &form, &s->section, why);
    if (status != IMP_STATUS_OK) return status;
    s->kind = form.kind;
    s->coil.form = form.coil;
    s->turned.form = form.turned;
    return status;
}

static imp_status keep(const imp_value *values, formula_instance *s)
{
    s->text = keep_texts(write_surface_texts, values, s->lo, s->hi);
    if (s->text == NULL) {
        expression_free(s->program);
        expression_free(s->section);
        return IMP_STATUS_INTERNAL;
    }
    s->coil.radius = s->turned.section = s->section;
    if (s->kind == TEXT_COIL && !coil_surface_begin(&s->coil, s->lo, s->hi)) s->kind = TEXT_PLAIN;
    if (s->kind == TEXT_TURNED) turned_surface_begin(&s->turned, s->lo, s->hi);
    return IMP_STATUS_OK;
}

static imp_status formula_create(const imp_value *values, void **self, imp_create_error *why)
{
    formula_instance *s = malloc(sizeof *s);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    imp_status status = read_domain(values, s, why);
    if (status == IMP_STATUS_OK) status = compile(values, s, why);
    if (status == IMP_STATUS_OK) status = keep(values, s);
    if (status == IMP_STATUS_OK)
        *self = s;
    else
        free(s);
    return status;
}

static void formula_destroy(void *self)
{
    formula_instance *s = self;
    expression_free(s->program);
    expression_free(s->section);
    free(s->text);
    free(s);
}

static void formula_domain(const void *self, double lo[3], double hi[3])
{
    const formula_instance *s = self;
    memcpy(lo, s->lo, sizeof s->lo);
    memcpy(hi, s->hi, sizeof s->hi);
}

static void formula_models(const void *self, imp_model u, imp_model v, imp_model t,
                           imp_model out[3])
{
    const formula_instance *s = self;
    const imp_model variables[] = {u, v, t};
    expression_models(s->program, variables, out);
}
IMP_SURFACE_FORMULA(formula_models)

/* Points are evaluated directly, which is faster than with constant models. */
static imp_status formula_eval(const void *self, size_t n, const double *p, double *x,
                               double *error)
{
    return expression_points(((const formula_instance *)self)->program, n, p, x, error);
}

/* --- Coils and surfaces of revolution --------------------------------------------------------- */

static imp_model formula_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const formula_instance *s = self;
    const imp_model at[3] = {x, y, z};
    (void)t;
    return s->kind == TEXT_COIL ? coil_surface_gap(&s->coil, at)
                                : turned_surface_gap(&s->turned, at);
}
IMP_DISTANCE_FORMULA(formula_gap)

static imp_status formula_distance(const void *self, const imp_model point[4], imp_model *distance)
{
    const formula_instance *s = self;
    const bool is_round = s->kind == TEXT_TURNED && turned_surface_is_round(&s->turned);
    if (s->kind != TEXT_COIL && !is_round) return IMP_STATUS_UNBOUNDED;
    return formula_gap_distance(self, point, distance);
}

static imp_status formula_symmetry(const void *self, imp_symmetry *symmetry)
{
    const formula_instance *s = self;
    if (s->kind == TEXT_COIL) return coil_surface_symmetry(&s->coil, symmetry);
    return s->kind == TEXT_TURNED ? turned_surface_symmetry(&s->turned, symmetry)
                                  : IMP_STATUS_UNBOUNDED;
}

static imp_status formula_write_formula(const void *self, const imp_text_sink *to)
{
    imp_add_text(to, ((const formula_instance *)self)->text);
    return IMP_STATUS_OK;
}

static const imp_surface_type formula = {
    IMP_TYPE_FIELDS(imp_surface_type, "formula", formula, formula_destroy),
    .flags = IMP_FLAG_ABSENT_OUTSIDE_TIMES,
    .distance = formula_distance,
    .symmetry = formula_symmetry,
    .write_formula = formula_write_formula,
    .summary = "any surface, given by formulas",
    .equation = "(x, y, z), each a text in u, v, t with + - * / ^, pi, e, constants, and abs sqrt "
                "cbrt exp log sin cos tan asin acos atan atan2 sinh cosh tanh pow min max hypot "
                "clamp lerp copysign; no discontinuous functions; (R cos a, R sin a, Z), a of one "
                "of u and v, R and Z of the other, is known to be a surface of revolution",
    .source = NULL,
    .example = "formula x=cos(2*pi*u)*(1+a*sin(t)) y=sin(2*pi*u)*(1+a*sin(t)) z=v "
               "constants={\"a\":0.1}",
    .domain = formula_domain,
    .eval = formula_eval,
    .rate = formula_models_rate,
    .include = formula_models_include,
};

PUBLISH_SURFACE(formula);

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/expression/type.h"

#include <impinge/formula.h>

static const imp_parameter parameters[] = {
    [TEXT_X] = ROW_TEXT("x", "\"x\"", "new x as a formula in x, y, z, t"),
    [TEXT_Y] = ROW_TEXT("y", "\"y\"", "new y as a formula in x, y, z, t"),
    [TEXT_Z] = ROW_TEXT("z", "\"z\"", "new z as a formula in x, y, z, t"),
    [CONSTANTS] = ROW_CONSTANTS("x, y and z"),
    [TIME] = ROW_MAP_TIME,
};

typedef struct map_instance {
    expression_program *program;
    char *text;    /* what it prints */
    double lo, hi; /* times */
} map_instance;

/* Nothing is known about x, y and z before the map is applied to a surface. */
static imp_status compile(const imp_value *values, map_instance *s, imp_create_error *why)
{
    static const char *const names[] = {"x", "y", "z", "t"};
    imp_model whole[4];
    for (int j = 0; j < 3; ++j) whole[j] = imp_unbounded(7);
    whole[3] = whole_range(s->lo, s->hi, 2);
    expression_scope scope = {.variable = names, .whole = whole, .variable_count = 4};
    return compile_texts(values, &scope, &s->program, NULL, NULL, why);
}

static imp_status keep(const imp_value *values, map_instance *s)
{
    s->text = keep_texts(write_map_texts, values, &s->lo, &s->hi);
    if (s->text == NULL) expression_free(s->program);
    return s->text != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static imp_status map_create(const imp_value *values, void **self, imp_create_error *why)
{
    map_instance *s = malloc(sizeof *s);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    imp_status status = read_time(values, TIME, &s->lo, &s->hi, why);
    if (status == IMP_STATUS_OK) status = compile(values, s, why);
    if (status == IMP_STATUS_OK) status = keep(values, s);
    if (status == IMP_STATUS_OK)
        *self = s;
    else
        free(s);
    return status;
}

static void map_destroy(void *self)
{
    map_instance *s = self;
    expression_free(s->program);
    free(s->text);
    free(s);
}

static void map_time_domain(const void *self, double *lo, double *hi)
{
    const map_instance *s = self;
    *lo = s->lo, *hi = s->hi;
}

static void map_models(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                       imp_model out[3])
{
    const map_instance *s = self;
    const imp_model variables[] = {x, y, z, t};
    expression_models(s->program, variables, out);
}
IMP_MAP_FORMULA(map_models)

/* Points are evaluated directly, which is faster than with constant models. */
static imp_status map_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    return expression_points(((const map_instance *)self)->program, n, p, x, error);
}

static imp_status map_write_formula(const void *self, const imp_text_sink *to)
{
    imp_add_text(to, ((const map_instance *)self)->text);
    return IMP_STATUS_OK;
}

static const imp_map_type map_formula = {
    IMP_TYPE_FIELDS(imp_map_type, "map-formula", map, map_destroy),
    .write_formula = map_write_formula,
    .summary = "any motion or deformation, given by formulas; motion-formula is better where rigid",
    .equation = "(x, y, z) becomes three texts in x, y, z, t, in the language of the surface type "
                "formula; a text that is absent leaves its coordinate unchanged",
    .source = NULL,
    .example = "map-formula z=z+a*sin(k*x-t) constants={\"a\":0.1,\"k\":3}",
    .time_domain = map_time_domain,
    .eval = map_eval,
    .rate = map_models_rate,
    .apply = map_models_apply,
};

IMPINGE_MAP_PLUGIN("map-formula", PLUGIN_VERSION, "Apache-2.0", "The Impinge authors", map_formula);

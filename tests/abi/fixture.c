/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The source of fixture_1_0.so, a plugin built when the ABI was 1.0, which every later release must
 * load and ask with the same answers (tests/cli/sdk_abi.bats). It uses all that the ABI has: every
 * kind of parameter, types with and without include, maps with and without apply, both with and
 * without net, a map with a pose, a surface with distances. No libm, whose answers might change.
 * README beside this file says how it was built. */

#include <impinge/formula.h>
#include <stdlib.h>
#include <string.h>

#define SIZE_OF(TYPE) .struct_size = (uint32_t)sizeof(TYPE)
#define COUNT(TABLE) (uint32_t)(sizeof(TABLE) / sizeof((TABLE)[0]))

static int nothing;

static imp_status create_nothing(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)why;
    *self = &nothing;
    return IMP_STATUS_OK;
}

static void destroy_nothing(void *self) { (void)self; }

static void unit_square(const void *self, double lo[3], double hi[3])
{
    (void)self;
    lo[0] = lo[1] = 0, hi[0] = hi[1] = 1;
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

/* --- Every kind of parameter: the square, moved by what was given ----------------------------- */

enum { NUMBER, INTEGER, BOOLEAN, STRING, TABLE, VECTOR, POINTS, LIST, ABSENT };

static const imp_parameter kinds_table[] = {
    [NUMBER] = {"number",
                "length",
                "required",
                NULL,
                IMP_KIND_NUMBER,
                IMP_PARAMETER_MIN_OPEN | IMP_PARAMETER_MAX_OPEN,
                0,
                {0, 0, 0},
                0,
                10},
    [INTEGER] = {"integer", "1", "whole", "3", IMP_KIND_INTEGER, 0, 0, {0, 0, 0}, -5, 5},
    [BOOLEAN] = {"boolean",
                 "1",
                 "yes or no",
                 "true",
                 IMP_KIND_BOOLEAN,
                 0,
                 0,
                 {0, 0, 0},
                 -INFINITY,
                 INFINITY},
    [STRING] = {"string",
                "1",
                "not 'no'",
                "\"yes\"",
                IMP_KIND_STRING,
                0,
                0,
                {0, 0, 0},
                -INFINITY,
                INFINITY},
    [TABLE] = {"table",
               "1",
               "names to numbers",
               "{\"a\": 0.5}",
               IMP_KIND_TABLE,
               0,
               0,
               {0, 0, 0},
               -INFINITY,
               INFINITY},
    [VECTOR] = {"vector",
                "length",
                "three numbers",
                "[0, 0, 0]",
                IMP_KIND_NUMBER,
                0,
                1,
                {3, 0, 0},
                -INFINITY,
                INFINITY},
    [POINTS] = {"points",
                "length",
                "rows of three",
                "[[1, 2, 3]]",
                IMP_KIND_NUMBER,
                0,
                2,
                {0, 3, 0},
                -INFINITY,
                INFINITY},
    [LIST] = {"list",
              "1",
              "one or more",
              "0.25",
              IMP_KIND_NUMBER,
              IMP_PARAMETER_SCALAR_OK,
              1,
              {0, 0, 0},
              -INFINITY,
              INFINITY},
    [ABSENT] = {"absent",
                "1",
                "may be left out",
                NULL,
                IMP_KIND_NUMBER,
                IMP_PARAMETER_OPTIONAL,
                0,
                {0, 0, 0},
                -INFINITY,
                INFINITY},
};

static double sum_of(const imp_value *value)
{
    double sum = 0;
    for (size_t k = 0; k < value->count; ++k) sum += value->number[k];
    return sum;
}

/* How much the names weigh: letters of a text, or of a table's names. */
static double letters_of(const imp_value *value)
{
    double letters = 0;
    for (size_t k = 0; k < value->count; ++k) letters += (double)strlen(value->string[k]);
    return letters;
}

static imp_status kinds_create(const imp_value *values, void **self, imp_create_error *why)
{
    if (strcmp(values[STRING].string[0], "no") == 0) {
        why->parameter = STRING;
        strcpy(why->text, "found 'no', allowed is every other text");
        return IMP_STATUS_PARAMETER;
    }
    double *moved = malloc(3 * sizeof *moved);
    if (moved == NULL) return IMP_STATUS_INTERNAL;
    moved[0] = sum_of(&values[NUMBER]) + sum_of(&values[VECTOR]) + 100 * sum_of(&values[INTEGER]);
    moved[1] = sum_of(&values[POINTS]) + (double)values[POINTS].extent[0] + sum_of(&values[LIST]);
    moved[2] = sum_of(&values[BOOLEAN]) + letters_of(&values[STRING]) + letters_of(&values[TABLE]) +
               sum_of(&values[TABLE]) + 1000 * (double)values[ABSENT].count;
    *self = moved;
    return IMP_STATUS_OK;
}

static imp_status kinds_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const double *moved = self;
    for (size_t k = 0; k < 3 * n; ++k) {
        x[k] = moved[k % 3] + (k % 3 < 2 ? p[k] : 0);
        if (error != NULL) error[k] = 0x1p-52 * fabs(x[k]);
    }
    return IMP_STATUS_OK;
}

static imp_status kinds_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    (void)self, (void)region;
    *rates = (imp_rate_matrix){{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}};
    return IMP_STATUS_OK;
}

static const imp_surface_type kinds = {
    SIZE_OF(imp_surface_type),
    .parameter_count = COUNT(kinds_table),
    .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "fixture_kinds",
    .summary = "a square with every kind of parameter",
    .equation = "(u, v, 0) moved by the parameters",
    .source = "nowhere",
    .example = "fixture_kinds number=1",
    .parameters = kinds_table,
    .create = kinds_create,
    .destroy = free,
    .domain = unit_square,
    .eval = kinds_eval,
    .rate = kinds_rate,
};

/* --- A formula, with include ------------------------------------------------------------------ */

static void sheet_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    (void)self;
    imp_model bump = imp_div(imp_num(1), imp_shift(imp_add(imp_sqr(u), imp_sqr(v)), 1));
    out[0] = u;
    out[1] = v;
    out[2] = imp_add(imp_mul(bump, imp_scale(t, 0.75)), imp_mul(u, v));
}
IMP_SURFACE_FORMULA(sheet_formula)

static const imp_surface_type sheet = {
    SIZE_OF(imp_surface_type),
    .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "fixture_sheet",
    .summary = "a sheet that swells",
    .equation = "(u, v, 0.75 t / (1 + u^2 + v^2) + u v)",
    .example = "fixture_sheet",
    .create = create_nothing,
    .destroy = destroy_nothing,
    .domain = unit_square,
    .eval = sheet_formula_eval,
    .rate = sheet_formula_rate,
    .include = sheet_formula_include,
};

/* --- Rates alone, and a time that ends -------------------------------------------------------- */

static void bare_domain(const void *self, double lo[3], double hi[3])
{
    unit_square(self, lo, hi);
    lo[2] = 0, hi[2] = 2;
}

static imp_status bare_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    (void)self;
    for (size_t k = 0; k < n; ++k) {
        const double *at = p + 3 * k;
        x[3 * k] = at[0], x[3 * k + 1] = at[1], x[3 * k + 2] = at[2] * (1 - at[0] * at[1]);
        if (error != NULL) error[3 * k] = error[3 * k + 1] = 0, error[3 * k + 2] = 0x1p-49;
    }
    return IMP_STATUS_OK;
}

static imp_status bare_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    (void)self;
    double t = region->hi[2];
    *rates = (imp_rate_matrix){{{1, 0, 0}, {0, 1, 0}, {t, t, 1}}};
    return t > 1.5 ? IMP_STATUS_UNBOUNDED : IMP_STATUS_OK;
}

/* Bilinear in u and v, linear in t. */
static imp_status bare_net(const void *self, const imp_region *region, imp_net *net)
{
    (void)self;
    net->degree[0] = net->degree[1] = net->is_moving = 1;
    for (int k = 0; k < 4; ++k) {
        const double u = k < 2 ? region->lo[0] : region->hi[0];
        const double v = k % 2 == 0 ? region->lo[1] : region->hi[1];
        net->point[0][k] = u, net->point[1][k] = v;
        net->velocity[2][k] = 1 - u * v;
        net->point[2][k] = region->c[2] * (1 - u * v);
    }
    net->error[2] = 0x1p-49;
    return IMP_STATUS_OK;
}

/* How far above z = t, which the surface never is. */
static imp_model bare_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    (void)self, (void)x, (void)y;
    return imp_max(imp_sub(z, t), imp_num(0));
}
IMP_DISTANCE_FORMULA(bare_gap)

static const imp_surface_type bare = {
    SIZE_OF(imp_surface_type),
    .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "fixture_bare",
    .summary = "a sheet without include",
    .equation = "(u, v, t (1 - u v)), t in [0,2]",
    .example = "fixture_bare",
    .create = create_nothing,
    .destroy = destroy_nothing,
    .domain = bare_domain,
    .eval = bare_eval,
    .rate = bare_rate,
    .net = bare_net,
    .distance = bare_gap_distance,
};

/* --- Maps, with and without apply ------------------------------------------------------------- */

static void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static void lean_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                         imp_model out[3])
{
    (void)self;
    out[0] = imp_add(x, imp_mul(z, t));
    out[1] = imp_sub(y, imp_num(0.5));
    out[2] = imp_neg(z);
}
IMP_MAP_FORMULA(lean_formula)

static const imp_map_type lean = {
    SIZE_OF(imp_map_type),
    .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "fixture_lean",
    .summary = "leans more and more, and hangs upside down",
    .equation = "(x + z t, y - 0.5, -z)",
    .example = "fixture_lean",
    .create = create_nothing,
    .destroy = destroy_nothing,
    .time_domain = always,
    .eval = lean_formula_eval,
    .rate = lean_formula_rate,
    .apply = lean_formula_apply,
};

static imp_status rise_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    (void)self;
    for (size_t k = 0; k < n; ++k) {
        memcpy(x + 3 * k, p + 4 * k, 3 * sizeof *x);
        x[3 * k + 2] += p[4 * k + 3];
        for (int i = 0; error != NULL && i < 3; ++i)
            error[3 * k + (size_t)i] = i < 2 ? 0 : 0x1p-52 * fabs(x[3 * k + 2]);
    }
    return IMP_STATUS_OK;
}

static imp_status rise_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    (void)self, (void)box;
    *rates = (imp_map_rates){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 1}}};
    return IMP_STATUS_OK;
}

static imp_status rise_net(const void *self, const imp_region *region, imp_net *net)
{
    (void)self;
    net->place[2] += region->c[2];
    net->drift[2] += 1;
    net->error[2] += 0x1p-52 * (fabs(net->place[2]) + fabs(net->drift[2]) * region->d[2]);
    return IMP_STATUS_OK;
}

static imp_status rise_rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    (void)self;
    imp_pose_at_rest(pose);
    pose->shift[2] = *t;
    return imp_pose_status(pose);
}

static const imp_map_type rise = {
    SIZE_OF(imp_map_type),       .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "fixture_rise",      .summary = "rises, without apply",
    .equation = "(x, y, z + t)", .example = "fixture_rise",
    .create = create_nothing,    .destroy = destroy_nothing,
    .time_domain = always,       .eval = rise_eval,
    .rate = rise_rate,           .net = rise_net,
    .rigid = rise_rigid,
};

/* --- The plugin ------------------------------------------------------------------------------- */

static const imp_surface_type *const surfaces[] = {&kinds, &sheet, &bare};
static const imp_map_type *const maps[] = {&lean, &rise};
static const imp_surface_factory surface_factory = {SIZE_OF(imp_surface_factory), COUNT(surfaces),
                                                    surfaces};
static const imp_map_factory map_factory = {SIZE_OF(imp_map_factory), COUNT(maps), maps};

static const void *get_factory(const char *id)
{
    if (strcmp(id, IMP_SURFACE_FACTORY) == 0) return &surface_factory;
    if (strcmp(id, IMP_MAP_FACTORY) == 0) return &map_factory;
    return NULL;
}

IMPINGE_PLUGIN("fixture", "1.0", "Apache-2.0", "The Impinge authors", get_factory);

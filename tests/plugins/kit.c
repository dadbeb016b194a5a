/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <stdlib.h>
#include <string.h>

#include "tiny.h"

/* No sin: a surface with a parameter of every kind and shape, which keeps what it was given and
 * shows the first of it as its point, and a map. `mood` asks create for complaints. */

enum { RADIUS, CENTER, POINTS, COUNT, CLOSED, LABEL, CONSTANTS, WEIGHTS, MOOD, ROWS };

static const imp_parameter surface_table[ROWS] = {
    [RADIUS] = {.name = "radius",
                .unit = "length",
                .doc = "required, open below",
                .kind = IMP_KIND_NUMBER,
                .flags = IMP_PARAMETER_MIN_OPEN,
                .min = 0,
                .max = INFINITY},
    [CENTER] = {.name = "center",
                .unit = "length",
                .doc = "a vector",
                .default_value = "[0, 0, 0]",
                .kind = IMP_KIND_NUMBER,
                .rank = 1,
                .extent = {3},
                .min = -INFINITY,
                .max = INFINITY},
    [POINTS] = {.name = "points",
                .unit = "length",
                .doc = "a list of points",
                .kind = IMP_KIND_NUMBER,
                .flags = IMP_PARAMETER_OPTIONAL,
                .rank = 2,
                .extent = {0, 3},
                .min = -INFINITY,
                .max = INFINITY},
    [COUNT] = {.name = "count",
               .unit = "1",
               .doc = "an integer",
               .default_value = "3",
               .kind = IMP_KIND_INTEGER,
               .min = 1,
               .max = 9},
    [CLOSED] = {.name = "closed",
                .unit = "1",
                .doc = "a boolean",
                .default_value = "false",
                .kind = IMP_KIND_BOOLEAN,
                .min = -INFINITY,
                .max = INFINITY},
    [LABEL] = {.name = "label",
               .unit = "1",
               .doc = "a string",
               .default_value = "\"none\"",
               .kind = IMP_KIND_STRING,
               .min = -INFINITY,
               .max = INFINITY},
    [CONSTANTS] = {.name = "constants",
                   .unit = "1",
                   .doc = "a table",
                   .kind = IMP_KIND_TABLE,
                   .flags = IMP_PARAMETER_OPTIONAL,
                   .min = -INFINITY,
                   .max = INFINITY},
    [WEIGHTS] = {.name = "weights",
                 .unit = "1",
                 .doc = "one or more, in (0, 1]",
                 .default_value = "1",
                 .kind = IMP_KIND_NUMBER,
                 .flags = IMP_PARAMETER_MIN_OPEN | IMP_PARAMETER_SCALAR_OK,
                 .rank = 1,
                 .extent = {0},
                 .min = 0,
                 .max = 1},
    [MOOD] = {.name = "mood",
              .unit = "1",
              .doc = "good, or how to complain",
              .default_value = "\"good\"",
              .kind = IMP_KIND_STRING,
              .min = -INFINITY,
              .max = INFINITY},
};

typedef struct kit {
    double center[3];
} kit;

static imp_status complain(imp_create_error *why, int32_t parameter, int64_t element,
                           const char *text)
{
    why->parameter = parameter;
    why->element = element;
    strncpy(why->text, text, sizeof why->text - 1);
    return IMP_STATUS_PARAMETER;
}

static imp_status refuse(const char *mood, imp_create_error *why)
{
    if (strcmp(mood, "radius") == 0) return complain(why, RADIUS, -1, "got 1, must be 2");
    if (strcmp(mood, "point") == 0) return complain(why, POINTS, 1, "got a knot");
    if (strcmp(mood, "whole") == 0) return complain(why, -1, -1, "got nonsense");
    if (strcmp(mood, "beyond") == 0) return complain(why, 1234, 5678, "row 1234");
    if (strcmp(mood, "bell") == 0) return complain(why, LABEL, 99, "\a\xff");
    if (strcmp(mood, "silent") == 0) return IMP_STATUS_PARAMETER;
    return IMP_STATUS_INTERNAL;
}

static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    if (strcmp(values[MOOD].string[0], "good") != 0) return refuse(values[MOOD].string[0], why);
    kit *made = malloc(sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    memcpy(made->center, values[CENTER].number, sizeof made->center);
    *self = made;
    return IMP_STATUS_OK;
}

static void destroy(void *self) { free(self); }

static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const kit *made = self;
    tiny_eval(self, n, p, x, error);
    for (size_t k = 0; k < 3 * n; ++k) x[k] = made->center[k % 3];
    return IMP_STATUS_OK;
}

static const imp_surface_type kit_type = {
    .struct_size = sizeof kit_type,
    .parameter_count = ROWS,
    .parameter_size = sizeof(imp_parameter),
    .name = "kit",
    .summary = "a point",
    .equation = "center",
    .example = "kit radius=1",
    .parameters = surface_table,
    .create = create,
    .destroy = destroy,
    .domain = tiny_domain,
    .eval = eval,
    .rate = tiny_rate,
};

/* --- The map: (x, y, z) + by ------------------------------------------------------------------ */

static const imp_parameter map_table[] = {
    {.name = "by",
     .unit = "length",
     .doc = "a vector",
     .kind = IMP_KIND_NUMBER,
     .rank = 1,
     .extent = {3},
     .min = -INFINITY,
     .max = INFINITY},
};

static imp_status map_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    kit *made = malloc(sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    memcpy(made->center, values[0].number, sizeof made->center);
    *self = made;
    return IMP_STATUS_OK;
}

static void map_times(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY;
    *hi = INFINITY;
}

static imp_status map_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const kit *made = self;
    for (size_t k = 0; k < n; ++k)
        for (size_t i = 0; i < 3; ++i) x[3 * k + i] = p[4 * k + i] + made->center[i];
    for (size_t k = 0; error != NULL && k < 3 * n; ++k) error[k] = 0x1p-52 * fabs(x[k]);
    return IMP_STATUS_OK;
}

static imp_status map_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    (void)self, (void)box;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) rates->m[i][j] = i == j;
    return IMP_STATUS_OK;
}

static const imp_map_type nudge_type = {
    .struct_size = sizeof nudge_type,
    .parameter_count = 1,
    .parameter_size = sizeof(imp_parameter),
    .name = "nudge",
    .summary = "moved by a vector",
    .equation = "(x, y, z) + by",
    .example = "nudge by=1,0,0",
    .parameters = map_table,
    .create = map_create,
    .destroy = destroy,
    .time_domain = map_times,
    .eval = map_eval,
    .rate = map_rate,
};

static const imp_surface_type *const surfaces[] = {&kit_type};
static const imp_surface_factory surface_factory = {sizeof surface_factory, 1, surfaces};
static const imp_map_type *const maps[] = {&nudge_type};
static const imp_map_factory map_factory = {sizeof map_factory, 1, maps};

static const void *get_factory(const char *id)
{
    if (strcmp(id, IMP_SURFACE_FACTORY) == 0) return &surface_factory;
    if (strcmp(id, IMP_MAP_FACTORY) == 0) return &map_factory;
    return NULL;
}
IMPINGE_PLUGIN("kit", "1.0", "Apache-2.0", "tests", get_factory);

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PLUGIN_H
#define PLUGINS_PLUGIN_H

#include <config.h>

#include <impinge/surface.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What every plugin of this folder shares
 * =======================================
 * Each file is one surface type or one map: a parameter table, a struct with the values
 * copied in, create, the mathematics, and at the end the type and its publication:
 *
 *   static const imp_surface_type sphere = {
 *       SURFACE_CALLS(sphere, sphere_formula),
 *       .summary = "...", .equation = "...", .source = "...", .example = "...",
 *   };
 *   PUBLISH_SURFACE(sphere);
 *
 * Instances are one block of plain memory: create gets it from malloc, and destroy is free. */

#define COUNT_OF(array) ((uint32_t)(sizeof(array) / sizeof((array)[0])))

/* --- Rows of a parameter table --- */

/* Any finite number, and one that must be greater than 0. PRESET: JSON text, or NULL for
 * required. */
#define ROW_NUMBER(NAME, UNIT, PRESET, DOC)                                                        \
    {                                                                                              \
        .name = NAME, .unit = UNIT, .preset = PRESET, .doc = DOC, .kind = IMP_NUMBER,              \
        .min = -INFINITY, .max = INFINITY                                                          \
    }
#define ROW_POSITIVE(NAME, UNIT, PRESET, DOC)                                                      \
    {                                                                                              \
        .name = NAME, .unit = UNIT, .preset = PRESET, .doc = DOC, .kind = IMP_NUMBER,              \
        .flags = IMP_MIN_OPEN, .min = 0, .max = INFINITY                                           \
    }

/* Three numbers, any or greater than 0; FLAGS is 0 or IMP_OPTIONAL. */
#define ROW_VECTOR(NAME, UNIT, PRESET, FLAGS, DOC)                                                 \
    {                                                                                              \
        .name = NAME, .unit = UNIT, .preset = PRESET, .doc = DOC, .kind = IMP_NUMBER,              \
        .flags = FLAGS, .rank = 1, .extent = {3}, .min = -INFINITY, .max = INFINITY                \
    }
#define ROW_POSITIVE_VECTOR(NAME, UNIT, PRESET, DOC)                                               \
    {                                                                                              \
        .name = NAME, .unit = UNIT, .preset = PRESET, .doc = DOC, .kind = IMP_NUMBER,              \
        .flags = IMP_MIN_OPEN, .rank = 1, .extent = {3}, .min = 0, .max = INFINITY                 \
    }
#define ROW_CENTER ROW_VECTOR("center", "length", "[0,0,0]", 0, "centre of the surface")

/* Any number of vectors of WIDTH numbers. */
#define ROW_VECTORS(NAME, UNIT, PRESET, WIDTH, FLAGS, DOC)                                         \
    {                                                                                              \
        .name = NAME, .unit = UNIT, .preset = PRESET, .doc = DOC, .kind = IMP_NUMBER,              \
        .flags = FLAGS, .rank = 2, .extent = {0, WIDTH}, .min = -INFINITY, .max = INFINITY         \
    }

/* Any number of numbers. */
#define ROW_NUMBERS(NAME, UNIT, PRESET, FLAGS, DOC)                                                \
    {                                                                                              \
        .name = NAME, .unit = UNIT, .preset = PRESET, .doc = DOC, .kind = IMP_NUMBER,              \
        .flags = FLAGS, .rank = 1, .min = -INFINITY, .max = INFINITY                               \
    }

/* --- Reading values --- */

static inline bool is_given(const imp_value *value) { return value->count > 0; }

static inline void copy_vector(double to[3], const imp_value *value)
{
    memcpy(to, value->number, 3 * sizeof to[0]);
}

/* Says what is wrong with one element of one parameter, or with -1 for both with the whole, and
 * answers IMP_PARAMETER, so that create can return it. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5), unused))
#endif
static imp_status
complain(imp_complaint *why, int parameter, int64_t element, const char *format, ...)
{
    va_list arguments;
    why->parameter = parameter;
    why->element = element;
    va_start(arguments, format);
    vsnprintf(why->text, sizeof why->text, format, arguments);
    va_end(arguments);
    return IMP_PARAMETER;
}

/* --- Domains --- */

/* The least doubles above pi/2, pi and 2 pi: angles up to these surely reach all the way round. */
#define ABOVE_HALF_PI 0x1.921fb54442d19p+0
#define ABOVE_PI 0x1.921fb54442d19p+1
#define ABOVE_TWO_PI 0x1.921fb54442d19p+2

/* u and v as given; every time. */
static inline void set_domain(double lo[3], double hi[3], double u_lo, double u_hi, double v_lo,
                              double v_hi)
{
    lo[0] = u_lo, hi[0] = u_hi;
    lo[1] = v_lo, hi[1] = v_hi;
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

/* --- The type --- */

/* CALLS is what the names of the callbacks start with: TYPE, or TYPE_formula if they come from
 * IMP_SURFACE_FORMULA. DESTROY: what frees an instance of more than one block. */
#define SURFACE_CALLS_DESTROY(TYPE, CALLS, DESTROY)                                                \
    .struct_size = (uint32_t)sizeof(imp_surface_type), .parameter_count = COUNT_OF(parameters),    \
    .parameter_size = (uint32_t)sizeof(imp_parameter), .name = #TYPE, .parameters = parameters,    \
    .create = TYPE##_create, .destroy = DESTROY, .domain = TYPE##_domain, .eval = CALLS##_eval,    \
    .rate = CALLS##_rate, .include = CALLS##_include
#define SURFACE_CALLS(TYPE, CALLS) SURFACE_CALLS_DESTROY(TYPE, CALLS, free)

/* All but .rate, for which some maps have a better bound than their formula. */
#define MAP_CALLS(TYPE, CALLS)                                                                     \
    .struct_size = (uint32_t)sizeof(imp_map_type), .parameter_count = COUNT_OF(parameters),        \
    .parameter_size = (uint32_t)sizeof(imp_parameter), .name = #TYPE, .parameters = parameters,    \
    .create = TYPE##_create, .destroy = free, .time_domain = TYPE##_time_domain,                   \
    .eval = CALLS##_eval, .apply = CALLS##_apply

/* A map that is defined at all times. */
#define MAP_AT_ALL_TIMES(TYPE)                                                                     \
    static void TYPE##_time_domain(const void *self, double *lo, double *hi)                       \
    {                                                                                              \
        (void)self;                                                                                \
        *lo = -INFINITY, *hi = INFINITY;                                                           \
    }

#define PUBLISH_SURFACE(TYPE)                                                                      \
    IMPINGE_SURFACE_PLUGIN(#TYPE, PACKAGE_VERSION, "Apache-2.0", "The Impinge authors", TYPE)
#define PUBLISH_MAP(TYPE)                                                                          \
    IMPINGE_MAP_PLUGIN(#TYPE, PACKAGE_VERSION, "Apache-2.0", "The Impinge authors", TYPE)

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_PLUGIN_H
#define IMPINGE_PLUGIN_H

#include <impinge/interval.h>
#include <impinge/surface.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Short plugins
 * =============
 *
 * Macros and functions for what most types have in common, so that a source file is short: a table
 * of parameters, a struct with their values, create, a domain, a formula, and the type. All of
 * Impinge's own types use them.
 *
 *   static const imp_parameter parameters[] = {
 *       [RADIUS] = IMP_ROW_POSITIVE("radius", "length", "1", "radius at rest"),
 *   };
 *   static imp_status ball_create(const imp_value *values, void **self, imp_create_error *why);
 *   static void ball_domain(const void *self, double lo[3], double hi[3]);
 *   static void ball_formula(const void *self, imp_model u, imp_model v, imp_model t,
 *                            imp_model out[3]);
 *   IMP_SURFACE_FORMULA(ball_formula)
 *
 *   static const imp_surface_type ball = {
 *       IMP_SURFACE_FIELDS(ball, ball_formula),
 *       .summary = "...", .equation = "...", .source = "...", .example = "...",
 *   };
 *   IMPINGE_SURFACE_PLUGIN("ball", "1.0", "MIT", "your name", ball);
 *
 * In C++17 everything but IMP_..._FIELDS works alike; IMP_SURFACE_VALUE and IMP_MAP_VALUE stand in
 * for those. <impinge/model.hpp> makes a type of a class or of a lambda. */

/* --- Rows of a parameter table ---------------------------------------------------------------
 *
 * NAME, UNIT, DOC: as in imp_parameter. DEFAULT: JSON text, or NULL for a parameter that must be
 * given. FLAGS: 0, or IMP_PARAMETER_OPTIONAL with a DEFAULT of NULL, or others of
 * IMP_PARAMETER_MIN_OPEN ... */

/* Any row, and any row of numbers: RANK and EXTENT as in imp_parameter, each number between MIN and
 * MAX. */
#define IMP_ROW_OF(KIND, NAME, UNIT, DEFAULT, FLAGS, RANK, EXTENT0, EXTENT1, MIN, MAX, DOC)        \
    {                                                                                              \
        NAME, UNIT, DOC, DEFAULT, KIND, FLAGS, RANK, {EXTENT0, EXTENT1, 0}, MIN, MAX               \
    }
#define IMP_ROW(NAME, UNIT, DEFAULT, FLAGS, RANK, EXTENT0, EXTENT1, MIN, MAX, DOC)                 \
    IMP_ROW_OF(IMP_KIND_NUMBER, NAME, UNIT, DEFAULT, FLAGS, RANK, EXTENT0, EXTENT1, MIN, MAX, DOC)

/* One number: any, greater than 0, or from MIN to MAX. */
#define IMP_ROW_NUMBER(NAME, UNIT, DEFAULT, DOC)                                                   \
    IMP_ROW(NAME, UNIT, DEFAULT, 0, 0, 0, 0, -INFINITY, INFINITY, DOC)
#define IMP_ROW_POSITIVE(NAME, UNIT, DEFAULT, DOC)                                                 \
    IMP_ROW(NAME, UNIT, DEFAULT, IMP_PARAMETER_MIN_OPEN, 0, 0, 0, 0, INFINITY, DOC)
#define IMP_ROW_BETWEEN(NAME, UNIT, DEFAULT, MIN, MAX, DOC)                                        \
    IMP_ROW(NAME, UNIT, DEFAULT, 0, 0, 0, 0, MIN, MAX, DOC)

/* Three numbers: any, or all greater than 0. */
#define IMP_ROW_VECTOR(NAME, UNIT, DEFAULT, FLAGS, DOC)                                            \
    IMP_ROW(NAME, UNIT, DEFAULT, FLAGS, 1, 3, 0, -INFINITY, INFINITY, DOC)
#define IMP_ROW_POSITIVE_VECTOR(NAME, UNIT, DEFAULT, DOC)                                          \
    IMP_ROW(NAME, UNIT, DEFAULT, IMP_PARAMETER_MIN_OPEN, 1, 3, 0, 0, INFINITY, DOC)
#define IMP_ROW_CENTER IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "centre of the surface")

/* A list of any length: of numbers, or of vectors of WIDTH numbers each. */
#define IMP_ROW_NUMBERS(NAME, UNIT, DEFAULT, FLAGS, DOC)                                           \
    IMP_ROW(NAME, UNIT, DEFAULT, FLAGS, 1, 0, 0, -INFINITY, INFINITY, DOC)
#define IMP_ROW_VECTORS(NAME, UNIT, DEFAULT, WIDTH, FLAGS, DOC)                                    \
    IMP_ROW(NAME, UNIT, DEFAULT, FLAGS, 2, 0, WIDTH, -INFINITY, INFINITY, DOC)

/* true or false. */
#define IMP_ROW_BOOLEAN(NAME, DEFAULT, DOC)                                                        \
    IMP_ROW_OF(IMP_KIND_BOOLEAN, NAME, "1", DEFAULT, 0, 0, 0, 0, -INFINITY, INFINITY, DOC)

/* A whole number from MIN to MAX. */
#define IMP_ROW_INTEGER(NAME, UNIT, DEFAULT, MIN, MAX, DOC)                                        \
    IMP_ROW_OF(IMP_KIND_INTEGER, NAME, UNIT, DEFAULT, 0, 0, 0, 0, MIN, MAX, DOC)

/* A text, and the name of a file: create gets one that is relative with the scene's folder in
 * front. A text's DEFAULT is JSON, "\"linear\""; FLAGS: 0 or IMP_PARAMETER_OPTIONAL. */
#define IMP_ROW_STRING(NAME, DEFAULT, FLAGS, DOC)                                                  \
    IMP_ROW_OF(IMP_KIND_STRING, NAME, "1", DEFAULT, FLAGS, 0, 0, 0, -INFINITY, INFINITY, DOC)
#define IMP_ROW_FILE(NAME, FLAGS, DOC) IMP_ROW_STRING(NAME, NULL, (FLAGS) | IMP_PARAMETER_FILE, DOC)

/* --- In create -------------------------------------------------------------------------------- */

/* Was the value of a row with IMP_PARAMETER_OPTIONAL given? */
static inline bool imp_is_given(const imp_value *value) { return value->count > 0; }

static inline void imp_copy_vector(double to[3], const imp_value *value)
{
    memcpy(to, value->number, 3 * sizeof to[0]);
}

/* Reports an error in one element of a parameter. -1 for `element` means the whole parameter, and
 * -1 for both means the type. Returns IMP_STATUS_PARAMETER, which create returns in turn. The text
 * is one sentence, formatted as by printf: what was got, and what is allowed. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5), unused))
#endif
static imp_status
imp_reject(imp_create_error *why, int parameter, int64_t element, const char *format, ...)
{
    va_list arguments;
    why->parameter = parameter;
    why->element = element;
    va_start(arguments, format);
    vsnprintf(why->text, sizeof why->text, format, arguments);
    va_end(arguments);
    return IMP_STATUS_PARAMETER;
}

/* Tells the user of `count` things that create left out, or read otherwise than expected; the text
 * says which, in one sentence. create then succeeds all the same. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5), unused))
#endif
static void
imp_note(imp_create_error *why, int parameter, uint64_t count, const char *format, ...)
{
    va_list arguments;
    if (!IMP_HAS(why, note)) return;
    why->note_count = count;
    why->note_parameter = parameter;
    va_start(arguments, format);
    vsnprintf(why->note, sizeof why->note, format, arguments);
    va_end(arguments);
}

/* Tells the host that create read no other files than those that its parameters name, and nothing
 * that changes by itself, such as the environment: one instance then serves many scenes of the same
 * file (is_repeatable). */
static inline void imp_repeatable(imp_create_error *why)
{
    if (IMP_HAS(why, is_repeatable)) why->is_repeatable = 1;
}

/* Makes PREFIX_create and PREFIX_renew of a type whose instance is one struct that owns nothing
 * else, from a function that fills one: `made` is all 0 when it is called.
 *
 *   static imp_status PREFIX_fill(INSTANCE *made, const imp_value *values, imp_create_error *why);
 *
 * The type also needs .renew = PREFIX_renew. */
#define IMP_CREATE_AND_RENEW(PREFIX, INSTANCE)                                                     \
    static imp_status PREFIX##_renew(void *self, const imp_value *values, imp_create_error *why)   \
    {                                                                                              \
        memset(self, 0, sizeof(INSTANCE));                                                         \
        return PREFIX##_fill((INSTANCE *)self, values, why);                                       \
    }                                                                                              \
    static imp_status PREFIX##_create(const imp_value *values, void **self, imp_create_error *why) \
    {                                                                                              \
        INSTANCE *made = (INSTANCE *)malloc(sizeof *made);                                         \
        if (made == NULL) return IMP_STATUS_INTERNAL;                                              \
        const imp_status status = PREFIX##_renew(made, values, why);                               \
        if (status == IMP_STATUS_OK)                                                               \
            *self = made;                                                                          \
        else                                                                                       \
            free(made);                                                                            \
        return status;                                                                             \
    }

/* Whether create goes on, while it holds that many bytes: a create that may take long, or much
 * memory, asks this before each large block and every few thousand items. 0: a limit was reached;
 * free everything and return IMP_STATUS_INTERNAL. */
static inline int imp_goes_on(imp_create_error *why, uint64_t bytes)
{
    return !IMP_OFFERS(why, goes_on) || why->goes_on(why, bytes);
}

/* Tells the host of a file that create is about to read and that none of its values names, so that
 * certificates hold its hash. 0: no memory; free everything and return IMP_STATUS_INTERNAL. A
 * create that reads such files does not call imp_repeatable. */
static inline int imp_reads(imp_create_error *why, const char *path)
{
    return !IMP_OFFERS(why, reads) || why->reads(why, path);
}

/* --- Domains ---------------------------------------------------------------------------------- */

/* u and v as given, at all times. Angles up to IMP_TWO_PI_UPPER cover the full turn, so that
 * rounding leaves no gap. */
static inline void imp_set_domain(double lo[3], double hi[3], double u_lo, double u_hi, double v_lo,
                                  double v_hi)
{
    lo[0] = u_lo;
    hi[0] = u_hi;
    lo[1] = v_lo;
    hi[1] = v_hi;
    lo[2] = -INFINITY;
    hi[2] = INFINITY;
}

/* The callback PREFIX_time_domain of a map that is defined at all times. */
#define IMP_MAP_AT_ALL_TIMES(PREFIX)                                                               \
    static void PREFIX##_time_domain(const void *self, double *lo, double *hi)                     \
    {                                                                                              \
        (void)self;                                                                                \
        *lo = -INFINITY;                                                                           \
        *hi = INFINITY;                                                                            \
    }

/* --- The type --------------------------------------------------------------------------------
 *
 * All fields but the texts, for a table called `parameters`. The callbacks are PREFIX_create,
 * PREFIX_domain (of a map PREFIX_time_domain), and CALLS_eval, CALLS_rate, CALLS_include (of a map
 * CALLS_apply): CALLS is the formula's name if IMP_SURFACE_FORMULA or IMP_MAP_FORMULA makes them.
 *
 * In the short forms the type is called PREFIX, and an instance is one block from malloc. Otherwise
 * NAME is the type's name, a string, and DESTROY frees an instance. */

#ifndef __cplusplus

/* TYPE is imp_surface_type or imp_map_type; the other callbacks follow after this macro. */
#define IMP_TYPE_FIELDS(TYPE, NAME, PREFIX, DESTROY)                                               \
    .struct_size = (uint32_t)sizeof(TYPE),                                                         \
    .parameter_count = (uint32_t)(sizeof parameters / sizeof parameters[0]),                       \
    .parameter_size = (uint32_t)sizeof(imp_parameter), .name = NAME, .parameters = parameters,     \
    .create = PREFIX##_create, .destroy = DESTROY

#define IMP_SURFACE_FIELDS_OF(NAME, PREFIX, CALLS, DESTROY)                                        \
    IMP_TYPE_FIELDS(imp_surface_type, NAME, PREFIX, DESTROY),                                      \
        .domain = PREFIX##_domain, .eval = CALLS##_eval, .rate = CALLS##_rate,                     \
        .include = CALLS##_include
#define IMP_SURFACE_FIELDS(PREFIX, CALLS) IMP_SURFACE_FIELDS_OF(#PREFIX, PREFIX, CALLS, free)

/* RATE: the callback, for maps with a better bound than their formula's, CALLS_rate. */
#define IMP_MAP_FIELDS_OF(NAME, PREFIX, CALLS, DESTROY, RATE)                                      \
    IMP_TYPE_FIELDS(imp_map_type, NAME, PREFIX, DESTROY), .time_domain = PREFIX##_time_domain,     \
                                                          .eval = CALLS##_eval, .rate = RATE,      \
                                                          .apply = CALLS##_apply
#define IMP_MAP_FIELDS(PREFIX, CALLS) IMP_MAP_FIELDS_OF(#PREFIX, PREFIX, CALLS, free, CALLS##_rate)

#else
}

/* C++ wants designated initializers in the order of the fields. Here the same macros, with VALUE
 * for FIELDS, are a value that a lambda completes:
 *
 *   constexpr imp_surface_type ball = [] {
 *       imp_surface_type type = IMP_SURFACE_VALUE(ball, ball_formula);
 *       type.summary = "...", type.equation = "...", type.example = "...";
 *       return type;
 *   }();
 */
template <class Type, class Create>
constexpr Type imp_type_value_(const char *name, const imp_parameter *parameters, size_t count,
                               Create create, void (*destroy)(void *))
{
    Type type{};
    type.struct_size = (uint32_t)sizeof(Type);
    type.parameter_count = (uint32_t)count;
    type.parameter_size = (uint32_t)sizeof(imp_parameter);
    type.name = name;
    type.parameters = parameters;
    type.create = create;
    type.destroy = destroy;
    return type;
}

template <class Domain, class Eval, class Rate, class Include>
constexpr imp_surface_type imp_surface_value_(imp_surface_type type, Domain domain, Eval eval,
                                              Rate rate, Include include)
{
    type.domain = domain;
    type.eval = eval;
    type.rate = rate;
    type.include = include;
    return type;
}

template <class Times, class Eval, class Rate, class Apply>
constexpr imp_map_type imp_map_value_(imp_map_type type, Times times, Eval eval, Rate rate,
                                      Apply apply)
{
    type.time_domain = times;
    type.eval = eval;
    type.rate = rate;
    type.apply = apply;
    return type;
}

#define IMP_TYPE_VALUE(TYPE, NAME, PREFIX, DESTROY)                                                \
    imp_type_value_<TYPE>(NAME, parameters, sizeof parameters / sizeof parameters[0],              \
                          PREFIX##_create, DESTROY)

#define IMP_SURFACE_VALUE_OF(NAME, PREFIX, CALLS, DESTROY)                                         \
    imp_surface_value_(IMP_TYPE_VALUE(imp_surface_type, NAME, PREFIX, DESTROY), PREFIX##_domain,   \
                       CALLS##_eval, CALLS##_rate, CALLS##_include)
#define IMP_SURFACE_VALUE(PREFIX, CALLS) IMP_SURFACE_VALUE_OF(#PREFIX, PREFIX, CALLS, free)

#define IMP_MAP_VALUE_OF(NAME, PREFIX, CALLS, DESTROY, RATE)                                       \
    imp_map_value_(IMP_TYPE_VALUE(imp_map_type, NAME, PREFIX, DESTROY), PREFIX##_time_domain,      \
                   CALLS##_eval, RATE, CALLS##_apply)
#define IMP_MAP_VALUE(PREFIX, CALLS) IMP_MAP_VALUE_OF(#PREFIX, PREFIX, CALLS, free, CALLS##_rate)

/* Says what to use instead. */
#define IMP_SURFACE_FIELDS(...) "IMP_SURFACE_FIELDS is for C; in C++ use IMP_SURFACE_VALUE"
#define IMP_MAP_FIELDS(...) "IMP_MAP_FIELDS is for C; in C++ use IMP_MAP_VALUE"
#endif

#endif /* IMPINGE_PLUGIN_H */

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Prints what the surface ABI fixes: sizes, offsets and sizes of fields, types of callbacks, and
 * numbers, one per line. tests/abi/layout_1.txt is what version 1.0 printed. */

#include <impinge/surface.h>
#include <stdio.h>

/* `may grow`: begins with its own size, or is reached by a stride, so a minor version may append.
 */
#define FIXED(TYPE) printf("size %s %zu fixed\n", #TYPE, sizeof(TYPE))
#define GROWS(TYPE) printf("size %s %zu may grow\n", #TYPE, sizeof(TYPE))
#define FIELD(TYPE, NAME)                                                                          \
    printf("field %s.%s at %zu of %zu\n", #TYPE, #NAME, offsetof(TYPE, NAME),                      \
           sizeof(((TYPE *)0)->NAME))
#define NUMBER(NAME) printf("number %s %llu\n", #NAME, (unsigned long long)(NAME))
#define TEXT(NAME) printf("text %s %s\n", #NAME, NAME)

static void numbers(void)
{
    NUMBER(IMP_ABI_MAJOR);
    NUMBER(IMP_PLUGIN_MAGIC);
    NUMBER(IMP_NOTE_TYPE);
    TEXT(IMP_NOTE_OWNER);
    TEXT(IMP_SURFACE_FACTORY);
    TEXT(IMP_MAP_FACTORY);
    NUMBER(IMP_STATUS_OK), NUMBER(IMP_STATUS_DOMAIN), NUMBER(IMP_STATUS_UNBOUNDED);
    NUMBER(IMP_STATUS_PARAMETER), NUMBER(IMP_STATUS_INTERNAL);
    NUMBER(IMP_KIND_NUMBER), NUMBER(IMP_KIND_INTEGER), NUMBER(IMP_KIND_BOOLEAN);
    NUMBER(IMP_KIND_STRING), NUMBER(IMP_KIND_TABLE);
    NUMBER(IMP_PARAMETER_MIN_OPEN), NUMBER(IMP_PARAMETER_MAX_OPEN), NUMBER(IMP_PARAMETER_SCALAR_OK),
        NUMBER(IMP_PARAMETER_OPTIONAL);
    NUMBER(IMP_FLAG_ABSENT_OUTSIDE_TIMES), NUMBER(IMP_FLAG_TURNS_EXACTLY);
    NUMBER(IMP_RANK_MAX);
    NUMBER(IMP_UU), NUMBER(IMP_UV), NUMBER(IMP_UT), NUMBER(IMP_VV), NUMBER(IMP_VT), NUMBER(IMP_TT);
    FIXED(imp_status), FIXED(imp_kind);
}

static void parameters(void)
{
    GROWS(imp_parameter);
    FIELD(imp_parameter, name), FIELD(imp_parameter, unit), FIELD(imp_parameter, doc);
    FIELD(imp_parameter, default_value), FIELD(imp_parameter, kind), FIELD(imp_parameter, flags);
    FIELD(imp_parameter, rank), FIELD(imp_parameter, extent);
    FIELD(imp_parameter, min), FIELD(imp_parameter, max);
    FIXED(imp_value);
    FIELD(imp_value, count), FIELD(imp_value, extent);
    FIELD(imp_value, number), FIELD(imp_value, string);
    GROWS(imp_create_error);
    FIELD(imp_create_error, struct_size), FIELD(imp_create_error, parameter);
    FIELD(imp_create_error, element), FIELD(imp_create_error, text);
}

static void regions(void)
{
    FIXED(imp_region);
    FIELD(imp_region, lo), FIELD(imp_region, hi), FIELD(imp_region, c), FIELD(imp_region, d);
    FIXED(imp_box4);
    FIELD(imp_box4, lo), FIELD(imp_box4, hi);
    FIXED(imp_rate_matrix);
    FIELD(imp_rate_matrix, m);
    FIXED(imp_map_rates);
    FIELD(imp_map_rates, m);
    FIXED(imp_model);
    FIELD(imp_model, a), FIELD(imp_model, b), FIELD(imp_model, q), FIELD(imp_model, e);
    FIELD(imp_model, lo), FIELD(imp_model, hi), FIELD(imp_model, rate);
    FIELD(imp_model, depends), FIELD(imp_model, reserved);
    NUMBER(IMP_NET_POINTS);
    FIXED(imp_net);
    FIELD(imp_net, degree), FIELD(imp_net, is_moving), FIELD(imp_net, is_weighted);
    FIELD(imp_net, place), FIELD(imp_net, drift), FIELD(imp_net, error);
    FIELD(imp_net, point), FIELD(imp_net, velocity), FIELD(imp_net, weight);
    FIXED(imp_pose);
    FIELD(imp_pose, turn), FIELD(imp_pose, shift), FIELD(imp_pose, pivot), FIELD(imp_pose, fixed);
    NUMBER(IMP_SYMMETRY_ABOUT_POINT), NUMBER(IMP_SYMMETRY_ABOUT_LINE);
    NUMBER(IMP_SYMMETRY_ALONG_LINE), NUMBER(IMP_SYMMETRY_ACROSS_LINE);
    NUMBER(IMP_SYMMETRY_SCREW_RIGHT), NUMBER(IMP_SYMMETRY_SCREW_LEFT), NUMBER(IMP_SCREW_TURNS);
    FIXED(imp_tube);
    FIELD(imp_tube, line), FIELD(imp_tube, radius);
    FIXED(imp_symmetry);
    FIELD(imp_symmetry, kind), FIELD(imp_symmetry, is_closed);
    FIELD(imp_symmetry, center), FIELD(imp_symmetry, axis);
}

/* Callbacks: the compiler says whether the field still has that type. */
#define CALL(TYPE, NAME, ...)                                                                      \
    printf("call %s.%s %s\n", #TYPE, #NAME,                                                        \
           _Generic(((TYPE *)0)->NAME, __VA_ARGS__                                                 \
                    : #__VA_ARGS__, default                                                        \
                    : "of another type"))

/* The fields that both kinds of types begin with, at the same places. */
#define TYPE_FIELDS(TYPE)                                                                          \
    FIELD(TYPE, struct_size), FIELD(TYPE, parameter_count), FIELD(TYPE, parameter_size);           \
    FIELD(TYPE, flags), FIELD(TYPE, name), FIELD(TYPE, summary), FIELD(TYPE, equation);            \
    FIELD(TYPE, source), FIELD(TYPE, example), FIELD(TYPE, parameters);                            \
    FIELD(TYPE, create), FIELD(TYPE, destroy);                                                     \
    CALL(TYPE, create, imp_status (*)(const imp_value *, void **, imp_create_error *));            \
    CALL(TYPE, destroy, void (*)(void *));                                                         \
    CALL(TYPE, eval, imp_status (*)(const void *, size_t, const double *, double *, double *))

static void types(void)
{
    GROWS(imp_text_sink);
    FIELD(imp_text_sink, struct_size), FIELD(imp_text_sink, reserved);
    FIELD(imp_text_sink, host), FIELD(imp_text_sink, add);
    CALL(imp_text_sink, add, void (*)(const imp_text_sink *, const char *, size_t));
    GROWS(imp_surface_type);
    TYPE_FIELDS(imp_surface_type);
    FIELD(imp_surface_type, domain), FIELD(imp_surface_type, eval);
    FIELD(imp_surface_type, rate), FIELD(imp_surface_type, include);
    FIELD(imp_surface_type, net);
    FIELD(imp_surface_type, piece_count), FIELD(imp_surface_type, piece);
    /* The table has this space, which clang-format would take. */
    /* clang-format off */
    CALL(imp_surface_type, piece_count, size_t (*)(const void *));
    /* clang-format on */
    CALL(imp_surface_type, piece, const void *(*)(const void *, size_t));
    FIELD(imp_surface_type, distance);
    CALL(imp_surface_type, distance, imp_status(*)(const void *, const imp_model *, imp_model *));
    FIELD(imp_surface_type, symmetry);
    CALL(imp_surface_type, symmetry, imp_status(*)(const void *, imp_symmetry *));
    FIELD(imp_surface_type, formula), FIELD(imp_surface_type, write_formula);
    CALL(imp_surface_type, write_formula, imp_status(*)(const void *, const imp_text_sink *));
    FIELD(imp_surface_type, renew);
    CALL(imp_surface_type, renew, imp_status(*)(void *, const imp_value *, imp_create_error *));
    FIELD(imp_surface_type, tube);
    CALL(imp_surface_type, tube, imp_status(*)(const void *, const imp_region *, imp_tube *));
    CALL(imp_surface_type, domain, void (*)(const void *, double *, double *));
    CALL(imp_surface_type, rate,
         imp_status(*)(const void *, const imp_region *, imp_rate_matrix *));
    CALL(imp_surface_type, include, imp_status(*)(const void *, const imp_region *, imp_model *));
    CALL(imp_surface_type, net, imp_status(*)(const void *, const imp_region *, imp_net *));
    GROWS(imp_map_type);
    TYPE_FIELDS(imp_map_type);
    FIELD(imp_map_type, time_domain), FIELD(imp_map_type, eval);
    FIELD(imp_map_type, rate), FIELD(imp_map_type, apply), FIELD(imp_map_type, net);
    FIELD(imp_map_type, rigid), FIELD(imp_map_type, span);
    CALL(imp_map_type, time_domain, void (*)(const void *, double *, double *));
    CALL(imp_map_type, rate, imp_status(*)(const void *, const imp_box4 *, imp_map_rates *));
    CALL(imp_map_type, apply, imp_status(*)(const void *, const imp_model *, imp_model *));
    CALL(imp_map_type, rigid, imp_status(*)(const void *, const imp_model *, imp_pose *));
    CALL(imp_map_type, span, void (*)(const void *, double *, double *));
    FIELD(imp_map_type, formula), FIELD(imp_map_type, write_formula);
    CALL(imp_map_type, write_formula, imp_status(*)(const void *, const imp_text_sink *));
    FIELD(imp_map_type, parts), FIELD(imp_map_type, renew);
    CALL(imp_map_type, renew, imp_status(*)(void *, const imp_value *, imp_create_error *));
}

static void plugins(void)
{
    GROWS(imp_surface_factory);
    FIELD(imp_surface_factory, struct_size), FIELD(imp_surface_factory, count);
    FIELD(imp_surface_factory, types);
    GROWS(imp_map_factory);
    FIELD(imp_map_factory, struct_size), FIELD(imp_map_factory, count);
    FIELD(imp_map_factory, types);
    GROWS(imp_plugin);
    FIELD(imp_plugin, magic), FIELD(imp_plugin, struct_size);
    FIELD(imp_plugin, abi_major), FIELD(imp_plugin, abi_minor);
    FIELD(imp_plugin, name), FIELD(imp_plugin, version);
    FIELD(imp_plugin, license), FIELD(imp_plugin, author), FIELD(imp_plugin, get_factory);
    CALL(imp_plugin, get_factory, const void *(*)(const char *));
}

int main(void)
{
    numbers();
    parameters();
    regions();
    types();
    plugins();
    return 0;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "mistakes.h"

#include <impinge/formula_text.h>

/* Each type is the tube, and all that it computes is in order; what it states as its formula is
 * something else. The last two state the tube itself, in one part and in two. */

/* Defines the radius at (v, t) as r, with that text for the wave, and the path as p. */
static void write_names(const tube *a, const char *wave, const imp_text_sink *to)
{
    imp_add_text(to, "r = radius + ");
    imp_add_text(to, wave);
    imp_add_text(to, "; p = 0");
    for (size_t k = 0; k < a->count; ++k) {
        imp_add_text(to, " + t^");
        imp_add_whole(to, k);
        imp_add_text(to, "*");
        imp_add_number(to, a->path[k]);
    }
    imp_add_text(to, "; ");
}

#define TUBE "r*cos(u); r*sin(u); 2*v + p"
#define WAVE_OF_TUBE "wave*sin(3*v + t)"
#define WHOLE "u in [0, 2*pi]; v in [-1, 2]; "

/* A part for each two texts: of the wave, and of the rest. */
#define STATES(NAME, ...)                                                                          \
    static imp_status NAME##_write(const void *self, const imp_text_sink *to)                      \
    {                                                                                              \
        static const char *const text[] = {__VA_ARGS__};                                           \
        for (size_t k = 0; k < sizeof text / sizeof *text; k += 2) {                               \
            if (k > 0) imp_add_text(to, " | ");                                                    \
            write_names(self, text[k], to);                                                        \
            imp_add_text(to, text[k + 1]);                                                         \
        }                                                                                          \
        return IMP_STATUS_OK;                                                                      \
    }                                                                                              \
    static const imp_surface_type NAME##_type = {                                                  \
        .struct_size = sizeof(imp_surface_type),                                                   \
        .parameter_count = TUBE_ROWS,                                                              \
        .parameter_size = sizeof(imp_parameter),                                                   \
        .name = #NAME,                                                                             \
        .summary = "a tube that states another formula",                                           \
        .equation = "((radius + wave sin(3v + t)) (cos u, sin u), 2v + path(t))",                  \
        .example = #NAME TUBE_EXAMPLE,                                                             \
        .parameters = tube_table,                                                                  \
        .create = tube_create,                                                                     \
        .destroy = tube_destroy,                                                                   \
        .domain = tube_domain,                                                                     \
        .eval = tube_formula_eval,                                                                 \
        .rate = tube_formula_rate,                                                                 \
        .include = tube_formula_include,                                                           \
        .write_formula = NAME##_write}

STATES(digit_wrong, "wave*sin(3.0000000000001*v + t)", WHOLE TUBE);
STATES(sign_wrong, "wave*sin(3*v - t)", WHOLE TUBE);
STATES(other_parameter, "radius*sin(3*v + t)", WHOLE TUBE);
STATES(axes_swapped, WAVE_OF_TUBE, WHOLE "r*sin(u); r*cos(u); 2*v + p");
STATES(turn_of_6_28, WAVE_OF_TUBE, "u in [0, 6.28]; v in [-1, 2]; " TUBE);
STATES(range_left_out, WAVE_OF_TUBE, "u in [0, 2*pi]; " TUBE);
STATES(times_cut, WAVE_OF_TUBE, WHOLE "t in [0, 1]; " TUBE);
STATES(name_unknown, WAVE_OF_TUBE, WHOLE "r*cos(u); r*sin(u); 2*v + q");
STATES(coordinate_left_out, WAVE_OF_TUBE, WHOLE "r*cos(u); r*sin(u)");
STATES(never_bounded, WAVE_OF_TUBE, WHOLE "r*cos(u)/(u - u); r*sin(u)/(u - u); (2*v + p)/(u - u)");
STATES(part_left_out, WAVE_OF_TUBE, "u in [0, 2*pi]; v in [-1, 0]; " TUBE, WAVE_OF_TUBE,
       "u in [0, 2*pi]; v in [0.01, 2]; " TUBE);
STATES(second_part_wrong, WAVE_OF_TUBE, "u in [0, 2*pi]; v in [-1, 1.99]; " TUBE,
       "wave*sin(3*v + t + 0.0000000001)", "u in [0, 2*pi]; v in [1.99, 2]; " TUBE);
STATES(one_part, WAVE_OF_TUBE, WHOLE TUBE);
STATES(two_parts, WAVE_OF_TUBE, "u in [0, 2*pi]; v in [-1, 0]; " TUBE, WAVE_OF_TUBE,
       "u in [0, 2*pi]; v in [0, 2]; " TUBE);

MISTAKES("mistakes_formula", &digit_wrong_type, &sign_wrong_type, &other_parameter_type,
         &axes_swapped_type, &turn_of_6_28_type, &range_left_out_type, &times_cut_type,
         &name_unknown_type, &coordinate_left_out_type, &never_bounded_type, &part_left_out_type,
         &second_part_wrong_type, &one_part_type, &two_parts_type);

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_RESULT_H
#define TOOLS_CLI_RESULT_H

#include <impinge/impinge.h>
#include <jansson.h>

/* A result, for people and for programs. */

/* Prints some lines to standard output, verdict first. Bounds are rounded to the side that claims
 * less. */
void result_print(const imp_scene *scene, const imp_result *result);

/* Returns one object that follows tools/schema/result.schema.json. NULL: no memory. */
json_t *result_json(const imp_scene *scene, const imp_result *result);

/* Adds "advice" unless it is NULL. False: no memory. */
bool result_set_advice(json_t *object, const char *advice);

/* Adds "warnings", if there are any: the remarks of types (imp_scene_remark), and parameters that
 * nothing follows. False: no memory. */
bool result_set_warnings(json_t *object, const imp_scene *scene);

/* Returns "clear", "contact" or "undecided". */
const char *result_verdict_name(imp_verdict verdict);

/* "touch", "inside". */
const char *result_kind_name(imp_contact_kind kind);

/* Whether a side of an answer is on a surface, not merely in a solid body. */
bool result_is_on_surface(const imp_side *side);

/* --- Parts of both, for other answers --------------------------------------------------------- */

/* Prints the label at the beginning of a line after the first. */
void result_print_label(const char *label);
void result_print_times(double from, double to);
void result_print_sides(const imp_scene *scene, const imp_side *a, const imp_side *b);
void result_print_normal(const double *normal); /* NULL: undefined */
void result_print_gap(double gap, double gamma);
void result_print_cost(const imp_stats *stats);

/* Why a search was ended, and the cure. */
typedef struct excuse {
    const char *why, *cure;
} excuse;
excuse result_excuse(imp_reason reason);

/* Returns why nothing was searched, or NULL. */
const char *result_reason_of_none(imp_reason reason);

/* Returns [from, to]; null: there is no such time. */
json_t *result_times_json(double from, double to);
json_t *result_reason_json(imp_reason reason);
json_t *result_vector_json(const double v[3]);
json_t *result_side_json(const imp_scene *scene, const imp_side *side);
json_t *result_stats_json(const imp_stats *stats);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_PIPELINE_H
#define CORE_READER_PIPELINE_H

#include <jansson.h>

#include "core/base/status.h"
#include "core/plugin/registry.h"

/* A surface written on one line
 * =============================
 *     TYPE name=value name=value ! MAP name=value ! ...
 *
 * Values are JSON, with three liberties: 1,0,0 is short for [1,0,0]; numbers may be written
 * .5, 5. or +5; a string needs no quotes if it has no blank and no '!' outside brackets.
 * Blanks inside brackets, parentheses and quotes belong to the value.
 *
 * The line becomes the same JSON object a scene file has for the surface, its maps under "maps";
 * whether types and parameters exist and fit is judged from there. The registry only tells
 * which values are strings. */

/* `who` stands in errors for the line, as in "a: at character 14: ...". NULL on error. The caller
 * owns the object. */
json_t *pipeline_read(const imp_registry *registry, const char *who, const char *line,
                      imp_error *error);

/* Reads a line of one stage like pipeline_read: a surface without maps, or a map by itself. */
json_t *pipeline_read_stage(const imp_registry *registry, imp_type_kind kind, const char *who,
                            const char *line, imp_error *error);

#endif

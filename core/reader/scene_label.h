/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_SCENE_LABEL_H
#define CORE_READER_SCENE_LABEL_H

#include <impinge/impinge.h>
#include <jansson.h>

#include "core/plugin/parameter_table.h"
#include "core/surface/instance.h"

/* How errors name an instance: its type, with its parameters as they would stand on a command line,
 * "sphere radius=2". Values that are long become "...". */

/* Writes the label of an instance that is made from an object. */
void scene_label_object(char label[INSTANCE_LABEL_MAX], const char *type, const json_t *object);

/* Keeps what the label of an instance is written from, when it is read, that was made from
 * arguments that are all numbers and in its type's table. False: no memory. */
bool scene_label_arguments(shared_instance *p, const parameter_table *table,
                           const imp_argument *arguments, size_t count);

#endif

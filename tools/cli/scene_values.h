/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SCENE_VALUES_H
#define TOOLS_CLI_SCENE_VALUES_H

#include <impinge/impinge.h>

/* Parameters of a scene by their names, and values for them. */

/* Returns the index of the parameter whose name is these `length` characters; the number of
 * parameters: there is none. */
size_t scene_values_find(const imp_scene *scene, const char *name, size_t length);

/* Sets the value of each parameter to the middle of its range. */
void scene_values_middle(const imp_scene *scene, double *values);

#endif

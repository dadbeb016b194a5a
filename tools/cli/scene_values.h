/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SCENE_VALUES_H
#define TOOLS_CLI_SCENE_VALUES_H

#include <impinge/impinge.h>

#include "tools/cli/message.h"

/* Parameters of a scene by their names, and values for them. */

/* Returns the index of the parameter whose name is these `length` characters; the number of
 * parameters: there is none. */
size_t scene_values_find(const imp_scene *scene, const char *name, size_t length);

/* Sets the value of each parameter to the middle of its range. */
void scene_values_middle(const imp_scene *scene, double *values);

/* A name that an option gives, and that the scene has no parameter of. */
typedef struct scene_values_wrong {
    const char *option; /* without its hyphens */
    const char *name;
    size_t length; /* of the name */
    /* Whether parameter k may be offered instead; NULL: each may. */
    bool (*is_offered)(const void *context, const imp_scene *scene, size_t k);
    const void *context;
} scene_values_wrong;

/* Words the error (IMP_ERROR_USAGE), with the nearest name, and all names if there is room. */
imp_code scene_values_refuse(const scene_values_wrong *wrong, const imp_scene *scene,
                             imp_error *error);

/* Complains with those words, of a name among all. */
exit_status scene_values_complain(const imp_scene *scene, const char *option, const char *name,
                                  size_t length, const char *verb);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_H
#define CORE_SCENE_H

#include "surface.h"

/* Bodies and their surfaces; which bodies ignore each other. Built by scene_file,
 * read by the solver. */

imp_scene *scene_new(void); /* NULL: no memory. Free with imp_scene_free. */

/* `name` is copied. Its index is the count before. */
imp_code scene_add_body(imp_scene *scene, const char *name);

/* Adds to the last body; takes over `s`, also when it fails. */
imp_code scene_add_surface(imp_scene *scene, surface *s);

/* Bodies a and b are never tested with each other. */
imp_code scene_ignore(imp_scene *scene, size_t a, size_t b);
bool scene_ignores(const imp_scene *scene, size_t a, size_t b);

/* What the scene file asks for; the defaults of imp_options_default. Preset: 0, 1, 1e-6, -1. */
typedef struct scene_settings {
    double t_start, t_end, gamma, clearance;
} scene_settings;
scene_settings *scene_settings_of(imp_scene *scene);

#endif

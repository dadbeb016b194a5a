/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_SCENE_BODIES_H
#define CORE_READER_SCENE_BODIES_H

#include "core/reader/scene_instances.h"

/* Bodies by name: how they are related
 * ====================================
 * For scenes from files and for those a program builds. Names of bodies and of groups are one name
 * space, so that "ignore" is never in doubt. */

typedef struct scene_bodies {
    scene_instances instances;
    assembly assembly;
    json_t *names; /* of bodies, to their index; of groups, to -1 - index */
    imp_error *error;
} scene_bodies;

/* Begins an empty list. Clear it even if this fails. */
imp_code scene_bodies_start(scene_bodies *b, const scene_source *source, imp_error *error);
void scene_bodies_clear(scene_bodies *b);

/* Adds a parameter of the scene, before anything that follows it. */
imp_code scene_bodies_parameter(scene_bodies *b, const char *name, double lo, double hi,
                                const place *at);

/* Begins a body; its name, or "body0", "body1", ... by position if NULL, must be new. */
imp_code scene_bodies_begin(scene_bodies *b, const char *name, const place *at);

/* Begins with the bodies of a scene, their groups, and who ignores whom. Precondition: there is
 * none yet. */
imp_code scene_bodies_copy(scene_bodies *b, const imp_scene *scene, const place *at);

imp_code scene_bodies_join(scene_bodies *b, size_t body, const char *group, const place *at);
imp_code scene_bodies_set_parent(scene_bodies *b, size_t body, const char *parent, const place *at);

/* Bodies of x are not tested with bodies of y: names of bodies or groups. */
imp_code scene_bodies_ignore(scene_bodies *b, const char *x, const place *at_x, const char *y,
                             const place *at_y);

/* Answers the error for a body that is its own ancestor, at `at`; it names the chain of parents. */
imp_code scene_bodies_refuse_cycle(const scene_bodies *b, size_t body, const place *at);

/* Puts the scene together and clears everything else. NULL: no memory, or the scene is too
 * large. */
imp_scene *scene_bodies_finish(scene_bodies *b, const place *at);

#endif

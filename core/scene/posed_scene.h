/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_POSED_SCENE_H
#define CORE_SCENE_POSED_SCENE_H

#include "core/scene/scene.h"

/* Scenes at values of the parameters
 * ==================================
 * A scene with parameters stands at the middle of their ranges. Here it is made anew at other
 * values: a scene without parameters, which shares all instances, and with them what is bounded
 * once for all pieces. */

/* Makes the scene of some bodies, in that order, at these values, one for each parameter. Settings
 * are those of `scene`; who ignores whom is left out. What follows parameter number `released`
 * follows time instead; SIZE_MAX: none. The caller frees *made. IMP_ERROR_MEMORY, or
 * IMP_SUCCESS. */
imp_code posed_scene_of_bodies(const imp_scene *scene, const double *values, const size_t *bodies,
                               size_t count, size_t released, imp_scene **made);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_DRIFT_H
#define TOOLS_SIMULATE_DRIFT_H

#include "tools/simulate/closest.h"

/* How a surface moves beyond the rigid motion of its body
 * =======================================================
 * That of a driven body moves by the body's own maps, that of a deforming one changes its shape.
 * Around a point of a patch the velocity is taken as linear in space along the surface, which it is
 * where a flat surface moves rigidly. */

typedef struct drift {
    vec at, velocity;
    vec along[2],
        gradient[2]; /* the velocity changes by gradient[i] where the place does by along[i] */
    bool any;
} drift;

/* At the nearest point of side k. */
imp_code drift_find(const setup *s, const closest *n, int k, double t, drift *out, imp_error *why);

vec drift_at(const drift *d, vec x);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_PARAMETERS_H
#define CORE_SCENE_SCENE_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>

/* The parameters of a scene: quantities with a name and a range that surfaces and maps may follow
 * instead of time. */

/* More of them than anybody could search: each that blurs at least doubles the work. */
enum { SCENE_PARAMETERS_MAX = 32 };

typedef struct scene_parameter {
    char *name;
    double lo, hi; /* finite, lo <= hi */
    bool is_followed;
} scene_parameter;

typedef struct scene_parameters {
    scene_parameter *at;
    size_t count, capacity;
} scene_parameters;

/* Adds a parameter; the name is copied. False: no memory. */
bool scene_parameters_add(scene_parameters *p, const char *name, double lo, double hi);
void scene_parameters_clear(scene_parameters *p);

/* Returns the index of that name, or the count if there is none. */
size_t scene_parameters_find(const scene_parameters *p, const char *name);

/* Returns the value at which the scene itself stands: the middle of the range. */
double scene_parameter_middle(double lo, double hi);

#endif

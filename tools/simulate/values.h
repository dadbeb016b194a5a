/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_VALUES_H
#define TOOLS_SIMULATE_VALUES_H

#include <jansson.h>

#include "tools/cli/message.h"
#include "tools/simulate/rigid.h"

/* Numbers of a scene, checked
 * ===========================
 * Magnitudes end at VALUE_MAX: then products of three of them do not overflow, which is what
 * energies and angular momenta are. */

#define VALUE_MAX 1e100

/* A place in a scene file. */
typedef struct value_place {
    const char *file;
    size_t body; /* SIZE_MAX: the scene itself */
    const char *key;
} value_place;

/* Complains "scene.json: /bodies/2/mass: ..." and returns EXIT_DATA. */
exit_status value_refuse(value_place at, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Read the value at the place from `object`, if it is there; else *to stays. */

/* Three numbers of at most VALUE_MAX each. */
exit_status value_vector(value_place at, const json_t *object, vec *to);

/* Reads a number from `lo` to `hi`. */
exit_status value_number(value_place at, const json_t *object, double lo, double hi, double *to);

/* Reads a number greater than 0: from 1 / VALUE_MAX to VALUE_MAX. */
exit_status value_positive(value_place at, const json_t *object, double *to);

/* Reads an inertia tensor: symmetric to rounding, positive definite, and no thinner than rounding
 * allows. */
exit_status value_inertia(value_place at, const json_t *object, mat3 *to);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_SHELL_WINDING_H
#define CORE_SOLID_SHELL_WINDING_H

#include "core/solid/shells.h"
#include "core/solid/winding.h"

/* How often a shell winds around a point
 * ======================================
 * The solid angle of a closed surface, divided by 4 pi, is an integer: 0 outside. */

/* The winding number of a shell around x: the enclosure number -+ error, and `times`, the integer
 * in it, which holds for all points within `off` of x. is_near: x is too near for that. */
typedef struct winding_number {
    double number, error;
    long times;
    bool is_near, is_whole; /* is_whole: the number may be an integer */
} winding_number;

/* Finds the winding number of a shell of these patches. Fails as plugins do. */
imp_code shell_wind(const shells *s, const patches *p, size_t shell, vec3 x, double off,
                    winding_number *found, imp_error *error);

/* Sums up the solid angles of the patches of one shell, or of all: SIZE_MAX, as they are. Ribbons
 * that close seams are left out. */
imp_code shell_solid_angle(const shells *s, const patches *p, size_t shell, vec3 x,
                           winding_sum *sum, imp_error *error);

#endif

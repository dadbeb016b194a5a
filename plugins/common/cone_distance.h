/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_CONE_DISTANCE_H
#define PLUGINS_COMMON_CONE_DISTANCE_H

#include <impinge/model.h>

/* Returns a bound (imp_surface_type.distance) of how far points m are from the cone about the z
 * axis that has this radius at z = 0 and its apex at z = height, which is not 0, and has no end on
 * the other side. */
imp_model cone_distance(double radius, double height, const imp_model m[3]);

#endif

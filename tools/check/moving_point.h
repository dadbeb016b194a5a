/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_MOVING_POINT_H
#define TOOLS_CHECK_MOVING_POINT_H

#include "tools/check/subject.h"

/* Models of points that move, and of their distances
 * ================================================== */

/* Returns the polynomial of a model at s. */
long double model_value(const imp_model *m, const double s[3]);

/* A model of a coordinate that is x at s. Its reach is of any scale up to twice the size;
 * length. */
imp_model model_through(uint64_t *random, double x, double size, const double s[3]);

/* False, and the check fails, if the model of a distance has a NaN or is inverted. */
bool distance_has_form(const subject *s, const imp_model *g);

/* Returns what a model claims of the distance at s: the least |g| that polynomial and range leave,
 * INFINITY if they leave none. */
long double distance_claimed(const imp_model *g, const double s[3]);

#endif

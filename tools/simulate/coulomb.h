/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_COULOMB_H
#define TOOLS_SIMULATE_COULOMB_H

#include "tools/simulate/rigid.h"

/* The impulse J of a single point of contact, in axes of which the first is the normal: with the
 * velocity u = free + k J it obeys Signorini's law with target 0 and Coulomb's with the coefficient
 * mu (impact.h). `inverse` is that of k, which is symmetric and positive definite; `now` is an
 * impulse that may be near. Where none is found that obeys both laws, friction is left out. */
vec coulomb_impulse(const mat3 *k, const mat3 *inverse, vec free, double mu, vec now);

#endif

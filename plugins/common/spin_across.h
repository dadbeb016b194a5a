/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_SPIN_ACROSS_H
#define PLUGINS_COMMON_SPIN_ACROSS_H

#include "plugins/common/spin.h"
#include "plugins/common/spline.h"

/* Turning by several pieces of constant spin
 * ==========================================
 * The pieces' rotations agree at the times between them (spin.h).
 *
 * Lemma. Let W be at least all bounds of spin.h's lemma for how fast entries of R change, and eta
 * at least all 3 max |D_i| (1 + |spin_i| h). Over several pieces X = R x moves by dX/dt = spin x X
 * + E, |E| <= eta |x|: in one piece spin x X = spin x (turn M x + s D x), and s |spin| |D x| and |D
 * x| are the difference. So |dX/dt| <= V |x| with V = W (1 + 4 SPIN_MISMATCH) + eta, and from the
 * middle m of the span, |y| <= r,
 *
 *   X(m + y) = X(m) + g x X(m) + F,   |F| <= (W V r / 2 + eta) r |x|,
 *
 * where g is the integral of the spin from m on, whose coordinates have slopes between the least
 * and the greatest of those pieces. F depends on time by at most (W V r + eta) |x|, and on x as it
 * depends on |x|, being linear in x. Near a point that touches, g x X(m) is along the surfaces. */

/* R x over times of the span. turns: of the path's pieces. The last two columns of the path's nodes
 * are the two bounds of spin_turn_make; node: those that hold over the span. */
void spin_across(const spin_turn *turns, const spline *path, const spline_span *span,
                 const imp_interval *node, imp_model t, const imp_model x[3], imp_model out[3]);

#endif

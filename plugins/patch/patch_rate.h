/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_PATCH_RATE_H
#define PLUGINS_PATCH_PATCH_RATE_H

#include "plugins/patch/patch.h"

/* The rate matrix of a patch, from hulls
 * ======================================
 * Over a region, X + t Y and its derivatives X_u + t Y_u ... lie in the hulls of the control points
 * that belong to the sub-patch; linear in t, they are largest at one of the two ends in time. With
 * weights, g = (X + t Y) / W has, for any numbers c and r with |g - c| <= r,
 *
 *   g_u = (X_u + t Y_u - c W_u - (g - c) W_u) / W,
 *   |g_u| <= (max |X_u + t Y_u - c W_u| + r max |W_u|) / min W,
 *
 * for either end of time. c and r come from the control points (X_i + t Y_i) / W_i. */

/* Implements imp_surface_type.rate. */
imp_status patch_rate(const patch *f, const imp_region *region, imp_rate_matrix *rates);

#endif

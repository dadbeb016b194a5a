/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_PATCH_INCLUDE_H
#define PLUGINS_PATCH_PATCH_INCLUDE_H

#include "plugins/patch/patch.h"

#include <impinge/model.h>

/* The order-2 inclusion of a patch
 * ================================
 * Of the series sum_kl C_kl T_k(s_u) T_l(s_v) over a region, what has k + l <= 2 is the quadratic;
 * the rest is at most the sum of the |C_kl|. The patch at time t = c_t + d_t s_t is
 * X + t Y = (X + c_t Y) + d_t s_t Y: exactly linear in t. Of d_t s_t Y the terms with k + l <= 1
 * are quadratic, the others go to the remainder. |T_k'| <= k^2 gives the rates:
 * |dF/ds_u| <= sum_kl k^2 |C_kl|. */

/* Implements imp_surface_type.include. */
imp_status patch_include(const patch *f, const imp_region *region, imp_model model[3]);

/* Differences and series, from the net, and then a copy of the data. */
void patch_finish(patch *f, const patch_data *data);

/* A whole patch. NULL: no memory. free() it. */
patch *patch_new(const patch_data *data);

/* Makes it that of other data. False: it has no room for these, and is as it was. */
bool patch_renew(patch *f, const patch_data *data);

#endif

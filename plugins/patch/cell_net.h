/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_CELL_NET_H
#define PLUGINS_PATCH_CELL_NET_H

#include "plugins/patch/nurbs_cells.h"

/* The control net over a region of a NURBS surface that no knot crosses
 * =====================================================================
 * A cell keeps its patch as a Chebyshev series. Over the region this is sum_kl C_kl T_k(s) T_l(r),
 * and with
 *
 *   T_k(s) = sum_i bernstein_ik B_i((s + 1) / 2)
 *
 * its control points are sum_kl bernstein_ik bernstein_jl C_kl. */

/* Implements imp_surface_type.net. IMP_STATUS_UNBOUNDED where a knot crosses the region, or the
 * patches have more than IMP_NET_POINTS points. */
imp_status nurbs_cell_net(const nurbs_instance *f, const imp_region *region, imp_net *net);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_NET_SERIES_H
#define CORE_TREE_NET_SERIES_H

#include "core/tree/node.h"

/* Taylor models of a bicubic net
 * ==============================
 * A net's patch is a polynomial. Its Chebyshev series, cut off after the terms of second order,
 * gives the node's models for less than the type's inclusion of the region costs. */

/* Fills what node_take_model fills of n, whose region is set, from its net p, over the same region.
 * False: p is not a bicubic patch without weights, or the region's centre is not in the middle; n
 * is unchanged. */
bool net_series_take(const net *p, node *n);

#endif

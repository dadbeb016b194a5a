/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_PATCH_NET_H
#define PLUGINS_PATCH_PATCH_NET_H

#include "plugins/patch/patch.h"

/* Implements imp_surface_type.net: the control points of the part of a patch over a region.
 * IMP_STATUS_UNBOUNDED for a patch of more than IMP_NET_POINTS points. */
imp_status patch_net(const patch *f, const imp_region *region, imp_net *net);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/surface/carried.h"

bool symmetry_is_sane(const imp_symmetry *found)
{
    const uint32_t orbits = IMP_SYMMETRY_ORBIT_U | IMP_SYMMETRY_ORBIT_V,
                   all = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_ALL | orbits;
    double most = 0;
    if (found->kind < IMP_SYMMETRY_ABOUT_POINT || found->kind > IMP_SYMMETRY_SCREW_LEFT)
        return false;
    if (symmetry_is_screw(found) && found->is_closed > IMP_SYMMETRY_CLOSED) return false;
    const bool is_ball = found->kind == IMP_SYMMETRY_ABOUT_POINT;
    for (int i = 0; i < 3; ++i) {
        if (!isfinite(found->center[i]) || !isfinite(found->axis[i])) return false;
        if (fabs(found->axis[i]) > most) most = fabs(found->axis[i]);
    }
    if (found->is_closed > all) return false;
    if (!is_ball && (found->is_closed & IMP_SYMMETRY_ORBIT_ALL) != 0) return false;
    if (is_ball && (found->is_closed & orbits) == 0) return true;
    return most > AXIS_LEAST && most < AXIS_MOST;
}

bool surface_has_symmetry(const surface *s)
{
    return IMP_OFFERS(s->type, symmetry) && surface_has_distance(s);
}

imp_status surface_symmetry(const surface *s, imp_symmetry *found)
{
    memset(found, 0, sizeof *found);
    if (!surface_has_symmetry(s)) return IMP_STATUS_UNBOUNDED;
    const surface_call call = surface_call_begin(s->type->name, "symmetry");
    imp_status status = s->type->symmetry(s->self, found);
    status = surface_call_end(call, status);
    if (status != IMP_STATUS_OK) return status;
    return symmetry_is_sane(found) ? IMP_STATUS_OK : SURFACE_BAD_SYMMETRY;
}

imp_status surface_closed_symmetry(const surface *s, imp_symmetry *found)
{
    if (!IMP_OFFERS(s->type, symmetry) || s->piece_count > 1) return IMP_STATUS_UNBOUNDED;
    const imp_status status = surface_symmetry(s, found);
    if (status != IMP_STATUS_OK) return status;
    if ((found->is_closed & IMP_SYMMETRY_CLOSED) == 0 || symmetry_is_screw(found))
        return IMP_STATUS_UNBOUNDED;
    if (found->kind != IMP_SYMMETRY_ABOUT_POINT) found->kind = IMP_SYMMETRY_ABOUT_LINE;
    return IMP_STATUS_OK;
}

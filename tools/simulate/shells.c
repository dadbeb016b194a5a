/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/shells.h"

#include <stdlib.h>

#define SEAM_SLACK 1e-6 /* part of the body's size within which points are the same */

static bool goes_on(void *context)
{
    const patches *p = context;
    return limits_reached(p->limits) == IMP_REASON_NONE;
}

static shape_verdict verdict_of(imp_closure_verdict verdict)
{
    switch (verdict) {
    case IMP_CLOSURE_CLOSED:
        return SHAPE_FOUND;
    case IMP_CLOSURE_OPEN:
        return SHAPE_OPEN;
    case IMP_CLOSURE_ONE_SIDED:
        return SHAPE_ONE_SIDED;
    case IMP_CLOSURE_UNBOUNDED:
        return SHAPE_UNBOUNDED;
    case IMP_CLOSURE_EMPTY:
        return SHAPE_FLAT;
    case IMP_CLOSURE_STOPPED:
        return SHAPE_STOPPED;
    }
    return SHAPE_FLAT;
}

shape_verdict shells_find(shells *s, const patches *p, vec *where, imp_error *why)
{
    *s = (shells){calloc(p->count + 1, sizeof *s->facing), 0};
    if (s->facing == NULL || p->count == 0) return s->facing == NULL ? SHAPE_NO_MEMORY : SHAPE_FLAT;
    imp_closure found = {.struct_size = (uint32_t)sizeof found};
    patches asked = *p;
    const imp_code code =
        imp_scene_get_closure(p->scene, p->patch[0].place.body, p->t, SEAM_SLACK * p->size,
                              s->facing, goes_on, &asked, &found, why);
    if (code != IMP_SUCCESS) return code == IMP_ERROR_MEMORY ? SHAPE_NO_MEMORY : SHAPE_FAULT;
    *where = vec_of(found.where);
    s->count = found.shells;
    return verdict_of(found.verdict);
}

void shells_free(shells *s)
{
    free(s->facing);
    *s = (shells){0};
}

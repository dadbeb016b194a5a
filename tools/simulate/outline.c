/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/outline.h"

#include <stdlib.h>

#include "tools/cli/scene_info.h"

static const vec_box everything = {{{-INFINITY, -INFINITY, -INFINITY}},
                                   {{INFINITY, INFINITY, INFINITY}}};

/* Includes a patch over all its domain and all times asked about. */
static void include(const imp_scene *still, const imp_options *options, outline_patch *p,
                    bool *varies)
{
    double lo[3], hi[3];
    imp_model model[3];
    imp_piece_domain(still, p->place, lo, hi);
    lo[2] = fmax(lo[2], options->t_start);
    hi[2] = fmin(hi[2], options->t_end);
    if (imp_piece_include(still, p->place, lo, hi, model, NULL) != IMP_SUCCESS) {
        *varies = true;
        return;
    }
    for (int i = 0; i < 3; ++i) {
        if (!(model[i].rate[2] == 0)) *varies = true;
        if (!(model[i].lo <= model[i].hi)) continue;
        p->box.lo.x[i] = model[i].lo;
        p->box.hi.x[i] = model[i].hi;
    }
}

bool outline_read(outline *o, const imp_scene *still, const imp_options *options, const limits *l,
                  size_t body)
{
    *o = (outline){.box = vec_box_empty()};
    o->patch = calloc(scene_info_pieces(still, body) + 1, sizeof *o->patch);
    if (o->patch == NULL) return false;
    bool stopped = false;
    for (size_t k = 0; k < imp_scene_surface_count(still, body); ++k)
        for (size_t n = 0; n < imp_scene_piece_count(still, body, k); ++n) {
            outline_patch *p = &o->patch[o->count++];
            *p = (outline_patch){{body, k, n}, everything};
            if (o->count % 256 == 1) stopped = limits_reached(l) != IMP_REASON_NONE;
            if (stopped)
                o->varies = true;
            else
                include(still, options, p, &o->varies);
            vec_box_add(&o->box, p->box.lo);
            vec_box_add(&o->box, p->box.hi);
        }
    return true;
}

void outline_free(outline *o) { free(o->patch); }

double outline_reach(const outline *o, vec x)
{
    vec far;
    if (o->count == 0) return 0;
    for (int i = 0; i < 3; ++i)
        far.x[i] = fmax(fabs(o->box.lo.x[i] - x.x[i]), fabs(o->box.hi.x[i] - x.x[i]));
    return vec_length(far) * (1 + 0x1p-50);
}

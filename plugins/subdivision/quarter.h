/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_QUARTER_H
#define PLUGINS_SUBDIVISION_QUARTER_H

#include "plugins/subdivision/walk.h"

#include "plugins/patch/pieces.h"

/* The surface over a part of a level (walk.h) that is not the corner's; at level 0, over all of a
 * regular face. Points and regions are the face's own, and lie in the part. */
typedef struct quarter_type {
    /* error may not be NULL */
    void (*point)(const walk *w, int u, int v, const double p[3], double x[3], double error[3]);

    /* Whether one polynomial is the surface all over the region; `include` takes such only. */
    bool (*is_one)(const walk *w, const imp_region *region, int u, int v);
    imp_status (*include)(const walk *w, const imp_region *region, int u, int v,
                          imp_model model[3]);

    /* Adds bounds over `part` to those over a whole region (pieces.h). */
    imp_status (*add)(const walk *w, const imp_region *whole, const imp_region *part, int u, int v,
                      imp_model sum[3]);

    /* Implements imp_surface_type.net; u and v may be NEAR | FAR. */
    imp_status (*net)(const walk *w, const imp_region *region, int u, int v, imp_net *net);
} quarter_type;

extern const quarter_type quarter_spline; /* of quads: one bicubic patch */
extern const quarter_type quarter_box;    /* of triangles: three quartic ones */

static inline const quarter_type *quarter_of(const control_mesh *m)
{
    return m->loop != NULL ? &quarter_box : &quarter_spline;
}

static inline void quarter_add_model(const imp_region *whole, const imp_region *part,
                                     const imp_model g[3], imp_model sum[3])
{
    const pieces_shift shift = pieces_shift_of(whole, part);
    for (int i = 0; i < 3; ++i) pieces_add(&sum[i], &g[i], &shift);
}

#endif

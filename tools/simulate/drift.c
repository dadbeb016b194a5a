/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/drift.h"

#include <string.h>

/* Computes the velocity of three points (u, v), by central differences over some 1e-5 of the time
 * asked about, within the times that exist. */
static imp_code velocities(const setup *s, const placed *at, imp_place place, double t,
                           const double (*uv)[2], vec velocity[3], imp_error *why)
{
    double lo[3], hi[3];
    imp_piece_domain(s->still, place, lo, hi);
    const double h = 1e-5 * (s->options.t_end - s->options.t_start);
    const double from = fmax(t - h, lo[2]), to = fmin(t + h, hi[2]);
    placed before = *at, after = *at;
    before.t = from, after.t = to;
    vec x[3], y[3];
    imp_code code = placed_eval(&before, place, 3, uv, x, why);
    if (code == IMP_SUCCESS) code = placed_eval(&after, place, 3, uv, y, why);
    for (int i = 0; i < 3; ++i)
        velocity[i] =
            to > from ? vec_scale(1 / (to - from), vec_sub(y[i], x[i])) : (vec){{0, 0, 0}};
    return code;
}

imp_code drift_find(const setup *s, const closest *n, int k, double t, drift *out, imp_error *why)
{
    const chart *c = &n->chart[k];
    *out = (drift){.at = n->jet[k].x, .any = s->actors[c->at->body].outline.varies};
    if (!out->any) return IMP_SUCCESS;
    double uv[3][2];
    vec velocity[3], x[3];
    for (int i = 0; i < 3; ++i) memcpy(uv[i], n->spot[k].p, sizeof uv[i]);
    for (int i = 0; i < 2; ++i) {
        const double h = 1e-3 * (c->hi[i] - c->lo[i]);
        uv[1 + i][i] += uv[1 + i][i] + h <= c->hi[i] ? h : -h;
    }
    const double(*points)[2] = (const double(*)[2])uv;
    imp_code code = velocities(s, c->at, c->place, t, points, velocity, why);
    if (code == IMP_SUCCESS) code = placed_eval(c->at, c->place, 3, points, x, why);
    if (code != IMP_SUCCESS) return code;
    out->velocity = velocity[0];
    for (int i = 0; i < 2; ++i) {
        out->along[i] = vec_sub(x[1 + i], x[0]);
        out->gradient[i] = vec_sub(velocity[1 + i], velocity[0]);
    }
    return IMP_SUCCESS;
}

vec drift_at(const drift *d, vec x)
{
    if (!d->any) return (vec){{0, 0, 0}};
    const vec way = vec_sub(x, d->at), *a = d->along;
    const double aa = vec_dot(a[0], a[0]), ab = vec_dot(a[0], a[1]), bb = vec_dot(a[1], a[1]);
    const double det = aa * bb - ab * ab, p = vec_dot(a[0], way), q = vec_dot(a[1], way);
    if (!(det > 1e-6 * aa * bb)) return d->velocity;
    const vec first = vec_scale((bb * p - ab * q) / det, d->gradient[0]);
    return vec_add(d->velocity, vec_along(first, (aa * q - ab * p) / det, d->gradient[1]));
}

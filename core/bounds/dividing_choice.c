/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/dividing_choice.h"

/* A surface's terms of second order along the tangents, as functions of y = (slopes) s: those of
 * y_1^2, y_1 y_2 and y_2^2. */
typedef struct bows {
    double xx[2], xy[2], yy[2];
} bows;

static bows bows_of(const local_slice *s)
{
    const double ux = s->l[0].t[0], uy = s->l[0].t[1], vx = s->l[1].t[0], vy = s->l[1].t[1];
    const double det = ux * vy - uy * vx;
    const double su[2] = {vy / det, -vx / det}, sv[2] = {-uy / det, ux / det};
    bows b;
    for (int i = 0; i < 2; ++i) {
        const double uu = s->q[UU].t[i], uv = s->q[UV].t[i], vv = s->q[VV].t[i];
        b.xx[i] = uu * su[0] * su[0] + uv * su[0] * sv[0] + vv * sv[0] * sv[0];
        b.xy[i] =
            2 * uu * su[0] * su[1] + uv * (su[0] * sv[1] + su[1] * sv[0]) + 2 * vv * sv[0] * sv[1];
        b.yy[i] = uu * su[1] * su[1] + uv * su[1] * sv[1] + vv * sv[1] * sv[1];
    }
    return b;
}

/* Adds `share` of the C that takes a surface's terms of third order off: C(y, y, y) = -6 K(y,
 * b(y)), b being its bows. */
static void add_third_order(const bows *b, const form *k, double share, cubic *c)
{
    const double *xx = b->xx, *xy = b->xy, *yy = b->yy;
    c->x[0] -= 6 * share * (k->xx * xx[0] + k->xy * xx[1]);
    c->x[1] -= 2 * share * (k->xx * xy[0] + k->xy * (xx[0] + xy[1]) + k->yy * xx[1]);
    c->x[2] -= 2 * share * (k->xx * yy[0] + k->xy * (xy[0] + yy[1]) + k->yy * xy[1]);
    c->x[3] -= 6 * share * (k->xy * yy[0] + k->yy * yy[1]);
}

/* Adds `share` of the Q that takes its terms of fourth order off: Q(y, y, y, y) = -12 b(y).(K b(y)
 * + C(y, y, .)). */
static void add_fourth_order(const bows *b, const form *k, const cubic *c, double share, quartic *q)
{
    for (int i = 0; i < 2; ++i) {
        const double kx = i == 0 ? k->xx : k->xy, ky = i == 0 ? k->xy : k->yy;
        const double xx = kx * b->xx[0] + ky * b->xx[1] + c->x[i];
        const double xy = kx * b->xy[0] + ky * b->xy[1] + 2 * c->x[i + 1];
        const double yy = kx * b->yy[0] + ky * b->yy[1] + c->x[i + 2];
        q->x[0] -= 12 * share * (xx * b->xx[i]);
        q->x[1] -= 3 * share * (xx * b->xy[i] + xy * b->xx[i]);
        q->x[2] -= 2 * share * (xx * b->yy[i] + xy * b->xy[i] + yy * b->xx[i]);
        q->x[3] -= 3 * share * (xy * b->yy[i] + yy * b->xy[i]);
        q->x[4] -= 12 * share * (yy * b->yy[i]);
    }
}

/* The field's K and normal are means of what both surfaces have at their centres: what C and Q add
 * there, on the mean, is taken off. */
bool dividing_choose(const frame *f, const local_view *v, const form *k, dividing *h)
{
    const local_slice *side[2] = {&v->a, &v->b};
    const bool is_face[2] = {f->side[0] == TOUCH_FACE, f->side[1] == TOUCH_FACE};
    if (!is_face[0] && !is_face[1]) return false;
    const double share = is_face[0] && is_face[1] ? 0.5 : 1, *delta = v->x.delta.t;
    bows b[2];
    *h = (dividing){.k = *k};
    for (int i = 0; i < 2; ++i)
        if (is_face[i]) {
            b[i] = bows_of(side[i]);
            add_third_order(&b[i], k, share, &h->c);
        }
    for (int i = 0; i < 2; ++i)
        if (is_face[i]) add_fourth_order(&b[i], k, &h->c, share, &h->q);
    const form by = cubic_by(&h->c, delta), by_q = quartic_by_two(&h->q, delta, delta);
    form_turn(&by, delta, h->slope);
    for (int i = 0; i < 2; ++i) h->slope[i] *= -0.125;
    h->k.xx -= 0.125 * by_q.xx;
    h->k.xy -= 0.125 * by_q.xy;
    h->k.yy -= 0.125 * by_q.yy;
    return true;
}

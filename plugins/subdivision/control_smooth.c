/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/control_build.h"

#include <impinge/interval.h>

static void add(double sum[3], const double *list, size_t k, double factor)
{
    for (size_t i = 0; i < 3; ++i) sum[i] += factor * list[3 * k + i];
}

static void set_face_points(const control_mesh *m, const double *from, double *to)
{
    for (uint32_t f = 0; f < m->face_count; ++f) {
        double *x = to + 3 * (m->point_count + f), sum[3] = {0, 0, 0};
        for (uint32_t h = m->first[f]; h < m->first[f + 1]; ++h) add(sum, from, m->corner[h], 1);
        for (int i = 0; i < 3; ++i) x[i] = sum[i] / (m->first[f + 1] - m->first[f]);
    }
}

/* Sets the points of edges by Loop's rule. */
static void set_edge_means(const control_mesh *m, const uint32_t *edge, const double *from,
                           double *to)
{
    for (uint32_t h = 0; h < m->corner_count; ++h) {
        const uint32_t twin = m->twin[h];
        if (twin < h) continue;
        const bool is_border = twin == CONTROL_NONE;
        double sum[3] = {0, 0, 0};
        add(sum, from, m->corner[h], is_border ? 0.5 : 0.375);
        add(sum, from, control_end(m, h), is_border ? 0.5 : 0.375);
        if (!is_border) {
            add(sum, from, control_end(m, control_next(m, h)), 0.125);
            add(sum, from, control_end(m, control_next(m, twin)), 0.125);
        }
        memcpy(to + 3 * (size_t)edge[h], sum, sizeof sum);
    }
}

static void set_edge_points(const control_mesh *m, const uint32_t *edge, const double *from,
                            double *to)
{
    for (uint32_t h = 0; h < m->corner_count; ++h) {
        const uint32_t twin = m->twin[h];
        if (twin < h) continue;
        const double share = twin == CONTROL_NONE ? 0.5 : 0.25;
        double sum[3] = {0, 0, 0};
        add(sum, from, m->corner[h], share);
        add(sum, from, control_end(m, h), share);
        if (twin != CONTROL_NONE) {
            add(sum, to, m->point_count + m->face[h], share);
            add(sum, to, m->point_count + m->face[twin], share);
        }
        memcpy(to + 3 * (size_t)edge[h], sum, sizeof sum);
    }
}

/* The neighbours of a border point along the border: the end of the first half-edge of its fan, and
 * the beginning of the last one's predecessor. */
static void smooth_border(const control_mesh *m, const control_point *p, const double *from,
                          double x[3])
{
    uint32_t last = p->start;
    for (uint16_t k = 1; k < p->faces; ++k) last = control_turn_left(m, last);
    if (p->faces == 1) {
        add(x, from, m->corner[last], 1);
        return;
    }
    add(x, from, m->corner[last], 0.75);
    add(x, from, control_end(m, p->start), 0.125);
    add(x, from, m->corner[control_previous(m, last)], 0.125);
}

static void smooth_point(const control_mesh *m, const control_point *p, const double *from,
                         const double *to, double x[3])
{
    const double n = p->faces;
    double around[3] = {0, 0, 0};
    uint32_t h = p->start;
    for (uint16_t k = 0; k < p->faces; ++k, h = control_turn_left(m, h)) {
        add(around, to, m->point_count + m->face[h], 1);
        add(around, from, control_end(m, h), 1);
    }
    for (size_t i = 0; i < 3; ++i)
        x[i] = (around[i] / n + (n - 2) * from[3 * (size_t)m->corner[h] + i]) / n;
}

/* Smooths a point among triangles by Loop's rule. */
static void smooth_among_triangles(const control_mesh *m, const control_point *p,
                                   const double *from, double x[3])
{
    double around[3] = {0, 0, 0};
    uint32_t h = p->start;
    for (uint16_t k = 0; k < p->faces; ++k, h = control_turn_left(m, h))
        add(around, from, control_end(m, h), 1);
    const double *own = from + 3 * (size_t)m->corner[h], share = control_loop_share(p->faces);
    for (int i = 0; i < 3; ++i) x[i] = own[i] + share * (around[i] / p->faces - own[i]);
}

static void set_points(const control_mesh *m, const uint32_t *edge, const double *from, double *to)
{
    if (m->loop != NULL) {
        set_edge_means(m, edge, from, to);
    } else {
        set_face_points(m, from, to);
        set_edge_points(m, edge, from, to);
    }
    for (uint32_t p = 0; p < m->point_count; ++p) {
        double x[3] = {0, 0, 0};
        if (m->fan[p].start == CONTROL_NONE)
            add(x, from, p, 1);
        else if (m->fan[p].is_border)
            smooth_border(m, &m->fan[p], from, x);
        else if (m->loop != NULL)
            smooth_among_triangles(m, &m->fan[p], from, x);
        else
            smooth_point(m, &m->fan[p], from, to, x);
        memcpy(to + 3 * (size_t)p, x, sizeof x);
    }
}

/* Lemma. All points are means of coarser ones, of which none is greater than `most`. Roundings, in
 * units of 2^-53 most: a face's n - 1 sums and a quotient n; an edge's 3 sums more; of a point with
 * n faces, the 2 n sums of means (each at most n most, later divided by n) 2 n beside those of the
 * faces, and 5 more: together below n_face + 2 n + 8. Of Loop's, an edge's products and sums 5; of
 * a point, n sums and 7, and 16 for the share, which is off by 2^-50 and multiplies at most 2 most:
 * below n + 24. What the coarser points were off counts once, as weights add up to 1. */
static void add_slip(const control_mesh *m, const double *list, double slip[3])
{
    uint32_t corners = 0, faces = 0;
    for (size_t f = 0; f < m->face_count; ++f)
        if (m->first[f + 1] - m->first[f] > corners) corners = m->first[f + 1] - m->first[f];
    for (size_t p = 0; p < m->point_count; ++p)
        if (m->fan[p].faces > faces) faces = m->fan[p].faces;
    const double units = m->loop != NULL ? faces + 24.0 : corners + 2.0 * faces + 8;
    for (size_t i = 0; i < 3; ++i) {
        double most = 0;
        for (size_t p = 0; p < m->point_count; ++p) most = imp_larger(most, fabs(list[3 * p + i]));
        slip[i] = (slip[i] + units * 0x1p-53 * most) * (1 + 0x1p-40) + IMP_TINY;
    }
}

void control_smooth(const control_mesh *m, const uint32_t *edge, const double *from, double *to,
                    double slip[3])
{
    set_points(m, edge, from, to);
    add_slip(m, from, slip);
}

/* Lemma, in units of 2^-52. Let x = 3/8 + cos(2 pi / n) / 4, at most 5/8. The angle, at most 3.2,
 * is off by two roundings, 3.2; its cosine by that and 4; a quarter of these and a sum's rounding,
 * 0.25, make 2.05 of x. Its square is off by 2 x 2.05 and 0.25, and 5/8 - x^2 by 0.25 more: 3.1 <
 * 4. 3 and 6 are exact. */
double control_loop_share(int n)
{
    if (n == 3) return 0.5625;
    if (n == 6) return 0.375;
    const double x = 0.375 + 0.25 * cos(6.283185307179586 / n);
    return 0.625 - x * x;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/raster.h"

#include <stdlib.h>

static size_t fine_width(const raster *r) { return r->width * RASTER_FINE; }
static size_t fine_height(const raster *r) { return r->height * RASTER_FINE; }

static uint8_t byte_of(float share)
{
    if (!(share > 0)) return 0;
    return share < 1 ? (uint8_t)(255 * share + 0.5f) : 255;
}

static void put(raster *r, size_t at, colour c)
{
    r->rgb[3 * at] = byte_of(c.r), r->rgb[3 * at + 1] = byte_of(c.g),
               r->rgb[3 * at + 2] = byte_of(c.b);
}

bool raster_begin(raster *r, size_t width, size_t height, colour background)
{
    *r =
        (raster){.width = width, .height = height, .window = {0, 0, (double)width, (double)height}};
    const size_t n = fine_width(r) * fine_height(r);
    r->rgb = malloc(3 * n);
    r->depth = malloc(n * sizeof *r->depth);
    if (r->rgb == NULL || r->depth == NULL) return false;
    for (size_t k = 0; k < n; ++k) {
        put(r, k, background);
        r->depth[k] = -INFINITY;
    }
    return true;
}

void raster_free(raster *r)
{
    free(r->rgb);
    free(r->depth);
    *r = (raster){0};
}

/* --- Light ------------------------------------------------------------------------------ */

/* Lambert and a highlight, by a lamp at the upper left behind the camera; the side turned to the
 * camera is lit, whichever it is. */
static colour lit(colour c, vec n)
{
    static const vec lamp = {{-0.42, 0.55, 0.722}}, halfway = {{-0.226, 0.296, 0.928}};
    const double length = vec_length(n);
    if (!(length > 0)) return c;
    n = vec_scale((n.x[2] < 0 ? -1 : 1) / length, n);
    const double facing = fmax(0, vec_dot(n, lamp)), shine = pow(fmax(0, vec_dot(n, halfway)), 48);
    const float diffuse = (float)(0.42 + 0.62 * facing), highlight = (float)(0.22 * shine);
    return (colour){c.r * diffuse + highlight, c.g * diffuse + highlight,
                    c.b * diffuse + highlight};
}

/* --- Triangles ---------------------------------------------------------------------------- */

static double cross2(const vec *a, const vec *b, double x, double y)
{
    return (b->x[0] - a->x[0]) * (y - a->x[1]) - (b->x[1] - a->x[1]) * (x - a->x[0]);
}

/* Fine pixels lo..hi-1 whose centres may lie between `from` and `to`, inside [edge_lo, edge_hi]. */
static void span(double from, double to, double edge_lo, double edge_hi, size_t *lo, size_t *hi)
{
    from = fmax(from, edge_lo) * RASTER_FINE - 0.5, to = fmin(to, edge_hi) * RASTER_FINE - 0.5;
    *lo = from > 0 ? (size_t)ceil(from) : 0;
    *hi = to >= 0 ? (size_t)floor(to) + 1 : 0;
}

static void bounds(const raster *r, const raster_corner c[3], size_t lo[2], size_t hi[2])
{
    const double *a = c[0].at.x, *b = c[1].at.x, *d = c[2].at.x;
    const raster_window *w = &r->window;
    const double width = fmin(w->x + w->width, (double)r->width);
    const double height = fmin(w->y + w->height, (double)r->height);
    span(fmin(a[0], fmin(b[0], d[0])), fmax(a[0], fmax(b[0], d[0])), fmax(w->x, 0), width, &lo[0],
         &hi[0]);
    span(fmin(a[1], fmin(b[1], d[1])), fmax(a[1], fmax(b[1], d[1])), fmax(w->y, 0), height, &lo[1],
         &hi[1]);
}

/* The corner's shares at a point inside sum up to 1. */
static vec blend(const double share[3], vec a, vec b, vec c)
{
    return vec_along(vec_along(vec_scale(share[0], a), share[1], b), share[2], c);
}

static void fill(raster *r, const raster_corner c[3], colour tint, bool hidden)
{
    size_t lo[2], hi[2];
    const double area = cross2(&c[0].at, &c[1].at, c[2].at.x[0], c[2].at.x[1]);
    if (!(area != 0) || !isfinite(area)) return;
    bounds(r, c, lo, hi);
    for (size_t y = lo[1]; y < hi[1]; ++y)
        for (size_t x = lo[0]; x < hi[0]; ++x) {
            const double px = ((double)x + 0.5) / RASTER_FINE, py = ((double)y + 0.5) / RASTER_FINE;
            const double share[3] = {cross2(&c[1].at, &c[2].at, px, py) / area,
                                     cross2(&c[2].at, &c[0].at, px, py) / area,
                                     cross2(&c[0].at, &c[1].at, px, py) / area};
            if (!(share[0] >= 0 && share[1] >= 0 && share[2] >= 0)) continue;
            const size_t at = y * fine_width(r) + x;
            const float depth = (float)blend(share, c[0].at, c[1].at, c[2].at).x[2];
            if (hidden && !(depth > r->depth[at])) continue;
            if (hidden) r->depth[at] = depth;
            put(r, at, lit(tint, blend(share, c[0].normal, c[1].normal, c[2].normal)));
        }
}

void raster_triangle(raster *r, const raster_corner corner[3], colour c)
{
    fill(r, corner, c, true);
}

void raster_line(raster *r, vec from, vec to, double width, colour c, bool hidden)
{
    const double dx = to.x[0] - from.x[0], dy = to.x[1] - from.x[1],
                 length = sqrt(dx * dx + dy * dy);
    const double along = length > 0 ? 0.5 * width / length : 0;
    const vec ahead = {{along * dx, along * dy, 0}};
    const vec side = length > 0 ? (vec){{-along * dy, along * dx, 0}} : (vec){{0, 0.5 * width, 0}};
    const vec a = vec_along(from, -0.5, ahead), b = vec_along(to, 0.5, ahead);
    const raster_corner q[4] = {{.at = vec_add(a, side)},
                                {.at = vec_sub(a, side)},
                                {.at = vec_sub(b, side)},
                                {.at = vec_add(b, side)}};
    fill(r, (const raster_corner[3]){q[0], q[1], q[2]}, c, hidden);
    fill(r, (const raster_corner[3]){q[0], q[2], q[3]}, c, hidden);
}

void raster_flat(raster *r, const double *xy, size_t n, colour c)
{
    for (size_t k = 1; k + 1 < n; ++k) {
        const raster_corner corner[3] = {{.at = {{xy[0], xy[1], 0}}},
                                         {.at = {{xy[2 * k], xy[2 * k + 1], 0}}},
                                         {.at = {{xy[2 * k + 2], xy[2 * k + 3], 0}}}};
        fill(r, corner, c, false);
    }
}

/* --- Reading back --------------------------------------------------------------------------- */

double raster_depth(const raster *r, double x, double y)
{
    const raster_window *w = &r->window;
    if (!(x >= w->x && y >= w->y && x < w->x + w->width && y < w->y + w->height)) return -INFINITY;
    if (!(x >= 0 && y >= 0 && x < (double)r->width && y < (double)r->height)) return -INFINITY;
    return r->depth[(size_t)(y * RASTER_FINE) * fine_width(r) + (size_t)(x * RASTER_FINE)];
}

void raster_row(const raster *r, size_t y, uint8_t *rgb)
{
    for (size_t k = 0; k < 3 * r->width; ++k) {
        unsigned sum = 0;
        for (size_t i = 0; i < RASTER_FINE; ++i)
            for (size_t j = 0; j < RASTER_FINE; ++j)
                sum +=
                    r->rgb[3 * ((y * RASTER_FINE + i) * fine_width(r) + k / 3 * RASTER_FINE + j) +
                           k % 3];
        rgb[k] = (uint8_t)((sum + RASTER_FINE * RASTER_FINE / 2) / (RASTER_FINE * RASTER_FINE));
    }
}

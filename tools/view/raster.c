/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/raster.h"

#include <stdlib.h>
#include <string.h>

static size_t fine_width(const raster *r) { return r->width * RASTER_FINE; }
static size_t fine_height(const raster *r) { return r->height * RASTER_FINE; }

static uint8_t byte_of(float share)
{
    if (!(share > 0)) return 0;
    return share < 1 ? (uint8_t)(255 * share + 0.5f) : 255;
}

static void put(uint8_t *rgb, size_t at, colour c)
{
    rgb[3 * at] = byte_of(c.r), rgb[3 * at + 1] = byte_of(c.g), rgb[3 * at + 2] = byte_of(c.b);
}

size_t raster_bytes(double width, double height)
{
    const double fine = width * height * RASTER_FINE * RASTER_FINE;
    return (size_t)(fine * (3 + sizeof(float)));
}

static bool layer_begin(raster_layer *layer, size_t n)
{
    layer->rgb = malloc(3 * n);
    layer->depth = malloc(n * sizeof *layer->depth);
    if (layer->rgb == NULL || layer->depth == NULL) return false;
    for (size_t k = 0; k < n; ++k) layer->depth[k] = -INFINITY;
    return true;
}

static void layer_free(raster_layer *layer)
{
    free(layer->rgb);
    free(layer->depth);
}

bool raster_begin(raster *r, size_t width, size_t height, colour background)
{
    *r = (raster){.width = width,
                  .height = height,
                  .veil_depth = INFINITY,
                  .window = {0, 0, (double)width, (double)height}};
    const size_t n = fine_width(r) * fine_height(r);
    if (!layer_begin(&r->front, n)) return false;
    for (size_t k = 0; k < n; ++k) put(r->front.rgb, k, background);
    return true;
}

void raster_free(raster *r)
{
    layer_free(&r->front);
    layer_free(&r->veil);
    *r = (raster){0};
}

/* --- Veil ------------------------------------------------------------------------------------- */

bool raster_veil(raster *r, double depth)
{
    r->veil_depth = depth;
    if (r->veil.depth != NULL || !(depth < INFINITY)) return true;
    layer_free(&r->veil); /* half of one, where memory ran out */
    r->veil = (raster_layer){NULL, NULL};
    return layer_begin(&r->veil, fine_width(r) * fine_height(r));
}

/* The window's fine pixels: lo to hi - 1. */
static void fine_window(const raster *r, size_t lo[2], size_t hi[2])
{
    const raster_window *w = &r->window;
    const double x1 = fmin(w->x + w->width, (double)r->width);
    const double y1 = fmin(w->y + w->height, (double)r->height);
    lo[0] = w->x > 0 ? (size_t)(w->x * RASTER_FINE) : 0,
    hi[0] = x1 > 0 ? (size_t)(x1 * RASTER_FINE) : 0;
    lo[1] = w->y > 0 ? (size_t)(w->y * RASTER_FINE) : 0,
    hi[1] = y1 > 0 ? (size_t)(y1 * RASTER_FINE) : 0;
}

/* The picture's share, of 255, under the veil. */
enum { SHINES_THROUGH = 185 };

void raster_veil_end(raster *r)
{
    size_t lo[2], hi[2];
    r->veil_depth = INFINITY;
    if (r->veil.depth == NULL) return;
    fine_window(r, lo, hi);
    for (size_t y = lo[1]; y < hi[1]; ++y)
        for (size_t x = lo[0]; x < hi[0]; ++x) {
            const size_t at = y * fine_width(r) + x;
            if (!(r->veil.depth[at] > r->front.depth[at])) continue;
            for (size_t k = 3 * at; k < 3 * at + 3; ++k)
                r->front.rgb[k] = (uint8_t)((SHINES_THROUGH * r->front.rgb[k] +
                                             (255 - SHINES_THROUGH) * r->veil.rgb[k] + 127) /
                                            255);
            r->veil.depth[at] = -INFINITY;
        }
}

/* --- Light ------------------------------------------------------------------------------------ */

/* x^48 */
static double sharpened(double x)
{
    const double x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x16 = x8 * x8;
    return x16 * x16 * x16;
}

/* Returns Lambert shading with a highlight, by a lamp at the upper left behind the camera;
 * whichever side faces the camera is lit. */
static colour lit(colour c, vec n)
{
    static const vec lamp = {{-0.42, 0.55, 0.722}}, halfway = {{-0.226, 0.296, 0.928}};
    const double square = vec_dot(n, n);
    if (!(square > 0)) return c;
    const double scale = (n.x[2] < 0 ? -1 : 1) / sqrt(square);
    const double facing = scale * vec_dot(n, lamp), mirrored = scale * vec_dot(n, halfway);
    const float diffuse = (float)(0.42 + 0.62 * (facing > 0 ? facing : 0));
    const float highlight = (float)(0.22 * (mirrored > 0 ? sharpened(mirrored) : 0));
    return (colour){c.r * diffuse + highlight, c.g * diffuse + highlight,
                    c.b * diffuse + highlight};
}

/* --- Triangles -------------------------------------------------------------------------------- */

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

/* A function that is linear over the picture: value at the pixel (0,0), and what a step adds. */
typedef struct ramp {
    double at, dx, dy;
} ramp;

/* The barycentric coordinate that is 1 at corner a and 0 on the line from b to c. `area`: cross2 of
 * the three corners. */
static ramp share_of(const vec *b, const vec *c, double area)
{
    const double dx = (b->x[1] - c->x[1]) / area, dy = (c->x[0] - b->x[0]) / area;
    return (ramp){-(dx * b->x[0] + dy * b->x[1]), dx, dy};
}

static double ramp_at(const ramp *r, double x, double y) { return r->at + r->dx * x + r->dy * y; }

/* A triangle while its pixels are drawn. */
typedef struct shaded {
    const raster_corner *corner;
    ramp share[3];
    colour tint;
    bool is_even; /* one normal: the colour is that of `flat` everywhere */
    colour flat;
} shaded;

static shaded shade(const raster_corner c[3], double area, colour tint)
{
    const vec *n0 = &c[0].normal, *n1 = &c[1].normal, *n2 = &c[2].normal;
    shaded s = {.corner = c,
                .share = {share_of(&c[1].at, &c[2].at, area), share_of(&c[2].at, &c[0].at, area),
                          share_of(&c[0].at, &c[1].at, area)},
                .tint = tint,
                .is_even = memcmp(n0, n1, sizeof *n0) == 0 && memcmp(n0, n2, sizeof *n0) == 0};
    if (s.is_even) s.flat = lit(tint, *n0);
    return s;
}

static colour colour_at(const shaded *s, const double share[3])
{
    if (s->is_even) return s->flat;
    const raster_corner *c = s->corner;
    const vec two = vec_along(vec_scale(share[0], c[0].normal), share[1], c[1].normal);
    return lit(s->tint, vec_along(two, share[2], c[2].normal));
}

/* Draws one fine pixel inside the triangle: over everything, or unless something nearer is
 * there. */
static void put_pixel(raster *r, const shaded *s, size_t at, const double share[3], bool hidden)
{
    raster_layer *layer = &r->front;
    if (hidden) {
        const raster_corner *c = s->corner;
        const double depth =
            share[0] * c[0].at.x[2] + share[1] * c[1].at.x[2] + share[2] * c[2].at.x[2];
        if (depth > r->veil_depth) layer = &r->veil;
        if (!((float)depth > layer->depth[at])) return;
        layer->depth[at] = (float)depth;
    }
    put(layer->rgb, at, colour_at(s, share));
}

static void fill(raster *r, const raster_corner c[3], colour tint, bool hidden)
{
    size_t lo[2], hi[2];
    const double area = cross2(&c[0].at, &c[1].at, c[2].at.x[0], c[2].at.x[1]);
    if (!(area != 0) || !isfinite(area)) return;
    bounds(r, c, lo, hi);
    if (lo[0] >= hi[0] || lo[1] >= hi[1]) return;
    const shaded s = shade(c, area, tint);
    for (size_t y = lo[1]; y < hi[1]; ++y) {
        const double py = ((double)y + 0.5) / RASTER_FINE;
        for (size_t x = lo[0]; x < hi[0]; ++x) {
            const double px = ((double)x + 0.5) / RASTER_FINE;
            const double share[3] = {ramp_at(&s.share[0], px, py), ramp_at(&s.share[1], px, py),
                                     ramp_at(&s.share[2], px, py)};
            if (share[0] >= 0 && share[1] >= 0 && share[2] >= 0)
                put_pixel(r, &s, y * fine_width(r) + x, share, hidden);
        }
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

/* --- Reading back ----------------------------------------------------------------------------- */

double raster_depth(const raster *r, double x, double y)
{
    const raster_window *w = &r->window;
    if (!(x >= w->x && y >= w->y && x < w->x + w->width && y < w->y + w->height)) return -INFINITY;
    if (!(x >= 0 && y >= 0 && x < (double)r->width && y < (double)r->height)) return -INFINITY;
    return r->front.depth[(size_t)(y * RASTER_FINE) * fine_width(r) + (size_t)(x * RASTER_FINE)];
}

void raster_row(const raster *r, size_t y, uint8_t *rgb)
{
    for (size_t k = 0; k < 3 * r->width; ++k) {
        unsigned sum = 0;
        for (size_t i = 0; i < RASTER_FINE; ++i)
            for (size_t j = 0; j < RASTER_FINE; ++j)
                sum +=
                    r->front
                        .rgb[3 * ((y * RASTER_FINE + i) * fine_width(r) + k / 3 * RASTER_FINE + j) +
                             k % 3];
        rgb[k] = (uint8_t)((sum + RASTER_FINE * RASTER_FINE / 2) / (RASTER_FINE * RASTER_FINE));
    }
}

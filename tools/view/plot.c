/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/plot.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "tools/view/palette.h"

/* Curves are thin: darker than bodies. */
static colour tint_of(size_t k)
{
    const colour c = palette_colour(k);
    return (colour){0.72f * c.r, 0.72f * c.g, 0.72f * c.b};
}

plot_series *plot_add(plot *p, const char *name, plot_kind kind, size_t count)
{
    if (p->count == PLOT_SERIES_MAX) return NULL;
    plot_series *s = &p->series[p->count];
    *s = (plot_series){.kind = kind,
                       .tint = tint_of(p->count),
                       .letter = kind == PLOT_BAND ? '#' : (char)('a' + (int)p->count),
                       .x = calloc(count + 1, sizeof(double)),
                       .y = calloc(count + 1, sizeof(double)),
                       .high = calloc(count + 1, sizeof(double)),
                       .count = count};
    p->count += 1;
    snprintf(s->name, sizeof s->name, "%s", name);
    return s->x != NULL && s->y != NULL && s->high != NULL ? s : NULL;
}

void plot_free(plot *p)
{
    for (size_t k = 0; k < p->count; ++k) {
        free(p->series[k].x);
        free(p->series[k].y);
        free(p->series[k].high);
    }
    *p = (plot){0};
}

/* --- Scales ----------------------------------------------------------------------------------- */

static bool is_log(const plot *p, int axis) { return axis == 0 ? p->log_x : p->log_y; }

static void stretch(const plot *p, plot_scale *s, int axis, double value)
{
    if (!isfinite(value) || (is_log(p, axis) && !(value > 0))) return;
    s->lo[axis] = fmin(s->lo[axis], value), s->hi[axis] = fmax(s->hi[axis], value);
}

/* Ends that are easily read: powers of ten, or a multiple of a tick. */
static double tick_step(double span)
{
    const double power = pow(10, floor(log10(span / 5)));
    const double rest = span / 5 / power;
    return power * (rest < 1.5 ? 1 : rest < 3.5 ? 2 : rest < 7.5 ? 5 : 10);
}

static void round_ends(const plot *p, plot_scale *s, int axis)
{
    double *lo = &s->lo[axis], *hi = &s->hi[axis];
    if (!(*lo <= *hi)) *lo = is_log(p, axis) ? 1 : 0, *hi = is_log(p, axis) ? 10 : 1;
    if (is_log(p, axis)) {
        *lo = pow(10, floor(log10(*lo) + 1e-9)), *hi = pow(10, ceil(log10(*hi) - 1e-9));
        if (!(*lo < *hi)) *hi = 10 * *lo;
        return;
    }
    if (axis == 1) *lo = fmin(*lo, 0);
    if (!(*lo < *hi)) *hi = *lo + 1;
    if (axis == 1) *hi = tick_step(*hi - *lo) * ceil(*hi / tick_step(*hi - *lo) - 1e-9);
    if (!(*hi <= DBL_MAX)) *hi = DBL_MAX;
}

plot_scale plot_measure(const plot *p)
{
    plot_scale s = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t k = 0; k < p->count; ++k) {
        const plot_series *q = &p->series[k];
        for (size_t i = 0; i < q->count; ++i) {
            stretch(p, &s, 0, q->x[i]);
            stretch(p, &s, 1, q->y[i]);
            if (q->kind != PLOT_BAND) continue;
            stretch(p, &s, 0, q->x[i + 1]);
            stretch(p, &s, 1, q->high[i]);
        }
    }
    if (p->has_level) stretch(p, &s, 1, p->level);
    for (int axis = 0; axis < 2; ++axis) round_ends(p, &s, axis);
    return s;
}

double plot_place(const plot *p, const plot_scale *s, int axis, double value)
{
    double lo = s->lo[axis], hi = s->hi[axis];
    if (is_log(p, axis)) {
        if (!(value > 0)) return NAN;
        value = log10(value), lo = log10(lo), hi = log10(hi);
    }
    return (0.5 * value - 0.5 * lo) / (0.5 * hi - 0.5 * lo); /* differences may be above DBL_MAX */
}

size_t plot_ticks(const plot *p, const plot_scale *s, int axis, double *ticks, size_t most)
{
    const double lo = s->lo[axis], hi = s->hi[axis];
    size_t count = 0;
    if (is_log(p, axis)) {
        const double decades = log10(hi) - log10(lo), step = ceil(decades / 8);
        for (double d = 0; d <= decades + 1e-9 && count < most; d += step)
            ticks[count++] = lo * pow(10, d);
        return count;
    }
    const double step = tick_step(fmin(hi - lo, DBL_MAX));
    for (double k = ceil(lo / step - 1e-9); k * step <= hi + 1e-9 * step && count < most; ++k)
        ticks[count++] = k * step + 0.0; /* no -0 */
    return count;
}

/* --- On a canvas ------------------------------------------------------------------------------ */

static const colour ink = {0.13f, 0.15f, 0.18f}, faint = {0.88f, 0.89f, 0.90f}, white = {1, 1, 1};

typedef struct frame {
    const plot *plot;
    plot_scale scale;
    double x, y, width, height; /* pixels */
} frame;

static double frame_x(const frame *f, double x)
{
    return f->x + f->width * plot_place(f->plot, &f->scale, 0, x);
}

static double frame_y(const frame *f, double y)
{
    return f->y + f->height * (1 - plot_place(f->plot, &f->scale, 1, y));
}

static void draw_axes(const frame *f, canvas *c)
{
    double ticks[16];
    char text[32];
    size_t n = plot_ticks(f->plot, &f->scale, 0, ticks, 16);
    for (size_t k = 0; k < n; ++k) {
        const double x = frame_x(f, ticks[k]);
        canvas_line(c, (const double[4]){x, f->y, x, f->y + f->height}, 2, (pen){faint, 1});
        snprintf(text, sizeof text, "%.6g", ticks[k]);
        canvas_text(c, x, f->y + f->height + 20, 15, CANVAS_MIDDLE, ink, text);
    }
    n = plot_ticks(f->plot, &f->scale, 1, ticks, 16);
    for (size_t k = 0; k < n; ++k) {
        const double y = frame_y(f, ticks[k]);
        canvas_line(c, (const double[4]){f->x, y, f->x + f->width, y}, 2, (pen){faint, 1});
        snprintf(text, sizeof text, "%.6g", ticks[k]);
        canvas_text(c, f->x - 8, y + 5, 15, CANVAS_RIGHT, ink, text);
    }
    const double x1 = f->x + f->width, y1 = f->y + f->height;
    canvas_line(c, (const double[6]){f->x, f->y, f->x, y1, x1, y1}, 3, (pen){ink, 1.2});
    canvas_text(c, f->x + 0.5 * f->width, y1 + 44, 16, CANVAS_MIDDLE, ink, f->plot->x_label);
    canvas_text(c, f->x - 8, f->y - 14, 16, CANVAS_LEFT, ink, f->plot->y_label);
}

static colour pale(colour c)
{
    return (colour){1 - 0.45f * (1 - c.r), 1 - 0.45f * (1 - c.g), 1 - 0.45f * (1 - c.b)};
}

/* Draws a band. An unknown upper end is at the top; a lower end without a place on the scale, at
 * the bottom. */
static void draw_band(const frame *f, canvas *c, const plot_series *s)
{
    for (size_t k = 0; k < s->count; ++k) {
        const double x0 = frame_x(f, s->x[k]), x1 = frame_x(f, s->x[k + 1]);
        double lo = frame_y(f, s->y[k]), hi = isfinite(s->high[k]) ? frame_y(f, s->high[k]) : f->y;
        if (!isfinite(lo)) lo = f->y + f->height;
        if (!isfinite(hi)) hi = f->y + f->height;
        if (lo - hi < 1.6) lo += 0.8, hi -= 0.8;
        canvas_shape(c, (const double[8]){x0, lo, x1, lo, x1, hi, x0, hi}, 4, pale(s->tint));
        canvas_line(c, (const double[4]){x0, lo, x1, lo}, 2, (pen){s->tint, 1.6});
    }
}

static void draw_curve(const frame *f, canvas *c, const plot_series *s)
{
    double before[2] = {NAN, NAN};
    for (size_t k = 0; k < s->count; ++k) {
        const double at[2] = {frame_x(f, s->x[k]), frame_y(f, s->y[k])};
        if (!isfinite(at[0]) || !isfinite(at[1])) continue;
        if (s->kind == PLOT_LINE && isfinite(before[0]))
            canvas_line(c, (const double[4]){before[0], before[1], at[0], at[1]}, 2,
                        (pen){s->tint, 2});
        canvas_disc(c, at[0], at[1], s->kind == PLOT_LINE ? 3.4 : 4.4, s->tint);
        before[0] = at[0], before[1] = at[1];
    }
}

static void draw_legend(const frame *f, canvas *c)
{
    for (size_t k = 0; k < f->plot->count; ++k) {
        const plot_series *s = &f->plot->series[k];
        const double x = f->x + f->width + 18, y = f->y + 14 + 24 * (double)k;
        canvas_disc(c, x, y - 5, 5, s->kind == PLOT_BAND ? pale(s->tint) : s->tint);
        canvas_text(c, x + 14, y, 14, CANVAS_LEFT, ink, s->name);
    }
}

static double legend_width(const plot *p, const canvas *c)
{
    double widest = 0;
    for (size_t k = 0; k < p->count; ++k)
        widest = fmax(widest, canvas_text_width(c, 14, p->series[k].name));
    return 44 + widest;
}

/* Writes words on a white ground that end at x, the baseline at y. */
static void draw_level_inside(const frame *f, canvas *c, double x, double y)
{
    char text[64];
    canvas_fitted(c, 14, f->width - 8, f->plot->level_label, text, sizeof text);
    const double left = x - canvas_text_width(c, 14, text) - 4, top = y - 12, bottom = y + 4;
    canvas_shape(c, (const double[8]){left - 3, top, x, top, x, bottom, left - 3, bottom}, 4,
                 white);
    canvas_text_fixed(c, left, y, 14, palette_mark, text);
}

/* Names the level at `y` right of the frame, where it hides no curve, or inside the frame where the
 * margin is too narrow or has the legend. */
static void draw_level_label(const frame *f, canvas *c, double y)
{
    const double right = f->x + f->width, left = right + 6;
    const double legend = f->y + 14 + 24 * (double)f->plot->count;
    if (y < legend || left + canvas_text_width(c, 14, f->plot->level_label) > c->width - 8)
        draw_level_inside(f, c, right, y > f->y + 24 ? y - 7 : y + 16);
    else
        canvas_text_fixed(c, left, y + 5, 14, palette_mark, f->plot->level_label);
}

static void draw_level(const frame *f, canvas *c)
{
    const double y = frame_y(f, f->plot->level), step = 9;
    for (double x = f->x; x + step <= f->x + f->width; x += 2 * step)
        canvas_line(c, (const double[4]){x, y, x + step, y}, 2, (pen){palette_mark, 1.4});
    draw_level_label(f, c, y);
}

/* Draws text above the frame, as near to x as the name of the vertical axis permits. */
static void draw_top_label(const frame *f, canvas *c, double x, const char *text)
{
    char fitted[192];
    const double begin = f->x + canvas_text_width(c, 16, f->plot->y_label) + 4;
    canvas_fitted(c, 14, c->width - begin - 8, text, fitted, sizeof fitted);
    const double width = canvas_text_width(c, 14, fitted);
    const double left = fmax(begin, fmin(x - 0.5 * width, c->width - width - 8));
    canvas_text_fixed(c, left, f->y - 6, 14, palette_mark, fitted);
}

static void draw_mark(const frame *f, canvas *c)
{
    const double x = frame_x(f, f->plot->mark);
    canvas_line(c, (const double[4]){x, f->y, x, f->y + f->height}, 2, (pen){palette_mark, 1.6});
    draw_top_label(f, c, x, f->plot->mark_label);
}

/* Draws the point, and a thin line up to its label. */
static void draw_point(const frame *f, canvas *c)
{
    const double x = frame_x(f, f->plot->point[0]), y = frame_y(f, f->plot->point[1]);
    if (!isfinite(x) || !isfinite(y)) return;
    canvas_line(c, (const double[4]){x, f->y, x, y}, 2, (pen){palette_mark, 0.6});
    canvas_disc(c, x, y, 5.2, white);
    canvas_disc(c, x, y, 3.8, palette_mark);
    draw_top_label(f, c, x, f->plot->point_label);
}

static void draw_title(const plot *p, canvas *c)
{
    char title[sizeof p->title];
    canvas_fitted(c, 19, c->width - 24, p->title, title, sizeof title);
    canvas_text(c, 0.5 * c->width, 34, 19, CANVAS_MIDDLE, ink, title);
}

void plot_draw(const plot *p, canvas *c)
{
    const frame f = {
        p, plot_measure(p), 84, 74, c->width - 84 - legend_width(p, c), c->height - 74 - 62};
    draw_title(p, c);
    draw_axes(&f, c);
    for (size_t k = 0; k < p->count; ++k)
        if (p->series[k].kind == PLOT_BAND) draw_band(&f, c, &p->series[k]);
    for (size_t k = 0; k < p->count; ++k)
        if (p->series[k].kind != PLOT_BAND) draw_curve(&f, c, &p->series[k]);
    if (p->marked) draw_mark(&f, c);
    if (p->has_level) draw_level(&f, c);
    if (p->has_point) draw_point(&f, c);
    draw_legend(&f, c);
}

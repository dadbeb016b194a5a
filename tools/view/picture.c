/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/view/palette.h"
#include "tools/view/visibility.h"

static const colour ink = {0.13f, 0.15f, 0.18f}, white = {1, 1, 1};

static colour darker(colour c, float by) { return (colour){c.r * by, c.g * by, c.b * by}; }

static colour lighter(colour c, float by)
{
    return (colour){1 - by * (1 - c.r), 1 - by * (1 - c.g), 1 - by * (1 - c.b)};
}

void picture_frame(camera *c, const raster_window *w, const stage *s, double title)
{
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    const cloud *all = &s->cloud;
    c->target = (vec){{0, 0, 0}};
    c->scale = 1, c->middle[0] = c->middle[1] = 0;
    if (all->count > 0) c->target = vec_scale(0.5, vec_add(all->box.lo, all->box.hi));
    for (size_t i = 0; i < all->count; ++i) {
        const vec seen = camera_see(c, all->point[i]);
        for (int k = 0; k < 2; ++k) lo[k] = fmin(lo[k], seen.x[k]), hi[k] = fmax(hi[k], seen.x[k]);
    }
    const double wide = hi[0] - lo[0], high = hi[1] - lo[1];
    const double scale = fmin(0.88 * w->width / wide, (0.9 * w->height - title) / high);
    const bool extends = scale > 0 && scale < INFINITY;
    c->scale = extends ? scale : 100;
    c->middle[0] = w->x + 0.5 * w->width - (extends ? 0.5 * scale * (lo[0] + hi[0]) : 0);
    c->middle[1] = w->y + 0.5 * (w->height + title) - (extends ? 0.5 * scale * (lo[1] + hi[1]) : 0);
}

/* --- What hides the spot ---------------------------------------------------------------------- */

/* Pixels in front of the spot, at least, from which on the bodies that hide it are transparent. */
static const double veil_pixels = 2;

typedef struct veil {
    bool *hides;  /* one a body; NULL: none does */
    double depth; /* depth in pixels; nearer shapes are transparent */
} veil;

static imp_code veil_begin(veil *v, const stage *s, const panel *p, imp_error *error)
{
    *v = (veil){NULL, INFINITY};
    if (!p->marks || !s->spot.is_known) return IMP_SUCCESS;
    v->hides = calloc(s->body_count + 1, sizeof *v->hides);
    if (v->hides == NULL) return mesh_no_memory(error);
    const double slack = 0.25 * visibility_slack(s) * p->camera.scale;
    v->depth = camera_see(&p->camera, stage_spot_point(s)).x[2] + fmax(slack, veil_pixels);
    return visibility_hiding(s, p->camera.toward, v->hides, error);
}

static bool is_veiled(const veil *v, size_t body) { return v->hides != NULL && v->hides[body]; }

/* --- Surfaces --------------------------------------------------------------------------------- */

typedef struct painter {
    const camera *camera;
    raster *raster;
    colour colour;
} painter;

static void paint_triangle(void *context, const mesh *m, const size_t c[3], size_t cell)
{
    const painter *paint = context;
    const camera *cam = paint->camera;
    raster_corner corner[3];
    (void)cell;
    for (int k = 0; k < 3; ++k) {
        const vec n = m->normal[c[k]];
        corner[k].at = camera_see(cam, m->point[c[k]]);
        corner[k].normal =
            (vec){{vec_dot(n, cam->right), vec_dot(n, cam->up), vec_dot(n, cam->toward)}};
    }
    raster_triangle(paint->raster, corner, paint->colour);
}

/* Moves a point two pixels nearer than the surface it is on, so that the surface does not hide
 * it. */
static vec lifted(const camera *c, vec p)
{
    vec seen = camera_see(c, p);
    seen.x[2] += 1.5;
    return seen;
}

/* How lines are drawn, by mesh_step_kind: share of the body's colour, pixels. */
typedef struct step_style {
    float darkness;
    double width;
} step_style;
static const step_style styles[] = {{0.62f, 0.8}, {0.72f, 0.7}, {0.45f, 1.2}};

static void paint_steps(const painter *paint, const mesh *m)
{
    for (size_t k = 0; k < m->step_count; ++k) {
        const mesh_step *s = &m->steps[k];
        raster_line(paint->raster, lifted(paint->camera, m->point[s->from]),
                    lifted(paint->camera, m->point[s->to]), styles[s->kind].width,
                    darker(paint->colour, styles[s->kind].darkness), true);
    }
}

static imp_code paint_surfaces(const stage *s, const camera *c, const veil *v, raster *r,
                               bool lines, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < s->count && code == IMP_SUCCESS; ++k) {
        const mesh *m = &s->meshes[k];
        const painter paint = {c, r, palette_colour(m->body)};
        if (!stage_is_there(s, m)) continue;
        if (!raster_veil(r, is_veiled(v, m->body) ? v->depth : INFINITY))
            return mesh_no_memory(error);
        painter own = paint;
        mesh_triangles(m, paint_triangle, &own);
        if (lines) paint_steps(&paint, m);
        code = allowance_check(s->allowance, "triangles were drawn", error);
    }
    raster_veil_end(r);
    return code;
}

/* --- As lines --------------------------------------------------------------------------------- */

/* Depths of the panel, to tell what is hidden. */
typedef struct outliner {
    const panel *panel;
    const raster *depths; /* of the panel alone */
    const veil *veil;
    canvas *canvas;
} outliner;

static bool is_inside(const raster_window *w, const double *p)
{
    return p[0] >= w->x && p[0] <= w->x + w->width && p[1] >= w->y && p[1] <= w->y + w->height;
}

/* Draws a step if it is of the requested kind, hidden or not; a veiled step is drawn as if
 * hidden. */
static void outline_step(const outliner *o, const mesh *m, const mesh_step *s, bool faint)
{
    const camera *cam = &o->panel->camera;
    const vec a = lifted(cam, m->point[s->from]), b = lifted(cam, m->point[s->to]);
    const vec middle = vec_scale(0.5, vec_add(a, b));
    const raster_window *w = &o->panel->window;
    if (!is_inside(w, a.x) || !is_inside(w, b.x)) return;
    const double front = raster_depth(o->depths, middle.x[0] - w->x, middle.x[1] - w->y);
    const bool veiled = is_veiled(o->veil, m->body) && middle.x[2] > o->veil->depth;
    if ((front > middle.x[2] + 1.5 || veiled) != faint) return;
    const colour body = palette_colour(m->body);
    const colour c =
        faint ? lighter(body, 0.35f) : darker(body, s->kind == MESH_EDGE ? 0.6f : 0.75f);
    canvas_line(o->canvas, (const double[4]){a.x[0], a.x[1], b.x[0], b.x[1]}, 2,
                (pen){c, faint                  ? 0.4
                         : s->kind == MESH_EDGE ? 1.2
                                                : 0.9});
}

static imp_code outline_surfaces(const stage *s, const panel *p, const veil *v, canvas *c,
                                 imp_error *error)
{
    raster depths = {.width = 0};
    camera shifted = p->camera;
    shifted.middle[0] -= p->window.x, shifted.middle[1] -= p->window.y;
    imp_code code = allowance_check_bytes(
        s->allowance, raster_bytes(p->window.width, p->window.height), "pixels were kept", error);
    const bool begun = code == IMP_SUCCESS && raster_begin(&depths, (size_t)p->window.width,
                                                           (size_t)p->window.height, white);
    if (code == IMP_SUCCESS && !begun) code = mesh_no_memory(error);
    if (code == IMP_SUCCESS) code = paint_surfaces(s, &shifted, v, &depths, false, error);
    const outliner o = {p, &depths, v, c};
    for (int faint = 1; faint >= 0 && code == IMP_SUCCESS; --faint)
        for (size_t k = 0; k < s->count; ++k) {
            const mesh *m = &s->meshes[k];
            for (size_t i = 0; i < m->step_count && stage_is_there(s, m); ++i)
                outline_step(&o, m, &m->steps[i], faint != 0);
        }
    raster_free(&depths);
    return code;
}

/* --- Marks ------------------------------------------------------------------------------------ */

static void arrow(canvas *c, const double from[2], const double to[2])
{
    const double dx = to[0] - from[0], dy = to[1] - from[1], length = sqrt(dx * dx + dy * dy);
    if (!(length > 4)) return;
    const double x = dx / length, y = dy / length, base[2] = {to[0] - 11 * x, to[1] - 11 * y};
    canvas_line(c, (const double[4]){from[0], from[1], base[0], base[1]}, 2,
                (pen){palette_mark, 2.2});
    canvas_shape(c,
                 (const double[6]){to[0], to[1], base[0] - 5 * y, base[1] + 5 * x, base[0] + 5 * y,
                                   base[1] - 5 * x},
                 3, palette_mark);
}

static void dot(canvas *c, const double at[2])
{
    canvas_disc(c, at[0], at[1], 5.2, white);
    canvas_disc(c, at[0], at[1], 3.8, palette_mark);
}

/* The normal is drawn as long as a sixth of the panel would be, seen from the side. */
static void mark_contact(const stage *s, const panel *p, canvas *c)
{
    const vec at = camera_see(&p->camera, stage_spot_point(s));
    if (!is_inside(&p->window, at.x)) return;
    if (s->spot.has_normal) {
        const vec tip =
            vec_along(stage_spot_point(s), p->window.height / 6 / p->camera.scale, s->spot.normal);
        arrow(c, at.x, camera_see(&p->camera, tip).x);
    }
    dot(c, at.x);
}

/* Draws the line between the two points, with its length. */
static void mark_nearest(const stage *s, const panel *p, canvas *c)
{
    const vec a = camera_see(&p->camera, s->spot.point[0]);
    const vec b = camera_see(&p->camera, s->spot.point[1]);
    if (!is_inside(&p->window, a.x) || !is_inside(&p->window, b.x)) return;
    canvas_line(c, (const double[4]){a.x[0], a.x[1], b.x[0], b.x[1]}, 2, (pen){palette_mark, 2.2});
    dot(c, a.x);
    dot(c, b.x);
    char text[32];
    snprintf(text, sizeof text, "%.4g", s->spot.upper);
    const double x = 0.5 * (a.x[0] + b.x[0]) + 10, y = 0.5 * (a.x[1] + b.x[1]) - 8;
    const double wide = canvas_text_width(c, 15, text);
    const double left = fmin(x, p->window.x + p->window.width - wide - 4);
    canvas_shape(c,
                 (const double[8]){left - 3, y + 5, left + wide + 3, y + 5, left + wide + 3, y - 13,
                                   left - 3, y - 13},
                 4, white);
    canvas_text_fixed(c, left, y, 15, palette_mark, text);
}

enum { LINES_MAX = 3 }; /* of a title */

static const double letters = 17, line_height = 22; /* pixels */

/* Draws one line of the title on white, at `below` pixels under the first. */
static void draw_title_line(const panel *p, canvas *c, double below, const char *line)
{
    const raster_window *w = &p->window;
    const double right = w->x + 20 + canvas_text_width(c, letters, line);
    const double top = w->y + 4 + below, low = w->y + 32 + below;
    canvas_shape(c, (const double[8]){w->x + 4, top, right, top, right, low, w->x + 4, low}, 4,
                 white);
    canvas_text(c, w->x + 12, w->y + 24 + below, letters, CANVAS_LEFT, ink, line);
}

/* Returns how many bytes of the title line k takes: all that are left in the last, which is cut
 * where it is too long. */
static size_t title_line(const canvas *c, double width, const char *rest, int k)
{
    const size_t used = k + 1 < LINES_MAX ? canvas_first_line(c, letters, width - 24, rest) : 0;
    return used > 0 ? used : strlen(rest);
}

double picture_title_height(const canvas *c, double width, const char *title)
{
    double height = 20;
    size_t used = title_line(c, width, title, 0);
    for (int k = 1; title[used] != '\0'; ++k) {
        height += line_height;
        title += used + strspn(title + used, " ");
        used = title_line(c, width, title, k);
    }
    return height;
}

static void draw_title(const panel *p, canvas *c)
{
    const double width = p->window.width;
    const char *rest = p->title;
    char line[sizeof p->title], fitted[sizeof line];
    for (int k = 0; k == 0 || *rest != '\0'; ++k) {
        const size_t used = title_line(c, width, rest, k);
        snprintf(line, sizeof line, "%.*s", (int)used, rest);
        canvas_fitted(c, letters, width - 24, line, fitted, sizeof fitted);
        draw_title_line(p, c, k * line_height, fitted);
        rest += used + strspn(rest + used, " ");
    }
}

static void draw_frame(const panel *p, canvas *c)
{
    const raster_window *w = &p->window;
    const double x = w->x + 0.5, y = w->y + 0.5, x1 = w->x + w->width - 0.5,
                 y1 = w->y + w->height - 0.5;
    canvas_line(c, (const double[10]){x, y, x1, y, x1, y1, x, y1, x, y}, 5,
                (pen){{0.82f, 0.84f, 0.86f}, 1});
    draw_title(p, c);
}

imp_code picture_draw(const stage *s, const panel *p, canvas *c, imp_error *error)
{
    veil v;
    imp_code code = veil_begin(&v, s, p, error);
    if (code == IMP_SUCCESS && c->raster != NULL) {
        c->raster->window = p->window;
        code = paint_surfaces(s, &p->camera, &v, c->raster, true, error);
    } else if (code == IMP_SUCCESS) {
        code = outline_surfaces(s, p, &v, c, error);
    }
    free(v.hides);
    if (p->marks && s->spot.is_known) (s->spot.is_contact ? mark_contact : mark_nearest)(s, p, c);
    draw_frame(p, c);
    return code;
}

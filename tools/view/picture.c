/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/picture.h"

#include <stdlib.h>
#include <string.h>

enum { TITLE = 20 }; /* pixels above the middle that the title takes */

static const colour ink = {0.13f, 0.15f, 0.18f}, mark = {0.84f, 0.10f, 0.11f}, white = {1, 1, 1};

colour picture_body_colour(size_t body)
{
    static const colour palette[] = {{0.40f, 0.62f, 0.86f}, {0.95f, 0.65f, 0.32f},
                                     {0.52f, 0.76f, 0.47f}, {0.79f, 0.55f, 0.80f},
                                     {0.90f, 0.83f, 0.42f}, {0.45f, 0.76f, 0.76f}};
    return palette[body % (sizeof palette / sizeof palette[0])];
}

json_t *picture_colour_json(colour c)
{
    char text[16];
    snprintf(text, sizeof text, "#%02x%02x%02x", (unsigned)(255 * c.r + 0.5f),
             (unsigned)(255 * c.g + 0.5f), (unsigned)(255 * c.b + 0.5f));
    return json_string(text);
}

static colour darker(colour c, float by) { return (colour){c.r * by, c.g * by, c.b * by}; }

static colour lighter(colour c, float by)
{
    return (colour){1 - by * (1 - c.r), 1 - by * (1 - c.g), 1 - by * (1 - c.b)};
}

void picture_frame(camera *c, const raster_window *w, const stage *s)
{
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    c->target = (vec){{0, 0, 0}};
    c->scale = 1, c->middle[0] = c->middle[1] = 0;
    if (s->cloud_count > 0) c->target = vec_scale(0.5, vec_add(s->box.lo, s->box.hi));
    for (size_t i = 0; i < s->cloud_count; ++i) {
        const vec seen = camera_see(c, s->cloud[i]);
        for (int k = 0; k < 2; ++k) lo[k] = fmin(lo[k], seen.x[k]), hi[k] = fmax(hi[k], seen.x[k]);
    }
    const double wide = hi[0] - lo[0], high = hi[1] - lo[1];
    const double scale = fmin(0.88 * w->width / wide, (0.9 * w->height - TITLE) / high);
    const bool extends = scale > 0 && scale < INFINITY;
    c->scale = extends ? scale : 100;
    c->middle[0] = w->x + 0.5 * w->width - (extends ? 0.5 * scale * (lo[0] + hi[0]) : 0);
    c->middle[1] = w->y + 0.5 * (w->height + TITLE) - (extends ? 0.5 * scale * (lo[1] + hi[1]) : 0);
}

/* --- Surfaces ----------------------------------------------------------------------------- */

typedef struct painter {
    const camera *camera;
    raster *raster;
    colour colour;
} painter;

static void paint_triangle(void *context, const mesh *m, const size_t c[3])
{
    const painter *paint = context;
    const camera *cam = paint->camera;
    raster_corner corner[3];
    for (int k = 0; k < 3; ++k) {
        const vec n = m->normal[c[k]];
        corner[k].at = camera_see(cam, m->point[c[k]]);
        corner[k].normal =
            (vec){{vec_dot(n, cam->right), vec_dot(n, cam->up), vec_dot(n, cam->toward)}};
    }
    raster_triangle(paint->raster, corner, paint->colour);
}

/* Two pixels nearer than the surface they lie on, so that they are not lost in it. */
static vec lifted(const camera *c, vec p)
{
    vec seen = camera_see(c, p);
    seen.x[2] += 1.5;
    return seen;
}

static void paint_step(void *context, const mesh *m, size_t from, size_t to)
{
    const painter *paint = context;
    raster_line(paint->raster, lifted(paint->camera, m->point[from]),
                lifted(paint->camera, m->point[to]), 0.8, darker(paint->colour, 0.62f), true);
}

static void paint_surfaces(const stage *s, const camera *c, raster *r, bool lines)
{
    for (size_t k = 0; k < s->count; ++k) {
        painter paint = {c, r, picture_body_colour(s->meshes[k].body)};
        if (!stage_is_there(s, &s->meshes[k])) continue;
        mesh_triangles(&s->meshes[k], paint_triangle, &paint);
        if (lines) mesh_marked_steps(&s->meshes[k], paint_step, &paint);
    }
}

/* --- As lines ------------------------------------------------------------------------------- */

/* Depths of the panel, to tell what is hidden. */
typedef struct outliner {
    const camera *camera;
    const raster *depths; /* of the panel alone */
    raster_window window; /* of the panel */
    canvas *canvas;
    colour colour;
    bool hidden; /* which of the two kinds of step is drawn now */
} outliner;

static bool is_inside(const raster_window *w, const double *p)
{
    return p[0] >= w->x && p[0] <= w->x + w->width && p[1] >= w->y && p[1] <= w->y + w->height;
}

static void outline_step(void *context, const mesh *m, size_t from, size_t to)
{
    const outliner *o = context;
    const vec a = lifted(o->camera, m->point[from]), b = lifted(o->camera, m->point[to]);
    const vec middle = vec_scale(0.5, vec_add(a, b));
    const raster_window *w = &o->window;
    if (!is_inside(w, a.x) || !is_inside(w, b.x)) return;
    const double front = raster_depth(o->depths, middle.x[0] - w->x, middle.x[1] - w->y);
    if ((front > middle.x[2] + 1.5) != o->hidden) return;
    const colour c = o->hidden ? lighter(o->colour, 0.35f) : darker(o->colour, 0.75f);
    canvas_line(o->canvas, (const double[4]){a.x[0], a.x[1], b.x[0], b.x[1]}, 2,
                (pen){c, o->hidden ? 0.4 : 0.9});
}

static imp_code outline_surfaces(const stage *s, const panel *p, canvas *c, imp_error *error)
{
    raster depths;
    camera shifted = p->camera;
    shifted.middle[0] -= p->window.x, shifted.middle[1] -= p->window.y;
    const bool begun =
        raster_begin(&depths, (size_t)p->window.width, (size_t)p->window.height, white);
    if (begun) paint_surfaces(s, &shifted, &depths, false);
    for (int pass = 0; pass < 2 && begun; ++pass)
        for (size_t k = 0; k < s->count; ++k) {
            const mesh *m = &s->meshes[k];
            outliner o = {&p->camera, &depths, p->window, c, picture_body_colour(m->body),
                          pass == 0};
            if (stage_is_there(s, m)) mesh_marked_steps(m, outline_step, &o);
        }
    raster_free(&depths);
    return begun ? IMP_SUCCESS : mesh_no_memory(error);
}

/* --- Marks ---------------------------------------------------------------------------------- */

static void arrow(canvas *c, const double from[2], const double to[2])
{
    const double dx = to[0] - from[0], dy = to[1] - from[1], length = sqrt(dx * dx + dy * dy);
    if (!(length > 4)) return;
    const double x = dx / length, y = dy / length, base[2] = {to[0] - 11 * x, to[1] - 11 * y};
    canvas_line(c, (const double[4]){from[0], from[1], base[0], base[1]}, 2, (pen){mark, 2.2});
    canvas_shape(c,
                 (const double[6]){to[0], to[1], base[0] - 5 * y, base[1] + 5 * x, base[0] + 5 * y,
                                   base[1] - 5 * x},
                 3, mark);
}

/* The normal is drawn as long as a sixth of the panel would be, seen from the side. */
static void draw_marks(const stage *s, const panel *p, canvas *c)
{
    const vec at = camera_see(&p->camera, stage_contact_point(s));
    if (!is_inside(&p->window, at.x)) return;
    if (s->contact.has_normal) {
        const vec tip = vec_along(stage_contact_point(s), p->window.height / 6 / p->camera.scale,
                                  s->contact.normal);
        arrow(c, at.x, camera_see(&p->camera, tip).x);
    }
    canvas_disc(c, at.x[0], at.x[1], 5.2, white);
    canvas_disc(c, at.x[0], at.x[1], 3.8, mark);
}

static void draw_frame(const panel *p, canvas *c)
{
    const raster_window *w = &p->window;
    const double x0 = w->x + 0.5, y0 = w->y + 0.5, x1 = x0 + w->width - 1, y1 = y0 + w->height - 1;
    canvas_line(c, (const double[10]){x0, y0, x1, y0, x1, y1, x0, y1, x0, y0}, 5,
                (pen){{0.82f, 0.84f, 0.86f}, 1});
    const double right = w->x + 20 + 9.4 * (double)strlen(p->title), low = w->y + 32;
    canvas_shape(c,
                 (const double[8]){w->x + 4, w->y + 4, right, w->y + 4, right, low, w->x + 4, low},
                 4, white);
    canvas_text(c, w->x + 12, w->y + 24, 17, CANVAS_LEFT, ink, p->title);
}

imp_code picture_draw(const stage *s, const panel *p, canvas *c, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    if (c->raster != NULL) {
        c->raster->window = p->window;
        paint_surfaces(s, &p->camera, c->raster, true);
    } else {
        code = outline_surfaces(s, p, c, error);
    }
    if (p->marks) draw_marks(s, p, c);
    draw_frame(p, c);
    return code;
}

/* --- From where to look ------------------------------------------------------------------------ */

enum { LOOK = 64 }; /* pixels: width and height of a trial */

/* Whether the contact is in front, and how well its normal shows. */
static double merit(const stage *s, raster *r, direction d)
{
    camera c = camera_toward(d.azimuth, d.elevation);
    const raster_window all = {0, 0, LOOK, LOOK};
    picture_frame(&c, &all, s);
    for (size_t k = 0; k < LOOK * LOOK * RASTER_FINE * RASTER_FINE; ++k) r->depth[k] = -INFINITY;
    paint_surfaces(s, &c, r, false);
    const vec at = camera_see(&c, stage_contact_point(s));
    const bool seen = raster_depth(r, at.x[0], at.x[1]) <= at.x[2] + 1;
    const double side =
        s->contact.has_normal ? 1 - fabs(vec_dot(s->contact.normal, c.toward)) : 0.5;
    const double turned = fmod(fabs(d.azimuth + 55) + 1e-9, 360);
    return (seen ? 2 : 0) + side - (turned > 180 ? 360 - turned : turned) / 400 -
           fabs(d.elevation - 25) / 200;
}

imp_code picture_choose(const stage *s, direction *chosen, imp_error *error)
{
    static const double elevations[] = {25, 50, -20};
    raster r;
    double best = -INFINITY;
    *chosen = (direction){-55, 25};
    if (s->contact.verdict != IMP_CONTACT) return IMP_SUCCESS;
    const bool begun = raster_begin(&r, LOOK, LOOK, white);
    for (size_t k = 0; k < 3 && begun; ++k)
        for (int turn = 0; turn < 8; ++turn) {
            const direction d = {-55 + 45 * turn, elevations[k]};
            const double found = merit(s, &r, d);
            if (found > best) best = found, *chosen = d;
        }
    raster_free(&r);
    return begun ? IMP_SUCCESS : mesh_no_memory(error);
}

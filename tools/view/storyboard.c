/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/storyboard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CAPTION = 34 }; /* pixels below the panels */

/* Of all surfaces together: 3 seconds of work, and a picture's pixels. */
enum { MAX_CELLS = 400000 };

imp_code storyboard_stage(const subject *what, const view_request *request, double *moments,
                          size_t count, stage *s, imp_error *error)
{
    const size_t bodies = imp_scene_body_count(what->scene);
    const stage_detail detail = {request->tolerance, MAX_CELLS, INFINITY};
    *s = (stage){.scene = what->scene,
                 .t_start = what->options.t_start,
                 .t_end = what->options.t_end,
                 .contact = what->contact,
                 .body_count = bodies < request->body_count ? bodies : request->body_count,
                 .moments = moments,
                 .moment_count = count};
    if (moments == NULL) return mesh_no_memory(error);
    return stage_make(s, &detail, error);
}

/* --- Which moments ------------------------------------------------------------------------ */

typedef struct story {
    double moments[4];
    char titles[4][96];
    size_t count;
    bool close_up; /* a last panel, of the contact's moment again */
    size_t contact;
} story;

static void add(story *tale, double t, const char *what)
{
    tale->moments[tale->count] = t;
    snprintf(tale->titles[tale->count++], sizeof tale->titles[0], "%st = %.7g", what, t);
}

static story plan(const subject *what, const view_request *request)
{
    story tale = {.contact = SIZE_MAX};
    const double t0 = what->options.t_start, t1 = what->options.t_end;
    if (request->has_at) {
        add(&tale, request->at, "");
    } else if (what->contact.verdict == IMP_CONTACT) {
        if (what->contact.t > t0) add(&tale, t0, "start: ");
        tale.contact = tale.count, tale.close_up = true;
        add(&tale, what->contact.t, "contact: ");
        if (what->contact.t < t1) add(&tale, t1, "end: ");
    } else if (t0 < t1) {
        for (int k = 0; k < 4; ++k)
            add(&tale, k == 3 ? t1 : t0 + (t1 - t0) * k / 3,
                k == 0   ? "start: "
                : k == 3 ? "end: "
                         : "");
    } else {
        add(&tale, t0, "");
    }
    return tale;
}

/* --- Panels --------------------------------------------------------------------------------- */

static raster_window window_of(const view_request *request, size_t panels, size_t k)
{
    const size_t columns = panels > 1 ? 2 : 1, rows = (panels + columns - 1) / columns;
    const double width = floor(request->width / (double)columns);
    const double height = floor((request->height - CAPTION) / (double)rows);
    return (raster_window){(double)(k % columns) * width, (double)(k / columns) * height, width,
                           height};
}

/* About the contact, where there is one and more than all is asked for. */
static void zoom(camera *c, const raster_window *w, const stage *s, double factor)
{
    const bool contact = s->contact.verdict == IMP_CONTACT;
    if (!(factor != 1)) return;
    if (contact) {
        c->target = stage_contact_point(s);
        c->middle[0] = w->x + 0.5 * w->width, c->middle[1] = w->y + 0.5 * w->height;
    } else {
        c->middle[0] += (factor - 1) * (c->middle[0] - w->x - 0.5 * w->width);
        c->middle[1] += (factor - 1) * (c->middle[1] - w->y - 0.5 * w->height);
    }
    c->scale *= factor;
}

static camera camera_for(const stage *s, const view_request *request, direction from,
                         const raster_window *w)
{
    camera c = camera_toward(from.azimuth, from.elevation);
    picture_frame(&c, w, s);
    zoom(&c, w, s, request->zoom);
    return c;
}

static imp_code draw_moments(stage *s, const story *tale, const view_request *request,
                             direction from, canvas *c, imp_error *error)
{
    const size_t panels = tale->count + tale->close_up;
    for (size_t k = 0; k < tale->count; ++k) {
        panel p = {.window = window_of(request, panels, k), .marks = k == tale->contact};
        p.camera = camera_for(s, request, from, &p.window);
        memcpy(p.title, tale->titles[k], sizeof p.title);
        imp_code code = stage_move(s, tale->moments[k], error);
        if (code == IMP_SUCCESS) code = picture_draw(s, &p, c, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

/* --- The contact from near -------------------------------------------------------------------- */

/* Diagonal of the smallest body's box, where the meshes stand. */
static double smallest_body(const stage *s)
{
    double least = INFINITY;
    for (size_t b = 0; b < s->body_count; ++b) {
        vec_box box = vec_box_empty();
        for (size_t k = 0; k < s->count; ++k)
            if (s->meshes[k].body == b && stage_is_there(s, &s->meshes[k]))
                for (size_t i = 0; i < s->meshes[k].nu * s->meshes[k].nv; ++i)
                    vec_box_add(&box, s->meshes[k].point[i]);
        const double size = vec_length(vec_sub(box.hi, box.lo));
        if (size > 0 && size < least) least = size;
    }
    return least;
}

static double close_up_radius(const stage *s)
{
    const double all = stage_size(s), small = 0.25 * smallest_body(s);
    return fmax(all / 60, fmin(small, all / 8));
}

static imp_code draw_close_up(stage *whole, const view_request *request, direction from,
                              const raster_window *w, canvas *c, double *error_upper,
                              imp_error *error)
{
    imp_code code = stage_move(whole, whole->contact.t, error);
    const double radius = close_up_radius(whole);
    panel p = {.window = *w, .camera = camera_toward(from.azimuth, from.elevation), .marks = true};
    p.camera.target = stage_contact_point(whole);
    p.camera.middle[0] = w->x + 0.5 * w->width, p.camera.middle[1] = w->y + 0.5 * w->height;
    p.camera.scale = 0.5 * fmin(w->width, w->height) / radius;
    const double near = p.camera.scale / camera_for(whole, request, from, w).scale;
    snprintf(p.title, sizeof p.title, "contact, %.3g times nearer", near);
    const stage_detail detail = {stage_size(whole) / 2000 / fmax(1, near), MAX_CELLS,
                                 1.5 * radius * hypot(w->width, w->height) /
                                     fmin(w->width, w->height)};
    stage s = {.scene = whole->scene,
               .t_start = whole->t_start,
               .t_end = whole->t_end,
               .contact = whole->contact,
               .body_count = whole->body_count,
               .moments = malloc(sizeof *s.moments),
               .moment_count = 1};
    if (s.moments == NULL) code = mesh_no_memory(error);
    if (code == IMP_SUCCESS) s.moments[0] = whole->contact.t;
    if (code == IMP_SUCCESS) code = stage_make(&s, &detail, error);
    if (code == IMP_SUCCESS) code = stage_move(&s, whole->contact.t, error);
    if (code == IMP_SUCCESS) code = picture_draw(&s, &p, c, error);
    if (s.error_upper > *error_upper) *error_upper = s.error_upper;
    stage_free(&s);
    return code;
}

/* --- All ------------------------------------------------------------------------------------- */

static void draw_caption(const stage *s, const view_request *request, canvas *c)
{
    const colour ink = {0.13f, 0.15f, 0.18f};
    const double y = request->height - 11;
    double x = 12;
    for (size_t b = 0; b < s->body_count && b < 6; ++b) {
        const char *name = imp_scene_body_name(s->scene, b);
        canvas_disc(c, x + 6, y - 5, 6, picture_body_colour(b));
        canvas_text(c, x + 18, y, 15, CANVAS_LEFT, ink, name);
        x += 40 + 8.2 * (double)strlen(name);
    }
    char text[128];
    snprintf(text, sizeof text, "surfaces drawn to within %.2g", s->error_upper);
    canvas_text(c, request->width - 12, y, 15, CANVAS_RIGHT, ink, text);
}

imp_code storyboard_direction(stage *s, const view_request *request, direction *from,
                              imp_error *error)
{
    imp_code code = stage_move(s, s->contact.t, error);
    if (code == IMP_SUCCESS) code = picture_choose(s, from, error);
    if (request->has_azimuth) from->azimuth = request->from.azimuth;
    if (request->has_elevation) from->elevation = request->from.elevation;
    s->error_upper = 0;
    return code;
}

static imp_code draw(stage *s, const story *tale, const view_request *request, canvas *c,
                     double *error_upper, imp_error *error)
{
    direction from;
    const size_t panels = tale->count + tale->close_up;
    const raster_window last = window_of(request, panels, panels - 1);
    imp_code code = storyboard_direction(s, request, &from, error);
    if (code == IMP_SUCCESS) code = draw_moments(s, tale, request, from, c, error);
    if (code == IMP_SUCCESS && tale->close_up)
        code = draw_close_up(s, request, from, &last, c, error_upper, error);
    if (s->error_upper > *error_upper) *error_upper = s->error_upper;
    if (c->raster != NULL)
        c->raster->window = (raster_window){0, 0, request->width, request->height};
    if (code == IMP_SUCCESS) draw_caption(s, request, c);
    return code;
}

imp_code storyboard_draw(const subject *what, const view_request *request, canvas *c,
                         double *error_upper, imp_error *error)
{
    const story tale = plan(what, request);
    double *moments = malloc(sizeof tale.moments);
    stage s;
    *error_upper = 0;
    if (moments != NULL) memcpy(moments, tale.moments, sizeof tale.moments);
    imp_code code = storyboard_stage(what, request, moments, tale.count, &s, error);
    if (code == IMP_SUCCESS) code = draw(&s, &tale, request, c, error_upper, error);
    stage_free(&s);
    return code;
}

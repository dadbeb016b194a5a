/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/storyboard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/view/legend.h"
#include "tools/view/picture.h"

/* Most cells of all surfaces together: 3 seconds of work, and a picture's pixels. */
enum { MAX_CELLS = 400000 };

imp_code storyboard_stage(subject *what, const view_request *request, double *moments, size_t count,
                          stage *s, imp_error *error)
{
    const stage_detail detail = {request->tolerance, MAX_CELLS, INFINITY};
    *s = (stage){.scene = what->scene,
                 .allowance = &what->allowance,
                 .t_start = what->options.t_start,
                 .t_end = what->options.t_end,
                 .contact = what->contact,
                 .spot = what->spot,
                 .body_count =
                     what->body_count > 0 ? what->body_count : imp_scene_body_count(what->scene),
                 .moments = moments,
                 .moment_count = count};
    if (moments == NULL) return mesh_no_memory(error);
    return stage_make(s, &detail, error);
}

/* --- Which moments ---------------------------------------------------------------------------- */

enum { MOMENTS = 4 };

typedef struct story {
    double moments[MOMENTS]; /* ascending */
    char titles[MOMENTS][sizeof((panel *)NULL)->title];
    size_t count;
    bool close_up;      /* a last panel, of the spot from near */
    const char *axis;   /* what the moments are of */
    const char *values; /* at which the scene stands; empty: it has no parameters */
    bool is_moment;     /* there is one moment only, which needs no name beside values */
    size_t spot;        /* the moment that is the spot's; SIZE_MAX: none is */
} story;

/* The values are named once: in the first title. */
static void add(story *tale, double t, const char *what, const char *more)
{
    const char *values = tale->count == 0 ? tale->values : "";
    char at[48] = "";
    if (values[0] == '\0' || !tale->is_moment)
        snprintf(at, sizeof at, "%.24s = %.7g", tale->axis, t);
    tale->moments[tale->count] = t;
    snprintf(tale->titles[tale->count++], sizeof tale->titles[0], "%s%s%s%s%s", what, at,
             at[0] != '\0' && values[0] != '\0' ? ", " : "", values, more);
}

/* Adds the title of the spot: "a and b" if there are several distances. */
static void add_spot(story *tale, const subject *what)
{
    const stage_spot *spot = &what->spot;
    const char *a = imp_scene_body_name(what->scene, spot->body[0]);
    const char *b = imp_scene_body_name(what->scene, spot->body[1]);
    char more[200];
    if (spot->is_contact)
        snprintf(more, sizeof more, ", %.80s and %.80s", a, b);
    else
        snprintf(more, sizeof more, ", %.80s and %.80s %.4g apart", a, b, spot->upper);
    tale->spot = tale->count;
    add(tale, spot->t, spot->is_contact ? "contact: " : "nearest: ", more);
}

static void add_proved(story *tale, const subject *what)
{
    const stage_contact *c = &what->contact;
    if (!c->is_known || c->verdict != IMP_VERDICT_UNDECIDED) return;
    if (c->t > what->options.t_start && c->t < what->options.t_end)
        add(tale, c->t, "no contact before: ", "");
}

/* Moments as far from each other, where none is worth more than another. */
static void plan_even(story *tale, double t0, double t1)
{
    static const char *const titles[MOMENTS] = {"start: ", "", "", "end: "};
    for (size_t k = 0; k < MOMENTS; ++k)
        add(tale, k + 1 == MOMENTS ? t1 : t0 + (t1 - t0) * (double)k / (MOMENTS - 1), titles[k],
            "");
}

/* Plans panels for the start, the end, and the events between. */
static void plan_all(story *tale, const subject *what)
{
    const double t0 = what->options.t_start, t1 = what->options.t_end;
    const stage_spot *spot = &what->spot;
    const bool spot_between = spot->is_known && t0 < spot->t && spot->t < t1;
    const bool proved_first = spot_between && what->contact.t < spot->t;
    tale->close_up = spot->is_known;
    if (spot->is_known && spot->t <= t0)
        add_spot(tale, what);
    else
        add(tale, t0, "start: ", "");
    if (proved_first) add_proved(tale, what);
    if (spot_between) add_spot(tale, what);
    if (!proved_first) add_proved(tale, what);
    if (t0 < t1 && !(spot->is_known && spot->t >= t1))
        add(tale, t1, "end: ", "");
    else if (t0 < t1)
        add_spot(tale, what);
}

static story plan(const subject *what, const view_request *request)
{
    story tale = {.spot = SIZE_MAX,
                  .axis = what->axis,
                  .values = what->values.text,
                  .is_moment = what->options.t_start == what->options.t_end};
    if (request->at_kind == REQUEST_AT_SPOT && what->spot.is_known)
        add_spot(&tale, what);
    else if (request->at_kind == REQUEST_AT_SPOT)
        add(&tale, what->options.t_start, "", ": nothing comes near anything");
    else if (request->at_kind == REQUEST_AT_TIME)
        add(&tale, request->at, "", "");
    else if (!what->spot.is_known && what->options.t_start < what->options.t_end)
        plan_even(&tale, what->options.t_start, what->options.t_end);
    else
        plan_all(&tale, what);
    if (request->at_kind == REQUEST_AT_TIME && what->spot.is_known && request->at == what->spot.t)
        tale.spot = 0;
    return tale;
}

/* --- Panels ----------------------------------------------------------------------------------- */

/* Data that all panels of a picture share. */
typedef struct board {
    stage *stage;
    const story *tale;
    const view_request *request;
    canvas *canvas;
    direction from;
    double height; /* pixels above the legend */
    double title;  /* pixels of the highest title */
} board;

static raster_window window_of(const board *b, size_t k)
{
    const size_t panels = b->tale->count + b->tale->close_up, columns = panels > 1 ? 2 : 1;
    const size_t rows = (panels + columns - 1) / columns;
    const double width = floor(b->canvas->width / (double)columns);
    const double height = floor(b->height / (double)rows);
    return (raster_window){(double)(k % columns) * width, (double)(k / columns) * height, width,
                           height};
}

/* Zooms in on the spot, if there is one and the request has a zoom. */
static void zoom(camera *c, const raster_window *w, const stage *s, double factor)
{
    if (!(factor != 1)) return;
    if (s->spot.is_known) {
        c->target = stage_spot_point(s);
        c->middle[0] = w->x + 0.5 * w->width, c->middle[1] = w->y + 0.5 * w->height;
    } else {
        c->middle[0] += (factor - 1) * (c->middle[0] - w->x - 0.5 * w->width);
        c->middle[1] += (factor - 1) * (c->middle[1] - w->y - 0.5 * w->height);
    }
    c->scale *= factor;
}

static camera camera_for(const board *b, const raster_window *w)
{
    camera c = camera_toward(b->from.azimuth, b->from.elevation);
    picture_frame(&c, w, b->stage, b->title);
    zoom(&c, w, b->stage, b->request->zoom);
    return c;
}

static imp_code draw_moments(const board *b, imp_error *error)
{
    const story *tale = b->tale;
    for (size_t k = 0; k < tale->count; ++k) {
        panel p = {.window = window_of(b, k), .marks = k == tale->spot};
        p.camera = camera_for(b, &p.window);
        memcpy(p.title, tale->titles[k], sizeof p.title);
        imp_code code = stage_move(b->stage, tale->moments[k], error);
        if (code == IMP_SUCCESS) code = picture_draw(b->stage, &p, b->canvas, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

/* --- The spot from near ----------------------------------------------------------------------- */

/* Returns the diagonal of the smallest body's box, at the meshes' present time. */
static double smallest_body(const stage *s)
{
    double least = INFINITY;
    for (size_t k = 0; k < s->count;) {
        vec_box box = vec_box_empty();
        const size_t body = s->meshes[k].body;
        for (; k < s->count && s->meshes[k].body == body; ++k)
            for (size_t i = 0; i < s->meshes[k].point_count && stage_is_there(s, &s->meshes[k]);
                 ++i)
                vec_box_add(&box, s->meshes[k].point[i]);
        const double size = vec_length(vec_sub(box.hi, box.lo));
        if (size > 0 && size < least) least = size;
    }
    return least;
}

/* Returns the radius around the spot that the close-up shows: both points at least. */
static double close_up_radius(const stage *s)
{
    const double all = stage_size(s), small = 0.25 * smallest_body(s);
    const double apart = vec_length(vec_sub(s->spot.point[1], s->spot.point[0]));
    return fmax(fmax(all / 60, 0.8 * apart), fmin(small, all / 8));
}

/* Makes a separate stage, finer near the spot. *near: its scale relative to the other panels. */
static imp_code make_close_up(const board *b, panel *p, double *near, stage *fine, imp_error *error)
{
    const stage *whole = b->stage;
    const raster_window *w = &p->window;
    const double radius = close_up_radius(whole), side = fmin(w->width, w->height);
    p->camera = camera_toward(b->from.azimuth, b->from.elevation);
    p->camera.target = stage_spot_point(whole);
    p->camera.middle[0] = w->x + 0.5 * w->width, p->camera.middle[1] = w->y + 0.5 * w->height;
    p->camera.scale = 0.5 * side / radius;
    *near = p->camera.scale / camera_for(b, w).scale;
    const stage_detail detail = {stage_size(whole) / 2000 / fmax(1, *near), MAX_CELLS,
                                 1.5 * radius * hypot(w->width, w->height) / side};
    *fine = (stage){.scene = whole->scene,
                    .allowance = whole->allowance,
                    .t_start = whole->t_start,
                    .t_end = whole->t_end,
                    .contact = whole->contact,
                    .spot = whole->spot,
                    .body_count = whole->body_count,
                    .moments = malloc(sizeof *fine->moments),
                    .moment_count = 1};
    if (fine->moments == NULL) return mesh_no_memory(error);
    fine->moments[0] = whole->spot.t;
    return stage_make(fine, &detail, error);
}

static imp_code draw_close_up(const board *b, double *error_upper, imp_error *error)
{
    stage fine = {.scene = NULL};
    panel p = {.window = window_of(b, b->tale->count), .marks = true};
    double near = 1;
    imp_code code = stage_move(b->stage, b->stage->spot.t, error);
    if (code == IMP_SUCCESS) code = make_close_up(b, &p, &near, &fine, error);
    snprintf(p.title, sizeof p.title, "%s, %.3g times nearer",
             b->stage->spot.is_contact ? "contact" : "nearest", near);
    if (code == IMP_SUCCESS) code = stage_move(&fine, fine.spot.t, error);
    if (code == IMP_SUCCESS) code = picture_draw(&fine, &p, b->canvas, error);
    if (fine.error_upper > *error_upper) *error_upper = fine.error_upper;
    stage_free(&fine);
    return code;
}

/* --- All -------------------------------------------------------------------------------------- */

static const char note_format[] = "surfaces drawn to within %.2g";

imp_code storyboard_direction(stage *s, const view_request *request, direction *from,
                              imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    if (s->spot.is_known) code = stage_move(s, s->spot.t, error);
    if (code == IMP_SUCCESS) code = visibility_choose(s, from, error);
    if (request->has_azimuth) from->azimuth = request->from.azimuth;
    if (request->has_elevation) from->elevation = request->from.elevation;
    s->error_upper = 0;
    return code;
}

static imp_code draw(stage *s, const story *tale, const view_request *request, canvas *c,
                     double *error_upper, imp_error *error)
{
    char note[sizeof note_format + 16];
    snprintf(note, sizeof note, note_format, 0.00012345); /* as long as any */
    board b = {s, tale, request, c, {0, 0}, c->height - legend_height(s, c, note), 0};
    for (size_t k = 0; k < tale->count; ++k)
        b.title = fmax(b.title, picture_title_height(c, window_of(&b, k).width, tale->titles[k]));
    imp_code code = storyboard_direction(s, request, &b.from, error);
    if (code == IMP_SUCCESS) code = draw_moments(&b, error);
    if (code == IMP_SUCCESS && tale->close_up) code = draw_close_up(&b, error_upper, error);
    if (s->error_upper > *error_upper) *error_upper = s->error_upper;
    if (code != IMP_SUCCESS) return code;
    if (c->raster != NULL) c->raster->window = (raster_window){0, 0, c->width, c->height};
    snprintf(note, sizeof note, note_format, s->error_upper);
    legend_draw(s, c, note);
    return code;
}

imp_code storyboard_draw(subject *what, const view_request *request, canvas *c, double *error_upper,
                         imp_error *error)
{
    *error_upper = 0;
    imp_code code = subject_find_nearest(what, error);
    if (code != IMP_SUCCESS) return code;
    const story tale = plan(what, request);
    double *moments = malloc(sizeof tale.moments);
    stage s;
    if (moments != NULL) memcpy(moments, tale.moments, sizeof tale.moments);
    code = storyboard_stage(what, request, moments, tale.count, &s, error);
    if (code == IMP_SUCCESS) code = draw(&s, &tale, request, c, error_upper, error);
    stage_free(&s);
    return code;
}

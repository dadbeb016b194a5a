/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/html_data.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/view/palette.h"

/* --- Arrays ----------------------------------------------------------------------------------- */

/* 32-bit numbers to be encoded in base64. */
typedef struct packed {
    uint8_t *bytes;
    size_t length, room;
} packed;

static bool packed_begin(packed *p, size_t numbers)
{
    *p = (packed){malloc(4 * numbers + 1), 0, 4 * numbers};
    return p->bytes != NULL;
}

static void put_word(packed *p, uint32_t word)
{
    for (int k = 0; k < 4 && p->length < p->room; ++k)
        p->bytes[p->length++] = (uint8_t)(word >> (8 * k));
}

static void put_float(packed *p, double number)
{
    const float single = (float)number;
    uint32_t word;
    memcpy(&word, &single, sizeof word);
    put_word(p, word);
}

/* RFC 4648. Frees the numbers; NULL: no memory. */
static json_t *packed_json(packed *p)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc((p->length + 2) / 3 * 4 + 1), *to = text;
    for (size_t k = 0; k < p->length && text != NULL; k += 3) {
        uint32_t three = 0;
        for (size_t i = 0; i < 3; ++i)
            three = three << 8 | (k + i < p->length ? p->bytes[k + i] : 0);
        for (int i = 0; i < 4; ++i) *to++ = digits[three >> (18 - 6 * i) & 63];
    }
    for (size_t k = p->length; k % 3 != 0; ++k)
        if (text != NULL) to[-(ptrdiff_t)(k + 1 - p->length)] = '=';
    json_t *json = text != NULL ? json_stringn(text, (size_t)(to - text)) : NULL;
    free(text);
    free(p->bytes);
    return json;
}

static json_t *numbers_json(const double *x, size_t count)
{
    json_t *array = json_array();
    for (size_t k = 0; k < count; ++k) json_array_append_new(array, output_json_number(x[k]));
    return array;
}

static json_t *vector_json(vec v) { return numbers_json(v.x, 3); }

/* --- Places ----------------------------------------------------------------------------------- */

/* The page's numbers have 32 bits: its origin is the middle of the scene, its unit the scene's
 * size, so that large and distant scenes lose no visible precision. */
typedef struct frame {
    vec centre;
    double unit; /* 1 / length */
} frame;

static frame frame_of(const stage *s)
{
    const vec_box *box = &s->cloud.box;
    if (s->cloud.count == 0) return (frame){{{0, 0, 0}}, 1};
    return (frame){vec_scale(0.5, vec_add(box->lo, box->hi)), 1 / stage_size(s)};
}

static vec place_of(const frame *f, vec p) { return vec_scale(f->unit, vec_sub(p, f->centre)); }

static json_t *places_json(const frame *f, const vec *x, size_t count)
{
    packed p;
    if (!packed_begin(&p, 3 * count)) return NULL;
    for (size_t k = 0; k < count; ++k) {
        const vec at = f != NULL ? place_of(f, x[k]) : x[k];
        for (int i = 0; i < 3; ++i) put_float(&p, at.x[i]);
    }
    return packed_json(&p);
}

/* --- One surface ------------------------------------------------------------------------------ */

static void put_corners(void *context, const mesh *m, const size_t c[3], size_t cell)
{
    (void)m, (void)cell;
    for (int k = 0; k < 3; ++k) put_word(context, (uint32_t)c[k]);
}

static json_t *triangles_json(const mesh *m)
{
    packed p;
    if (!packed_begin(&p, 3 * m->triangle_count)) return NULL;
    mesh_triangles(m, put_corners, &p);
    return packed_json(&p);
}

static json_t *steps_json(const mesh *m, bool edges)
{
    packed p;
    if (!packed_begin(&p, 2 * m->step_count)) return NULL;
    for (size_t k = 0; k < m->step_count; ++k) {
        if ((m->steps[k].kind == MESH_EDGE) != edges) continue;
        put_word(&p, m->steps[k].from);
        put_word(&p, m->steps[k].to);
    }
    return packed_json(&p);
}

/* In the page's coordinates the pose x -> R x + s is x -> R x + (R c + s - c) / size. */
static json_t *poses_json(const frame *f, const track *t, size_t frames)
{
    json_t *poses = json_array();
    for (size_t k = 0; k < frames; ++k) {
        const pose *p = &t->poses[k];
        const vec shift = place_of(f, pose_apply(p, f->centre));
        const double all[7] = {p->turn[0], p->turn[1], p->turn[2], p->turn[3],
                               shift.x[0], shift.x[1], shift.x[2]};
        json_array_append_new(poses, numbers_json(all, 7));
    }
    return poses;
}

static json_t *presence_json(const track *t, size_t frames)
{
    json_t *array = json_array();
    for (size_t k = 0; k < frames; ++k) json_array_append_new(array, json_boolean(t->there[k]));
    return array;
}

typedef struct proof {
    packed *to;
    const double *pairs; /* of the cells */
} proof;

static void put_proof(void *context, const mesh *m, const size_t c[3], size_t cell)
{
    const proof *p = context;
    (void)m, (void)c;
    put_float(p->to, p->pairs[cell]);
}

/* Returns, for each triangle, how many pairs had been tested when it was proved clear. */
static json_t *proved_json(const html_page *page, size_t index)
{
    const mesh *m = page->film->tracks[index].mesh;
    packed p;
    if (page->regions.count == 0) return json_null();
    if (!packed_begin(&p, m->triangle_count)) return NULL;
    proof all = {&p, page->regions.pairs[index]};
    mesh_triangles(m, put_proof, &all);
    return packed_json(&p);
}

static json_t *surface_json(const html_page *page, const frame *f, size_t index)
{
    const track *t = &page->film->tracks[index];
    const size_t frames = page->film->frames, shown = t->rigid ? 1 : frames;
    return json_pack("{s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "body",
                     (json_int_t)t->mesh->body, "count", (json_int_t)t->count, "index",
                     triangles_json(t->mesh), "lines", steps_json(t->mesh, false), "edges",
                     steps_json(t->mesh, true), "points",
                     places_json(f, t->point, shown * t->count), "normals",
                     places_json(NULL, t->normal, shown * t->count), "poses",
                     t->rigid ? poses_json(f, t, frames) : json_null(), "there",
                     presence_json(t, frames), "proved", proved_json(page, index));
}

/* --- The whole -------------------------------------------------------------------------------- */

static json_t *surfaces_json(const html_page *page, const frame *f)
{
    json_t *all = json_array();
    for (size_t k = 0; k < page->film->count && all != NULL; ++k)
        if (json_array_append_new(all, surface_json(page, f, k)) != 0) {
            json_decref(all);
            all = NULL;
        }
    return all;
}

/* "#rrggbb" */
static json_t *colour_json(colour c)
{
    char text[16];
    snprintf(text, sizeof text, "#%02x%02x%02x", (unsigned)(255 * c.r + 0.5f),
             (unsigned)(255 * c.g + 0.5f), (unsigned)(255 * c.b + 0.5f));
    return json_string(text);
}

static json_t *bodies_json(const stage *s)
{
    json_t *all = json_array();
    for (size_t b = 0; b < s->body_count; ++b)
        json_array_append_new(all, json_pack("{s:o, s:o, s:b}", "name",
                                             output_json_text(imp_scene_body_name(s->scene, b)),
                                             "colour", colour_json(palette_colour(b)), "shown",
                                             imp_scene_surface_count(s->scene, b) > 0));
    return all;
}

static json_t *spot_json(const stage *s, const frame *f)
{
    const stage_spot *spot = &s->spot;
    if (!spot->is_known) return json_null();
    return json_pack("{s:o, s:b, s:o, s:o, s:o, s:[i,i], s:o}", "t", output_json_number(spot->t),
                     "contact", spot->is_contact, "a", vector_json(place_of(f, spot->point[0])),
                     "b", vector_json(place_of(f, spot->point[1])), "normal",
                     spot->has_normal ? vector_json(spot->normal) : json_null(), "bodies",
                     (int)spot->body[0], (int)spot->body[1], "distance",
                     output_json_number(spot->upper));
}

static json_t *events_json(const html_page *page, const frame *f)
{
    json_t *all = json_array();
    for (size_t k = 0; k < page->events->count; ++k) {
        const event *e = &page->events->event[k];
        json_array_append_new(all, json_pack("{s:o, s:o, s:o, s:o}", "t", output_json_number(e->t),
                                             "point", vector_json(place_of(f, e->point)), "normal",
                                             e->has_normal ? vector_json(e->normal) : json_null(),
                                             "what", output_json_text(e->what)));
    }
    return all;
}

static json_t *gap_json(const gap_profile *gap, size_t times)
{
    if (gap->count == 0) return json_null();
    return json_pack("{s:o, s:o, s:o}", "t", numbers_json(gap->t, times), "lower",
                     numbers_json(gap->lower, gap->count), "upper",
                     numbers_json(gap->upper, gap->count));
}

/* Returns the answer in words. */
static json_t *told_json(const html_page *page)
{
    const stage *s = &page->film->stage;
    const char *axis = page->axis;
    char text[700];
    const stage_contact *c = &s->contact;
    const stage_spot *spot = &s->spot;
    size_t used = 0;
    text[0] = '\0';
    if (c->is_known && c->verdict == IMP_VERDICT_CONTACT)
        snprintf(text, sizeof text, "First contact at %.64s = %.7g", axis, c->t);
    else if (c->is_known && c->verdict == IMP_VERDICT_CLEAR)
        snprintf(text, sizeof text, "No contact from %.64s = %.7g to %.7g, proved. ", axis,
                 s->t_start, s->t_end);
    else if (c->is_known)
        snprintf(text, sizeof text, "No contact before %.64s = %.7g, proved; not decided after. ",
                 axis, c->t);
    used = strlen(text);
    if (spot->is_known)
        snprintf(text + used, sizeof text - used,
                 spot->is_contact ? ": %.100s and %.100s; proved that none is earlier. "
                                  : "Nearest: %.100s and %.100s, %.4g apart at %.64s = %.7g. ",
                 imp_scene_body_name(s->scene, spot->body[0]),
                 imp_scene_body_name(s->scene, spot->body[1]), spot->upper, axis, spot->t);
    used = strlen(text);
    snprintf(text + used, sizeof text - used, "Surfaces are drawn to within %.2g.", s->error_upper);
    return output_json_text(text);
}

json_t *html_data(const html_page *page)
{
    const film *f = page->film;
    const stage *s = &f->stage;
    const frame place = frame_of(s);
    json_t *searched = page->regions.count > 0 ? json_real(page->regions.total) : json_null();
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "title",
                     output_json_text(page->title), "times", numbers_json(f->times, f->frames),
                     "spot", spot_json(s, &place), "told", told_json(page), "axis",
                     output_json_text(page->axis), "bodies", bodies_json(s), "surfaces",
                     surfaces_json(page, &place), "toward", vector_json(page->toward), "events",
                     events_json(page, &place), "gap", gap_json(&page->gap, page->gap.count + 1),
                     "distance", gap_json(&page->moments, page->moments.count), "searched",
                     searched);
}

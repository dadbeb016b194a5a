/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/html_data.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/result.h"
#include "tools/view/picture.h"

/* --- Arrays ----------------------------------------------------------------------------------- */

/* 32-bit numbers on their way into base64. */
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

static void put_vectors(packed *p, const vec *x, size_t count)
{
    for (size_t i = 0; i < 3 * count; ++i) put_float(p, x[i / 3].x[i % 3]);
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

static json_t *vectors_json(const vec *x, size_t count)
{
    packed p;
    if (!packed_begin(&p, 3 * count)) return NULL;
    put_vectors(&p, x, count);
    return packed_json(&p);
}

static json_t *numbers_json(const double *x, size_t count)
{
    json_t *array = json_array();
    for (size_t k = 0; k < count; ++k) json_array_append_new(array, output_json_number(x[k]));
    return array;
}

static json_t *vector_json(vec v) { return numbers_json(v.x, 3); }

/* --- One surface --------------------------------------------------------------------------------- */

static void put_corners(void *context, const mesh *m, const size_t c[3])
{
    (void)m;
    for (int k = 0; k < 3; ++k) put_word(context, (uint32_t)c[k]);
}

static json_t *triangles_json(const mesh *m)
{
    packed p;
    if (!packed_begin(&p, 3 * mesh_triangle_count(m))) return NULL;
    mesh_triangles(m, put_corners, &p);
    return packed_json(&p);
}

static void put_step(void *context, const mesh *m, size_t from, size_t to)
{
    (void)m;
    put_word(context, (uint32_t)from);
    put_word(context, (uint32_t)to);
}

static json_t *lines_json(const mesh *m)
{
    packed p;
    if (!packed_begin(&p, 4 * m->nu * m->nv)) return NULL;
    mesh_marked_steps(m, put_step, &p);
    return packed_json(&p);
}

static json_t *poses_json(const track *t, size_t frames)
{
    json_t *poses = json_array();
    for (size_t k = 0; k < frames; ++k) {
        const pose *p = &t->poses[k];
        const double all[7] = {p->turn[0],    p->turn[1],    p->turn[2],   p->turn[3],
                               p->shift.x[0], p->shift.x[1], p->shift.x[2]};
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

/* For each cell how many pairs had been tested when it was proved clear. */
static json_t *proved_json(const html_page *page, size_t index)
{
    const mesh *m = page->film->tracks[index].mesh;
    const size_t cells = (m->nu - 1) * (m->nv - 1);
    packed p;
    if (page->regions == NULL) return json_null();
    if (!packed_begin(&p, cells)) return NULL;
    for (size_t k = 0; k < cells; ++k) put_float(&p, page->regions->pairs[index][k]);
    return packed_json(&p);
}

static json_t *surface_json(const html_page *page, size_t index)
{
    const track *t = &page->film->tracks[index];
    const size_t frames = page->film->frames, shown = t->rigid ? 1 : frames;
    return json_pack("{s:o, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "colour",
                     picture_colour_json(picture_body_colour(t->mesh->body)), "count",
                     (json_int_t)t->count, "index", triangles_json(t->mesh), "lines",
                     lines_json(t->mesh), "points", vectors_json(t->point, shown * t->count),
                     "normals", vectors_json(t->normal, shown * t->count), "poses",
                     t->rigid ? poses_json(t, frames) : json_null(), "there",
                     presence_json(t, frames), "proved", proved_json(page, index));
}

/* --- The whole ----------------------------------------------------------------------------------- */

static json_t *surfaces_json(const html_page *page)
{
    json_t *all = json_array();
    for (size_t k = 0; k < page->film->count && all != NULL; ++k)
        if (json_array_append_new(all, surface_json(page, k)) != 0) {
            json_decref(all);
            all = NULL;
        }
    return all;
}

static json_t *bodies_json(const stage *s)
{
    json_t *all = json_array();
    for (size_t b = 0; b < s->body_count; ++b)
        json_array_append_new(
            all, json_pack("{s:o, s:o}", "name", output_json_text(imp_scene_body_name(s->scene, b)),
                           "colour", picture_colour_json(picture_body_colour(b))));
    return all;
}

static json_t *contact_json(const stage *s)
{
    if (s->contact.verdict != IMP_CONTACT) return json_null();
    return json_pack("{s:o, s:o, s:o}", "t", output_json_number(s->contact.t), "point",
                     vector_json(stage_contact_point(s)), "normal",
                     s->contact.has_normal ? vector_json(s->contact.normal) : json_null());
}

static json_t *gap_json(const gap_profile *gap)
{
    return json_pack("{s:o, s:o, s:o}", "t", numbers_json(gap->t, gap->count + 1), "lower",
                     numbers_json(gap->lower, gap->count), "upper",
                     numbers_json(gap->upper, gap->count));
}

static json_t *told_json(const stage *s)
{
    char text[256];
    const char *verdict = result_verdict_name(s->contact.verdict);
    if (s->contact.verdict == IMP_CONTACT)
        snprintf(text, sizeof text, "contact at t = %.10g, gap at most %.3g", s->contact.t,
                 s->contact.gamma);
    else
        snprintf(text, sizeof text, "%s, proved until t = %.10g", verdict, s->contact.t);
    snprintf(text + strlen(text), sizeof text - strlen(text), "; surfaces drawn to within %.2g",
             s->error_upper);
    return json_string(text);
}

json_t *html_data(const html_page *page)
{
    const film *f = page->film;
    const stage *s = &f->stage;
    json_t *searched = page->regions != NULL ? json_real(page->regions->total) : json_null();
    json_t *gap = page->gap != NULL ? gap_json(page->gap) : json_null();
    const vec centre = vec_scale(0.5, vec_add(s->box.lo, s->box.hi));
    return json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:f, s:o, s:o}", "title",
                     "impinge view", "times", numbers_json(f->times, f->frames), "contact",
                     contact_json(s), "told", told_json(s), "bodies", bodies_json(s), "surfaces",
                     surfaces_json(page), "centre", vector_json(centre), "toward",
                     vector_json(page->toward), "size", stage_size(s), "gap", gap, "searched",
                     searched);
}

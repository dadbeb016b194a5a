/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/legend.h"

#include <string.h>

#include "tools/view/palette.h"

static const colour ink = {0.13f, 0.15f, 0.18f};

/* Pixels: margin at both sides, from dot to name, between entries, height of a row and of
 * letters. */
static const double margin = 12, to_name = 18, between = 24, row_height = 22, text_size = 15;

/* A place for the next entry. */
typedef struct flow {
    double x, width;
    size_t row, rows; /* rows: at most */
    bool is_full;
} flow;

static flow flow_begin(const canvas *c)
{
    const double rows = floor((c->height / 3 - margin) / row_height);
    return (flow){margin, c->width - 2 * margin, 0, rows > 1 ? (size_t)rows : 1, false};
}

/* The width is at most that of a row. */
static bool flow_place(flow *f, double width, double *x, size_t *row)
{
    if (f->x > margin && f->x + width > margin + f->width) f->x = margin, f->row += 1;
    if (f->row >= f->rows) return false;
    *x = f->x, *row = f->row;
    f->x += width + between;
    return true;
}

/* A name that fits into the row, cut off if necessary. */
typedef struct legend_name {
    char text[256];
    double width;
} legend_name;

static legend_name name_of(const canvas *c, const char *name, double room)
{
    legend_name n;
    canvas_fitted(c, text_size, room, name, n.text, sizeof n.text);
    n.width = canvas_text_width(c, text_size, n.text);
    return n;
}

/* Bodies with surfaces from `body` on. */
static size_t bodies_from(const stage *s, size_t body)
{
    size_t count = 0;
    for (; body < s->body_count; ++body) count += imp_scene_surface_count(s->scene, body) > 0;
    return count;
}

/* Returns the baseline of a row; that of the bottom row is above the margin. */
static double row_y(const canvas *c, size_t rows, size_t row)
{
    return c->height - margin - row_height * (double)(rows - 1 - row);
}

static void draw_entry(canvas *c, double x, double y, size_t body, const char *name)
{
    canvas_disc(c, x + 6, y - 5, 6, palette_colour(body));
    canvas_text_fixed(c, x + to_name, y, text_size, ink, name);
}

/* Lays everything out, and draws it where `rows`, the number of rows, is not 0. Answers that
 * number. */
static size_t lay_out(const stage *s, canvas *c, const char *note, size_t rows)
{
    flow f = flow_begin(c);
    double x;
    size_t row = 0;
    char rest[48];
    for (size_t b = 0; b < s->body_count; ++b) {
        if (imp_scene_surface_count(s->scene, b) == 0) continue;
        const legend_name name = name_of(c, imp_scene_body_name(s->scene, b), f.width - to_name);
        flow after = f;
        if (!flow_place(&after, to_name + name.width, &x, &row)) break;
        /* The last row needs space for the count of the rest, unless this is the last entry. */
        snprintf(rest, sizeof rest, "and %zu more", bodies_from(s, b));
        const double rest_width = canvas_text_width(c, text_size, rest);
        const bool is_last = bodies_from(s, b) == 1;
        const bool fits = after.x + rest_width <= margin + f.width || row + 1 < f.rows;
        if (!is_last && !fits) {
            if (!flow_place(&f, rest_width, &x, &row)) break;
            if (rows > 0) canvas_text_fixed(c, x, row_y(c, rows, row), text_size, ink, rest);
            break;
        }
        f = after;
        if (rows > 0) draw_entry(c, x, row_y(c, rows, row), b, name.text);
    }
    const double width = canvas_text_width(c, text_size, note);
    size_t note_row = row;
    if (f.x + width > margin + f.width && f.x > margin) note_row = row + 1;
    if (rows > 0)
        canvas_text(c, c->width - margin, row_y(c, rows, note_row), text_size, CANVAS_RIGHT, ink,
                    note);
    return note_row + 1;
}

double legend_height(const stage *s, const canvas *c, const char *note)
{
    canvas unused = *c;
    return margin + row_height * (double)lay_out(s, &unused, note, 0);
}

void legend_draw(const stage *s, canvas *c, const char *note)
{
    lay_out(s, c, note, lay_out(s, c, note, 0));
}

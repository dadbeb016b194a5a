/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/canvas.h"

#include <string.h>

#include "tools/view/stroke_font.h"

/* --- SVG -------------------------------------------------------------------------------- */

canvas canvas_svg_begin(FILE *file, double width, double height)
{
    fprintf(file,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" "
            "viewBox=\"0 0 %g %g\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
            width, height, width, height);
    return (canvas){.width = width, .height = height, .file = file};
}

void canvas_svg_end(const canvas *c) { fputs("</svg>\n", c->file); }

static void svg_colour(const canvas *c, const char *key, colour k)
{
    fprintf(c->file, " %s=\"#%02x%02x%02x\"", key, (unsigned)(255 * k.r + 0.5f),
            (unsigned)(255 * k.g + 0.5f), (unsigned)(255 * k.b + 0.5f));
}

static void svg_points(const canvas *c, const char *element, const double *xy, size_t n)
{
    fprintf(c->file, "<%s points=\"", element);
    for (size_t k = 0; k < n; ++k)
        fprintf(c->file, "%s%.2f,%.2f", k > 0 ? " " : "", xy[2 * k], xy[2 * k + 1]);
    fputs("\"", c->file);
}

static void svg_escaped(const canvas *c, const char *text)
{
    for (; *text != '\0'; ++text) {
        const char *entity = *text == '<' ? "&lt;" : *text == '&' ? "&amp;" : NULL;
        if (entity != NULL)
            fputs(entity, c->file);
        else
            fputc(*text >= 0x20 && *text < 0x7F ? *text : '?', c->file);
    }
}

static void svg_text(canvas *c, double x, double y, double size, canvas_anchor anchor, colour tint,
                     const char *text)
{
    static const char *const anchors[] = {"start", "middle", "end"};
    fprintf(c->file,
            "<text x=\"%.2f\" y=\"%.2f\" font-family=\"sans-serif\" font-size=\"%.2f\" "
            "text-anchor=\"%s\"",
            x, y, 0.8 * size, anchors[anchor]);
    svg_colour(c, "fill", tint);
    fputs(">", c->file);
    svg_escaped(c, text);
    fputs("</text>\n", c->file);
}

/* --- Either ----------------------------------------------------------------------------- */

void canvas_line(canvas *c, const double *xy, size_t n, pen p)
{
    if (c->file != NULL) {
        svg_points(c, "polyline", xy, n);
        svg_colour(c, "stroke", p.colour);
        fprintf(c->file, " fill=\"none\" stroke-width=\"%.2f\" stroke-linejoin=\"round\"/>\n",
                p.width);
        return;
    }
    for (size_t k = 0; k + 1 < n; ++k)
        raster_line(c->raster, (vec){{xy[2 * k], xy[2 * k + 1], 0}},
                    (vec){{xy[2 * k + 2], xy[2 * k + 3], 0}}, p.width, p.colour, false);
}

void canvas_shape(canvas *c, const double *xy, size_t n, colour fill)
{
    if (c->file != NULL) {
        svg_points(c, "polygon", xy, n);
        svg_colour(c, "fill", fill);
        fputs("/>\n", c->file);
        return;
    }
    raster_flat(c->raster, xy, n, fill);
}

void canvas_disc(canvas *c, double x, double y, double radius, colour fill)
{
    enum { CORNERS = 32 };
    double xy[2 * CORNERS];
    for (size_t k = 0; k < CORNERS; ++k) {
        const double angle = (2 * 3.14159265358979323846 / CORNERS) * (double)k;
        xy[2 * k] = x + radius * cos(angle), xy[2 * k + 1] = y + radius * sin(angle);
    }
    canvas_shape(c, xy, CORNERS, fill);
}

static void stroke_text(canvas *c, double x, double y, double size, canvas_anchor anchor,
                        colour tint, const char *text)
{
    const double unit = size / STROKE_LINE, wide = unit * STROKE_ADVANCE;
    const double length = wide * (double)strlen(text);
    if (anchor == CANVAS_MIDDLE) x -= 0.5 * length;
    if (anchor == CANVAS_RIGHT) x -= length;
    for (; *text != '\0'; ++text, x += wide) {
        double from[2] = {0, 0};
        bool drawing = false;
        for (const char *s = stroke_of(*text); *s != '\0';) {
            if (*s == ' ') {
                drawing = false;
                ++s;
                continue;
            }
            const double to[2] = {x + unit * (s[0] - '0'), y - unit * (s[1] - '2')};
            if (drawing)
                canvas_line(c, (const double[4]){from[0], from[1], to[0], to[1]}, 2,
                            (pen){tint, 1.05 * unit});
            from[0] = to[0], from[1] = to[1], drawing = true;
            s += 2;
        }
    }
}

void canvas_text(canvas *c, double x, double y, double size, canvas_anchor anchor, colour tint,
                 const char *text)
{
    if (c->file != NULL)
        svg_text(c, x, y, size, anchor, tint, text);
    else
        stroke_text(c, x, y, size, anchor, tint, text);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/canvas.h"

#include <string.h>

#include "tools/view/stroke_font.h"

/* --- SVG -------------------------------------------------------------------------------------- */

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

/* XML 1.0 allows no control characters and no U+FFFE and U+FFFF, even as references; "]]>" must not
 * stand in text. */
static void svg_escaped(const canvas *c, const char *text)
{
    for (; *text != '\0'; ++text) {
        const unsigned char byte = (unsigned char)*text;
        const bool is_no_character =
            strncmp(text, "\xEF\xBF\xBE", 3) == 0 || strncmp(text, "\xEF\xBF\xBF", 3) == 0;
        if (byte == '<')
            fputs("&lt;", c->file);
        else if (byte == '>')
            fputs("&gt;", c->file);
        else if (byte == '&')
            fputs("&amp;", c->file);
        else
            fputc(byte < 0x20 || byte == 0x7F || is_no_character ? '?' : byte, c->file);
        if (is_no_character) text += 2;
    }
}

/* Sizes of letters are those of strokes, of which a line is higher than the letters of a
 * typeface. */
static const double svg_letters = 0.8;

/* `length`: the text is stretched or compressed to this many pixels; 0: its natural length. */
static void svg_text(canvas *c, double x, double y, double size, canvas_anchor anchor, colour tint,
                     double length, const char *text)
{
    static const char *const anchors[] = {"start", "middle", "end"};
    fprintf(c->file,
            "<text x=\"%.2f\" y=\"%.2f\" font-family=\"sans-serif\" font-size=\"%.2f\" "
            "text-anchor=\"%s\"",
            x, y, svg_letters * size, anchors[anchor]);
    if (length > 0)
        fprintf(c->file, " textLength=\"%.2f\" lengthAdjust=\"spacingAndGlyphs\"", length);
    svg_colour(c, "fill", tint);
    fputs(">", c->file);
    svg_escaped(c, text);
    fputs("</text>\n", c->file);
}

/* --- Either ----------------------------------------------------------------------------------- */

/* Returns whether all coordinates are finite and not far outside of every picture. */
static bool are_places(const double *xy, size_t n)
{
    for (size_t k = 0; k < 2 * n; ++k)
        if (!(fabs(xy[k]) < 1e9)) return false;
    return true;
}

void canvas_line(canvas *c, const double *xy, size_t n, pen p)
{
    if (!are_places(xy, n)) return;
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
    if (!are_places(xy, n)) return;
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

/* --- Words ------------------------------------------------------------------------------------ */

/* Bytes of the character that begins here. */
static size_t character_bytes(const char *text)
{
    size_t n = 1;
    while (((unsigned char)text[n] & 0xC0) == 0x80) ++n;
    return n;
}

/* Returns the width of a character in pixels; for a typeface, one that most letters do not
 * exceed. */
static double character_width(const canvas *c, double size, const char *text)
{
    if (c->file == NULL) return size * STROKE_ADVANCE / STROKE_LINE;
    return svg_letters * size * ((unsigned char)*text < 0x80 ? 0.58 : 1);
}

double canvas_text_width(const canvas *c, double size, const char *text)
{
    double width = 0;
    for (; *text != '\0'; text += character_bytes(text)) width += character_width(c, size, text);
    return width;
}

size_t canvas_first_line(const canvas *c, double size, double room, const char *text)
{
    double width = 0;
    size_t used = 0, kept = 0; /* bytes, and those before the last space */
    while (text[used] != '\0') {
        if (text[used] == ' ') kept = used;
        width += character_width(c, size, text + used);
        if (width > room) return kept;
        used += character_bytes(text + used);
    }
    return used;
}

void canvas_fitted(const canvas *c, double size, double room, const char *text, char *fitted,
                   size_t length)
{
    static const char dots[] = "...";
    double width = 0;
    size_t used = 0, kept = 0; /* bytes that are kept, with space for the dots */
    const double less = canvas_text_width(c, size, dots);
    while (text[used] != '\0') {
        const size_t bytes = character_bytes(text + used);
        width += character_width(c, size, text + used);
        if (width > room || used + bytes + sizeof dots > length) break;
        used += bytes;
        if (width + less <= room) kept = used;
    }
    if (text[used] == '\0')
        snprintf(fitted, length, "%s", text);
    else
        snprintf(fitted, length, "%.*s%s", (int)kept, text, dots);
}

/* Draws one letter with its left foot at x, y; a character without strokes is drawn as '?'. */
static void stroke_letter(canvas *c, double x, double y, double unit, colour tint, char letter)
{
    double from[2] = {0, 0};
    bool drawing = false;
    for (const char *s = stroke_of(letter); *s != '\0';) {
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

static void stroke_text(canvas *c, double x, double y, double size, canvas_anchor anchor,
                        colour tint, const char *text)
{
    const double length = canvas_text_width(c, size, text);
    if (anchor == CANVAS_MIDDLE) x -= 0.5 * length;
    if (anchor == CANVAS_RIGHT) x -= length;
    for (; *text != '\0'; text += character_bytes(text)) {
        stroke_letter(c, x, y, size / STROKE_LINE, tint, *text);
        x += character_width(c, size, text);
    }
}

void canvas_text(canvas *c, double x, double y, double size, canvas_anchor anchor, colour tint,
                 const char *text)
{
    if (c->file != NULL)
        svg_text(c, x, y, size, anchor, tint, 0, text);
    else
        stroke_text(c, x, y, size, anchor, tint, text);
}

void canvas_text_fixed(canvas *c, double x, double y, double size, colour tint, const char *text)
{
    if (c->file != NULL)
        svg_text(c, x, y, size, CANVAS_LEFT, tint, canvas_text_width(c, size, text), text);
    else
        stroke_text(c, x, y, size, CANVAS_LEFT, tint, text);
}

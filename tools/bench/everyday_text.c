/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/everyday.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Meshes ----------------------------------------------------------------------------------- */

enum { CORNERS_MAX = 64 };

typedef struct lathe {
    bool is_open, is_inclined;
    int corners, rings;
    double circle[CORNERS_MAX][2]; /* the corners of the unit circle */
} lathe;

/* Fills the circle by halving angles, from a quarter turn on, without a call to libm but sqrt. */
static void fill_circle(lathe *m)
{
    double cosine = 0, sine = 1;
    for (int corners = 4; corners < m->corners; corners *= 2) {
        cosine = sqrt(0.5 * (1 + cosine));
        sine = 0.5 * sine / cosine;
    }
    double x = 1, y = 0;
    for (int k = 0; k < m->corners; ++k) {
        m->circle[k][0] = x;
        m->circle[k][1] = y;
        const double before = x;
        x = x * cosine - y * sine;
        y = before * sine + y * cosine;
    }
}

static void write_point(FILE *out, const lathe *m, double x, double y, double z)
{
    if (m->is_inclined)
        fprintf(out, "[%.17g,%.17g,%.17g]", (2 * x + 2 * y - z) / 3, (-x + 2 * y + 2 * z) / 3,
                (2 * x - y + 2 * z) / 3);
    else
        fprintf(out, "[%.17g,%.17g,%.17g]", x, y, z);
}

/* Reads r:z or r/s:z at *at and writes its ring of points. */
static void write_ring(FILE *out, const lathe *m, char **at)
{
    const double top = strtod(*at, at), foot = **at == '/' ? strtod(*at + 1, at) : top;
    const double z = strtod(*at + 1, at);
    for (int k = 0; k < m->corners; ++k) {
        const double r = k % 4 < 2 ? top : foot;
        fputs(m->rings + k > 0 ? "," : "", out);
        write_point(out, m, r * m->circle[k][0], r * m->circle[k][1], z);
    }
}

static void write_faces(FILE *out, const lathe *m)
{
    const int n = m->corners;
    for (int ring = 0; ring + 1 < m->rings; ++ring)
        for (int k = 0; k < n; ++k) {
            const int a = ring * n + k, b = ring * n + (k + 1) % n;
            fprintf(out, "%s[%d,%d,%d],[%d,%d,%d]", ring + k > 0 ? "," : "", a, b, b + n, a, b + n,
                    a + n);
        }
    for (int k = 1; k + 1 < n && !m->is_open; ++k)
        fprintf(out, ",[0,%d,%d],[%d,%d,%d]", k + 1, k, (m->rings - 1) * n, (m->rings - 1) * n + k,
                (m->rings - 1) * n + k + 1);
}

/* Reads what stands behind < up to >, and returns where that ends. */
static const char *write_lathe(FILE *out, const char *text)
{
    char *at = (char *)(uintptr_t)text;
    lathe m = {0};
    for (; *at != ' '; ++at) {
        m.is_open = m.is_open || *at == 'o';
        m.is_inclined = m.is_inclined || *at == 'i';
    }
    m.corners = (int)strtol(at, &at, 10);
    fill_circle(&m);
    fputs("\"type\":\"mesh\",\"points\":[", out);
    for (; *at == ' '; ++m.rings) write_ring(out, &m, &at);
    fputs("],\"faces\":[", out);
    write_faces(out, &m);
    fputs("]", out);
    return at + 1;
}

/* --- Gaps ------------------------------------------------------------------------------------- */

/* Returns the text with numbers for what c stands in; NULL: no memory. */
static char *expand_gaps(const char *text, double c)
{
    char *made = NULL;
    size_t size;
    FILE *out = open_memstream(&made, &size);
    if (out == NULL) return NULL;
    while (*text != '\0') {
        char *end;
        if (*text == '@' || *text == '~') {
            const double x = strtod(text + 1, &end);
            fprintf(out, "%.17g", *text == '@' ? x + c : x - c);
            text = end;
        } else {
            fputc(*text == '\'' ? '"' : *text, out);
            ++text;
        }
    }
    const bool complete = !ferror(out);
    if (fclose(out) == 0 && complete) return made;
    free(made);
    return NULL;
}

char *everyday_expand(const char *text, double c)
{
    char *plain = expand_gaps(text, c), *made = NULL;
    size_t size;
    FILE *out = plain != NULL ? open_memstream(&made, &size) : NULL;
    for (const char *at = plain; out != NULL && *at != '\0';)
        if (*at == '<')
            at = write_lathe(out, at + 1);
        else
            fputc(*at++, out);
    free(plain);
    const bool complete = out != NULL && !ferror(out);
    if (out != NULL && fclose(out) == 0 && complete) return made;
    free(made);
    return NULL;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/crowd.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/common/random.h"

/* Side of a cell, in which a body of radius at most 1 begins; length. */
#define CELL 2.5

typedef struct crowd {
    FILE *out;
    uint64_t state;
} crowd;

static double between(crowd *c, double lo, double hi) { return random_between(&c->state, lo, hi); }

static void write_vector(crowd *c, const char *before, double size)
{
    const double x = between(c, -size, size), y = between(c, -size, size);
    fprintf(c->out, "%s[%.6f,%.6f,%.6f]", before, x, y, between(c, -size, size));
}

/* --- Surfaces, each within 1 of the origin, and their own maps -------------------------------- */

static void write_ball(crowd *c)
{
    fprintf(c->out, "{\"type\":\"sphere\",\"radius\":%.6f}],\"maps\":[", between(c, 0.5, 1));
}

static void write_turning_ellipsoid(crowd *c)
{
    fprintf(c->out, "{\"type\":\"ellipsoid\",\"radii\":[1,%.6f,%.6f]}],\"maps\":[",
            between(c, 0.3, 0.9), between(c, 0.3, 0.9));
    write_vector(c, "{\"type\":\"rotate\",\"axis\":", 1);
    fprintf(c->out, ",\"rate\":%.6f},", between(c, -3, 3));
}

static void write_turning_torus(crowd *c)
{
    fprintf(c->out, "{\"type\":\"torus\",\"major_radius\":%.6f,\"minor_radius\":0.25}],\"maps\":[",
            between(c, 0.5, 0.7));
    write_vector(c, "{\"type\":\"rotate\",\"axis\":", 1);
    fprintf(c->out, ",\"rate\":%.6f},", between(c, -3, 3));
}

static void write_swelling_box(crowd *c)
{
    fprintf(c->out, "{\"type\":\"superellipsoid\",\"radii\":[0.4,0.5,0.6]}],\"maps\":[");
    fprintf(c->out, "{\"type\":\"scale\",\"factors\":[[1],[%.6f]]},", between(c, -0.3, 0.3));
}

static void write_bending_patch(crowd *c)
{
    fputs("{\"type\":\"bezier\",\"degree\":[2,2],\"points\":[", c->out);
    for (int k = 0; k < 9; ++k)
        fprintf(c->out, "%s[%.6f,%.6f,%.6f]", k > 0 ? "," : "", 0.6 * (k / 3) - 0.6,
                0.6 * (k % 3) - 0.6, between(c, -0.5, 0.5));
    fputs("],\"velocities\":", c->out);
    for (int k = 0; k < 9; ++k) write_vector(c, k > 0 ? "," : "[", 0.3);
    fputs("]}],\"maps\":[", c->out);
}

static void write_ripple(crowd *c)
{
    fprintf(c->out,
            "{\"type\":\"ripple\",\"size\":[1.2,1.2],\"amplitude\":%.6f,\"speed\":2}],\"maps\":[",
            between(c, 0.05, 0.2));
    write_vector(c, "{\"type\":\"rotate\",\"axis\":", 1);
    fprintf(c->out, ",\"rate\":%.6f},", between(c, -2, 2));
}

static void write_twisting_ellipsoid(crowd *c)
{
    fprintf(c->out, "{\"type\":\"ellipsoid\",\"radii\":[0.9,0.4,0.8]}],\"maps\":[");
    fprintf(c->out, "{\"type\":\"twist\",\"rate\":[0,%.6f]},", between(c, -1.5, 1.5));
}

static void write_triangle(crowd *c)
{
    for (int k = 0; k < 3; ++k)
        write_vector(c, k > 0 ? "," : "{\"type\":\"triangle\",\"points\":[", 0.55);
    fputs("]}],\"maps\":[", c->out);
}

/* --- Bodies ----------------------------------------------------------------------------------- */

static void (*const kinds[])(crowd *) = {
    write_ball,     write_bending_patch, write_turning_torus,     write_swelling_box,
    write_triangle, write_ripple,        write_turning_ellipsoid, write_twisting_ellipsoid};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* From somewhere in the cell number k of a cube of `side` cells along each edge. */
static void write_body(crowd *c, size_t k, size_t side)
{
    const size_t cell[3] = {k % side, k / side % side, k / side / side};
    fprintf(c->out, "%s{\"name\":\"%zu\",\"surfaces\":[", k > 0 ? "," : "", k);
    kinds[random_bits(&c->state) % KINDS](c);
    fputs("{\"type\":\"translate\",\"offset\":[[", c->out);
    for (int i = 0; i < 3; ++i)
        fprintf(c->out, "%s%.6f", i > 0 ? "," : "", CELL * (double)cell[i] + between(c, -0.2, 0.2));
    write_vector(c, "],", 2);
    fputs("]}]}", c->out);
}

char *crowd_text(size_t count, uint64_t seed)
{
    char *text = NULL;
    size_t length, side = 1;
    crowd c = {open_memstream(&text, &length), seed};
    if (c.out == NULL) return NULL;
    while (side * side * side < count) ++side;
    fputs("{\"bodies\":[", c.out);
    for (size_t k = 0; k < count; ++k) write_body(&c, k, side);
    fputs("]}", c.out);
    const int failed = ferror(c.out);
    if (fclose(c.out) == 0 && !failed) return text;
    free(text);
    return NULL;
}

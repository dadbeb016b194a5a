/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <stdio.h>
#include <stdlib.h>

#include "tools/bench/crowd.h"

static const bench_method models = {.name = "models"};
static const bench_method *const methods[] = {&models, NULL};

/* --- bodies ----------------------------------------------------------------------------------- */

static exit_status build_bodies(bench_cases *list, const bench_request *request)
{
    for (size_t count = 100; count <= 100000 && count <= request->up_to; count *= 10) {
        bench_begin(list, 1e-6, -1, "%zu bodies", count);
        bench_add_text(list, crowd_text(count, 14));
    }
    return bench_built(list, request);
}

const bench_set bench_bodies = {
    "bodies",
    "The first contact among many bodies, half of which deform, that drift in all directions. "
    "Memory is\nthe library's own count: the scene, its trees and the pairs that wait.",
    methods, build_bodies, NULL};

/* --- surfaces: meshes ------------------------------------------------------------------------- */

/* A point of the unit circle, from its start at 0 once around at 1, at an uneven speed, by the
 * tangents of half the angles. */
static void circle(double part, double *x, double *y)
{
    const int quarter = (int)(4 * part);
    const double t = 4 * part - quarter, c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
    const double turned[4][2] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
    *x = turned[quarter % 4][0], *y = turned[quarter % 4][1];
}

/* A torus of 2 * rows * columns triangles, radii 1 and 0.4. */
static void write_torus(FILE *out, size_t rows, size_t columns)
{
    fputs("{\"type\":\"mesh\",\"points\":[", out);
    for (size_t k = 0; k < rows * columns; ++k) {
        double c, s, a, b;
        circle((double)(k / columns) / (double)rows, &c, &s);
        circle((double)(k % columns) / (double)columns, &a, &b);
        fprintf(out, "%s[%.9f,%.9f,%.9f]", k > 0 ? "," : "", (1 + 0.4 * a) * c, (1 + 0.4 * a) * s,
                0.4 * b);
    }
    fputs("],\"faces\":[", out);
    for (size_t k = 0; k < rows * columns; ++k) {
        const size_t row = k / columns, next = (row + 1) % rows * columns;
        const size_t at = k % columns, beside = (at + 1) % columns;
        fprintf(out, "%s[%zu,%zu,%zu],[%zu,%zu,%zu]", k > 0 ? "," : "", row * columns + at,
                next + at, next + beside, row * columns + at, next + beside,
                row * columns + beside);
    }
    fputs("]}", out);
}

char *crowd_two_meshes(size_t rows, size_t columns)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    if (out == NULL) return NULL;
    fputs("{\"bodies\":[{\"surfaces\":[", out);
    write_torus(out, rows, columns);
    fputs("],\"maps\":[{\"type\":\"rotate\",\"axis\":[1,2,3],\"rate\":2}]},{\"surfaces\":[", out);
    write_torus(out, rows, columns);
    fputs("],\"maps\":[{\"type\":\"rotate\",\"axis\":[2,-1,0.5],\"rate\":-3},"
          "{\"type\":\"translate\",\"offset\":[[3.2,0.5,0.3],[-3,0,0]]}]}]}",
          out);
    const int failed = ferror(out);
    if (fclose(out) == 0 && !failed) return text;
    free(text);
    return NULL;
}

static exit_status build_surfaces(bench_cases *list, const bench_request *request)
{
    static const size_t sizes[][2] = {{5, 10}, {20, 25}, {50, 50}, {100, 100}};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        const size_t triangles = 2 * sizes[k][0] * sizes[k][1];
        if (triangles > request->up_to) break;
        bench_begin(list, 1e-6, -1, "%zu triangles each", triangles);
        bench_add_text(list, crowd_two_meshes(sizes[k][0], sizes[k][1]));
    }
    return bench_built(list, request);
}

const bench_set bench_surfaces = {
    "surfaces",
    "Two meshes, tori of ever more triangles, that turn and drift into each other. Memory is the "
    "library's\nown count.",
    methods, build_surfaces, NULL};

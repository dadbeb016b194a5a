/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_ROUGH_SHEETS_H
#define TESTS_SUPPORT_ROUGH_SHEETS_H

#include <limits.h>
#include <math.h>
#include <string.h>

#include "core/broad_phase/candidates.h"
#include "core/scene/scene.h"
#include "core/surface/surface_internal.h"
#include "core/tree/node.h"
#include "tests/support/built_plugins.h"
#include "tests/support/compose.h"

#include <impinge/baseline.h>

#include <impinge/examine.h>

/* Two rough sheets of triangles that fly at each other: each as one mesh, or as its triangles. */

static imp_registry *registry;

static inline void open_registry(void) { registry = built_registry(); }

static inline void close_registry(void) { imp_registry_free(registry); }

enum { SIDE = 7, POINTS = SIDE * SIDE, FACES = 2 * (SIDE - 1) * (SIDE - 1), TEXT = 1 << 16 };

typedef struct sheet {
    double point[POINTS][3], velocity[POINTS][3];
    int face[FACES][3];
} sheet;

/* A rough square of triangles around (0, 0, z). */
static inline sheet rough_sheet(uint64_t *random, double z, double speed)
{
    sheet s;
    for (int k = 0; k < POINTS; ++k) {
        s.point[k][0] = (k % SIDE) / 3.0 - 1 + random_between(random, -0.1, 0.1);
        s.point[k][1] = (k / SIDE) / 3.0 - 1 + random_between(random, -0.1, 0.1);
        s.point[k][2] = z + random_between(random, -0.2, 0.2);
        for (int i = 0; i < 3; ++i) s.velocity[k][i] = speed * random_between(random, -1, 1);
    }
    int(*f)[3] = s.face;
    for (int j = 0; j + 1 < SIDE; ++j)
        for (int i = 0; i + 1 < SIDE; ++i) {
            const int a = SIDE * j + i, b = a + 1, c = a + SIDE, d = c + 1;
            memcpy(*f++, (int[3]){a, b, c}, sizeof *f);
            memcpy(*f++, (int[3]){b, d, c}, sizeof *f);
        }
    return s;
}

static inline void print_vectors(FILE *out, const char *name, double (*x)[3], const int *which,
                                 int count)
{
    fprintf(out, ",\"%s\":[", name);
    for (int k = 0; k < count; ++k) {
        const double *p = x[which != NULL ? which[k] : k];
        fprintf(out, "%s[%.17g,%.17g,%.17g]", k > 0 ? "," : "", p[0], p[1], p[2]);
    }
    fprintf(out, "]");
}

static inline void print_mesh(FILE *out, sheet *s)
{
    fprintf(out, "{\"type\":\"mesh\",\"faces\":[");
    for (int k = 0; k < FACES; ++k)
        fprintf(out, "%s[%d,%d,%d]", k > 0 ? "," : "", s->face[k][0], s->face[k][1], s->face[k][2]);
    fprintf(out, "]");
    print_vectors(out, "points", s->point, NULL, POINTS);
    print_vectors(out, "velocities", s->velocity, NULL, POINTS);
    fprintf(out, "}");
}

static inline void print_triangles(FILE *out, sheet *s)
{
    for (int k = 0; k < FACES; ++k) {
        fprintf(out, "%s{\"type\":\"triangle\"", k > 0 ? "," : "");
        print_vectors(out, "points", s->point, s->face[k], 3);
        print_vectors(out, "velocities", s->velocity, s->face[k], 3);
        fprintf(out, "}");
    }
}

static const char *const motions[] = {
    "",
    "{\"type\":\"translate\",\"velocity\":[0,0.2,-1.5]}",
    ("{\"type\":\"rotate\",\"axis\":[1,2,0],\"rate\":3},"
     "{\"type\":\"translate\",\"velocity\":[0.1,0.2,-1.2]}"),
    "{\"type\":\"twist\"},{\"type\":\"rotate\",\"axis\":[0,0,1],\"rate\":-2}",
};
enum { MOTIONS = sizeof motions / sizeof *motions };

static inline imp_scene *scene_of(sheet sheets[2], const char *motion, bool whole)
{
    static char text[TEXT * 8];
    FILE *out = fmemopen(text, sizeof text, "w");
    fprintf(out, "{\"gamma\":1e-4,\"bodies\":[");
    for (int b = 0; b < 2; ++b) {
        fprintf(out, "%s{\"name\":\"%c\",\"surfaces\":[", b > 0 ? "," : "", 'a' + b);
        (whole ? print_mesh : print_triangles)(out, &sheets[b]);
        fprintf(out, "],\"maps\":[%s]}", b > 0 ? motion : "");
    }
    fprintf(out, "]}");
    ck_assert_int_eq(fclose(out), 0);
    imp_error error;
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "test", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/input.h"

/* Random moving patches, bicubic or of another degree, as X. Chen and others ("A
 * Time-Dependent Inclusion-Based Method for Continuous Collision Detection between Parametric
 * Surfaces", SIGGRAPH Asia 2024) draw them: control points uniform in [-1,1]^3, the first patch's
 * shifted by -n and the second's by n, a random direction of unit length; velocities uniform in
 * [-1,1]^3, shifted the other way. */

/* --- Drawing ---------------------------------------------------------------------------------- */

static void write_vectors(FILE *out, uint64_t *state, int count, const double n[3], double side)
{
    for (int k = 0; k < count; ++k) {
        double x[3];
        for (int i = 0; i < 3; ++i) x[i] = random_between(state, -1, 1) + side * n[i];
        fprintf(out, "%s[%.17g,%.17g,%.17g]", k > 0 ? "," : "", x[0], x[1], x[2]);
    }
}

static void write_patch(FILE *out, uint64_t *state, int degree, const double n[3], double side)
{
    const int count = (degree + 1) * (degree + 1);
    fprintf(out, "{\"surfaces\":[{\"type\":\"bezier\",\"degree\":[%d,%d],\"points\":[", degree,
            degree);
    write_vectors(out, state, count, n, side);
    fputs("],\"velocities\":[", out);
    write_vectors(out, state, count, n, -side);
    fputs("]}]}", out);
}

/* Returns the next scene of the sequence; NULL: no memory. */
static char *draw(uint64_t *state, int degree)
{
    char *text = NULL;
    size_t size;
    double n[3];
    FILE *out = open_memstream(&text, &size);
    if (out == NULL) return NULL;
    bench_direction(state, n);
    fputs("{\"bodies\":[", out);
    write_patch(out, state, degree, n, -1);
    fputs(",", out);
    write_patch(out, state, degree, n, 1);
    fputs("]}", out);
    const bool complete = !ferror(out);
    if (fclose(out) == 0 && complete) return text;
    free(text);
    return NULL;
}

void bench_add_patches(bench_cases *list, uint64_t seed, int degree, uint64_t count)
{
    for (uint64_t k = 0; k < count && !list->no_memory; ++k)
        bench_add_text(list, draw(&seed, degree));
}

/* --- The file --------------------------------------------------------------------------------- */

/* {"reference": {"verdict": "contact", "t": ...}}, as another solver answered. */
static void take_reference(bench_scene *scene)
{
    json_t *object = json_loads(scene->a, 0, NULL);
    const json_t *reference = json_object_get(object, "reference");
    const char *verdict = json_string_value(json_object_get(reference, "verdict"));
    scene->has_reference = verdict != NULL;
    scene->meets = verdict != NULL && strcmp(verdict, "contact") == 0;
    scene->t = json_number_value(json_object_get(reference, "t"));
    json_decref(object);
}

exit_status bench_add_file(bench_cases *list, const char *verb)
{
    char *path = input_package_file("bicubic_moving_100.jsonl", verb), *line = NULL;
    FILE *file = path != NULL ? input_open(path, verb) : NULL;
    size_t size = 0;
    while (file != NULL && getline(&line, &size, file) > 0 && !list->no_memory) {
        bench_scene *added = bench_add_text(list, strdup(line));
        if (added != NULL) take_reference(added);
    }
    const bool complete = file != NULL && !ferror(file);
    if (file != NULL && !complete) complain(EXIT_DATA, verb, "%s: %s", path, strerror(errno));
    free(line);
    if (file != NULL) input_close(file);
    free(path);
    return complete ? EXIT_ANSWERED : EXIT_DATA;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/common/array.h"
#include "tools/cli/input.h"

/* --- Lists of cases --------------------------------------------------------------------------- */

void bench_begin(bench_cases *list, double gamma, double gamma_clear, const char *format, ...)
{
    bench_case *cases = array_reserve(list->cases, list->count, &list->capacity, sizeof *cases);
    list->no_memory = list->no_memory || cases == NULL;
    if (cases == NULL) return;
    list->cases = cases;
    bench_case *c = &cases[list->count++];
    *c = (bench_case){.gamma = gamma, .gamma_clear = gamma_clear};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(c->name, sizeof c->name, format, arguments);
    va_end(arguments);
}

static bench_scene *add(bench_cases *list, bench_scene scene)
{
    if (list->no_memory) return NULL;
    bench_case *c = &list->cases[list->count - 1];
    bench_scene *scenes = array_reserve(c->scenes, c->count, &c->capacity, sizeof *scenes);
    list->no_memory = scenes == NULL;
    if (scenes == NULL) return NULL;
    c->scenes = scenes;
    scenes[c->count] = scene;
    return &scenes[c->count++];
}

bench_scene *bench_add_pair(bench_cases *list, char *a, char *b)
{
    list->no_memory = list->no_memory || a == NULL || b == NULL;
    bench_scene *added = add(list, (bench_scene){.a = a, .b = b});
    if (added != NULL) return added;
    free(a);
    free(b);
    return NULL;
}

bench_scene *bench_add_text(bench_cases *list, char *text)
{
    list->no_memory = list->no_memory || text == NULL;
    bench_scene *added = add(list, (bench_scene){.a = text});
    if (added == NULL) free(text);
    return added;
}

exit_status bench_add_package_file(bench_cases *list, const char *name, const char *verb)
{
    char *path = input_package_file(name, verb);
    if (path == NULL) return EXIT_DATA;
    bench_scene *added = bench_add_text(list, path);
    if (added != NULL) added->is_path = true;
    return EXIT_ANSWERED;
}

void bench_cases_free(bench_cases *list)
{
    for (size_t k = 0; k < list->count; ++k) {
        for (size_t n = 0; n < list->cases[k].count; ++n) {
            free(list->cases[k].scenes[n].a);
            free(list->cases[k].scenes[n].b);
        }
        free(list->cases[k].scenes);
    }
    free(list->cases);
    *list = (bench_cases){0};
}

char *bench_text(const char *format, ...)
{
    char *text;
    va_list arguments;
    va_start(arguments, format);
    const int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    return length >= 0 ? text : NULL;
}

exit_status bench_built(const bench_cases *list, const bench_request *request)
{
    return list->no_memory ? complain_of_memory(request->verb) : EXIT_ANSWERED;
}

/* --- Random numbers --------------------------------------------------------------------------- */

void bench_direction(uint64_t *state, double n[3])
{
    double norm;
    do {
        for (int i = 0; i < 3; ++i) n[i] = random_between(state, -1, 1);
        norm = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    } while (!(norm > 0.1 && norm <= 1));
    for (int i = 0; i < 3; ++i) n[i] /= norm;
}

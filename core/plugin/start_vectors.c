/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/start_vectors.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char **program_arguments;

/* Other C libraries give constructors nothing. */
#ifdef __GLIBC__
__attribute__((constructor)) static void keep_arguments(int count, char **arguments)
{
    (void)count;
    program_arguments = arguments;
}
#endif

static size_t count_of(char *const *vector)
{
    size_t count = 0;
    while (vector != NULL && vector[count] != NULL) ++count;
    return count;
}

/* Entries without a name stay out. */
static bool copy_names(start_vectors *v)
{
    const size_t count = count_of(environ);
    v->names = calloc(count + 1, sizeof *v->names);
    if (v->names == NULL) return false;
    for (size_t k = 0; k < count; ++k) {
        const size_t length = strcspn(environ[k], "=");
        if (length == 0 || environ[k][length] == '\0') continue;
        v->names[v->name_count] = strndup(environ[k], length);
        if (v->names[v->name_count] == NULL) return false;
        v->name_count += 1;
    }
    return true;
}

static bool copy_arguments(start_vectors *v)
{
    v->argument_count = count_of(program_arguments);
    if (v->argument_count == 0) return true;
    v->arguments = calloc(v->argument_count, sizeof *v->arguments);
    if (v->arguments == NULL) return false;
    memcpy(v->arguments, program_arguments, v->argument_count * sizeof *v->arguments);
    return true;
}

bool start_vectors_copy(start_vectors *v)
{
    *v = (start_vectors){.names = NULL};
    if (copy_names(v) && copy_arguments(v)) return true;
    start_vectors_free(v);
    return false;
}

bool start_vectors_are_kept(const start_vectors *v, char *text, size_t size)
{
    for (size_t k = 0; k < v->argument_count; ++k)
        if (program_arguments[k] != v->arguments[k]) {
            snprintf(text, size, "argument %zu of the program", k);
            return false;
        }
    for (size_t k = 0; k < v->name_count; ++k)
        if (getenv(v->names[k]) == NULL) {
            snprintf(text, size, "the environment variable %s", v->names[k]);
            return false;
        }
    return true;
}

void start_vectors_free(start_vectors *v)
{
    for (size_t k = 0; k < v->name_count; ++k) free(v->names[k]);
    free(v->names);
    free(v->arguments);
    *v = (start_vectors){.names = NULL};
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/file_state.h"
#include "core/base/status.h"
#include "core/common/array.h"
#include "core/common/sha256.h"
#include "core/common/system_error.h"
#include "core/plugin/registry.h"
#include "core/scene/scene.h"

/* The plugin files of the types that a scene uses, and the files that its values name, as a
 * certificate names them. */

/* --- Types ------------------------------------------------------------------------------------ */

typedef struct used_type {
    imp_type_kind kind;
    const char *name;
} used_type;

typedef struct used_types {
    used_type *at;
    size_t count, capacity;
} used_types;

/* Adds the type of an instance once; false: no memory. */
static bool add_type(used_types *all, const shared_instance *p)
{
    const used_type type = {p->surface != NULL ? IMP_TYPE_SURFACE : IMP_TYPE_MAP,
                            p->surface != NULL ? p->surface->name : p->map->name};
    for (size_t k = 0; k < all->count; ++k)
        if (all->at[k].kind == type.kind && strcmp(all->at[k].name, type.name) == 0) return true;
    used_type *grown = array_reserve(all->at, all->count, &all->capacity, sizeof *grown);
    if (grown == NULL) return false;
    all->at = grown;
    grown[all->count++] = type;
    return true;
}

static bool add_surfaces(used_types *all, const imp_scene *scene, size_t body)
{
    for (size_t i = 0; i < scene_surface_count(scene, body); ++i) {
        const surface *s = scene_surface(scene, body, i);
        for (size_t k = 0; k <= surface_map_count(s); ++k)
            if (!add_type(all, surface_origin(s, k))) return false;
    }
    return true;
}

/* Writes a line for a type of a file; none for one that is linked in. */
static imp_code put_type(const imp_registry *registry, const used_type *type, FILE *to,
                         imp_error *error)
{
    char hash[SHA256_TEXT];
    const char *file = registry_find_file(registry, type->kind, type->name);
    const char *slash = file != NULL ? strrchr(file, '/') : NULL;
    if (slash == NULL) return IMP_SUCCESS;
    if (!sha256_file(file, hash))
        return error_set(error, IMP_ERROR_FILE, "%s: %s", file, system_error_text(errno));
    fprintf(to, "type %s %s %s\n", type->name, hash, slash + 1);
    return IMP_SUCCESS;
}

static imp_code put_types(const imp_scene *scene, FILE *to, imp_error *error)
{
    used_types all = {.count = 0};
    imp_code code = IMP_SUCCESS;
    for (size_t b = 0; b < scene_body_count(scene) && code == IMP_SUCCESS; ++b)
        if (!add_surfaces(&all, scene, b)) code = error_set_memory(error);
    for (size_t k = 0; k < all.count && code == IMP_SUCCESS; ++k)
        code = put_type(scene_registry(scene), &all.at[k], to, error);
    free(all.at);
    return code;
}

/* --- Files ------------------------------------------------------------------------------------ */

static int compare_paths(const void *x, const void *y)
{
    return strcmp(((const named_file *)x)->path, ((const named_file *)y)->path);
}

/* Writes a name; bytes that are no printable ASCII, and %, as % and two digits. */
static void put_name(const char *name, FILE *to)
{
    for (const char *c = name; *c != '\0'; ++c)
        if (*c < ' ' || *c > '~' || *c == '%')
            fprintf(to, "%%%02x", (unsigned char)*c);
        else
            fputc(*c, to);
}

/* Writes the hash of a file that the scene was made of. False: it cannot be read again, or it is
 * not what it was: a file that is replaced by another keeps none of its times. */
static bool hash_again(const named_file *file, char hash[SHA256_TEXT])
{
    file_state now;
    return file_state_read(file->path, &now) && sha256_file(file->path, hash) &&
           file_state_read(file->path, &now) && memcmp(&now, &file->state, sizeof now) == 0;
}

/* Writes a line for each file, by path, once. */
static imp_code put_files(const named_files *files, FILE *to, imp_error *error)
{
    if (files->count == 0) return IMP_SUCCESS;
    named_file *sorted = malloc(files->count * sizeof *sorted);
    if (sorted == NULL) return error_set_memory(error);
    memcpy(sorted, files->at, files->count * sizeof *sorted);
    qsort(sorted, files->count, sizeof *sorted, compare_paths);
    for (size_t k = 0, next; k < files->count; k = next) {
        char hash[SHA256_TEXT];
        bool is_known = hash_again(&sorted[k], hash);
        for (next = k + 1; next < files->count && compare_paths(&sorted[k], &sorted[next]) == 0;
             ++next)
            if (memcmp(&sorted[k].state, &sorted[next].state, sizeof sorted->state) != 0)
                is_known = false; /* it changed while the scene was read */
        fprintf(to, "file %s ", is_known ? hash : "-");
        put_name(sorted[k].name, to);
        fputc('\n', to);
    }
    free(sorted);
    return IMP_SUCCESS;
}

/* --- All of them ------------------------------------------------------------------------------ */

static imp_code put_all(const imp_scene *scene, FILE *to, imp_error *error)
{
    const imp_code code = put_types(scene, to, error);
    return code == IMP_SUCCESS ? put_files(scene_files_named(scene), to, error) : code;
}

char *imp_scene_sources(const imp_scene *scene, imp_error *error)
{
    char *text = NULL;
    size_t size;
    if (scene == NULL) return error_set_missing(error, "imp_scene_sources"), NULL;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL) return error_set_memory(error), NULL;
    imp_code code = scene_registry(scene) != NULL ? put_all(scene, to, error) : IMP_SUCCESS;
    if (fclose(to) != 0 && code == IMP_SUCCESS) code = error_set_memory(error);
    if (code == IMP_SUCCESS) return text;
    free(text);
    return NULL;
}

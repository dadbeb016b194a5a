/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/receipt.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/common/search_path.h"
#include "tools/cli/build_tree.h"

static int stale(const char *what)
{
    printf("stale: %s\n", what);
    return STALE;
}

/* --- Types ------------------------------------------------------------------------------------ */

/* Adds the folders in which impinge would look, in its order. */
static bool find_folders(search_path *all, const char *plugin_path)
{
    const char *built = build_tree_plugins();
    if (built == NULL) return search_path_add_defaults(all, plugin_path);
    return search_path_add(all, plugin_path, true) &&
           search_path_add(all, secure_getenv("IMPINGE_PLUGIN_PATH"), true) &&
           search_path_add(all, built, false) && search_path_add_defaults(all, NULL);
}

/* Finds the first file of that name; the caller frees its path. NULL: there is none. */
static char *find_file(const search_path *all, const char *name)
{
    for (size_t k = 0; k < all->count; ++k) {
        char *path;
        if (asprintf(&path, "%s/%s", all->directory[k].path, name) < 0) return NULL;
        if (access(path, F_OK) == 0) return path;
        free(path);
    }
    return NULL;
}

static int check_type(const source *type, const search_path *all)
{
    char own[SHA256_TEXT], what[600];
    char *path = find_file(all, type->file);
    const bool found = path != NULL && sha256_file(path, own);
    int status = HOLDS;
    if (!found)
        snprintf(what, sizeof what,
                 "the type %s: its plugin %.250s %s; name its folder by --plugin-path", type->type,
                 type->file, path == NULL ? "is not found" : "cannot be read");
    else
        snprintf(what, sizeof what, "the type %s has changed: %.400s", type->type, path);
    if (!found || strcmp(own, type->hash) != 0) status = stale(what);
    free(path);
    return status;
}

static int check_types(const statement *s, const char *plugin_path)
{
    search_path all = {.count = 0};
    int status = find_folders(&all, plugin_path) ? HOLDS : stale("memory ran out");
    for (size_t k = 0; k < s->source_count && status == HOLDS; ++k)
        if (strcmp(s->sources[k].kind, "type") == 0) status = check_type(&s->sources[k], &all);
    search_path_clear(&all);
    return status;
}

/* --- Files ------------------------------------------------------------------------------------ */

static int digit_of(char c)
{
    const char *digits = "0123456789abcdef", *at = c != '\0' ? strchr(digits, c) : NULL;
    return at != NULL ? (int)(at - digits) : -1;
}

/* Puts in place of % and two digits the byte that they are. */
static void decode(char *name)
{
    char *to = name;
    for (const char *c = name; *c != '\0'; ++c) {
        const int high = *c == '%' ? digit_of(c[1]) : -1, low = high >= 0 ? digit_of(c[2]) : -1;
        *to++ = (char)(low >= 0 ? 16 * high + low : *c);
        if (low >= 0) c += 2;
    }
    *to = '\0';
}

/* Returns the path of a file that a scene names; the caller frees it. NULL: no memory. */
static char *path_of(const char *name, const char *scene)
{
    const char *slash = strrchr(scene, '/');
    const int folder = *name != '/' && slash != NULL ? (int)(slash - scene) + 1 : 0;
    char *path, *plain = strdup(name);
    if (plain == NULL) return NULL;
    decode(plain);
    const int size = asprintf(&path, "%.*s%s", folder, scene, plain);
    free(plain);
    return size >= 0 ? path : NULL;
}

static int check_file(const source *file, const char *scene)
{
    char own[SHA256_TEXT], what[600];
    char *path = path_of(file->file, scene);
    if (path == NULL) return stale("memory ran out");
    struct stat facts; /* only a regular file is read: a pipe might wait forever */
    const bool is_read =
        stat(path, &facts) == 0 && S_ISREG(facts.st_mode) && sha256_file(path, own);
    const char *why = strcmp(file->hash, "-") == 0 ? "could not be read again when it was written"
                      : !is_read                   ? "cannot be read"
                                                   : "has changed";
    snprintf(what, sizeof what, "the file %.400s %s", file->file, why);
    free(path);
    return is_read && strcmp(own, file->hash) == 0 ? HOLDS : stale(what);
}

static int check_files(const statement *s, const char *scene)
{
    int status = HOLDS;
    for (size_t k = 0; k < s->source_count && status == HOLDS; ++k)
        if (strcmp(s->sources[k].kind, "file") == 0) status = check_file(&s->sources[k], scene);
    return status;
}

/* --- The receipt ------------------------------------------------------------------------------ */

static int check_scene(const statement *s, const char *scene)
{
    char own[SHA256_TEXT];
    bool named = false;
    if (!sha256_file(scene, own)) {
        fprintf(stderr, "impinge-verify: %s: %s\n", scene, strerror(errno));
        return USAGE;
    }
    for (size_t k = 0; k < s->source_count; ++k) {
        if (strcmp(s->sources[k].kind, "scene") != 0) continue;
        named = true;
        if (strcmp(s->sources[k].hash, own) != 0) return stale("the scene has changed");
    }
    return named ? HOLDS : stale("the certificate names no scene");
}

int receipt_check(const statement *s, const char *scene, const char *plugin_path)
{
    int status = check_scene(s, scene);
    if (status == HOLDS && strcmp(s->program, "impinge " PACKAGE_VERSION) != 0) {
        char what[200];
        snprintf(what, sizeof what, "the version has changed: %s, not %.60s", PACKAGE_VERSION,
                 strncmp(s->program, "impinge ", 8) == 0 ? s->program + 8 : s->program);
        return stale(what);
    }
    if (status == HOLDS) status = check_files(s, scene);
    return status == HOLDS ? check_types(s, plugin_path) : status;
}

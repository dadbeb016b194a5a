/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "array.h"
#include "plugin_file.h"
#include "registry.h"
#include "status.h"
#include "text.h"
#include "type_view.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

typedef struct loaded_plugin {
    char *path; /* absolute */
    plugin_file file;
} loaded_plugin;

/* A file that was looked at, taken or not: the same one reached again is passed over. */
typedef struct file_identity {
    uint64_t device, inode;
} file_identity;

typedef struct found_type {
    imp_type_sort sort;
    type_view view;
    const void *type;                 /* imp_surface_type or imp_map_type */
    const loaded_plugin *from;        /* who offers it */
    const loaded_plugin *shadowed_by; /* NULL: it is the one found */
} found_type;

typedef struct refused_file {
    char *file, *reason;
} refused_file;

struct imp_registry {
    loaded_plugin **plugin; /* each on its own, since types point to them */
    size_t plugin_count, plugin_capacity;
    file_identity *seen;
    size_t seen_count, seen_capacity;
    found_type *type;
    size_t type_count, type_capacity;
    refused_file *refused;
    size_t refused_count, refused_capacity;
    trial_book *book; /* while scanning */
    bool secure;
    char *isolated; /* names between commas, ",a,b,"; "" for all; NULL for none */
};

/* --- Finding ------------------------------------------------------------------------- */

static const found_type *find(const imp_registry *r, imp_type_sort sort, const char *name)
{
    for (size_t i = 0; i < r->type_count; ++i)
        if (r->type[i].sort == sort && strcmp(r->type[i].view.name, name) == 0) return &r->type[i];
    return NULL;
}

const imp_surface_type *registry_find_surface(const imp_registry *registry, const char *name)
{
    const found_type *found = find(registry, IMP_SORT_SURFACE, name);
    return found ? found->type : NULL;
}

const imp_map_type *registry_find_map(const imp_registry *registry, const char *name)
{
    const found_type *found = find(registry, IMP_SORT_MAP, name);
    return found ? found->type : NULL;
}

const char *registry_find_file(const imp_registry *registry, imp_type_sort sort, const char *name)
{
    const found_type *found = find(registry, sort, name);
    return found ? found->from->path : NULL;
}

const char *registry_nearest(const imp_registry *registry, imp_type_sort sort, const char *name)
{
    text_nearest search = {.wanted = name};
    for (size_t i = 0; i < registry->type_count; ++i)
        if (registry->type[i].sort == sort)
            text_nearest_offer(&search, registry->type[i].view.name);
    return search.best;
}

bool registry_isolates(const imp_registry *registry, const char *name)
{
    if (!registry->isolated || registry->isolated[0] == '\0') return registry->isolated != NULL;
    char wanted[TEXT_NAME_MAX + 3];
    snprintf(wanted, sizeof wanted, ",%s,", name);
    return strstr(registry->isolated, wanted) != NULL;
}

/* The first name of a list ",a,b," that is no type's, cut out into `name`; false: there is none. */
static bool unknown_name(const imp_registry *r, const char *list, char name[TEXT_NAME_MAX + 1])
{
    for (const char *c = list + 1; *c != '\0'; c += strcspn(c, ",") + 1) {
        snprintf(name, TEXT_NAME_MAX + 1, "%.*s", (int)strcspn(c, ","), c);
        if (!find(r, IMP_SORT_SURFACE, name) && !find(r, IMP_SORT_MAP, name)) return true;
    }
    return false;
}

imp_code imp_registry_isolate(imp_registry *registry, const char *names, imp_error *error)
{
    const size_t size = names ? strlen(names) + 3 : 1;
    char *list = malloc(size), unknown[TEXT_NAME_MAX + 1];
    if (!list) return error_set_memory(error);
    snprintf(list, size, names ? ",%s," : "%s", names ? names : "");
    if (names && unknown_name(registry, list, unknown)) {
        free(list);
        return error_set(error, IMP_ERROR_USAGE,
                         "there is no type '%s' to isolate; `impinge list` shows what there is",
                         unknown);
    }
    free(registry->isolated);
    registry->isolated = list;
    return IMP_SUCCESS;
}

bool imp_registry_type(const imp_registry *registry, size_t index, imp_type_info *info)
{
    if (!registry || !info || index >= registry->type_count) return false;
    const found_type *found = &registry->type[index];
    const imp_plugin *entry = found->from->file.entry;
    *info = (imp_type_info){
        .sort = found->sort,
        .name = found->view.name,
        .summary = found->view.summary,
        .equation = found->view.equation,
        .source = found->view.source,
        .example = found->view.example,
        .file = found->from->path,
        .plugin = entry->name,
        .version = entry->version,
        .license = entry->license,
        .author = entry->author,
        .shadowed_by = found->shadowed_by ? found->shadowed_by->path : NULL,
        .parameters = found->view.table.rows,
        .parameter_count = found->view.table.count,
        .parameter_size = found->view.table.stride,
    };
    return true;
}

bool imp_registry_refusal(const imp_registry *registry, size_t index, imp_plugin_refusal *refusal)
{
    if (!registry || !refusal || index >= registry->refused_count) return false;
    *refusal = (imp_plugin_refusal){registry->refused[index].file, registry->refused[index].reason};
    return true;
}

/* --- Filling. Each answers false only when memory ran out. -------------------------- */

static bool add_refusal(imp_registry *r, const char *file, const char *reason)
{
    refused_file *grown =
        array_reserve(r->refused, r->refused_count, &r->refused_capacity, sizeof *grown);
    if (!grown) return false;
    r->refused = grown;
    refused_file *refused = &r->refused[r->refused_count++];
    *refused = (refused_file){strdup(file), strdup(reason)};
    return refused->file && refused->reason;
}

static bool add_type(imp_registry *r, const loaded_plugin *from, imp_type_sort sort,
                     const void *type, type_view view)
{
    found_type *grown = array_reserve(r->type, r->type_count, &r->type_capacity, sizeof *grown);
    if (!grown) return false;
    r->type = grown;
    const found_type *earlier = find(r, sort, view.name);
    r->type[r->type_count++] = (found_type){sort, view, type, from, earlier ? earlier->from : NULL};
    return true;
}

static bool add_types(imp_registry *r, const loaded_plugin *plugin)
{
    const imp_surface_factory *surfaces = plugin->file.surfaces;
    for (uint32_t i = 0; surfaces && i < surfaces->count; ++i) {
        const imp_surface_type *type = surfaces->types[i];
        if (!add_type(r, plugin, IMP_SORT_SURFACE, type, type_view_of_surface(type))) return false;
    }
    const imp_map_factory *maps = plugin->file.maps;
    for (uint32_t i = 0; maps && i < maps->count; ++i) {
        const imp_map_type *type = maps->types[i];
        if (!add_type(r, plugin, IMP_SORT_MAP, type, type_view_of_map(type))) return false;
    }
    return true;
}

/* Takes over an open plugin. */
static bool add_plugin(imp_registry *r, const char *path, plugin_file *file)
{
    loaded_plugin *plugin = malloc(sizeof *plugin);
    loaded_plugin **grown =
        array_reserve(r->plugin, r->plugin_count, &r->plugin_capacity, sizeof *grown);
    if (grown) r->plugin = grown;
    if (!plugin || !grown) {
        free(plugin);
        plugin_file_close(file);
        return false;
    }
    r->plugin[r->plugin_count++] = plugin;
    *plugin = (loaded_plugin){strdup(path), *file};
    return plugin->path && add_types(r, plugin);
}

static bool was_seen(const imp_registry *r, file_identity id)
{
    for (size_t i = 0; i < r->seen_count; ++i)
        if (r->seen[i].device == id.device && r->seen[i].inode == id.inode) return true;
    return false;
}

static bool add_seen(imp_registry *r, file_identity id)
{
    file_identity *grown = array_reserve(r->seen, r->seen_count, &r->seen_capacity, sizeof *grown);
    if (!grown) return false;
    r->seen = grown;
    r->seen[r->seen_count++] = id;
    return true;
}

static bool identify(const char *path, file_identity *id)
{
    struct stat facts;
    if (stat(path, &facts) != 0) return false;
    *id = (file_identity){(uint64_t)facts.st_dev, (uint64_t)facts.st_ino};
    return true;
}

/* A file that cannot be identified (a dangling link) goes on, to be refused with the reason. */
static bool scan_file(imp_registry *r, const char *path)
{
    file_identity id;
    if (identify(path, &id)) {
        if (was_seen(r, id)) return true;
        if (!add_seen(r, id)) return false;
    }
    plugin_file file;
    imp_error error;
    switch (plugin_file_open(&file, path, r->book, &error)) {
    case IMP_SUCCESS:
        return add_plugin(r, path, &file);
    case IMP_ERROR_MEMORY:
        return false;
    default:
        return add_refusal(r, path, error.text);
    }
}

static bool scan_names(imp_registry *r, const char *directory, const plugin_names *names)
{
    char *absolute = realpath(directory, NULL);
    if (!absolute) return errno != ENOMEM && add_refusal(r, directory, strerror(errno));
    bool good = true;
    for (size_t i = 0; i < names->count && good; ++i) {
        size_t size = strlen(absolute) + strlen(names->name[i]) + 2;
        char *path = malloc(size);
        if (path) snprintf(path, size, "%s/%s", absolute, names->name[i]);
        good = path && scan_file(r, path);
        free(path);
    }
    free(absolute);
    return good;
}

/* Where anybody may put a plugin, anybody's code may run here. */
static bool anyone_may_write(const char *directory)
{
    struct stat facts;
    return stat(directory, &facts) == 0 && S_ISDIR(facts.st_mode) && (facts.st_mode & S_IWOTH) != 0;
}

static bool scan_directory(imp_registry *r, const search_directory *directory)
{
    if (anyone_may_write(directory->path)) {
        const char *why = r->secure
                              ? "anyone may write to this directory: refused; chmod o-w it"
                              : "warning: anyone may write to this directory; its plugins are "
                                "taken all the same (--secure refuses them)";
        if (!add_refusal(r, directory->path, why)) return false;
        if (r->secure) return true;
    }
    plugin_names names;
    names_status status = plugin_names_read(&names, directory->path);
    const char *why = status == NAMES_UNREADABLE ? strerror(errno) : NULL;
    if (status == NAMES_NO_DIRECTORY && directory->named) why = "there is no such directory";
    bool good = status != NAMES_MEMORY;
    if (why) good = add_refusal(r, directory->path, why);
    if (good && status == NAMES_READ) good = scan_names(r, directory->path, &names);
    plugin_names_clear(&names);
    return good;
}

/* --- Life ---------------------------------------------------------------------------- */

imp_registry *registry_scan(const search_path *path, unsigned flags)
{
    imp_registry *r = calloc(1, sizeof *r);
    if (!r) return NULL;
    r->secure = (flags & IMP_REGISTRY_SECURE) != 0;
    r->book = trial_book_read();
    bool good = r->book != NULL;
    for (size_t i = 0; i < path->count && good; ++i) good = scan_directory(r, &path->directory[i]);
    trial_book_close(r->book);
    r->book = NULL;
    if (good) return r;
    imp_registry_free(r);
    return NULL;
}

imp_registry *imp_registry_open(const char *path, unsigned flags)
{
    search_path all = {.count = 0};
    imp_registry *r = search_path_add_defaults(&all, path) ? registry_scan(&all, flags) : NULL;
    search_path_clear(&all);
    return r;
}

imp_registry *imp_registry_new(const char *path) { return imp_registry_open(path, 0); }

static bool scan_one(imp_registry *r, const char *file)
{
    char *absolute = realpath(file, NULL);
    if (!absolute) return errno != ENOMEM && add_refusal(r, file, strerror(errno));
    r->book = trial_book_read();
    bool good = r->book && scan_file(r, absolute);
    trial_book_close(r->book);
    r->book = NULL;
    free(absolute);
    return good;
}

imp_registry *imp_registry_from_file(const char *file)
{
    imp_registry *r = file ? calloc(1, sizeof *r) : NULL;
    if (!r || scan_one(r, file)) return r;
    imp_registry_free(r);
    return NULL;
}

static void free_plugin(loaded_plugin *plugin)
{
    plugin_file_close(&plugin->file);
    free(plugin->path);
    free(plugin);
}

void imp_registry_free(imp_registry *r)
{
    if (!r) return;
    for (size_t i = 0; i < r->refused_count; ++i) {
        free(r->refused[i].file);
        free(r->refused[i].reason);
    }
    for (size_t i = r->plugin_count; i > 0; --i) free_plugin(r->plugin[i - 1]);
    free(r->isolated);
    free(r->refused);
    free(r->plugin);
    free(r->seen);
    free(r->type);
    free(r);
}

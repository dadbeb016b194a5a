/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/base/text.h"
#include "core/common/array.h"
#include "core/common/capabilities.h"
#include "core/common/system_error.h"
#include "core/plugin/file_trust.h"
#include "core/plugin/kept_instances.h"
#include "core/plugin/registry_internal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* --- Filling. Each returns false only when memory ran out. ------------------------------------ */

static bool add_remark(remarks *list, const char *file, const char *text)
{
    remark *grown = array_reserve(list->all, list->count, &list->capacity, sizeof *grown);
    if (grown == NULL) return false;
    list->all = grown;
    remark *fresh = &list->all[list->count++];
    *fresh = (remark){strdup(file), strdup(text)};
    return fresh->file != NULL && fresh->text != NULL;
}

static bool add_refusal(imp_registry *r, const char *file, const char *reason)
{
    return add_remark(&r->refusals, file, reason);
}

/* The names of the types, which all fit. */
static void list_capabilities(found_type *found)
{
    const imp_surface_type *surface = found->kind == IMP_TYPE_SURFACE ? found->type : NULL;
    const imp_map_type *map = found->kind == IMP_TYPE_MAP ? found->type : NULL;
    for (capability k = CAPABILITY_CORE; k < CAPABILITIES; ++k)
        if (surface_type_offers(surface, k) || map_type_offers(map, k))
            text_append(found->capabilities, sizeof found->capabilities, "%s%s",
                        k == CAPABILITY_CORE ? "" : " ", capabilities[k].name);
}

static bool add_type(imp_registry *r, const loaded_plugin *from, imp_type_kind kind,
                     const void *type, type_view view)
{
    found_type *grown = array_reserve(r->type, r->type_count, &r->type_capacity, sizeof *grown);
    if (grown == NULL) return false;
    r->type = grown;
    const found_type *earlier = registry_find(r, kind, view.name);
    r->type[r->type_count++] =
        (found_type){kind, view, type, from, earlier != NULL ? earlier->from : NULL, ""};
    list_capabilities(&r->type[r->type_count - 1]);
    return true;
}

static bool add_types(imp_registry *r, const loaded_plugin *plugin)
{
    const imp_surface_factory *surfaces = plugin->file.surfaces;
    for (uint32_t i = 0; surfaces != NULL && i < surfaces->count; ++i) {
        const imp_surface_type *type = surfaces->types[i];
        if (!add_type(r, plugin, IMP_TYPE_SURFACE, type, type_view_of_surface(type))) return false;
    }
    const imp_map_factory *maps = plugin->file.maps;
    for (uint32_t i = 0; maps != NULL && i < maps->count; ++i) {
        const imp_map_type *type = maps->types[i];
        if (!add_type(r, plugin, IMP_TYPE_MAP, type, type_view_of_map(type))) return false;
    }
    return true;
}

/* Takes over an open plugin. */
static bool add_plugin(imp_registry *r, const char *path, plugin_file *file)
{
    loaded_plugin *plugin = malloc(sizeof *plugin);
    loaded_plugin **grown =
        array_reserve(r->plugin, r->plugin_count, &r->plugin_capacity, sizeof *grown);
    if (grown != NULL) r->plugin = grown;
    if (plugin == NULL || grown == NULL) {
        free(plugin);
        plugin_file_close(file, path);
        return false;
    }
    r->plugin[r->plugin_count++] = plugin;
    *plugin = (loaded_plugin){strdup(path), *file};
    return plugin->path != NULL && add_types(r, plugin);
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
    if (grown == NULL) return false;
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
    trust_fault fault;
    if (r->secure && !file_is_trusted(path, &fault)) return add_refusal(r, path, fault.text);
    if (identify(path, &id)) {
        if (was_seen(r, id)) return true;
        if (!add_seen(r, id)) return false;
    }
    plugin_file file;
    imp_error error;
    switch (plugin_file_open(&file, path, r->cache, &error)) {
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
    if (absolute == NULL)
        return errno != ENOMEM && add_refusal(r, directory, system_error_text(errno));
    bool good = true;
    for (size_t i = 0; i < names->count && good; ++i) {
        size_t size = strlen(absolute) + strlen(names->name[i]) + 2;
        char *path = malloc(size);
        if (path != NULL) snprintf(path, size, "%s/%s", absolute, names->name[i]);
        good = path != NULL && scan_file(r, path);
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
    trust_fault fault;
    if (r->secure && access(directory->path, F_OK) == 0 &&
        !file_is_trusted(directory->path, &fault))
        return add_refusal(r, directory->path, fault.text);
    if (!r->secure && anyone_may_write(directory->path) &&
        !add_remark(&r->warnings, directory->path,
                    "anyone may write to this directory, so anyone's code may run here; chmod o-w "
                    "it (--secure takes no plugins from it)"))
        return false;
    plugin_names names;
    names_status status = plugin_names_read(&names, directory->path);
    const char *why = status == NAMES_UNREADABLE ? system_error_text(errno) : NULL;
    if (status == NAMES_NO_DIRECTORY && directory->named) why = "there is no such directory";
    bool good = status != NAMES_MEMORY;
    if (why != NULL) good = add_refusal(r, directory->path, why);
    if (good && status == NAMES_READ) good = scan_names(r, directory->path, &names);
    plugin_names_clear(&names);
    return good;
}

/* --- Whole registries ------------------------------------------------------------------------- */

/* NULL: no memory. */
static imp_registry *registry_new(void)
{
    imp_registry *r = calloc(1, sizeof *r);
    if (r == NULL) return NULL;
    r->store = arena_store_new();
    r->kept = kept_instances_new();
    if (r->store != NULL && r->kept != NULL) return r;
    imp_registry_free(r);
    return NULL;
}

FP_APART static imp_registry *scan(const search_path *path, unsigned flags)
{
    imp_registry *r = registry_new();
    if (r == NULL) return NULL;
    r->secure = (flags & IMP_REGISTRY_SECURE) != 0;
    r->cache = load_cache_read();
    bool good = r->cache != NULL;
    for (size_t i = 0; i < path->count && good; ++i) good = scan_directory(r, &path->directory[i]);
    load_cache_close(r->cache);
    r->cache = NULL;
    if (good) return r;
    imp_registry_free(r);
    return NULL;
}

imp_registry *registry_scan(const search_path *path, unsigned flags)
{
    const fp_environment environment = fp_environment_enter();
    imp_registry *r = scan(path, flags);
    fp_environment_leave(&environment);
    return r;
}

imp_registry *imp_registry_open(const char *path, unsigned flags)
{
    search_path all = {.count = 0};
    const bool good = (flags & IMP_REGISTRY_ONLY_PATH) != 0 ? search_path_add(&all, path, true)
                                                            : search_path_add_defaults(&all, path);
    imp_registry *r = good ? registry_scan(&all, flags) : NULL;
    search_path_clear(&all);
    return r;
}

imp_registry *imp_registry_new(const char *path) { return imp_registry_open(path, 0); }

FP_APART static bool scan_one(imp_registry *r, const char *file)
{
    char *absolute = realpath(file, NULL);
    if (absolute == NULL) return errno != ENOMEM && add_refusal(r, file, system_error_text(errno));
    r->cache = load_cache_read();
    bool good = r->cache != NULL && scan_file(r, absolute);
    load_cache_close(r->cache);
    r->cache = NULL;
    free(absolute);
    return good;
}

imp_registry *imp_registry_from_file(const char *file)
{
    imp_registry *r = file != NULL ? registry_new() : NULL;
    if (r == NULL) return NULL;
    const fp_environment environment = fp_environment_enter();
    const bool good = scan_one(r, file);
    fp_environment_leave(&environment);
    if (good) return r;
    imp_registry_free(r);
    return NULL;
}

/* --- Linked in -------------------------------------------------------------------------------- */

/* Undoes what add_plugin did of the last plugin before memory ran out. */
static void forget_from(imp_registry *r, size_t plugins, size_t types)
{
    r->type_count = types;
    if (r->plugin_count == plugins) return;
    loaded_plugin *last = r->plugin[--r->plugin_count];
    free(last->path);
    free(last);
}

FP_APART static imp_code add_linked(imp_registry *r, const imp_plugin *entry, imp_error *error)
{
    for (size_t k = 0; k < r->plugin_count; ++k)
        if (r->plugin[k]->file.entry == entry) return IMP_SUCCESS;
    plugin_file file;
    const imp_code code = plugin_file_link(&file, entry, error);
    if (code != IMP_SUCCESS) return code;
    const size_t plugins = r->plugin_count, types = r->type_count;
    if (add_plugin(r, IMP_LINKED_IN, &file)) return IMP_SUCCESS;
    forget_from(r, plugins, types);
    return error_set_memory(error);
}

imp_code imp_registry_add(imp_registry *registry, const imp_plugin *plugin, imp_error *error)
{
    if (registry == NULL || plugin == NULL) return error_set_missing(error, "imp_registry_add");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = add_linked(registry, plugin, error);
    fp_environment_leave(&environment);
    return code;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_PLUGIN_FILE_H
#define CORE_PLUGIN_PLUGIN_FILE_H

#include "core/base/status.h"
#include "core/plugin/elf_probe.h"
#include "core/plugin/load_probe.h"

/* One plugin, from file to types
 * ==============================
 * Opening goes in steps, each of which may refuse: read the file, try it in a child process,
 * load it, find its entry, check its tables. Code of the plugin runs from the second step on. What
 * is open is wholly checked; what is refused is not loaded any more, and has left the
 * floating-point mode of this thread as it was. */

typedef struct plugin_file {
    elf_probe facts;
    void *handle;                        /* of dlopen; NULL: linked in */
    const imp_plugin *entry;             /* this and all below live in the shared object */
    const imp_surface_factory *surfaces; /* NULL: offers none */
    const imp_map_factory *maps;         /* NULL: offers none */
} plugin_file;

/* `path` is absolute; the cache knows earlier outcomes and records new ones. On failure the text
 * says why, without the path, and only facts.file is of use (0 if the file could
 * not be opened): IMP_ERROR_PLUGIN, or IMP_ERROR_MEMORY if memory ran out. */
imp_code plugin_file_open(plugin_file *plugin, const char *path, load_cache *cache,
                          imp_error *error);

/* Checks entry and tables of a plugin that is linked into the program. It fails as plugin_file_open
 * does. */
imp_code plugin_file_link(plugin_file *plugin, const imp_plugin *entry, imp_error *error);

/* Nothing of the plugin may be used any more. */
void plugin_file_close(plugin_file *plugin, const char *path);

#endif

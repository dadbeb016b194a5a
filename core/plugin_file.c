/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "fp_mode.h"
#include "plugin_check.h"
#include "plugin_file.h"
#include "text.h"

#include <assert.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#define ENTRY "impinge_plugin"

static imp_code step_read(plugin_file *plugin, const char *path, imp_error *error)
{
    if (elf_probe_file(path, false, &plugin->facts)) return IMP_SUCCESS;
    const elf_check *check = elf_probe_refusal(&plugin->facts);
    return error_set(error, IMP_ERROR_PLUGIN, "%s: %s", check->name, check->text);
}

/* RTLD_NOW: an undefined function is told here, not by a dead host at its first call.
 * RTLD_LOCAL: plugins do not see each other. The constructors run here. */
static imp_code step_load(plugin_file *plugin, const char *path, imp_error *error)
{
    fp_mode before = fp_mode_read();
    plugin->handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    bool kept = fp_mode_kept(before);
    if (!plugin->handle) {
        const char *why = dlerror();
        error_set(error, IMP_ERROR_PLUGIN,
                  "load: %.600s; link it with every library it uses, and see that they are "
                  "installed",
                  why ? why : "dlopen failed");
        if (error) text_clean(error->text);
        return IMP_ERROR_PLUGIN;
    }
    if (!kept)
        return error_set(
            error, IMP_ERROR_PLUGIN,
            "load: loading it changes the mode of arithmetic, which breaks every "
            "bound of every plugin; compile and link it without -ffast-math or -Ofast");
    return IMP_SUCCESS;
}

static imp_code step_enter(plugin_file *plugin, const char *path, imp_error *error)
{
    (void)path;
    plugin->entry = dlsym(plugin->handle, ENTRY);
    if (!plugin->entry)
        return error_set(error, IMP_ERROR_PLUGIN,
                         "entry: does not export the symbol " ENTRY
                         "; define it by the macro IMPINGE_PLUGIN, with default visibility");
    const imp_code code = plugin_check_entry(plugin->entry, &plugin->facts, error);
    if (code != IMP_SUCCESS) error_prefix(error, "entry");
    return code;
}

static imp_code step_tables(plugin_file *plugin, const char *path, imp_error *error)
{
    (void)path;
    fp_mode before = fp_mode_read();
    plugin->surfaces = plugin->entry->get_factory(IMP_SURFACE_FACTORY);
    plugin->maps = plugin->entry->get_factory(IMP_MAP_FACTORY);
    if (!fp_mode_kept(before))
        return error_set(error, IMP_ERROR_PLUGIN,
                         "types: get_factory changes the mode of arithmetic; compile and link the "
                         "plugin without -ffast-math or -Ofast, and leave fesetround alone");
    const imp_code code = plugin_check_factories(plugin->surfaces, plugin->maps, error);
    if (code != IMP_SUCCESS) error_prefix(error, "types");
    return code;
}

/* What runs code of the plugin, in this order. */
static imp_code run(plugin_file *plugin, const char *path, imp_error *error)
{
    imp_code code = step_load(plugin, path, error);
    if (code == IMP_SUCCESS) code = step_enter(plugin, path, error);
    if (code == IMP_SUCCESS) code = step_tables(plugin, path, error);
    return code;
}

/* In the child: all of it, and closing too. */
static imp_code try_out(const char *path, imp_error *error)
{
    plugin_file plugin = {.handle = NULL};
    imp_code code = step_read(&plugin, path, error);
    if (code == IMP_SUCCESS) code = run(&plugin, path, error);
    plugin_file_close(&plugin);
    return code;
}

/* Only what the file itself did once it was loaded. That it could not be read again or not be
 * loaded may be the doing of the moment (no more files may be open), or of another file (a library
 * that is missing today). */
static bool is_lasting(imp_code code, const char *text)
{
    static const char *const steps[] = {"trial:", "entry:", "types:"};
    for (size_t k = 0; k < sizeof steps / sizeof *steps; ++k)
        if (strncmp(text, steps[k], strlen(steps[k])) == 0) return true;
    return code == IMP_SUCCESS;
}

/* False: no memory. */
static bool remember(trial_book *book, const char *path, const elf_probe *facts, imp_code code,
                     const char *text)
{
    return !is_lasting(code, text) || trial_book_add(book, path, facts, code, text);
}

static imp_code step_trial(const plugin_file *plugin, const char *path, trial_book *book,
                           imp_error *error)
{
    imp_code code;
    const char *known;
    if (trial_book_find(book, path, &plugin->facts, &code, &known))
        return code == IMP_SUCCESS ? code : error_set(error, code, "%s", known);
    imp_error found = {IMP_SUCCESS, ""};
    code = plugin_trial_run(path, try_out, &found);
    if (code == IMP_ERROR_MEMORY || !remember(book, path, &plugin->facts, code, found.text))
        return error_set_memory(error);
    return code == IMP_SUCCESS ? code : error_set(error, code, "%s", found.text);
}

imp_code plugin_file_open(plugin_file *plugin, const char *path, trial_book *book, imp_error *error)
{
    assert(path[0] == '/');
    *plugin = (plugin_file){.handle = NULL};
    imp_code code = step_read(plugin, path, error);
    if (code == IMP_SUCCESS) code = step_trial(plugin, path, book, error);
    if (code == IMP_SUCCESS) code = run(plugin, path, error);
    if (code != IMP_SUCCESS) plugin_file_close(plugin);
    return code;
}

/* A refusal of the child's reads "check: why", by the step's name. */
static void tell_trial(imp_code code, const imp_error *found, imp_finding_sink tell, void *context)
{
    if (code == IMP_SUCCESS) {
        tell(context, "trial", IMP_PASSED, "loads in a child process, and its tables are in order");
        return;
    }
    char name[24];
    const char *text = strchr(found->text, ':');
    const size_t length = text != NULL ? (size_t)(text - found->text) : sizeof name;
    if (length < sizeof name && strchr(found->text, ' ') > text) {
        memcpy(name, found->text, length);
        name[length] = '\0';
        tell(context, name, IMP_REFUSED, text + 2);
    } else {
        tell(context, "trial", IMP_REFUSED, found->text);
    }
}

bool imp_plugin_examine(const char *path, imp_finding_sink tell, void *context)
{
    elf_probe facts;
    const imp_finding findings[] = {IMP_NOT_REACHED, IMP_PASSED, IMP_REFUSED};
    const bool good = elf_probe_file(path, true, &facts);
    for (int k = 0; k < PROBE_CHECKS; ++k)
        tell(context, facts.check[k].name, findings[facts.check[k].verdict], facts.check[k].text);
    char *absolute = good ? realpath(path, NULL) : NULL;
    if (absolute == NULL) {
        tell(context, "trial", IMP_NOT_REACHED, "");
        return false;
    }
    imp_error found = {IMP_SUCCESS, ""};
    const imp_code code = plugin_trial_run(absolute, try_out, &found);
    trial_book *book = code != IMP_ERROR_MEMORY ? trial_book_read() : NULL;
    if (book != NULL) remember(book, absolute, &facts, code, found.text);
    trial_book_close(book);
    free(absolute);
    tell_trial(code, &found, tell, context);
    return code == IMP_SUCCESS;
}

void plugin_file_close(plugin_file *plugin)
{
    fp_mode before = fp_mode_read();
    if (plugin->handle) dlclose(plugin->handle);
    fp_mode_restore(before);
    plugin->handle = NULL;
    plugin->entry = NULL;
    plugin->surfaces = NULL;
    plugin->maps = NULL;
}

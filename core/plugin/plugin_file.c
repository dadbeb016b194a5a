/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/active_callback.h"
#include "core/base/fp_mode.h"
#include "core/base/text.h"
#include "core/plugin/plugin_check.h"
#include "core/plugin/plugin_file.h"
#include "core/plugin/start_vectors.h"

#include <assert.h>
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>

#include <impinge/examine.h>

#define ENTRY "impinge_plugin"

/* Should the file change after the cache was asked, step_probe finds nothing of it there, and tries
 * it in a child, where its tables are checked. */
static void step_read(plugin_file *plugin, const char *path, const load_cache *cache,
                      load_outcome *out)
{
    const bool is_tried = cache != NULL && load_cache_has_passed(cache, path);
    if (is_tried ? elf_probe_tried(path, &plugin->facts)
                 : elf_probe_file(path, false, &plugin->facts))
        return;
    const elf_check *check = elf_probe_refusal(&plugin->facts);
    load_outcome_refuse(out, LOAD_READ, check->name, "%s", check->text);
    if (plugin->facts.lacks_memory) out->code = error_set_memory(&out->error);
}

/* A sanitizer's runtime ends the process if it is not loaded before everything else. */
static bool has_runtime(const char *sanitizer)
{
    if (sanitizer[0] == '\0') return true;
    return dlsym(RTLD_DEFAULT, sanitizer[3] == 'a' ? "__asan_init" : "__tsan_init") != NULL;
}

/* RTLD_NOW: an undefined function is reported here, not by a dead host at its first call.
 * RTLD_LOCAL: plugins do not see each other. The constructors run here. */
static void step_open(plugin_file *plugin, const char *path, load_outcome *out)
{
    const char *sanitizer = plugin->facts.sanitizer;
    const fp_mode before = fp_mode_read();
    if (!has_runtime(sanitizer)) {
        load_outcome_refuse(
            out, LOAD_OPEN, "load",
            "it is compiled with -fsanitize and needs %s, which has to be there first: "
            "LD_PRELOAD=$(cc -print-file-name=%.8sso) ASAN_OPTIONS=detect_leaks=0 impinge ...",
            sanitizer, sanitizer);
        return;
    }
    plugin->handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    const bool kept = fp_mode_kept(before);
    if (plugin->handle == NULL && errno == ENOMEM) {
        out->code = IMP_ERROR_MEMORY; /* nothing of the file has run that could have set it */
    } else if (plugin->handle == NULL) {
        const char *why = dlerror();
        load_outcome_refuse(out, LOAD_OPEN, "load",
                            "%.600s; link it with every library it uses, and see that they are "
                            "installed",
                            why != NULL ? why : "dlopen failed");
        text_clean(out->error.text);
    } else if (!elf_identity_is_at(plugin->facts.file, path)) {
        load_outcome_refuse(out, LOAD_OPEN, "load",
                            "the file was changed while it was being loaded; try again");
    } else if (!kept) {
        load_outcome_refuse(out, LOAD_OPEN, "load",
                            "loading it changes the mode of arithmetic, which breaks every "
                            "bound of every plugin; compile and link it without -ffast-math or "
                            "-Ofast");
    }
}

/* Our own check refuses, or had no memory for it. */
static void refuse_checked(load_outcome *out, load_step step, const char *check)
{
    const imp_code code = out->error.code;
    load_outcome_refuse(out, step, check, NULL);
    out->code = code;
}

static void step_enter(plugin_file *plugin, const char *path, load_outcome *out)
{
    (void)path;
    plugin->entry = dlsym(plugin->handle, ENTRY);
    if (plugin->entry == NULL)
        load_outcome_refuse(out, LOAD_ENTRY, "entry",
                            "does not export the symbol " ENTRY
                            "; define it by the macro IMPINGE_PLUGIN, with default visibility");
    else if (plugin_check_entry(plugin->entry, &plugin->facts, &out->error) != IMP_SUCCESS)
        refuse_checked(out, LOAD_ENTRY, "entry");
}

static void step_tables(plugin_file *plugin, const char *path, load_outcome *out)
{
    (void)path;
    const fp_mode before = fp_mode_read();
    plugin->surfaces = plugin->entry->get_factory(IMP_SURFACE_FACTORY);
    plugin->maps = plugin->entry->get_factory(IMP_MAP_FACTORY);
    if (!fp_mode_kept(before))
        load_outcome_refuse(out, LOAD_TYPES, "types",
                            "get_factory changes the mode of arithmetic; compile and link the "
                            "plugin without -ffast-math or -Ofast, and leave fesetround alone");
    else if (plugin_check_factories(plugin->surfaces, plugin->maps, &out->error) != IMP_SUCCESS)
        refuse_checked(out, LOAD_TYPES, "types");
}

typedef struct step {
    const char *callback; /* what of the plugin runs */
    void (*run)(plugin_file *plugin, const char *path, load_outcome *out);
} step;

/* What runs code of the plugin, in this order. A refusal while memory ran out says nothing about
 * the file. */
static void run(plugin_file *plugin, const char *path, load_outcome *out)
{
    static const step steps[] = {
        {"constructor", step_open}, {"impinge_plugin", step_enter}, {"get_factory", step_tables}};
    for (size_t k = 0; k < sizeof steps / sizeof *steps && out->code == IMP_SUCCESS; ++k) {
        imp_call *call = active_callback_begin(path, steps[k].callback);
        errno = 0;
        steps[k].run(plugin, path, out);
        if (errno == ENOMEM) out->step = LOAD_OPEN;
        active_callback_end(call);
    }
}

static void refuse_changes(const start_vectors *before, load_outcome *out)
{
    char lost[128];
    if (out->code != IMP_SUCCESS || start_vectors_are_kept(before, lost, sizeof lost)) return;
    load_outcome_refuse(out, LOAD_PROBE, "trial",
                        "loading it overwrites %s; look at its constructors, which are called with "
                        "argc, argv and envp",
                        lost);
    text_clean(out->error.text);
}

/* In the child: all of it, and closing too. */
static void try_out(const char *path, load_outcome *out)
{
    plugin_file plugin = {.handle = NULL};
    start_vectors before;
    if (!start_vectors_copy(&before)) {
        out->code = IMP_ERROR_MEMORY;
        return;
    }
    step_read(&plugin, path, NULL, out);
    if (out->code == IMP_SUCCESS) run(&plugin, path, out);
    plugin_file_close(&plugin, path);
    refuse_changes(&before, out);
    start_vectors_free(&before);
}

/* "check: why". */
static imp_code outcome_error(const load_outcome *out, imp_error *error)
{
    if (out->code == IMP_SUCCESS) return IMP_SUCCESS;
    if (out->code == IMP_ERROR_MEMORY) return error_set_memory(error);
    return error_set(error, out->code, "%s: %s", out->check, out->error.text);
}

/* Keeps what the file itself did once it was loaded. False: no memory. */
static bool remember(load_cache *cache, const char *path, const elf_probe *facts,
                     const load_outcome *out)
{
    imp_error error = {IMP_SUCCESS, ""};
    if (out->code != IMP_SUCCESS && out->step < LOAD_PROBE) return true;
    const imp_code code = outcome_error(out, &error);
    return load_cache_add(cache, path, facts, code, error.text);
}

static imp_code step_probe(const plugin_file *plugin, const char *path, load_cache *cache,
                           imp_error *error)
{
    imp_code code;
    const char *known;
    if (load_cache_find(cache, path, &plugin->facts, &code, &known))
        return code == IMP_SUCCESS
                   ? code
                   : error_set(error, code, "%s (remembered; `impinge why FILE` tries again)",
                               known);
    load_outcome out;
    load_probe_run(path, try_out, &out);
    if (out.code != IMP_ERROR_MEMORY && !remember(cache, path, &plugin->facts, &out))
        return error_set_memory(error);
    return outcome_error(&out, error);
}

imp_code plugin_file_open(plugin_file *plugin, const char *path, load_cache *cache,
                          imp_error *error)
{
    assert(path[0] == '/');
    *plugin = (plugin_file){.handle = NULL};
    load_outcome out = {.code = IMP_SUCCESS};
    step_read(plugin, path, cache, &out);
    imp_code code = outcome_error(&out, error);
    if (code == IMP_SUCCESS) code = step_probe(plugin, path, cache, error);
    if (code == IMP_SUCCESS) {
        run(plugin, path, &out);
        code = outcome_error(&out, error);
    }
    if (code != IMP_SUCCESS) plugin_file_close(plugin, path);
    return code;
}

imp_code plugin_file_link(plugin_file *plugin, const imp_plugin *entry, imp_error *error)
{
    *plugin = (plugin_file){.entry = entry};
    load_outcome out = {.code = IMP_SUCCESS};
    if (plugin_check_entry(entry, NULL, &out.error) != IMP_SUCCESS) {
        refuse_checked(&out, LOAD_ENTRY, "entry");
    } else {
        imp_call *call = active_callback_begin(entry->name, "get_factory");
        step_tables(plugin, IMP_LINKED_IN, &out);
        active_callback_end(call);
    }
    return outcome_error(&out, error);
}

static bool examine(const char *path, imp_finding_sink tell, void *context)
{
    elf_probe facts;
    const imp_finding findings[] = {IMP_FINDING_NOT_REACHED, IMP_FINDING_PASSED,
                                    IMP_FINDING_REFUSED};
    const bool good = elf_probe_file(path, true, &facts);
    for (int k = 0; k < PROBE_CHECKS; ++k)
        tell(context, facts.check[k].name, findings[facts.check[k].verdict], facts.check[k].text);
    char *absolute = good ? realpath(path, NULL) : NULL;
    if (absolute == NULL) {
        tell(context, "trial", IMP_FINDING_NOT_REACHED, "");
        return false;
    }
    load_outcome out;
    load_probe_run(absolute, try_out, &out);
    load_cache *cache = out.code != IMP_ERROR_MEMORY ? load_cache_read() : NULL;
    if (cache != NULL) remember(cache, absolute, &facts, &out);
    load_cache_close(cache);
    free(absolute);
    if (out.code == IMP_SUCCESS)
        tell(context, "trial", IMP_FINDING_PASSED,
             "loads in a child process, and its tables are in order");
    else if (out.code == IMP_ERROR_MEMORY)
        tell(context, "trial", IMP_FINDING_REFUSED, "out of memory");
    else
        tell(context, out.check, IMP_FINDING_REFUSED, out.error.text);
    return out.code == IMP_SUCCESS;
}

bool imp_plugin_examine(const char *path, imp_finding_sink tell, void *context)
{
    if (path == NULL || tell == NULL) return false;
    const fp_environment environment = fp_environment_enter();
    const bool good = examine(path, tell, context);
    fp_environment_leave(&environment);
    return good;
}

void plugin_file_close(plugin_file *plugin, const char *path)
{
    fp_mode before = fp_mode_read();
    imp_call *call = active_callback_begin(path, "destructor");
    if (plugin->handle != NULL) dlclose(plugin->handle);
    active_callback_end(call);
    fp_mode_restore(before);
    *plugin = (plugin_file){.facts = plugin->facts};
}

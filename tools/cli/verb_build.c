/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/common/system_error.h"
#include "tools/cli/catalogue.h"
#include "tools/cli/compile.h"
#include "tools/cli/input.h"
#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

/* A plugin is compiled into a new folder inside its target folder, loaded there, and moved only if
 * the loader accepts it: a plugin that worked is never replaced by one that does not. */

typedef struct building {
    const char *source, *verb;
    char folder[PATH_MAX];   /* the plugin's final path; absolute */
    char name[NAME_MAX + 1]; /* "wobble.so" */
    char trial[PATH_MAX];    /* the folder inside, until it is moved */
} building;

static exit_status too_long(const building *b)
{
    return complain(EXIT_DATA, b->verb, "%s: %s", b->source, strerror(ENAMETOOLONG));
}

static bool join(char *path, size_t size, const char *folder, const char *name)
{
    const int length = snprintf(path, size, "%s/%s", folder, name);
    return length > 0 && (size_t)length < size;
}

/* --- The target ------------------------------------------------------------------------------- */

/* Finds the user's plugin folder by the rule of core/common/search_path.h. */
static bool user_folder(char *folder, size_t size)
{
    const char *data = secure_getenv("XDG_DATA_HOME"), *home = secure_getenv("HOME");
    const char *below = "impinge/" IMP_TEXT_OF(IMP_ABI_MAJOR);
    if (data != NULL && data[0] == '/') return join(folder, size, data, below);
    if (home == NULL || home[0] != '/') return false;
    const int length = snprintf(folder, size, "%s/.local/share/%s", home, below);
    return length > 0 && (size_t)length < size;
}

/* Makes the folder and those above it. */
static bool make_folders(char *folder)
{
    for (char *slash = strchr(folder + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        const bool made = mkdir(folder, 0777) == 0 || errno == EEXIST;
        *slash = '/';
        if (!made) return false;
    }
    return mkdir(folder, 0777) == 0 || errno == EEXIST;
}

static exit_status find_folder(building *b, const arguments *args)
{
    const option_value *output = arguments_option(args, "output");
    const bool install = arguments_option(args, "install") != NULL;
    char asked[PATH_MAX];
    if (output != NULL && install)
        return complain(EXIT_USAGE, b->verb, "--install and --output both say where it goes");
    if (install && !user_folder(asked, sizeof asked))
        return complain(EXIT_DATA, b->verb,
                        "neither XDG_DATA_HOME nor HOME names your folder for data");
    if (!install) snprintf(asked, sizeof asked, "%s", output != NULL ? output->text : ".");
    if ((install && !make_folders(asked)) || realpath(asked, b->folder) == NULL)
        return complain(EXIT_DATA, b->verb, "%s: %s", asked, system_error_text(errno));
    if (strchr(b->folder, ':') != NULL)
        return complain(EXIT_DATA, b->verb,
                        "%s: a folder of plugins cannot have ':' in its name, which separates "
                        "folders in paths",
                        b->folder);
    return EXIT_ANSWERED;
}

/* Finds the plugin's file name: wobble.c makes wobble.so. */
static exit_status find_name(building *b)
{
    const char *slash = strrchr(b->source, '/');
    const char *base = slash != NULL ? slash + 1 : b->source;
    const int stem = (int)(strrchr(base, '.') - base);
    const int length = snprintf(b->name, sizeof b->name, "%.*s.so", stem, base);
    if (stem == 0)
        return complain(EXIT_USAGE, b->verb, "%s: the file has no name before its suffix", base);
    return (size_t)length < sizeof b->name ? EXIT_ANSWERED : too_long(b);
}

static exit_status make_trial(building *b)
{
    if (!join(b->trial, sizeof b->trial, b->folder, ".impinge-XXXXXX")) return too_long(b);
    if (mkdtemp(b->trial) != NULL) return EXIT_ANSWERED;
    return complain(EXIT_DATA, b->verb, "%s: %s", b->folder, system_error_text(errno));
}

/* --- Does the loader take it? ----------------------------------------------------------------- */

/* Complains of a refused plugin. The folder `trial` is cut from a path in the reason, since it is
 * removed. */
static exit_status refused_for(const char *reason, const building *b)
{
    const char *path = strstr(reason, b->trial);
    const int before = path != NULL ? (int)(path - reason) : 0;
    const char *rest = path != NULL ? path + strlen(b->trial) + 1 : reason;
    return complain(EXIT_PLUGIN, b->verb,
                    "%s was compiled, but is not a plugin that can be loaded: %.*s%s", b->source,
                    before, reason, rest);
}

static exit_status refused(const imp_registry *registry, const char *file, const building *b)
{
    imp_plugin_refusal refusal;
    for (size_t i = 0; imp_registry_refusal(registry, i, &refusal); ++i)
        if (strcmp(refusal.file, file) == 0) return refused_for(refusal.reason, b);
    return complain(EXIT_PLUGIN, b->verb, "%s was compiled, but the loader does not see it",
                    b->source);
}

static bool is_same_type(const imp_type_info *a, const imp_type_info *b)
{
    return a->kind == b->kind && strcmp(a->name, b->name) == 0;
}

/* Returns another file with that type, or NULL. The one we replace, `target`, does not count. */
static const char *found_elsewhere(const imp_registry *registry, const imp_type_info *type,
                                   const char *target)
{
    imp_type_info other;
    for (size_t i = 0; imp_registry_type(registry, i, &other); ++i)
        if (is_same_type(&other, type) && strcmp(other.file, type->file) != 0 &&
            !input_is_same(other.file, target))
            return other.file;
    return NULL;
}

static size_t print_types(const imp_registry *registry, const char *file, const char *target)
{
    imp_type_info info;
    size_t count = 0;
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i) {
        if (strcmp(info.file, file) != 0) continue;
        const char *other = found_elsewhere(registry, &info, target);
        printf("%s %s: %s\n", catalogue_kind_name(info.kind), info.name, info.summary);
        if (other != NULL)
            printf("  There is another %s in %s; of two, the first found is used.\n", info.name,
                   message_shown(other).text);
        ++count;
    }
    return count;
}

/* Loads the plugin `file` and prints its types. */
static exit_status try_plugin(const building *b, const char *file, const char *target)
{
    imp_registry *registry = query_registry_first(b->trial, 0, b->verb);
    if (registry == NULL) return EXIT_DATA;
    const size_t types = print_types(registry, file, target);
    const exit_status status = types > 0 ? EXIT_ANSWERED : refused(registry, file, b);
    imp_registry_free(registry);
    return status;
}

/* --- All of it -------------------------------------------------------------------------------- */

static exit_status build_in_trial(const building *b, const char *file, const char *target)
{
    exit_status status = compile_plugin(b->source, file, b->verb);
    if (status == EXIT_ANSWERED) status = try_plugin(b, file, target);
    if (status != EXIT_ANSWERED) return status;
    if (rename(file, target) != 0)
        return complain(EXIT_DATA, b->verb, "%s: %s", target, system_error_text(errno));
    printf("in %s\n", message_shown(target).text);
    return EXIT_ANSWERED;
}

static exit_status build(building *b, const arguments *args)
{
    char file[PATH_MAX], target[PATH_MAX];
    exit_status status = find_name(b);
    if (status == EXIT_ANSWERED) status = find_folder(b, args);
    if (status == EXIT_ANSWERED) status = make_trial(b);
    if (status != EXIT_ANSWERED) return status;
    if (join(file, sizeof file, b->trial, b->name) &&
        join(target, sizeof target, b->folder, b->name)) {
        status = build_in_trial(b, file, target);
        unlink(file);
    } else {
        status = too_long(b);
    }
    rmdir(b->trial);
    return status;
}

static exit_status run(const arguments *args)
{
    building b = {.source = args->operands[0], .verb = args->verb->name};
    if (!compile_knows(b.source))
        return complain(EXIT_USAGE, b.verb,
                        "%s: a source file is wanted, which ends in .c, .cc, .cpp or .cxx",
                        b.source);
    if (access(b.source, R_OK) != 0)
        return complain(EXIT_DATA, b.verb, "%s: %s", b.source, system_error_text(errno));
    return build(&b, args);
}

static const option build_options[] = {
    {.name = "install", .help = "put the plugin where impinge looks for yours"},
    {.name = "output",
     .kind = OPTION_TEXT,
     .argument = "DIR",
     .help = "put the plugin into this folder (the current one)"},
    {.name = NULL}};

static const option *const tables[] = {build_options, options_always, NULL};

const verb verb_build = {
    .name = "build",
    .operands = "FILE",
    .summary = "Compile a plugin of one source file",
    .details =
        "Compiles FILE.c (or .cc, .cpp, .cxx) against the headers that came with impinge into\n"
        "FILE.so, and loads it. If the loader refuses it, that is said and nothing is written.\n"
        "The environment's CC, CPPFLAGS, CFLAGS (C++: CXX, CXXFLAGS) and LDFLAGS are used.\n"
        "Types in a folder of your own are found with --plugin-path DIR.\n",
    .example = "impinge new drum && impinge build drum/drum.c",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};

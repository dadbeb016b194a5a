/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tools/cli/build_tree.h"
#include "tools/cli/input.h"
#include "tools/cli/output.h"
#include "tools/cli/program.h"
#include "tools/cli/project.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

#define LETTERS "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
#define NAME_SIZE 64 /* 63 bytes, as surface.h has it */

/* The differences between projects of a surface and of a map. The pipelines `before` NAME and `b`
 * touch; `formula` is the template's formula, in the checker's language. */
typedef struct project_kind {
    imp_type_kind kind;
    const char *called, *source, *before, *b, *formula;
} project_kind;

#define USER_FOLDER "\"${XDG_DATA_HOME:-$HOME/.local/share}/impinge/1\""

/* How the project is built: commands that configure it, and that build, test and install it for one
 * user. `where` names the SDK to the first, before a folder; `tools` are packages of Debian. */
typedef struct project_build {
    const char *configure, *make, *where, *tools;
    project_file files[4]; /* templates, and the places they go to */
} project_build;

static const project_build by_autotools = {"autoreconf -fi && ./configure --with-user-plugins",
                                           "make check install",
                                           "PKG_CONFIG_PATH=",
                                           "",
                                           {{"configure.ac", "configure.ac", false},
                                            {"Makefile.am", "Makefile.am", false},
                                            {"impinge.m4", "m4/impinge.m4", false},
                                            {NULL, NULL, false}}};
static const project_build by_cmake = {
    "cmake -S . -B build -DIMPINGE_USER_PLUGINS=ON",
    "cmake --build build && (cd build && ctest --output-on-failure) && cmake --install build",
    "-DImpingeSDK_DIR=",
    "cmake",
    {{"CMakeLists.txt", "CMakeLists.txt", false}, {NULL, NULL, false}}};
static const project_build by_meson = {
    "meson setup build -Dplugindir=" USER_FOLDER,
    "meson test -C build --print-errorlogs && meson install -C build",
    "--pkg-config-path=",
    "meson",
    {{"meson.build", "meson.build", false},
     {"meson_options.txt", "meson_options.txt", false},
     {NULL, NULL, false}}};

/* What depends on the language. */
typedef struct project_language {
    const char *ending, *cmake, *meson, *standard, *args, *autoconf;
} project_language;

static const project_language in_c = {"c", "C", "c", "c_std=c11", "c_args", ""};
static const project_language in_cxx = {"cc",       "CXX",          "cpp", "cpp_std=c++17",
                                        "cpp_args", "\nAC_PROG_CXX"};

/* The project asked for. */
typedef struct project_plan {
    const project_kind *kind;
    const project_build *build;
    const project_language *language;
    const char *name, *folder;
    char *a; /* the pipeline that ends with NAME */
    char source[NAME_SIZE + 3];
} project_plan;

static const project_kind surface_project = {
    IMP_TYPE_SURFACE,
    "surface",
    "surface.c",
    "",
    "sphere radius=0.5 center=0,0,2 ! translate velocity=0,0,-2",
    "u; v; height*(1-u^2)*(1-v^2)*sin(rate*t)"};
static const project_kind map_project = {
    IMP_TYPE_MAP,
    "map",
    "map.c",
    "sphere center=0,0,2 ! ",
    "sphere radius=0.5 center=4,0,2 ! translate velocity=-4,0,0",
    "x+slope*z*sin(rate*t); y; z"};

/* --- May it be called that? ------------------------------------------------------------------- */

static exit_status check_name(const char *name, const char *speaker)
{
    const size_t length = strlen(name);
    if (length == 0 || length >= NAME_SIZE || strspn(name, LETTERS "0123456789_-") != length ||
        strchr(LETTERS, name[0]) == NULL)
        return complain(EXIT_USAGE, speaker,
                        "'%s' cannot be a type's name; must be 1 to 63 letters, digits, '_' "
                        "and '-', a letter first",
                        name);
    if (strncmp(name, "conftest", 8) == 0)
        return complain(EXIT_USAGE, speaker,
                        "'%s' cannot be a project's name: configure scripts sweep up files that "
                        "begin with 'conftest'",
                        name);
    return EXIT_ANSWERED;
}

/* Complains if a type of that kind and name exists: the first found would shadow the other. */
static exit_status check_is_free(const project_kind *kind, const arguments *args)
{
    imp_type_info info;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    exit_status status = EXIT_ANSWERED;
    for (size_t i = 0; imp_registry_type(registry, i, &info) && status == EXIT_ANSWERED; ++i)
        if (info.kind == kind->kind && strcmp(info.name, args->operands[0]) == 0)
            status = complain(EXIT_DATA, args->verb->name,
                              "there is a %s '%s' already, in %s; one would shadow the other, so "
                              "choose a new name",
                              kind->called, info.name, info.file);
    imp_registry_free(registry);
    return status;
}

/* --- Words of the project --------------------------------------------------------------------- */

/* Finds the user's full name, without characters that a C comment or string cannot contain. */
static void find_author(char author[128])
{
    const struct passwd *who = getpwuid(geteuid());
    const char *name = who != NULL ? who->pw_gecos : NULL;
    if (name == NULL || name[0] == '\0' || name[0] == ',') name = who != NULL ? who->pw_name : "";
    size_t length = 0;
    for (; *name != '\0' && *name != ',' && length < 100; ++name)
        if ((unsigned char)*name >= 0x20 && strchr("\"\\*@?\x7F", *name) == NULL)
            author[length++] = *name;
    author[length] = '\0';
    json_t *text = length > 0 ? json_string(author) : NULL; /* NULL: not UTF-8 */
    if (text == NULL) strcpy(author, "somebody");
    json_decref(text);
}

static exit_status write_project(const project_plan *plan, const arguments *args)
{
    enum { SHARED = 5, OF_BUILD = 4 };
    const project_kind *kind = plan->kind;
    const project_build *build = plan->build;
    const project_language *language = plan->language;
    char author[128], id[NAME_SIZE];
    find_author(author);
    snprintf(id, sizeof id, "%s", plan->name);
    for (char *c = id; *c != '\0'; ++c)
        if (*c == '-') *c = '_';
    const project_word words[] = {{"name", plan->name},
                                  {"id", id},
                                  {"author", author},
                                  {"a", plan->a},
                                  {"b", kind->b},
                                  {"kind", kind->called},
                                  {"guide", SDKDOCDIR},
                                  {"formula", kind->formula},
                                  {"source", plan->source},
                                  {"configure", build->configure},
                                  {"make", build->make},
                                  {"tools", build->tools},
                                  {"cxx", language->autoconf},
                                  {"language", language->cmake},
                                  {"meson_language", language->meson},
                                  {"standard", language->standard},
                                  {"args", language->args},
                                  {NULL, NULL}};
    project_file files[SHARED + OF_BUILD] = {
        {"README", "README", false},
        {language == &in_c ? kind->source : "surface.cc", plan->source, false},
        {"check.sh", "check.sh", true},
        {"github.yml", ".github/workflows/check.yml", false},
        {"gitlab.yml", ".gitlab-ci.yml", false}};
    memcpy(files + SHARED, build->files, sizeof build->files);
    return project_write(plan->folder, files, words, args->verb->name);
}

/* --- What to do with it ----------------------------------------------------------------------- */

/* Returns the word by which a shell finds this command: its name if it is in PATH, else its
 * path. */
static char *command_word(void)
{
    char *found = program_find("impinge"), *self = realpath("/proc/self/exe", NULL), *word = NULL;
    const bool by_name =
        self == NULL || build_tree_data() != NULL || (found != NULL && input_is_same(found, self));
    word = output_shell_word(by_name ? "impinge" : self);
    free(found);
    free(self);
    return word;
}

/* Does pkg-config, as it is set up, find the SDK that came with this command? */
static bool pkg_config_finds_us(void)
{
    const char *program = getenv("PKG_CONFIG");
    const char *words[] = {program != NULL && program[0] != '\0' ? program : "pkg-config",
                           "--silence-errors", "--variable=pcfiledir", "impinge-sdk", NULL};
    const program_end end = program_run(words, PROGRAM_OUTPUT, false);
    if (end.said != NULL) end.said[strcspn(end.said, "\n")] = '\0';
    const bool ours = end.said != NULL && input_is_same(end.said, PKGCONFIGDIR);
    free(end.said);
    return ours;
}

/* Returns what names the SDK to the configuring command, " PKG_CONFIG_PATH=...", or "" if it is not
 * needed. NULL: no memory. */
static char *configure_rest(const project_build *build)
{
    const char *folder = build == &by_cmake ? CMAKEDIR "/ImpingeSDK" : PKGCONFIGDIR;
    char *whole = NULL, *rest = NULL;
    if (build != &by_cmake && pkg_config_finds_us()) return strdup("");
    if (asprintf(&whole, "%s%s", build->where, folder) < 0) return NULL;
    char *word = output_shell_word(whole);
    if (word != NULL && asprintf(&rest, " %s", word) < 0) rest = NULL;
    free(word), free(whole);
    return rest;
}

static exit_status print_commands(const project_plan *plan, const arguments *args)
{
    char *at = output_shell_word(plan->folder), *command = command_word();
    char *rest = configure_rest(plan->build);
    char *word_a = output_shell_word(plan->a), *word_b = output_shell_word(plan->kind->b);
    const bool known =
        at != NULL && command != NULL && rest != NULL && word_a != NULL && word_b != NULL;
    if (known)
        printf("%s holds a %s that works. To build, install, check and try it:\n\n"
               "  cd %s && %s%s\n"
               "  %s\n"
               "  %s check %s\n"
               "  %s pair %s %s\n\n"
               "Its mathematics is in %s. The guide: " SDKDOCDIR "/README\n",
               message_shown(plan->folder).text, plan->kind->called, at, plan->build->configure,
               rest, plan->build->make, command, plan->name, command, word_a, word_b, plan->source);
    if (build_tree_data() != NULL)
        puts("First install Impinge itself: this command runs from the folder it was built in.");
    free(at), free(command), free(rest), free(word_a), free(word_b);
    return known ? EXIT_ANSWERED : complain_of_memory(args->verb->name);
}

/* Reads what is asked for; plan->a is to be freed. */
static exit_status read_plan(const arguments *args, project_plan *plan)
{
    const bool is_map = arguments_option(args, "map") != NULL;
    const bool is_cxx = arguments_option(args, "cxx") != NULL;
    const bool cmake = arguments_option(args, "cmake") != NULL;
    const bool meson = arguments_option(args, "meson") != NULL;
    *plan = (project_plan){.kind = is_map ? &map_project : &surface_project,
                           .build = cmake   ? &by_cmake
                                    : meson ? &by_meson
                                            : &by_autotools,
                           .language = is_cxx ? &in_cxx : &in_c,
                           .name = args->operands[0]};
    plan->folder = args->operand_count > 1 ? args->operands[1] : plan->name;
    if (cmake && meson)
        return complain(EXIT_USAGE, args->verb->name, "--cmake and --meson exclude each other");
    if (is_map && is_cxx)
        return complain(EXIT_USAGE, args->verb->name,
                        "--cxx is about surfaces: <impinge/model.hpp> makes no maps, which are "
                        "written in C");
    const exit_status status = check_name(plan->name, args->verb->name);
    if (status != EXIT_ANSWERED) return status;
    snprintf(plan->source, sizeof plan->source, "%s.%s", plan->name, plan->language->ending);
    if (asprintf(&plan->a, "%s%s", plan->kind->before, plan->name) >= 0) return EXIT_ANSWERED;
    plan->a = NULL;
    return complain_of_memory(args->verb->name);
}

static exit_status run(const arguments *args)
{
    project_plan plan;
    exit_status status = read_plan(args, &plan);
    if (status == EXIT_ANSWERED) status = check_is_free(plan.kind, args);
    if (status == EXIT_ANSWERED) status = write_project(&plan, args);
    if (status == EXIT_ANSWERED) status = print_commands(&plan, args);
    free(plan.a);
    return status;
}

static const option new_options[] = {
    {.name = "map", .help = "a map instead of a surface type"},
    {.name = "cxx", .help = "a class in C++17 instead of C; surfaces only"},
    {.name = "cmake", .help = "build it with CMake"},
    {.name = "meson", .help = "build it with Meson"},
    {.name = NULL}};

static const option *const tables[] = {new_options, options_always, NULL};

const verb verb_new = {
    .name = "new",
    .operands = "NAME [DIR]",
    .summary = "Begin a plugin of your own",
    .details =
        "Writes a small project into the folder DIR (NAME unless given), which must be new or\n"
        "empty: a surface type, or with --map a map, called NAME, that works and is yours to\n"
        "change. It builds against the installed headers with autoconf, automake and libtool, or "
        "as\n"
        "--cmake and --meson say, in C or, with --cxx, in C++. Four commands are printed that\n"
        "build, install, check and try it. Files for GitHub and GitLab demand in CI that every\n"
        "claim of it is proved.\n",
    .example = "impinge new wobble",
    .operand_min = 1,
    .operand_max = 2,
    .options = tables,
    .run = run};

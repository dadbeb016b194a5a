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

static exit_status write_project(const project_kind *kind, const char *folder, const char *a,
                                 const arguments *args)
{
    const char *name = args->operands[0];
    char author[128], id[NAME_SIZE], source[NAME_SIZE + 2];
    find_author(author);
    snprintf(id, sizeof id, "%s", name);
    for (char *c = id; *c != '\0'; ++c)
        if (*c == '-') *c = '_';
    snprintf(source, sizeof source, "%s.c", name);
    const project_word words[] = {{"name", name},       {"id", id},
                                  {"author", author},   {"a", a},
                                  {"b", kind->b},       {"kind", kind->called},
                                  {"guide", SDKDOCDIR}, {"formula", kind->formula},
                                  {NULL, NULL}};
    const project_file files[] = {{"README", "README", false},
                                  {"configure.ac", "configure.ac", false},
                                  {"Makefile.am", "Makefile.am", false},
                                  {kind->source, source, false},
                                  {"check.sh", "check.sh", true},
                                  {"impinge.m4", "m4/impinge.m4", false},
                                  {NULL, NULL, false}};
    return project_write(folder, files, words, args->verb->name);
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

/* Returns " PKG_CONFIG_PATH=..." for configure if it is needed, else "". NULL: no memory. */
static char *configure_rest(void)
{
    if (pkg_config_finds_us()) return strdup("");
    char *word = output_shell_word("PKG_CONFIG_PATH=" PKGCONFIGDIR), *rest = NULL;
    if (word != NULL && asprintf(&rest, " %s", word) < 0) rest = NULL;
    free(word);
    return rest;
}

static exit_status print_commands(const project_kind *kind, const char *folder, const char *a,
                                  const arguments *args)
{
    char *at = output_shell_word(folder), *command = command_word(), *rest = configure_rest();
    char *word_a = output_shell_word(a), *word_b = output_shell_word(kind->b);
    const bool known =
        at != NULL && command != NULL && rest != NULL && word_a != NULL && word_b != NULL;
    if (known)
        printf("%s holds a %s that works. To build, install, check and try it:\n\n"
               "  cd %s && autoreconf -fi && ./configure --with-user-plugins%s\n"
               "  make check install\n"
               "  %s check %s\n"
               "  %s pair %s %s\n\n"
               "Its mathematics is in %s.c. The guide: " SDKDOCDIR "/README\n",
               message_shown(folder).text, kind->called, at, rest, command, args->operands[0],
               command, word_a, word_b, args->operands[0]);
    if (build_tree_data() != NULL)
        puts("First install Impinge itself: this command runs from the folder it was built in.");
    free(at), free(command), free(rest), free(word_a), free(word_b);
    return known ? EXIT_ANSWERED : complain_of_memory(args->verb->name);
}

static exit_status run(const arguments *args)
{
    const char *name = args->operands[0];
    const char *folder = args->operand_count > 1 ? args->operands[1] : name;
    const project_kind *kind =
        arguments_option(args, "map") != NULL ? &map_project : &surface_project;
    char *a = NULL;
    exit_status status = check_name(name, args->verb->name);
    if (status == EXIT_ANSWERED) status = check_is_free(kind, args);
    if (status != EXIT_ANSWERED) return status;
    if (asprintf(&a, "%s%s", kind->before, name) < 0) return complain_of_memory(args->verb->name);
    status = write_project(kind, folder, a, args);
    if (status == EXIT_ANSWERED) status = print_commands(kind, folder, a, args);
    free(a);
    return status;
}

static const option new_options[] = {{.name = "map", .help = "a map instead of a surface type"},
                                     {.name = NULL}};

static const option *const tables[] = {new_options, options_always, NULL};

const verb verb_new = {
    .name = "new",
    .operands = "NAME [DIR]",
    .summary = "Begin a plugin of your own",
    .details =
        "Writes a small project into the folder DIR (NAME unless given), which must be new or\n"
        "empty: a surface type, or with --map a map, called NAME, that works and is yours to\n"
        "change. It builds against the installed headers with autoconf, automake and libtool.\n"
        "Four commands are printed that build, install, check and try it.\n",
    .example = "impinge new wobble",
    .operand_min = 1,
    .operand_max = 2,
    .options = tables,
    .run = run};

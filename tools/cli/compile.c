/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/compile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/system_error.h"
#include "tools/cli/build_tree.h"
#include "tools/cli/program.h"

typedef struct language {
    const char *suffix, *compiler, *variable, *flags_variable, *standard;
} language;

static const language languages[] = {
    {".c", "cc", "CC", "CFLAGS", "-std=gnu11"},
    {".cc", "c++", "CXX", "CXXFLAGS", "-std=gnu++17"},
    {".cpp", "c++", "CXX", "CXXFLAGS", "-std=gnu++17"},
    {".cxx", "c++", "CXX", "CXXFLAGS", "-std=gnu++17"},
};

static const language *language_of(const char *source)
{
    const char *suffix = strrchr(source, '.');
    for (size_t i = 0; suffix != NULL && i < sizeof languages / sizeof languages[0]; ++i)
        if (strcmp(suffix, languages[i].suffix) == 0) return &languages[i];
    return NULL;
}

bool compile_knows(const char *source) { return language_of(source) != NULL; }

/* --- The command line ------------------------------------------------------------------------- */

#define WORDS_MAX 250

/* A command; words taken from the environment point into `texts`, which it owns. */
typedef struct command {
    const char *words[WORDS_MAX + 1];
    int count;
    char *texts[4];
    int text_count;
    char *include;
    bool complete;
} command;

static void add(command *c, const char *word)
{
    if (c->count < WORDS_MAX)
        c->words[c->count++] = word;
    else
        c->complete = false;
}

/* Adds the words of an environment variable, or of `otherwise` if it is not set. */
static void add_variable(command *c, const char *variable, const char *otherwise)
{
    const char *value = getenv(variable);
    if (value == NULL || value[strspn(value, " \t\n")] == '\0') value = otherwise;
    char *text = strdup(value);
    if (text == NULL || !program_words(text, c->words, &c->count, WORDS_MAX)) c->complete = false;
    c->texts[c->text_count++] = text;
}

static void add_include(command *c)
{
    const char *built = build_tree_data();
    const int length = built != NULL ? asprintf(&c->include, "-I%s/include", built)
                                     : asprintf(&c->include, "-I%s", INCLUDEDIR);
    if (length < 0) c->include = NULL;
    if (c->include != NULL)
        add(c, c->include);
    else
        c->complete = false;
}

static command command_for(const language *in, const char *source, const char *target)
{
    static const char *const usual[] = {"-O2", "-Wall", "-Wextra"};
    static const char *const needed[] = {"-ffp-contract=off", "-fvisibility=hidden", "-fPIC",
                                         "-shared"};
    command c = {.complete = true};
    add_variable(&c, in->variable, in->compiler);
    add(&c, in->standard);
    for (size_t i = 0; i < sizeof usual / sizeof usual[0]; ++i) add(&c, usual[i]);
    add_variable(&c, "CPPFLAGS", "");
    add_variable(&c, in->flags_variable, "");
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; ++i) add(&c, needed[i]);
    add_include(&c);
    add(&c, "-o");
    add(&c, target);
    add(&c, source);
    add_variable(&c, "LDFLAGS", "");
    add(&c, "-lm");
    c.words[c.count] = NULL;
    return c;
}

static void clear(command *c)
{
    for (int i = 0; i < c->text_count; ++i) free(c->texts[i]);
    free(c->include);
}

/* --- Messages of the compiler ----------------------------------------------------------------- */

/* Returns the line that contains `mark`, or the first line if mark is NULL. Terminates it in
 * `said`. */
static const char *line_with(char *said, const char *mark)
{
    char *line = mark != NULL ? strstr(said, mark) : said;
    if (line == NULL) return NULL;
    line[strcspn(line, "\n")] = '\0';
    while (line > said && line[-1] != '\n') --line;
    return line;
}

static const char *first_error(char *said)
{
    static const char *const marks[] = {"error: ", "undefined reference", NULL};
    const char *line = NULL;
    for (size_t i = 0; i < sizeof marks / sizeof marks[0] && line == NULL; ++i)
        line = line_with(said, marks[i]);
    return line;
}

static exit_status tell(const program_end *end, const char *compiler, const char *source,
                        const char *verb)
{
    if (end->error != 0)
        return complain(EXIT_DATA, verb,
                        "the compiler '%s' cannot be run: %s; CC (for C++: CXX) in the "
                        "environment names another",
                        compiler, system_error_text(end->error));
    if (end->status == 0) return EXIT_ANSWERED;
    if (end->said != NULL && end->said[0] != '\0')
        return complain(EXIT_DATA, verb, "%s was not built: %s", source, first_error(end->said));
    return complain(EXIT_DATA, verb, "%s was not built: '%s' ended with status %d", source,
                    compiler, end->status);
}

exit_status compile_plugin(const char *source, const char *target, const char *verb)
{
    const language *in = language_of(source);
    command c = command_for(in, source, target);
    exit_status status = EXIT_DATA;
    if (c.complete) {
        const program_end end = program_run(c.words, PROGRAM_ERRORS, true);
        status = tell(&end, c.words[0], source, verb);
        free(end.said);
    } else {
        status = complain(EXIT_DATA, verb,
                          "the command line of the compiler is too long, or memory ran out");
    }
    clear(&c);
    return status;
}

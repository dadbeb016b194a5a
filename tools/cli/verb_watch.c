/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <jansson.h>

#include "core/common/system_error.h"
#include "tools/cli/compile.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/program.h"
#include "tools/cli/verbs.h"
#include "tools/cli/watched_files.h"

#define QUICK_EFFORT "0.05" /* of the full check */

/* The verbs build, check and solve run as commands of their own in each round, so that a plugin is
 * loaded anew and its crash ends only that command. */

typedef struct answer {
    bool is_known;
    char verdict[16];
    double t;
    json_int_t pairs;
} answer;

typedef struct watching {
    const arguments *args;
    const char *source, *scene;
    char folder[64]; /* of our own: the plugin goes there */
    char *path;      /* of --plugin-path, with that folder before all others */
    answer last;
} watching;

/* --- Commands --------------------------------------------------------------------------------- */

/* Runs a verb of this very command; what it wrote to standard output is said[0] and freed by the
 * caller. Answers the exit status. */
static int run_verb(const char *const *words, char **said)
{
    char self[4096];
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    const char *line[16] = {length > 0 ? self : "impinge"};
    size_t count = 1;
    if (length > 0) self[length] = '\0';
    for (; words[count - 1] != NULL && count < 15; ++count) line[count] = words[count - 1];
    line[count] = NULL;
    const program_end end = program_run(line, PROGRAM_OUTPUT, false);
    *said = end.said;
    return end.error != 0 ? EXIT_DATA : end.status;
}

static bool build(const watching *w)
{
    char *said;
    const char *const words[] = {"build", w->source, "--output", w->folder, NULL};
    const int status = run_verb(words, &said);
    free(said);
    return status == EXIT_ANSWERED;
}

/* Where build has put the plugin: FILE.so. */
static void plugin_path(const watching *w, char *path, size_t size)
{
    const char *slash = strrchr(w->source, '/');
    const char *base = slash != NULL ? slash + 1 : w->source;
    const int stem = (int)(strrchr(base, '.') - base);
    snprintf(path, size, "%s/%.*s.so", w->folder, stem, base);
}

/* Prints the first failure; `impinge check` prints all. */
static void print_failure(const json_t *report)
{
    const json_t *types = json_object_get(report, "types");
    for (size_t k = 0; k < json_array_size(types); ++k) {
        const json_t *checks = json_object_get(json_array_get(types, k), "checks");
        for (size_t i = 0; i < json_array_size(checks); ++i) {
            const json_t *check = json_array_get(checks, i);
            const char *verdict = json_string_value(json_object_get(check, "verdict"));
            if (verdict == NULL || strcmp(verdict, "fail") != 0) continue;
            printf("  check    FAIL %s: %s\n", json_string_value(json_object_get(check, "name")),
                   message_shown(json_string_value(json_object_get(check, "text"))).text);
            return;
        }
    }
    puts("  check    FAIL; `impinge check` tells more");
}

static bool check(const watching *w)
{
    char *said, path[256];
    plugin_path(w, path, sizeof path);
    const char *const words[] = {"check",         path,    "--effort", QUICK_EFFORT, "--json",
                                 "--plugin-path", w->path, NULL};
    const int status = run_verb(words, &said);
    json_t *report = said != NULL ? json_loads(said, 0, NULL) : NULL;
    if (status == EXIT_ANSWERED)
        puts("  check    passed, quickly");
    else
        print_failure(report);
    json_decref(report);
    free(said);
    return status == EXIT_ANSWERED;
}

/* --- Answers ---------------------------------------------------------------------------------- */

static answer read_answer(const json_t *result)
{
    answer a = {.is_known = false};
    const char *verdict = json_string_value(json_object_get(result, "verdict"));
    const json_t *stats = json_object_get(result, "stats");
    if (verdict == NULL || stats == NULL) return a;
    snprintf(a.verdict, sizeof a.verdict, "%s", verdict);
    a.t = json_number_value(json_object_get(result, "t_lower"));
    a.pairs = json_integer_value(json_object_get(stats, "pairs"));
    a.is_known = true;
    return a;
}

static void print_answer(const answer *now, const answer *last)
{
    printf("  answer   %s", now->verdict);
    if (strcmp(now->verdict, "clear") != 0) printf(" at t = %.10g", now->t);
    printf(", %" JSON_INTEGER_FORMAT " pairs", now->pairs);
    if (!last->is_known) {
        putchar('\n');
        return;
    }
    const bool is_same = strcmp(now->verdict, last->verdict) == 0 && now->t == last->t;
    if (is_same && now->pairs == last->pairs) {
        puts("; as before");
        return;
    }
    printf("; before: ");
    if (!is_same) printf("%s at t = %.10g, ", last->verdict, last->t);
    printf("%" JSON_INTEGER_FORMAT " pairs", last->pairs);
    if (last->pairs > 0)
        printf(" (%+.0f %%)", 100 * ((double)now->pairs / (double)last->pairs - 1));
    putchar('\n');
}

static void solve(watching *w)
{
    char *said;
    const char *const words[] = {"solve",  w->scene,        "--max-pairs", "1M",
                                 "--json", "--plugin-path", w->path,       NULL};
    run_verb(words, &said);
    json_t *result = said != NULL ? json_loads(said, 0, NULL) : NULL;
    const answer now = read_answer(result);
    if (now.is_known) {
        const char *advice = json_string_value(json_object_get(result, "advice"));
        print_answer(&now, &w->last);
        if (advice != NULL) printf("  advice   %s\n", advice);
        w->last = now;
    }
    json_decref(result);
    free(said);
}

/* --- Rounds ----------------------------------------------------------------------------------- */

static exit_status one_round(watching *w)
{
    printf("%s\n", message_shown(w->source).text);
    if (build(w)) {
        puts("  build    done");
        check(w);
        solve(w);
    }
    return output_flush(w->args->verb->name);
}

static exit_status all_rounds(watching *w)
{
    const uint64_t most = arguments_count(w->args, "rounds", 0);
    const char *const paths[] = {w->source, w->scene};
    watched_files files;
    exit_status status = watched_files_begin(&files, paths, 2, w->args->verb->name);
    for (uint64_t k = 1; status == EXIT_ANSWERED; ++k) {
        status = one_round(w);
        if (status != EXIT_ANSWERED || k == most || !watched_files_wait(&files)) break;
    }
    watched_files_end(&files);
    return status;
}

static exit_status run(const arguments *args)
{
    const option_value *path = arguments_option(args, "plugin-path");
    const char *temporary = getenv("TMPDIR");
    watching w = {.args = args, .source = args->operands[0], .scene = args->operands[1]};
    char plugin[256];
    if (!compile_knows(w.source))
        return complain(EXIT_USAGE, args->verb->name,
                        "%s: a source file is wanted, which ends in .c, .cc, .cpp or .cxx",
                        w.source);
    snprintf(w.folder, sizeof w.folder, "%s/impinge-watch-XXXXXX",
             temporary != NULL && strlen(temporary) < 30 ? temporary : "/tmp");
    if (mkdtemp(w.folder) == NULL)
        return complain(EXIT_DATA, args->verb->name, "%s: %s", w.folder, system_error_text(errno));
    exit_status status = EXIT_DATA;
    if (asprintf(&w.path, "%s%s%s", w.folder, path != NULL ? ":" : "",
                 path != NULL ? path->text : "") < 0) {
        w.path = NULL;
        status = complain_of_memory(args->verb->name);
    } else {
        interrupt_prepare();
        status = all_rounds(&w);
    }
    plugin_path(&w, plugin, sizeof plugin);
    unlink(plugin);
    rmdir(w.folder);
    free(w.path);
    return status;
}

static const option watch_options[] = {
    {.name = "rounds",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "end after N rounds; 0: when a signal comes (0)"},
    {.name = "plugin-path",
     .kind = OPTION_TEXT,
     .argument = "DIR[:DIR]",
     .help = "look for the scene's other plugins here before anywhere else"},
    {.name = NULL}};

static const option *const tables[] = {watch_options, options_always, NULL};

const verb verb_watch = {
    .name = "watch",
    .operands = "FILE SCENE",
    .summary = "Build, check and solve again whenever a file changes",
    .details =
        "Builds the plugin FILE.c (or .cc, .cpp, .cxx) into a folder of its own, checks it "
        "quickly\n"
        "and solves SCENE with it, now and whenever one of the two files is written; prints what\n"
        "changed in the answer and its pairs. SIGINT (^C) ends it.\n",
    .example = "echo '{\"bodies\": [{\"surfaces\": [{\"type\": \"gong\"}]}]}' >gong.json\n"
               "  impinge new gong && impinge watch gong/gong.c gong.json --rounds 1",
    .operand_min = 2,
    .operand_max = 2,
    .options = tables,
    .run = run};

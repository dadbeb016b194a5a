/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/common/system_error.h"
#include "tools/cli/input.h"
#include "tools/cli/output.h"
#include "tools/cli/output_file.h"
#include "tools/cli/output_operands.h"
#include "tools/cli/program.h"
#include "tools/cli/verbs.h"
#include "tools/view/plot_source.h"
#include "tools/view/png.h"
#include "tools/view/request.h"

#include <impinge/baseline.h>

/* --- The output ------------------------------------------------------------------------------- */

enum { WIDTH = 960, HEIGHT = 480, COLUMNS = 79, ROWS = 24 }; /* pixels; characters */

static const char *const formats[] = {"png", "svg", NULL};

/* NULL: to the terminal. */
static const char *ending(const arguments *args)
{
    const option_value *output = arguments_option(args, "output");
    const option_value *format = arguments_option(args, "format");
    if (output == NULL) return NULL;
    if (format != NULL) return format->choice == 0 ? ".png" : ".svg";
    const char *dot = request_ending(output->text);
    return dot != NULL ? dot : "";
}

/* In letters of either case. */
static bool ends_with(const arguments *args, const char *wanted)
{
    return strcasecmp(ending(args), wanted) == 0;
}

static exit_status check_output(const arguments *args)
{
    const exit_status status = output_spares_operands(args, "output");
    if (status != EXIT_ANSWERED || ending(args) == NULL || ends_with(args, ".svg")) return status;
    if (ends_with(args, ".png"))
        return png_check(arguments_option(args, "output")->text, args->verb->name);
    return complain(EXIT_USAGE, args->verb->name,
                    "--output must end with one of .png, .svg, or --format say which, not '%s'",
                    arguments_option(args, "output")->text);
}

/* False: no memory. What cannot be written is complained of when the file is closed. */
static bool write_png(const plot *p, FILE *file)
{
    raster r;
    canvas c = {WIDTH, HEIGHT, &r, NULL};
    const bool begun = raster_begin(&r, WIDTH, HEIGHT, (colour){1, 1, 1});
    if (begun) plot_draw(p, &c);
    const bool good = begun && (png_write_raster(file, &r) || ferror(file));
    raster_free(&r);
    return good;
}

static exit_status write_file(const plot *p, const arguments *args)
{
    output_file out;
    const char *path = arguments_option(args, "output")->text;
    exit_status status = output_file_begin(&out, path, args->verb->name);
    if (status != EXIT_ANSWERED) return status;
    bool good = true;
    if (ends_with(args, ".png")) {
        good = write_png(p, out.file);
    } else {
        canvas c = canvas_svg_begin(out.file, WIDTH, HEIGHT);
        plot_draw(p, &c);
        canvas_svg_end(&c);
    }
    status = output_file_end(&out, good);
    return good || status != EXIT_ANSWERED ? status : complain_of_memory(args->verb->name);
}

static json_t *plot_json(const arguments *args)
{
    const option_value *output = arguments_option(args, "output");
    return json_pack("{s:o, s:i, s:i}", "file", output_json_text(output->text), "width", WIDTH,
                     "height", HEIGHT);
}

static exit_status show(const plot *p, const arguments *args)
{
    if (ending(args) == NULL)
        return plot_print(p, stdout, COLUMNS, ROWS) ? output_flush(args->verb->name)
                                                    : complain_of_memory(args->verb->name);
    const char *path = arguments_option(args, "output")->text;
    const exit_status status = write_file(p, args);
    if (status != EXIT_ANSWERED || output_is_standard(path)) return status; /* the plot alone */
    if (arguments_option(args, "json") != NULL)
        return output_json(plot_json(args), args->verb->name);
    printf("%s: %dx%d pixels\n", message_shown(path).text, WIDTH, HEIGHT);
    return output_flush(args->verb->name);
}

/* --- Distance over time ----------------------------------------------------------------------- */

static exit_status measure(subject *what, size_t slices, const arguments *args, gap_profile *gap)
{
    imp_error error = {0};
    imp_options options = what->options;
    imp_code code = subject_find_nearest(what, &error);
    options.max_seconds = allowance_left(&what->allowance, 0.9);
    options.baseline = IMP_BASELINE_NONE;
    if (code == IMP_SUCCESS) code = gap_measure(what->scene, &options, slices, 0.1, gap, &error);
    return code == IMP_SUCCESS ? EXIT_ANSWERED : complain_of(&error, args->verb->name);
}

static exit_status plot_scene(const arguments *args)
{
    const option_value *slices = arguments_option(args, "slices");
    const uint64_t count = arguments_count(args, "slices", 64);
    if (count < 1 || count > 10000)
        return complain(EXIT_USAGE, args->verb->name, "--slices must be from 1 to 10000, not '%s'",
                        slices->text);
    const double required = arguments_number(args, "require", 0);
    subject what;
    gap_profile gap = {0};
    plot p = {0};
    exit_status status = subject_read(&what, args);
    if (status == EXIT_ANSWERED) status = measure(&what, (size_t)count, args, &gap);
    if (status == EXIT_ANSWERED)
        status = plot_of_gap(&p, &gap, &what, required) ? show(&p, args)
                                                        : complain_of_memory(args->verb->name);
    plot_free(&p);
    gap_free(&gap);
    subject_free(&what);
    return status;
}

/* --- Benchmarks ------------------------------------------------------------------------------- */

static exit_status show_bench(const char *text, size_t length, const char *name,
                              const arguments *args)
{
    json_t *json = json_loadb(text, length, 0, NULL);
    const json_t *sets = json_object_get(json, "sets");
    exit_status status = EXIT_ANSWERED;
    if (json_array_size(sets) != 1)
        status = complain(EXIT_DATA, args->verb->name,
                          "%s: not one set that `impinge bench SET --json` prints", name);
    plot p = {0};
    if (status == EXIT_ANSWERED)
        status = plot_of_bench(&p, json_array_get(sets, 0), name, args->verb->name);
    if (status == EXIT_ANSWERED) status = show(&p, args);
    plot_free(&p);
    json_decref(json);
    return status;
}

/* Runs this program as `bench SET --json`; its complaints are shown. */
static exit_status plot_set(const char *set, const arguments *args)
{
    const char *const words[] = {
        "/proc/self/exe", "bench", "--json", "--repeat", "1", "--", set, NULL};
    const program_end end = program_run(words, PROGRAM_OUTPUT, false);
    exit_status status = (exit_status)end.status;
    if (end.error != 0)
        status = complain(EXIT_DATA, args->verb->name, "bench %s: %s", set,
                          system_error_text(end.error));
    else if (status == EXIT_ANSWERED && end.said != NULL)
        status = show_bench(end.said, strlen(end.said), set, args);
    free(end.said);
    return status;
}

/* Returns whether the file is of bench: it has "sets". Other files are read as scenes. */
static bool is_of_bench(const input_text *t)
{
    json_t *json = json_loadb(t->text, t->length, 0, NULL);
    const bool found = json_object_get(json, "sets") != NULL;
    json_decref(json);
    return found;
}

/* A set of benchmarks is one word without a dot or a slash, and no file. */
static bool names_a_set(const char *word)
{
    FILE *file = strpbrk(word, "./-") == NULL ? fopen(word, "r") : stdin;
    if (file != NULL && file != stdin) fclose(file);
    return file == NULL;
}

static exit_status plot_file(const arguments *args)
{
    input_text t = {0};
    FILE *file = input_open(args->operands[0], args->verb->name);
    if (file == NULL) return EXIT_DATA;
    exit_status status = EXIT_DATA;
    const bool read = input_read(file, args->operands[0], args->verb->name, &t);
    const bool bench = read && is_of_bench(&t);
    input_close(file);
    if (bench) status = show_bench(t.text, t.length, args->operands[0], args);
    free(t.text);
    return read && !bench ? plot_scene(args) : status;
}

static exit_status run(const arguments *args)
{
    const exit_status checked = check_output(args);
    if (checked != EXIT_ANSWERED) return checked;
    if (args->operand_count == 2 || strcmp(args->operands[0], "-") == 0) return plot_scene(args);
    return names_a_set(args->operands[0]) ? plot_set(args->operands[0], args) : plot_file(args);
}

static const option plot_options[] = {
    {.name = "output",
     .kind = OPTION_TEXT,
     .argument = "FILE",
     .help = "write here (also -o FILE; '-': standard output); without it, to the terminal"},
    {.name = "format",
     .kind = OPTION_CHOICE,
     .argument = "NAME",
     .choices = formats,
     .help = "of the output; else its extension selects it"},
    {.name = "require",
     .kind = OPTION_NUMBER,
     .argument = "D",
     .min_open = true,
     .help = "draw a line at this distance"},
    {.name = "slices",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "of time, each with its bracket (64)"},
    {.name = NULL}};

static const option *const tables[] = {plot_options,     options_search, options_query,
                                       options_registry, options_always, NULL};

const verb verb_plot = {
    .name = "plot",
    .operands = "SCENE|RESULT|SET or A B",
    .summary = "Plot distance over time, or benchmarks",
    .details =
        "Of a scene, or two surfaces: the least distance between its bodies in each slice of "
        "time,\n"
        "as a bracket: proved not to be below the band's lower edge, and found, at two points, "
        "not\n"
        "above its upper edge. The contact is marked.\n"
        "\n"
        "Of a set of benchmarks (figure7, bicubic, ... as for `impinge bench`, which is run), or "
        "of\n"
        "a file that `impinge bench SET --json` printed: mean pairs of each method; of figure7,\n"
        "over the distance S of the paper's figure 7.\n",
    .example = "impinge plot 'sphere center=-4,0,0 ! translate velocity=3,0,0' sphere",
    .operand_min = 1,
    .operand_max = 2,
    .options = tables,
    .run = run};

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/input.h"
#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"
#include "tools/view/plot_source.h"
#include "tools/view/view.h"

static void show_command(const char *name, const char *path, const char *rest)
{
    char *word = output_shell_word(path);
    if (word == NULL) return;
    printf("  impinge %s %s%s\n", name, word, rest);
    free(word);
}

/* --- The teapot ------------------------------------------------------------------------------- */

static exit_status show_teapot(imp_registry *registry, const char *path, const arguments *args)
{
    const bool json = arguments_option(args, "json") != NULL;
    if (!json)
        puts("The Utah teapot (M. Newell 1975; 32 Bezier patches) turns and drifts, and a spinning "
             "torus\n"
             "flies at it. When and where do they first touch?\n");
    const exit_status introduced = output_flush(args->verb->name);
    if (introduced != EXIT_ANSWERED) return introduced;
    const exit_status status = query_answer_file(registry, path, args);
    if (json || status > EXIT_UNDECIDED) return status;
    puts("\nThe same by hand:");
    show_command("solve", path, "");
    return status;
}

/* --- The blade: frames ------------------------------------------------------------------------ */

enum { FRAMES_A_SECOND = 60 };

/* The distance at each frame, as proved brackets. */
static imp_code measure_frames(const subject *what, gap_profile *f, imp_error *error)
{
    const double span = what->options.t_end - what->options.t_start;
    const size_t count = (size_t)floor(span * FRAMES_A_SECOND + 1e-9) + 1;
    double *t = calloc(count, sizeof *t);
    if (t == NULL) return mesh_no_memory(error);
    for (size_t k = 0; k < count; ++k) t[k] = what->options.t_start + (double)k / FRAMES_A_SECOND;
    const imp_code code = gap_at_moments(what->scene, &what->options, NULL, t, count, f, error);
    free(t);
    return code;
}

/* --- The blade: printed text ------------------------------------------------------------------ */

static exit_status introduce(const char *speaker)
{
    puts("A rotor blade makes 15 turns a second above a sheet that flexes more and more.\n"
         "Do they touch within a quarter of a second?\n");
    return output_flush(speaker);
}

static void tell_frames(const gap_profile *f)
{
    size_t nearest = 0;
    for (size_t k = 1; k < f->count; ++k)
        if (f->lower[k] < f->lower[nearest]) nearest = k;
    printf("1. Looking at %zu moments, %d frames a second: no contact.\n"
           "   The nearest frame is t = %.4g, where the two are %s apart.\n\n",
           f->count, FRAMES_A_SECOND, f->t[nearest], output_number_lower(f->lower[nearest]).text);
}

static void tell_search(const subject *what)
{
    const imp_result r = imp_query_result(what->query);
    puts("2. Searching all moments, with proof:");
    result_print(what->scene, &r);
    if (r.verdict == IMP_VERDICT_CONTACT)
        printf(
            "   Two points at most %g apart were evaluated at that time, rounding included, and\n"
            "   no two points of blade and sheet, of which there are infinitely many, come\n"
            "   nearer than %g at any moment before.\n",
            r.gamma, r.gamma_clear);
}

static bool add_frames(plot *p, const gap_profile *f)
{
    plot_series *s = plot_add(p, "what the frames see", PLOT_POINTS, f->count);
    if (s == NULL) return false;
    s->letter = 'o';
    memcpy(s->x, f->t, f->count * sizeof *s->x);
    memcpy(s->y, f->upper, f->count * sizeof *s->y);
    return true;
}

static exit_status tell_gap(const subject *what, const gap_profile *f, const char *speaker)
{
    gap_profile gap;
    plot p = {0};
    imp_error error = {0};
    exit_status status = EXIT_ANSWERED;
    if (gap_measure(what->scene, &what->options, 67, 0.05, &gap, &error) != IMP_SUCCESS)
        status = complain_of(&error, speaker);
    else if (puts("\n3. Between the frames:") < 0 || !plot_of_gap(&p, &gap, what, 0) ||
             !add_frames(&p, f) || !plot_print(&p, stdout, 79, 22))
        status = complain_of_memory(speaker);
    plot_free(&p);
    gap_free(&gap);
    return status == EXIT_ANSWERED ? output_flush(speaker) : status;
}

/* --- The blade: files ------------------------------------------------------------------------- */

enum { FRAMES_OF_PAGE = 26 }; /* a hundredth of a second apart; more would take longer to make */

static exit_status write_one(subject *what, const arguments *args, const char *directory,
                             const char *ending)
{
    view_request request;
    char *path;
    exit_status status = request_read(args, &request);
    if (asprintf(&path, "%s%simpinge-demo%s", directory, directory[0] != '\0' ? "/" : "", ending) <
        0)
        return complain_of_memory(args->verb->name);
    request.output = path;
    request.format = ending;
    request.frames = FRAMES_OF_PAGE;
    if (status == EXIT_ANSWERED) status = view_write_and_tell(what, &request);
    free(path);
    return status;
}

static exit_status write_files(subject *what, const arguments *args)
{
    const option_value *output = arguments_option(args, "output");
    const char *directory = output != NULL ? output->text : "";
    puts("\n4. To look at:");
    const exit_status status = write_one(what, args, directory, view_has(".png") ? ".png" : ".svg");
    if (status != EXIT_ANSWERED || !view_has(".html")) return status;
    return write_one(what, args, directory, ".html");
}

static exit_status show_blade(subject *what, const char *path, const arguments *args)
{
    gap_profile f = {0};
    imp_error error = {0};
    exit_status status = EXIT_ANSWERED;
    if (measure_frames(what, &f, &error) != IMP_SUCCESS)
        status = complain_of(&error, args->verb->name);
    if (status == EXIT_ANSWERED) {
        tell_frames(&f);
        tell_search(what);
        status = tell_gap(what, &f, args->verb->name);
    }
    gap_free(&f);
    if (status == EXIT_ANSWERED) status = write_files(what, args);
    if (status != EXIT_ANSWERED) return status;
    puts("\nTry next:");
    show_command("solve", path, "");
    show_command("view", path, " -o blade.svg");
    show_command("plot", path, "");
    puts("  impinge demo teapot\n  impinge list");
    return EXIT_ANSWERED;
}

static exit_status demonstrate(imp_registry *registry, const char *path, const arguments *args)
{
    if (arguments_option(args, "json") != NULL) return query_answer_file(registry, path, args);
    const exit_status introduced = introduce(args->verb->name);
    if (introduced != EXIT_ANSWERED) return introduced;
    subject what;
    exit_status status = subject_of_file(&what, path, args);
    if (status == EXIT_ANSWERED) status = show_blade(&what, path, args);
    subject_free(&what);
    return status;
}

/* --- Which ------------------------------------------------------------------------------------ */

typedef struct demonstration {
    const char *name, *file;
    exit_status (*show)(imp_registry *registry, const char *path, const arguments *args);
} demonstration;

static const demonstration all[] = {{"blade", "blade.json", demonstrate},
                                    {"teapot", "teapot.json", show_teapot}};

static const demonstration *find(const arguments *args)
{
    const char *name = args->operand_count > 0 ? args->operands[0] : "blade";
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k)
        if (strcmp(all[k].name, name) == 0) return &all[k];
    complain(EXIT_USAGE, args->verb->name, "unknown demonstration '%s'; there are blade, teapot",
             name);
    return NULL;
}

static exit_status run(const arguments *args)
{
    const demonstration *d = find(args);
    if (d == NULL) return EXIT_USAGE;
    const exit_status checked = query_check(args);
    if (checked != EXIT_ANSWERED) return checked;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    exit_status status = EXIT_DATA;
    char *path = input_package_file(d->file, args->verb->name);
    if (path != NULL) status = d->show(registry, path, args);
    free(path);
    query_registry_free(registry);
    return status;
}

static const char *scene_name(size_t index)
{
    static const char *const names[] = {"blade", "teapot"};
    return index < 2 ? names[index] : NULL;
}

static const option demo_options[] = {{.name = "output",
                                       .kind = OPTION_TEXT,
                                       .argument = "DIR",
                                       .help = "blade: write picture and page here (.)"},
                                      {.name = NULL}};

static const option *const tables[] = {demo_options,     options_search, options_query,
                                       options_registry, options_always, NULL};

const verb verb_demo = {
    .name = "demo",
    .operands = "[blade|teapot]",
    .summary = "See what sampling misses and a proof finds",
    .details =
        "blade (unless another is named): a fast, thin rotor blade above a sheet that flexes. At "
        "60\n"
        "frames a second nothing is seen; the search finds the contact and proves that nothing\n"
        "touched before. Prints both answers and the distance over time, and writes a picture,\n"
        "impinge-demo.png, and a page, impinge-demo.html, into the current directory.\n"
        "teapot: the 32 Bezier patches of the Utah teapot (M. Newell, 1975), turning and "
        "drifting,\n"
        "against a spinning torus that flies at it.\n",
    .example = "impinge demo teapot",
    .operand_max = 1,
    .operand_word = scene_name,
    .options = tables,
    .run = run};

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>
#include <stdlib.h>

#include "input.h"
#include "output.h"
#include "query.h"
#include "verbs.h"

static void introduce(void)
{
    puts("The Utah teapot (M. Newell 1975; 32 Bezier patches) turns and drifts, and a spinning "
         "torus\n"
         "flies at it. When and where do they first touch?\n");
}

static void show_command(const char *path)
{
    char *word = output_shell_word(path);
    if (word == NULL) return;
    printf("\nThe same by hand:  impinge solve %s\n", word);
    free(word);
}

static exit_status show(imp_registry *registry, const char *path, const arguments *args)
{
    const bool json = arguments_option(args, "json") != NULL;
    if (!json) introduce();
    const exit_status introduced = output_flush(args->verb->name);
    if (introduced != EXIT_ANSWERED) return introduced;
    const exit_status status = query_answer_file(registry, path, args);
    if (!json && status <= EXIT_UNDECIDED) show_command(path);
    return status;
}

static exit_status run(const arguments *args)
{
    const exit_status checked = query_check(args);
    if (checked != EXIT_ANSWERED) return checked;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    exit_status status = EXIT_DATA;
    char *path = input_package_file("teapot.json", args->verb->name);
    if (path != NULL) {
        status = show(registry, path, args);
    }
    free(path);
    imp_registry_free(registry);
    return status;
}

static const option *const tables[] = {options_query, options_registry, options_always, NULL};

const verb verb_demo = {
    .name = "demo",
    .operands = "",
    .summary = "See the teapot meet a torus",
    .details =
        "Solves a scene that comes with impinge: the 32 Bezier patches of the Utah teapot\n"
        "(M. Newell, 1975), turning and drifting, against a spinning torus that flies at it.\n",
    .example = "impinge demo",
    .options = tables,
    .run = run};

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/spelling.h"
#include "tools/cli/catalogue.h"
#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/scene_info.h"
#include "tools/cli/verbs.h"
#include "tools/view/view.h"

/* A surface and a map may share a name; then both are shown. Shadowed types are not. */
static bool is_asked_for(const imp_type_info *info, const char *name)
{
    return info->shadowed_by == NULL && strcmp(info->name, name) == 0;
}

static void print_line(const char *label, const char *text)
{
    if (text != NULL && text[0] != '\0') printf("  %-10s %s\n", label, message_shown(text).text);
}

static void print_parameter(const imp_parameter *p)
{
    const range_text range = catalogue_range(p);
    printf("    %s: %s", p->name, catalogue_shape(p).text);
    if (p->flags & IMP_PARAMETER_SCALAR_OK) printf(" (one may stand alone)");
    if (range.text[0] != '\0') printf(", %s%s", p->rank > 0 ? "each " : "", range.text);
    if (p->default_value != NULL)
        printf("; default %s", p->default_value);
    else
        printf("; %s", p->flags & IMP_PARAMETER_OPTIONAL ? "optional" : "required");
    if (p->unit != NULL && p->unit[0] != '\0' && strcmp(p->unit, "1") != 0)
        printf("; unit %s", p->unit);
    putchar('\n');
    if (p->doc != NULL) printf("        %s\n", p->doc);
}

static void print_parameters(const imp_type_info *info)
{
    if (info->parameter_count == 0) {
        print_line("parameters", "none");
        return;
    }
    puts("  parameters");
    for (size_t i = 0; i < info->parameter_count; ++i)
        print_parameter(catalogue_parameter(info, i));
}

/* Returns the example of some surface, for a map to act on. */
static const char *any_surface(const imp_registry *registry)
{
    imp_type_info info;
    const char *best = NULL;
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i) {
        if (info.kind != IMP_TYPE_SURFACE || info.shadowed_by != NULL) continue;
        if (best == NULL || strlen(info.example) < strlen(best)) best = info.example;
    }
    return best;
}

/* Prints a command that works: the example against itself, under the map if it is one. */
static void print_command(const imp_registry *registry, const imp_type_info *info)
{
    const char *surface = info->kind == IMP_TYPE_MAP ? any_surface(registry) : info->example;
    char *pipeline = NULL;
    if (surface == NULL) return;
    const int length = info->kind == IMP_TYPE_MAP
                           ? asprintf(&pipeline, "%s ! %s", surface, info->example)
                           : asprintf(&pipeline, "%s", surface);
    char *a = length >= 0 ? output_shell_word(pipeline) : NULL;
    char *b = output_shell_word(surface);
    if (a != NULL && b != NULL) printf("  %-10s impinge pair %s %s\n", "try", a, b);
    free(a);
    free(b);
    if (length >= 0) free(pipeline);
}

static void print_type(const imp_registry *registry, const imp_type_info *info)
{
    printf("%s (%s): %s\n", info->name, catalogue_kind_name(info->kind), info->summary);
    print_line("equation", info->equation);
    print_line("source", info->source);
    print_line("formula", info->formula);
    print_parameters(info);
    print_line("example", info->example);
    print_command(registry, info);
    printf("  %-10s %s %s, %s, %s\n", "plugin", info->plugin, info->version, info->license,
           info->author);
    print_line("uses", info->capabilities);
    print_line("file", info->file);
}

static exit_status print_all(const imp_registry *registry, const arguments *args)
{
    imp_type_info info;
    json_t *types = json_array();
    size_t found = 0;
    const bool json = arguments_option(args, "json") != NULL;
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i) {
        if (!is_asked_for(&info, args->operands[0])) continue;
        if (json && json_array_append_new(types, catalogue_full_json(&info)) != 0) break;
        if (!json && found > 0) putchar('\n');
        if (!json) print_type(registry, &info);
        ++found;
    }
    if (json) return output_json(json_pack("{s:o}", "types", types), args->verb->name);
    json_decref(types);
    return EXIT_ANSWERED;
}

static exit_status unknown(const imp_registry *registry, const arguments *args)
{
    imp_type_info info;
    spelling_search near = {.wanted = args->operands[0]};
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i) spelling_offer(&near, info.name);
    if (near.best != NULL)
        return complain(EXIT_DATA, args->verb->name,
                        "unknown type '%s', did you mean '%s'? `impinge list` shows all",
                        args->operands[0], near.best);
    return complain(EXIT_DATA, args->verb->name,
                    "unknown type '%s'; `impinge list` shows all; give the directory of a plugin "
                    "file by --plugin-path",
                    args->operands[0]);
}

/* The example as a subject: alone, at rest or as its map moves it. */
static exit_status draw(imp_registry *registry, const imp_type_info *info, const arguments *args)
{
    const char *surface = info->kind == IMP_TYPE_MAP ? any_surface(registry) : info->example;
    char *pipeline = NULL;
    imp_error error = {0};
    view_request request;
    exit_status status = request_read(args, &request);
    if (status != EXIT_ANSWERED) return status;
    request.output = arguments_option(args, "view")->text;
    request.format = request_ending(request.output);
    request.json = false;
    status = view_check_output(&request);
    if (status != EXIT_ANSWERED) return status;
    const bool map = info->kind == IMP_TYPE_MAP && surface != NULL;
    if (asprintf(&pipeline, "%s%s%s", map ? surface : info->example, map ? " ! " : "",
                 map ? info->example : "") < 0)
        return complain_of_memory(args->verb->name);
    subject what = {.scene = imp_scene_from_pair(registry, pipeline, pipeline, &error)};
    free(pipeline);
    if (what.scene == NULL) return complain_of(&error, args->verb->name);
    what.options = imp_options_default(what.scene);
    what.body_count = 1, what.has_looked = true;
    snprintf(what.title, sizeof what.title, "%s", info->name);
    status = view_write_and_tell(&what, &request);
    imp_scene_free(what.scene);
    return status;
}

static exit_status draw_first(imp_registry *registry, const arguments *args)
{
    imp_type_info info;
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i)
        if (is_asked_for(&info, args->operands[0])) return draw(registry, &info, args);
    return EXIT_ANSWERED;
}

/* Reports a file that cannot be written before anything is printed. */
static exit_status check_view(const arguments *args)
{
    const option_value *view = arguments_option(args, "view");
    const view_request request = {.verb = args->verb->name,
                                  .output = view != NULL ? view->text : NULL,
                                  .format = view != NULL ? request_ending(view->text) : NULL};
    return view != NULL ? view_check_output(&request) : EXIT_ANSWERED;
}

static bool is_known(const imp_registry *registry, const char *name)
{
    imp_type_info info;
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i)
        if (is_asked_for(&info, name)) return true;
    return false;
}

static exit_status run(const arguments *args)
{
    const exit_status checked = check_view(args);
    if (checked != EXIT_ANSWERED) return checked;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    const bool known = is_known(registry, args->operands[0]);
    const bool scene = !known && scene_info_is_asked(args->operands[0]);
    exit_status status = scene   ? scene_info_print(registry, args)
                         : known ? print_all(registry, args)
                                 : unknown(registry, args);
    if (status == EXIT_ANSWERED && !scene && arguments_option(args, "view") != NULL)
        status = draw_first(registry, args);
    query_registry_free(registry);
    return status;
}

static const option info_options[] = {
    {.name = "view",
     .kind = OPTION_TEXT,
     .argument = "FILE",
     .help = "draw the example into this file, as `impinge view` does"},
    {.name = "max-seconds",
     .kind = OPTION_NUMBER,
     .argument = "S",
     .help = "read a scene and test its bodies for at most S seconds; 0: no limit (0)"},
    {.name = NULL}};

static const option *const tables[] = {info_options, options_registry, options_always, NULL};

const verb verb_info = {
    .name = "info",
    .operands = "TYPE|SCENE.json",
    .summary = "Describe a surface type or map, or the bodies of a scene",
    .details =
        "Prints summary, equation, parameters (shape, range, unit, default), an example, and the\n"
        "plugin the type comes from. Where a surface and a map share the name, both.\n"
        "Of a scene it prints the bodies, and which of them are closed, so that they may be "
        "solid.\n",
    .example = "impinge info sphere",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};

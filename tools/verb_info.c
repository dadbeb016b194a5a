/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue.h"
#include "output.h"
#include "query.h"
#include "verbs.h"

/* A surface and a map may share a name; then both are told of. Shadowed types are not. */
static bool is_asked_for(const imp_type_info *info, const char *name)
{
    return info->shadowed_by == NULL && strcmp(info->name, name) == 0;
}

static void print_line(const char *label, const char *text)
{
    if (text != NULL && text[0] != '\0') printf("  %-10s %s\n", label, text);
}

static void print_parameter(const imp_parameter *p)
{
    const range_text range = catalogue_range(p);
    printf("    %s: %s", p->name, catalogue_shape(p).text);
    if (p->flags & IMP_SCALAR_OK) printf(" (one may stand alone)");
    if (range.text[0] != '\0') printf(", %s%s", p->rank > 0 ? "each " : "", range.text);
    if (p->preset != NULL)
        printf("; default %s", p->preset);
    else
        printf("; %s", p->flags & IMP_OPTIONAL ? "may be left out" : "required");
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

/* The example of some surface, for a map to act on. */
static const char *any_surface(const imp_registry *registry)
{
    imp_type_info info;
    const char *best = NULL;
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i) {
        if (info.sort != IMP_SORT_SURFACE || info.shadowed_by != NULL) continue;
        if (best == NULL || strlen(info.example) < strlen(best)) best = info.example;
    }
    return best;
}

/* A command that runs: the example against itself, under the map if it is one. */
static void print_command(const imp_registry *registry, const imp_type_info *info)
{
    const char *surface = info->sort == IMP_SORT_MAP ? any_surface(registry) : info->example;
    char *pipeline = NULL;
    if (surface == NULL) return;
    const int length = info->sort == IMP_SORT_MAP
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
    printf("%s (%s): %s\n", info->name, catalogue_sort_name(info->sort), info->summary);
    print_line("equation", info->equation);
    print_line("source", info->source);
    print_parameters(info);
    print_line("example", info->example);
    print_command(registry, info);
    printf("  %-10s %s %s, %s, %s\n", "plugin", info->plugin, info->version, info->license,
           info->author);
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
    imp_nearest near = {.wanted = args->operands[0]};
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i)
        imp_nearest_offer(&near, info.name);
    if (near.best != NULL)
        return complain(EXIT_DATA, args->verb->name,
                        "there is no type '%s', did you mean '%s'? `impinge list` shows all",
                        args->operands[0], near.best);
    return complain(EXIT_DATA, args->verb->name, "there is no type '%s'; `impinge list` shows all",
                    args->operands[0]);
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
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    const exit_status status =
        is_known(registry, args->operands[0]) ? print_all(registry, args) : unknown(registry, args);
    imp_registry_free(registry);
    return status;
}

static const option *const tables[] = {options_registry, options_always, NULL};

const verb verb_info = {
    .name = "info",
    .operands = "TYPE",
    .summary = "Tell everything about a surface type or map",
    .details =
        "Prints summary, equation, parameters (shape, range, unit, default), an example, and the\n"
        "plugin the type comes from. Where a surface and a map share the name, both.\n",
    .example = "impinge info sphere",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/catalogue.h"
#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

/* The types found, surfaces first, each kind by name; among types of one name, the one that is used
 * first. */
typedef struct type_list {
    imp_type_info *types;
    size_t count;
} type_list;

static int compare(const void *left, const void *right)
{
    const imp_type_info *a = left, *b = right;
    if (a->kind != b->kind) return a->kind == IMP_TYPE_SURFACE ? -1 : 1;
    const int names = strcmp(a->name, b->name);
    if (names != 0) return names;
    if ((a->shadowed_by == NULL) != (b->shadowed_by == NULL))
        return a->shadowed_by == NULL ? -1 : 1;
    return strcmp(a->file, b->file);
}

static bool collect(const imp_registry *registry, type_list *list)
{
    imp_type_info info;
    for (list->count = 0; imp_registry_type(registry, list->count, &info);) ++list->count;
    list->types = calloc(list->count + 1, sizeof *list->types);
    if (list->types == NULL) return false;
    for (size_t i = 0; i < list->count; ++i) imp_registry_type(registry, i, &list->types[i]);
    qsort(list->types, list->count, sizeof *list->types, compare);
    return true;
}

static size_t refusal_count(const imp_registry *registry)
{
    imp_plugin_refusal refusal;
    size_t count = 0;
    while (imp_registry_refusal(registry, count, &refusal)) ++count;
    return count;
}

/* --- For people ------------------------------------------------------------------------------- */

static int longer(int width, const char *text)
{
    const int length = (int)strlen(text);
    return length > width ? length : width;
}

enum { SCREEN = 80 }; /* columns */

/* Prints the text from column `indent` on, wrapped at blanks before the last column. */
static void print_wrapped(const char *text, int indent)
{
    while ((int)strlen(text) > SCREEN - 1 - indent) {
        int length = SCREEN - 1 - indent;
        while (length > 0 && text[length] != ' ') --length;
        if (length == 0) break;
        printf("%.*s\n%*s", length, text, indent, "");
        text += length + 1;
    }
    puts(text);
}

static void print_types(const type_list *list, bool files)
{
    int name = 0;
    for (size_t i = 0; i < list->count; ++i) name = longer(name, list->types[i].name);
    for (size_t i = 0; i < list->count; ++i) {
        const imp_type_info *t = &list->types[i];
        printf("%-7s  %s%-*s%s  ", catalogue_kind_name(t->kind), output_colour(OUTPUT_BOLD), name,
               t->name, output_colour(OUTPUT_PLAIN));
        if (files)
            puts(message_shown(t->file).text);
        else
            print_wrapped(t->summary, 7 + 2 + name + 2);
        if (t->shadowed_by != NULL)
            printf("%-7s  shadowed by %s\n", "", message_shown(t->shadowed_by).text);
    }
}

static void print_count(const char *before, size_t n, const char *one, const char *many)
{
    printf("%s%zu %s", before, n, n == 1 ? one : many);
}

static void print_totals(const type_list *list, size_t refused)
{
    size_t surfaces = 0, maps = 0, shadowed = 0;
    for (size_t i = 0; i < list->count; ++i) {
        if (list->types[i].shadowed_by != NULL)
            ++shadowed;
        else if (list->types[i].kind == IMP_TYPE_SURFACE)
            ++surfaces;
        else
            ++maps;
    }
    print_count(list->count > 0 ? "\n" : "", surfaces, "surface type", "surface types");
    print_count(", ", maps, "map", "maps");
    if (shadowed > 0) print_count(", ", shadowed, "shadowed", "shadowed");
    puts(".");
    if (list->count == 0) puts("`impinge help list` says where plugins are searched for.");
    if (refused == 0) return;
    print_count("", refused, "file or directory was", "files or directories were");
    puts(" rejected; `impinge list --refused` shows why.");
}

static void print_refusals(const imp_registry *registry)
{
    imp_plugin_refusal refusal;
    for (size_t i = 0; imp_registry_refusal(registry, i, &refusal); ++i)
        printf("%s: %s\n", message_shown(refusal.file).text, message_shown(refusal.reason).text);
    if (refusal_count(registry) == 0) puts("Nothing was rejected.");
}

/* --- For programs ----------------------------------------------------------------------------- */

static json_t *types_json(const type_list *list)
{
    json_t *types = json_array();
    for (size_t i = 0; i < list->count; ++i)
        if (json_array_append_new(types, catalogue_short_json(&list->types[i])) != 0) {
            json_decref(types);
            return NULL;
        }
    return types;
}

/* Lists refusals or warnings, which `next` returns one by one. */
static json_t *remarks_json(const imp_registry *registry,
                            bool (*next)(const imp_registry *, size_t, imp_plugin_refusal *))
{
    json_t *remarks = json_array();
    imp_plugin_refusal remark;
    for (size_t i = 0; next(registry, i, &remark); ++i)
        if (json_array_append_new(remarks,
                                  json_pack("{s:o, s:o}", "file", output_json_text(remark.file),
                                            "reason", output_json_text(remark.reason))) != 0) {
            json_decref(remarks);
            return NULL;
        }
    return remarks;
}

static exit_status print(const imp_registry *registry, const type_list *list, const arguments *args)
{
    if (arguments_option(args, "json") != NULL)
        return output_json(json_pack("{s:o, s:o, s:o}", "types", types_json(list), "refused",
                                     remarks_json(registry, imp_registry_refusal), "warnings",
                                     remarks_json(registry, imp_registry_warning)),
                           args->verb->name);
    if (arguments_option(args, "refused") != NULL) {
        print_refusals(registry);
    } else {
        print_types(list, arguments_option(args, "files") != NULL);
        print_totals(list, refusal_count(registry));
    }
    return EXIT_ANSWERED;
}

static exit_status run(const arguments *args)
{
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    type_list list;
    const exit_status status = collect(registry, &list) ? print(registry, &list, args)
                                                        : complain_of_memory(args->verb->name);
    free(list.types);
    imp_registry_free(registry);
    return status;
}

static const option list_options[] = {
    {.name = "files", .help = "print the plugin file of each type in place of its summary"},
    {.name = "refused", .help = "print the files and directories that were rejected, and why"},
    {.name = NULL}};

static const option *const tables[] = {list_options, options_registry, options_always, NULL};

const verb verb_list = {
    .name = "list",
    .operands = "",
    .summary = "List the surface types and maps available",
    .details =
        "Prints each type's kind (surface or map), name and summary; with --files the plugin file\n"
        "it comes from. Of two types of one kind and name the first found is used; the other is "
        "shown\n"
        "as shadowed. Plugins are looked for in this order: --plugin-path, the environment's\n"
        "IMPINGE_PLUGIN_PATH, the user's plugin directory, the installed one.\n",
    .example = "impinge list",
    .options = tables,
    .run = run};

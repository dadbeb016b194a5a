/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/run_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/verbs.h"

/* Whether the option changes decided results: limits and options of output or threads do not. */
static bool changes_questions(const char *name)
{
    static const char *const others[] = {"audit",       "boxes",     "exit-code",   "isolate",
                                         "json",        "max-boxes", "max-bytes",   "max-pairs",
                                         "max-seconds", "no-color",  "plugin-path", "progress",
                                         "resume",      "secure",    "threads"};
    for (size_t k = 0; k < sizeof others / sizeof *others; ++k)
        if (strcmp(others[k], name) == 0) return false;
    return true;
}

/* Returns value number k as it was written, behind the earlier ones of an option that adds up. */
static json_t *text_json(const arguments *args, size_t k)
{
    const option_value *value = &args->values[k];
    char *all = NULL;
    size_t size, count = 0;
    if (strcmp(value->row->name, "parameter") != 0)
        return output_json_text(value->text != NULL ? value->text : "");
    FILE *to = open_memstream(&all, &size);
    if (to == NULL) return NULL;
    for (size_t i = 0; i <= k; ++i)
        if (args->values[i].row == value->row)
            fprintf(to, "%s%s", count++ > 0 ? " " : "", args->values[i].text);
    json_t *json = fclose(to) == 0 ? output_json_text(all) : NULL;
    free(all);
    return json;
}

json_t *run_options_json(const arguments *args)
{
    json_t *options = json_object();
    for (size_t k = 0; k < args->value_count; ++k) {
        const option_value *value = &args->values[k];
        if (changes_questions(value->row->name))
            json_object_set_new(options, value->row->name, text_json(args, k));
    }
    return json_pack("{s:o}", "options", options);
}

/* --- Comparison with the present options ------------------------------------------------------ */

/* Complains of an option that was given with another value, or in only one of the two runs. */
static exit_status complain_of_option(const run_options_source *of, const char *name,
                                      const json_t *then, const json_t *now, const char *speaker)
{
    static const char cure[] = "give the same options, or name a new file";
    if (then == NULL)
        return complain(EXIT_DATA, speaker,
                        "%s: its answers were made without --%s, this run has --%s %s (%s); %s",
                        of->file, name, name, json_string_value(now), of->record, cure);
    if (now == NULL)
        return complain(EXIT_DATA, speaker,
                        "%s: its answers were made with --%s %s, this run has none (%s); %s",
                        of->file, name, json_string_value(then), of->record, cure);
    return complain(
        EXIT_DATA, speaker, "%s: its answers were made with --%s %s, this run has --%s %s (%s); %s",
        of->file, name, json_string_value(then), name, json_string_value(now), of->record, cure);
}

/* Returns the first option of `x` that `y` lacks or has with another value; NULL: there is none. */
static const char *first_other(json_t *x, const json_t *y)
{
    const char *name;
    json_t *value;
    json_object_foreach(x, name,
                        value) if (!json_equal(value, json_object_get(y, name))) return name;
    return NULL;
}

exit_status run_options_compare(const run_options_source *of, json_t *then, json_t *now,
                                const arguments *args)
{
    const char *name = first_other(then, now);
    if (name == NULL) name = first_other(now, then);
    if (name == NULL) return EXIT_ANSWERED;
    return complain_of_option(of, name, json_object_get(then, name), json_object_get(now, name),
                              args->verb->name);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/badge.h"

#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/output_file.h"

/* Labels and their colours, the worst first. */
static const char *const labels[][2] = {
    {"failed", "red"}, {"refuted", "red"}, {"tested", "green"}, {"proved", "brightgreen"}};
enum { LABELS = sizeof labels / sizeof *labels };

static int rank_of(const char *label)
{
    for (int k = 0; k < LABELS; ++k)
        if (label != NULL && strcmp(labels[k][0], label) == 0) return k;
    return 0;
}

static const char *text_at(const json_t *object, const char *key)
{
    return json_string_value(json_object_get(object, key));
}

static int rank_of_report(const json_t *report)
{
    const json_t *types = json_object_get(report, "types");
    const char *verdict = text_at(report, "verdict");
    int least = LABELS;
    for (size_t k = 0; k < json_array_size(types); ++k) {
        const int rank = rank_of(text_at(json_array_get(types, k), "label"));
        if (rank < least) least = rank;
    }
    const bool is_sound = verdict != NULL && strcmp(verdict, "pass") == 0 && least < LABELS;
    return is_sound || least == rank_of("refuted") ? least : 0;
}

const char *badge_label(const json_t *report) { return labels[rank_of_report(report)][0]; }

/* Returns the verdicts by the checks' names. */
static json_t *verdicts_json(const json_t *checks)
{
    json_t *verdicts = json_object();
    for (size_t k = 0; k < json_array_size(checks); ++k) {
        const json_t *check = json_array_get(checks, k);
        json_object_set(verdicts, text_at(check, "name"), json_object_get(check, "verdict"));
    }
    return verdicts;
}

static json_t *type_json(const json_t *type)
{
    static const char *const kept[] = {"kind", "name", "label", "tests", "proof", "tightness"};
    json_t *object = json_object();
    for (size_t k = 0; k < sizeof kept / sizeof *kept; ++k) {
        json_t *value = json_object_get(type, kept[k]);
        if (value != NULL) json_object_set(object, kept[k], value);
    }
    json_object_set_new(object, "checks", verdicts_json(json_object_get(type, "checks")));
    return object;
}

static json_t *badge_json(const json_t *report, const badge_facts *facts)
{
    const int rank = rank_of_report(report);
    json_t *types = json_array();
    const json_t *all = json_object_get(report, "types");
    for (size_t k = 0; k < json_array_size(all); ++k)
        json_array_append_new(types, type_json(json_array_get(all, k)));
    return json_pack("{s:i, s:s, s:s, s:s, s:s, s:{s:i, s:i}, s:o, s:o, s:o, s:O, s:O, s:s, s:o, "
                     "s:o}",
                     "schemaVersion", 1, "label", "impinge", "message", labels[rank][0], "color",
                     labels[rank][1], "impinge", PACKAGE_VERSION, "abi", "major", IMP_ABI_MAJOR,
                     "minor", IMP_ABI_MINOR, "plugin", output_json_text(facts->plugin), "version",
                     output_json_text(facts->version), "formula", output_json_text(facts->formula),
                     "seed", json_object_get(report, "seed"), "effort",
                     json_object_get(report, "effort"), "verdict", text_at(report, "verdict"),
                     "checks", verdicts_json(json_object_get(report, "checks")), "types", types);
}

exit_status badge_write(const char *path, const json_t *report, const badge_facts *facts,
                        const char *verb)
{
    output_file out;
    char *line = output_json_line(badge_json(report, facts));
    if (line == NULL) return complain_of_memory(verb);
    exit_status status = output_file_begin(&out, path, verb);
    if (status == EXIT_ANSWERED) {
        const bool written = fprintf(out.file, "%s\n", line) > 0;
        status = output_file_end(&out, written);
    }
    free(line);
    return status;
}

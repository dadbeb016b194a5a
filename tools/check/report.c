/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/report.h"

#include <stdio.h>
#include <string.h>

#include "tools/cli/catalogue.h"
#include "tools/cli/output.h"

static const char *verdict_name(check_verdict verdict)
{
    static const char *const names[] = {
        [CHECK_PASS] = "pass", [CHECK_FAIL] = "fail", [CHECK_SKIP] = "skip", [CHECK_NOTE] = "note"};
    return names[verdict];
}

/* Texts of plugins may have several lines. */
static void print_line(const char *before, const char *between, const char *text)
{
    printf("%s%s%s\n", before, between, message_shown(text).text);
}

bool report_begin(check_report *r, const char *file, double effort)
{
    if (!r->as_json) {
        print_line("", "", file);
        return true;
    }
    r->types = json_array();
    r->checks = json_array();
    r->root =
        json_pack("{s:o, s:I, s:f, s:O, s:O}", "file", output_json_text(file), "seed",
                  (json_int_t)r->seed, "effort", effort, "checks", r->checks, "types", r->types);
    return r->root != NULL;
}

void report_type(check_report *r, imp_type_kind kind, const char *name,
                 const char *const stage[CHECK_STAGES])
{
    r->type_failed = r->type_refuted = false;
    r->type_faults = 0;
    r->type_echoes[0] = '\0';
    r->type_tests = 0;
    r->type_proof = (check_proof){.claims = 0};
    if (!r->as_json) {
        print_line(catalogue_kind_name(kind), " ", name);
        for (int k = 0; k < CHECK_STAGES && stage[k] != NULL; ++k)
            print_line("  as: ", "", stage[k]);
        return;
    }
    json_t *stages = json_array();
    for (int k = 0; k < CHECK_STAGES && stage[k] != NULL; ++k)
        json_array_append_new(stages, output_json_text(stage[k]));
    json_decref(r->checks);
    r->checks = json_array();
    r->type = json_pack("{s:s, s:o, s:o, s:O}", "kind", catalogue_kind_name(kind), "name",
                        output_json_text(name), "stages", stages, "checks", r->checks);
    json_array_append_new(r->types, r->type);
}

/* --- One check ---------------------------------------------------------------------- */

static json_t *ratios_json(const double ratio[CHECK_SCALES])
{
    json_t *array = json_array();
    for (int k = 0; k < CHECK_SCALES; ++k)
        json_array_append_new(array, output_json_number(ratio[k]));
    return array;
}

/* Measurements belong to the type. */
static void add_measures(check_report *r, const char *check, const check_answer *a)
{
    if (a->verdict != CHECK_PASS) return;
    if (strcmp(check, "tightness") == 0)
        json_object_set_new(r->type, check,
                            json_pack("{s:o, s:o}", "rates", ratios_json(a->rate_ratio), "ranges",
                                      ratios_json(a->range_ratio)));
    if (a->proof.claims > 0)
        json_object_set_new(r->type, check,
                            json_pack("{s:I, s:I, s:I, s:I}", "claims", (json_int_t)a->proof.claims,
                                      "proved", (json_int_t)a->proof.proved, "regions",
                                      (json_int_t)a->proof.regions, "boxes",
                                      (json_int_t)a->proof.boxes));
    if (strcmp(check, "cost") == 0)
        json_object_set_new(
            r->type, check,
            json_pack("{s:o, s:o, s:o, s:[o, o]}", "eval_ns", output_json_number(a->eval_ns),
                      "rate_ns", output_json_number(a->rate_ns), "include_ns",
                      output_json_number(a->include_ns), "pairs", output_json_number(a->pairs[0]),
                      output_json_number(a->pairs[1])));
}

/* Was it reported before? Records the possible causes, and the checks that fail for a known one. */
static bool is_echo(check_report *r, const char *check, const check_answer *a)
{
    const size_t used = strlen(r->type_echoes);
    if (a->verdict != CHECK_FAIL) return false;
    const bool told = (a->faults & r->type_faults) != 0;
    r->type_faults |= a->faults;
    if (told)
        snprintf(r->type_echoes + used, sizeof r->type_echoes - used, "%s%s", used > 0 ? ", " : "",
                 check);
    return told;
}

static void add_json(check_report *r, const char *check, const check_answer *a, const char *again,
                     bool echo)
{
    json_t *object =
        json_pack("{s:s, s:s, s:o, s:I}", "name", check, "verdict", verdict_name(a->verdict),
                  "text", output_json_text(a->text), "tests", (json_int_t)a->tests);
    if (a->verdict == CHECK_FAIL) json_object_set_new(object, "replay", output_json_text(again));
    if (a->verdict == CHECK_FAIL) json_object_set_new(object, "told_before", json_boolean(echo));
    json_array_append_new(r->checks, object);
    if (r->type != NULL) add_measures(r, check, a);
}

void report_add(check_report *r, const char *check, bool of_bounds, const check_answer *a)
{
    char again[2048];
    const bool alone = strcmp(check, "load") != 0;
    snprintf(again, sizeof again, "%s%s%s", r->again, alone ? " --only " : "", alone ? check : "");
    r->verdicts[a->verdict] += 1;
    if (a->proof.claims > 0)
        r->type_proof = a->proof;
    else if (of_bounds)
        r->type_tests += a->tests;
    if (a->verdict == CHECK_FAIL)
        *(of_bounds && a->tests > 0 ? &r->type_refuted : &r->type_failed) = true;
    const bool echo = is_echo(r, check, a);
    if (r->as_json) {
        add_json(r, check, a, again, echo);
        return;
    }
    if (echo) return;
    char label[40];
    snprintf(label, sizeof label, "  %s  %-12s",
             a->verdict == CHECK_FAIL ? "FAIL" : verdict_name(a->verdict), check);
    print_line(label, " ", a->text);
    if (a->verdict == CHECK_FAIL) print_line("        again: ", "", again);
}

/* --- Totals ------------------------------------------------------------------------- */

static const char *type_label(const check_report *r)
{
    const check_proof *p = &r->type_proof;
    if (r->type_refuted) return "refuted";
    if (r->type_failed) return "failed";
    return p->claims > 0 && p->proved == p->claims ? "proved" : "tested";
}

void report_type_end(check_report *r)
{
    const char *label = type_label(r);
    const unsigned long long seed = r->seed;
    if (r->as_json) {
        json_object_set_new(r->type, "label", json_string(label));
        json_object_set_new(r->type, "tests", json_integer((json_int_t)r->type_tests));
        r->type = NULL;
        return;
    }
    if (r->type_echoes[0] != '\0')
        printf("  FAIL  also %s, possibly for the same reason; --only NAME shows each\n",
               r->type_echoes);
    if (strcmp(label, "proved") == 0)
        printf("  proved(%llu, %llu): claims, seed\n", (unsigned long long)r->type_proof.claims,
               seed);
    if (strcmp(label, "proved") == 0 && r->type_tests == 0) return;
    if (strcmp(label, "proved") == 0 || strcmp(label, "tested") == 0)
        printf("  tested(%llu, %llu): comparisons, seed\n", (unsigned long long)r->type_tests,
               seed);
    else
        printf("  %s\n", label);
}

exit_status report_end(check_report *r, const char *verb)
{
    const exit_status found = r->verdicts[CHECK_FAIL] > 0 ? EXIT_CONFORMANCE : EXIT_ANSWERED;
    if (!r->as_json) {
        printf("%zu passed, %zu failed, %zu skipped", r->verdicts[CHECK_PASS],
               r->verdicts[CHECK_FAIL], r->verdicts[CHECK_SKIP]);
        if (r->verdicts[CHECK_NOTE] > 0) printf(", %zu noted", r->verdicts[CHECK_NOTE]);
        putchar('\n');
        return found;
    }
    json_object_set_new(r->root, "verdict",
                        json_string(r->verdicts[CHECK_FAIL] > 0 ? "fail" : "pass"));
    json_decref(r->checks);
    json_decref(r->types);
    const exit_status written = output_json(r->root, verb);
    return written != EXIT_ANSWERED ? written : found;
}

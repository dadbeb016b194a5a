/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/report.h"

#include <stdio.h>
#include <string.h>

#include "tools/cli/catalogue.h"
#include "tools/cli/output.h"

enum { SAID_LINES = 12 };

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
    if (!r->as_json) print_line("", "", file);
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

/* --- One check -------------------------------------------------------------------------------- */

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
                            json_pack("{s:o, s:o, s:o, s:o}", "rates", ratios_json(a->rate_ratio),
                                      "ranges", ratios_json(a->range_ratio), "remainders",
                                      ratios_json(a->remainder_ratio), "distances",
                                      output_json_number(a->distance_ratio)));
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

/* What the plugin wrote to standard error. */
static void print_said(const char *said)
{
    char line[400];
    for (int k = 0; k < SAID_LINES && *said != '\0'; ++k) {
        const size_t length = strcspn(said, "\n");
        snprintf(line, sizeof line, "%.*s", length < 399 ? (int)length : 399, said);
        print_line("        said: ", "", line);
        said += said[length] == '\n' ? length + 1 : length;
    }
    if (*said != '\0') puts("        said: ... (--in-process shows all)");
}

/* The command that repeats a check, and that which stops in a debugger before the call at fault. */
typedef struct commands {
    char again[2048], debug[2200];
} commands;

static commands commands_of(const check_report *r, const char *check, const check_answer *a)
{
    commands c = {"", ""};
    const bool alone = strcmp(check, "load") != 0 && strcmp(check, "example") != 0;
    snprintf(c.again, sizeof c.again, "%s%s%s", r->again, alone ? " --only " : "",
             alone ? check : "");
    if (a->blamed > 0)
        snprintf(c.debug, sizeof c.debug, "gdb -ex run --args %s --call %llu", c.again,
                 (unsigned long long)a->blamed);
    return c;
}

static void note_spoke(check_report *r, const char *check)
{
    const size_t used = strlen(r->spoke);
    snprintf(r->spoke + used, sizeof r->spoke - used, "%s%s", used > 0 ? ", " : "", check);
}

static void add_json(check_report *r, const char *check, const check_answer *a, const commands *c,
                     bool echo)
{
    json_t *object =
        json_pack("{s:s, s:s, s:o, s:I}", "name", check, "verdict", verdict_name(a->verdict),
                  "text", output_json_text(a->text), "tests", (json_int_t)a->tests);
    if (a->verdict == CHECK_FAIL) json_object_set_new(object, "replay", output_json_text(c->again));
    if (a->verdict == CHECK_FAIL && c->debug[0] != '\0')
        json_object_set_new(object, "debug", output_json_text(c->debug));
    if (a->said[0] != '\0') json_object_set_new(object, "stderr", output_json_text(a->said));
    if (a->verdict == CHECK_FAIL) json_object_set_new(object, "told_before", json_boolean(echo));
    json_array_append_new(r->checks, object);
    if (r->type != NULL) add_measures(r, check, a);
}

void report_add(check_report *r, const char *check, bool of_bounds, const check_answer *a)
{
    const commands c = commands_of(r, check, a);
    r->verdicts[a->verdict] += 1;
    if (a->proof.claims > 0)
        r->type_proof = a->proof;
    else if (of_bounds)
        r->type_tests += a->tests;
    if (a->verdict == CHECK_FAIL)
        *(of_bounds && a->tests > 0 ? &r->type_refuted : &r->type_failed) = true;
    const bool echo = is_echo(r, check, a);
    add_json(r, check, a, &c, echo);
    if (r->as_json) return;
    if (a->said[0] != '\0' && (echo || a->verdict != CHECK_FAIL)) note_spoke(r, check);
    if (echo) return;
    char label[40];
    snprintf(label, sizeof label, "  %s  %-12s",
             a->verdict == CHECK_FAIL ? "FAIL" : verdict_name(a->verdict), check);
    print_line(label, " ", a->text);
    if (a->verdict != CHECK_FAIL) return;
    print_said(a->said);
    print_line("        again: ", "", c.again);
    if (c.debug[0] != '\0') print_line("        debug: ", "", c.debug);
}

/* --- Totals ----------------------------------------------------------------------------------- */

static const char *type_label(const check_report *r)
{
    const check_proof *p = &r->type_proof;
    if (r->type_refuted) return "refuted";
    if (r->type_failed) return "failed";
    return p->claims > 0 && p->proved == p->claims ? "proved" : "tested";
}

static void tell_spoke(check_report *r)
{
    if (r->spoke[0] != '\0' && !r->as_json)
        printf("  note  standard error was written to in %s; --in-process shows it\n", r->spoke);
    r->spoke[0] = '\0';
}

void report_type_end(check_report *r)
{
    tell_spoke(r);
    const char *label = type_label(r);
    const unsigned long long seed = r->seed;
    json_object_set_new(r->type, "label", json_string(label));
    json_object_set_new(r->type, "tests", json_integer((json_int_t)r->type_tests));
    r->type = NULL;
    if (r->as_json) return;
    if (r->type_echoes[0] != '\0')
        printf("  FAIL  also %s, possibly for the same reason; --only NAME shows each\n",
               r->type_echoes);
    if (strcmp(label, "proved") == 0)
        printf("  proved(%llu, %llu): claims, seed\n", (unsigned long long)r->type_proof.claims,
               seed);
    const bool stands = strcmp(label, "proved") == 0 || strcmp(label, "tested") == 0;
    if (stands && r->type_tests == 0) return; /* what --only left out */
    if (stands)
        printf("  tested(%llu, %llu): comparisons, seed\n", (unsigned long long)r->type_tests,
               seed);
    else
        printf("  %s\n", label);
}

exit_status report_end(check_report *r, const char *verb)
{
    const exit_status found = r->verdicts[CHECK_FAIL] > 0 ? EXIT_CONFORMANCE : EXIT_ANSWERED;
    json_object_set_new(r->root, "verdict",
                        json_string(r->verdicts[CHECK_FAIL] > 0 ? "fail" : "pass"));
    json_decref(r->checks);
    json_decref(r->types);
    if (!r->as_json) {
        printf("%zu passed, %zu failed, %zu skipped", r->verdicts[CHECK_PASS],
               r->verdicts[CHECK_FAIL], r->verdicts[CHECK_SKIP]);
        if (r->verdicts[CHECK_NOTE] > 0) printf(", %zu noted", r->verdicts[CHECK_NOTE]);
        putchar('\n');
        return found;
    }
    const exit_status written = output_json(json_incref(r->root), verb);
    return written != EXIT_ANSWERED ? written : found;
}

void report_free(check_report *r)
{
    json_decref(r->root);
    r->root = NULL;
}

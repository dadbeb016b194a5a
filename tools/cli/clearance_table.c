/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/clearance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/result.h"

imp_clearance clearance_table_get(const clearance_table *table, size_t k)
{
    if (table->answers != NULL) return table->answers[k];
    if (table->has_rest && k + 1 == table->count) return table->rest;
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    imp_clearance_get(table->query, k, &answer, NULL);
    if (answer.reason == IMP_REASON_RUNNING) answer.reason = table->ended;
    return answer;
}

/* --- Pairs of bodies -------------------------------------------------------------------------- */

static int by_proof(const void *x, const void *y)
{
    const imp_clearance *a = x, *b = y;
    if (a->lower != b->lower) return a->lower < b->lower ? -1 : 1;
    if (a->body[0] != b->body[0]) return a->body[0] < b->body[0] ? -1 : 1;
    return a->body[1] < b->body[1] ? -1 : a->body[1] > b->body[1];
}

void clearance_sort(imp_clearance *answers, size_t count)
{
    if (count > 0) qsort(answers, count, sizeof *answers, by_proof);
}

/* Whether the search for the nearest distance of some two bodies ended before it was found. */
static bool is_any_open(const clearance_table *table)
{
    for (size_t k = 0; k < table->count; ++k)
        if (table->answers[k].reason == IMP_REASON_DECIDED ||
            clearance_is_ended(table->answers[k].reason))
            return true;
    return false;
}

enum { VERDICT_WIDTH = 64 };

static void format_verdict(const imp_clearance *r, char text[VERDICT_WIDTH])
{
    if (isnan(r->t_violated))
        snprintf(text, VERDICT_WIDTH, "%s", clearance_verdict_name(r->verdict));
    else
        snprintf(text, VERDICT_WIDTH, "violated from t = %s",
                 output_number_lower(r->t_violated).text);
}

static int verdict_width(const clearance_table *table)
{
    char text[VERDICT_WIDTH];
    int width = 8;
    for (size_t k = 0; k < table->count; ++k) {
        format_verdict(&table->answers[k], text);
        if ((int)strlen(text) > width) width = (int)strlen(text);
    }
    return width;
}

/* Prints advice about the first pairs that have some, and how many more have. */
static void print_advice(const clearance_table *table)
{
    enum { ADVICE_PRINTED = 8 };
    size_t printed = 0;
    for (size_t k = 0; k < table->count && printed < ADVICE_PRINTED; ++k) {
        const imp_clearance *r = &table->answers[k];
        const char *advice = clearance_table_advice(table, r);
        if (advice == NULL) continue;
        result_print_label("advice");
        printf("%s, %s: %s\n", imp_scene_body_name(table->scene, r->body[0]),
               imp_scene_body_name(table->scene, r->body[1]), advice);
        printed += 1;
    }
    if (printed < table->advice_count)
        printf("           and about %zu more pairs of bodies (--json)\n",
               table->advice_count - printed);
}

/* Columns are padded to the widest text in them; without a requirement there is no verdict. */
void clearance_print_pairs(const clearance_table *table)
{
    const char *nearest = is_any_open(table) ? "nearest found so far" : "nearest";
    const bool is_required = table->answers[0].verdict != IMP_REQUIREMENT_NONE;
    const int width = is_required ? verdict_width(table) : 0;
    const int gap = (int)strlen(nearest) > 17 ? (int)strlen(nearest) : 17;
    printf("%-17s  %-*s  %-12s  ", "never nearer than", gap, nearest, "at t");
    if (is_required) printf("%-*s  ", width, "verdict");
    puts("bodies");
    for (size_t k = 0; k < table->count; ++k) {
        const imp_clearance *r = &table->answers[k];
        char text[VERDICT_WIDTH] = "-";
        if (r->has_witness) snprintf(text, sizeof text, "%.6g", r->t);
        printf("%-17s  %-*s  %-12s  ", output_number_lower(r->lower).text, gap,
               output_number_upper(r->upper).text, text);
        if (is_required) format_verdict(r, text);
        if (is_required) printf("%-*s  ", width, text);
        printf("%s, %s", imp_scene_body_name(table->scene, r->body[0]),
               imp_scene_body_name(table->scene, r->body[1]));
        if (table->survey != NULL)
            survey_parts_print_values(table->survey, survey_parts_find(table->survey, r->body));
        putchar('\n');
    }
    print_advice(table);
}

/* Prints the number, or an empty field for NaN. */
static void print_field(double number)
{
    if (isfinite(number)) printf("%s", output_number_exact(number).text);
    putchar(',');
}

/* Prints a name behind `before`, which needs no quotes, as RFC 4180 says: quoted if it contains a
 * comma, a quote or a line break; quotes are doubled. */
static void print_name(const char *before, const char *name)
{
    putchar(',');
    if (strpbrk(name, ",\"\r\n") == NULL) {
        printf("%s%s", before, name);
        return;
    }
    printf("\"%s", before);
    for (; *name != '\0'; ++name) {
        if (*name == '"') putchar('"');
        putchar(*name);
    }
    putchar('"');
}

static bool is_over_parameter(const clearance_table *table)
{
    return table->survey != NULL && table->survey->over != SIZE_MAX;
}

/* A column for the value of each parameter comes last: "at NAME", since names may be those of
 * other columns. */
void clearance_print_csv_head(const clearance_table *table)
{
    imp_scene_parameter_info info;
    printf("%s,lower,upper,t,verdict,a,b", is_over_parameter(table) ? "from,to" : "t0,t1");
    for (size_t j = 0; table->survey != NULL && imp_scene_parameter(table->scene, j, &info); ++j)
        print_name("at ", info.name);
    putchar('\n');
}

static void print_csv_values(const clearance_table *table, size_t k, bool has_witness)
{
    const size_t count = imp_scene_parameter_count(table->scene);
    for (size_t j = 0; table->survey != NULL && j < count; ++j)
        printf(",%s",
               has_witness ? output_number_exact(table->survey->answers[k].numbers[j]).text : "");
}

void clearance_print_csv(const clearance_table *table, size_t at, const imp_clearance *r)
{
    const imp_scene *scene = table->scene;
    double field[] = {r->t_start, r->t_end, r->lower, r->upper, r->t};
    if (is_over_parameter(table)) {
        const value_range slice = survey_parts_slice(table->survey, at);
        field[0] = slice.lo, field[1] = slice.hi;
    }
    for (int k = 0; k < 5; ++k) print_field(field[k]);
    const char *verdict = clearance_verdict_name(r->verdict);
    fputs(verdict != NULL ? verdict : "", stdout);
    print_name("", r->has_witness ? imp_scene_body_name(scene, r->a.body) : "");
    print_name("", r->has_witness ? imp_scene_body_name(scene, r->b.body) : "");
    print_csv_values(table, at, r->has_witness);
    putchar('\n');
}

/* --- All in one ------------------------------------------------------------------------------- */

static imp_requirement worse(imp_requirement x, imp_requirement y)
{
    if (x == IMP_REQUIREMENT_VIOLATED || y == IMP_REQUIREMENT_VIOLATED)
        return IMP_REQUIREMENT_VIOLATED;
    return x == IMP_REQUIREMENT_UNDECIDED ? x : y;
}

/* Orders reasons; the greatest of all parts is the combined reason: ended early, then a verdict
 * alone, then a bracket. */
static int weight(imp_reason reason)
{
    if (clearance_is_ended(reason)) return 3;
    if (reason == IMP_REASON_DECIDED) return 2;
    return reason == IMP_REASON_NONE ? 1 : 0;
}

/* Lemma. The least of the parts' lower bounds, and any part's upper bound, are bounds for all parts
 * together. */
static imp_clearance join_brackets(const clearance_table *table)
{
    imp_clearance all = clearance_table_get(table, 0);
    for (size_t k = 1; k < table->count; ++k) {
        const imp_clearance r = clearance_table_get(table, k);
        const imp_requirement verdict = worse(all.verdict, r.verdict);
        const imp_reason reason = weight(all.reason) < weight(r.reason) ? r.reason : all.reason;
        const double lower = r.lower < all.lower ? r.lower : all.lower;
        if (r.upper < all.upper) all = r;
        all.verdict = verdict;
        all.reason = reason;
        all.lower = lower;
    }
    return all;
}

/* Whether an answer without a known first violation may have one before time t. */
static bool may_be_violated_before(const imp_clearance *r, double t)
{
    const bool holds = r->verdict == IMP_REQUIREMENT_HOLDS;
    return !holds && isnan(r->t_violated) && r->t_start < t;
}

/* Lemma. The earliest known violation is the first of all unless an undecided answer begins before
 * it. */
static bool first_violation(const clearance_table *table, imp_clearance *first)
{
    bool found = false;
    for (size_t k = 0; k < table->count; ++k) {
        const imp_clearance r = clearance_table_get(table, k);
        if (isnan(r.t_violated)) continue;
        if (!found || r.t_violated < first->t_violated) *first = r;
        found = true;
    }
    for (size_t k = 0; found && k < table->count; ++k) {
        const imp_clearance r = clearance_table_get(table, k);
        found = !may_be_violated_before(&r, first->t_violated);
    }
    return found;
}

imp_clearance clearance_summary(const clearance_table *table)
{
    imp_clearance all = join_brackets(table), first = all;
    all.t_start = clearance_table_get(table, 0).t_start;
    all.t_end = clearance_table_get(table, table->count - 1).t_end;
    all.body[0] = all.body[1] = SIZE_MAX;
    all.t_violated = NAN;
    if (!first_violation(table, &first)) return all;
    all.t_violated = first.t_violated;
    all.gap_violated = first.gap_violated;
    all.a_violated = first.a_violated;
    all.b_violated = first.b_violated;
    return all;
}

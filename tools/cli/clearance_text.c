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

/* What is printed:
 *
 *   holds, tightest 2.3117 at t = 0.4203 between "link5" and "fixture"
 *     proved   never nearer than 2.3094
 *     required 2
 *     a        surface 0 of "link5"    u 1.5         v 0.25   at (1, 0, 0)
 *     b        surface 0 of "fixture"  u 3.14159265  v 1.5    at (1.00009, 0, 0)
 *     normal   (1, 0, 0), from a to b
 *     cost     123 pairs, ...
 *
 * If the search ended with the verdict, the first line has only that, and the two points one line:
 *
 *     seen     32.4 apart at t = 0.5, "link1" and "fixture"; --tolerance finds the tightest
 */

static const char *name_of(const imp_scene *scene, size_t body)
{
    return imp_scene_body_name(scene, body);
}

static bool is_ended(imp_reason reason)
{
    return reason != IMP_REASON_NONE && reason != IMP_REASON_DECIDED &&
           result_reason_of_none(reason) == NULL;
}

static bool is_decided_only(const imp_clearance *r) { return r->reason == IMP_REASON_DECIDED; }

static void print_first_line(const imp_scene *scene, const imp_clearance *r)
{
    const char *verdict = clearance_verdict_name(r->verdict);
    if (verdict != NULL) fputs(verdict, stdout);
    if (!isnan(r->t_violated)) printf(" at t = %s", output_number_lower(r->t_violated).text);
    if (verdict != NULL && !is_decided_only(r)) fputs(", ", stdout);
    if (is_decided_only(r)) {
        putchar('\n');
    } else if (!r->has_witness && r->upper < INFINITY) {
        puts("nothing measured yet");
    } else if (!r->has_witness) {
        const char *why = result_reason_of_none(r->reason);
        puts(why != NULL ? why : result_excuse(r->reason).why);
    } else {
        printf("tightest %s%s at t = %.10g between \"%s\" and \"%s\"\n",
               is_ended(r->reason) ? "so far " : "", output_number_upper(r->upper).text, r->t,
               name_of(scene, r->a.body), name_of(scene, r->b.body));
    }
}

static void print_violation(const imp_scene *scene, const imp_clearance *r)
{
    if (isnan(r->t_violated)) return;
    result_print_label("violated");
    printf("first by \"%s\" and \"%s\", %s apart at t = %s\n", name_of(scene, r->a_violated.body),
           name_of(scene, r->b_violated.body), output_number_upper(r->gap_violated).text,
           output_number_lower(r->t_violated).text);
}

static void print_seen(const imp_scene *scene, const imp_clearance *r)
{
    if (!is_decided_only(r) || r->t == r->t_violated) return;
    result_print_label("seen");
    printf("%s apart at t = %.10g, \"%s\" and \"%s\"; --tolerance finds the tightest\n",
           output_number_upper(r->upper).text, r->t, name_of(scene, r->a.body),
           name_of(scene, r->b.body));
}

/* A larger gamma would not help. */
static excuse excuse_of(const imp_clearance *r)
{
    excuse e = result_excuse(r->reason);
    const bool bracket = r->verdict == IMP_REQUIREMENT_NONE;
    if (r->reason == IMP_REASON_PAIRS)
        e.cure = bracket ? "raise --max-pairs, or --tolerance" : "raise --max-pairs";
    if (r->reason == IMP_REASON_SECONDS)
        e.cure = bracket ? "raise --max-seconds, or --tolerance" : "raise --max-seconds";
    if (r->reason == IMP_REASON_MEMORY)
        e.cure = bracket ? "raise --max-bytes, or --tolerance" : "raise --max-bytes";
    if (r->reason == IMP_REASON_RESOLUTION)
        e = (excuse){"double precision resolves no more here",
                     bracket ? "raise --tolerance" : "require a little more or less"};
    return e;
}

void clearance_print(const imp_scene *scene, const imp_clearance *r)
{
    print_first_line(scene, r);
    if (r->lower < INFINITY) {
        result_print_label("proved");
        printf("never nearer than %s\n", output_number_lower(r->lower).text);
    }
    if (is_ended(r->reason)) {
        result_print_label("ended");
        const excuse e = excuse_of(r);
        printf("%s: %s\n", e.why, e.cure);
    }
    if (r->verdict != IMP_REQUIREMENT_NONE) {
        result_print_label("required");
        printf("%.10g\n", r->required);
    }
    print_violation(scene, r);
    print_seen(scene, r);
    if (r->has_witness) {
        result_print_sides(scene, &r->a, &r->b);
        result_print_normal(r->has_normal ? r->normal : NULL);
    }
    result_print_cost(&r->stats);
}

/* --- Tables --------------------------------------------------------------------------------- */

static int by_tightness(const void *x, const void *y)
{
    const imp_clearance *a = x, *b = y;
    if (a->upper != b->upper) return a->upper < b->upper ? -1 : 1;
    if (a->body[0] != b->body[0]) return a->body[0] < b->body[0] ? -1 : 1;
    return a->body[1] < b->body[1] ? -1 : a->body[1] > b->body[1];
}

void clearance_sort(imp_clearance *answers, size_t count)
{
    if (count > 0) qsort(answers, count, sizeof *answers, by_tightness);
}

void clearance_print_pairs(const clearance_table *table)
{
    printf("%-17s %-17s %-12s %-10s %s\n", "nearest", "proved", "at t", "required", "bodies");
    for (size_t k = 0; k < table->count; ++k) {
        const imp_clearance *r = &table->answers[k];
        const char *verdict = clearance_verdict_name(r->verdict);
        printf("%-17s %-17s ", output_number_upper(r->upper).text,
               output_number_lower(r->lower).text);
        if (r->has_witness)
            printf("%-12.6g", r->t);
        else
            printf("%-12s", "-");
        printf(" %-10s %s, %s\n", verdict != NULL ? verdict : "-",
               name_of(table->scene, r->body[0]), name_of(table->scene, r->body[1]));
    }
}

void clearance_print_csv_head(void) { puts("t0,t1,lower,upper,t,verdict"); }

/* An empty field for what is not there. */
static void print_field(double number)
{
    if (isfinite(number)) printf("%.17g", number);
    putchar(',');
}

void clearance_print_csv(const imp_clearance *r)
{
    const double field[] = {r->t_start, r->t_end, r->lower, r->upper, r->t};
    for (int k = 0; k < 5; ++k) print_field(field[k]);
    const char *verdict = clearance_verdict_name(r->verdict);
    puts(verdict != NULL ? verdict : "");
}

/* --- All in one ------------------------------------------------------------------------------- */

static imp_requirement worse(imp_requirement x, imp_requirement y)
{
    if (x == IMP_REQUIREMENT_VIOLATED || y == IMP_REQUIREMENT_VIOLATED)
        return IMP_REQUIREMENT_VIOLATED;
    return x == IMP_REQUIREMENT_UNDECIDED ? x : y;
}

/* The greatest weight counts for all parts: ended early, then a verdict alone, then a bracket. */
static int weight(imp_reason reason)
{
    if (is_ended(reason)) return 3;
    if (reason == IMP_REASON_DECIDED) return 2;
    return reason == IMP_REASON_NONE ? 1 : 0;
}

/* Lemma. What holds of each part holds of all: the least of the lower bounds, and any upper bound. */
imp_clearance clearance_summary(const clearance_table *table)
{
    imp_clearance all = table->answers[0];
    for (size_t k = 1; k < table->count; ++k) {
        const imp_clearance *r = &table->answers[k];
        const imp_requirement verdict = worse(all.verdict, r->verdict);
        const imp_reason reason = weight(all.reason) < weight(r->reason) ? r->reason : all.reason;
        const double lower = r->lower < all.lower ? r->lower : all.lower;
        if (r->upper < all.upper) all = *r;
        all.verdict = verdict;
        all.reason = reason;
        all.lower = lower;
    }
    all.t_start = table->answers[0].t_start;
    all.t_end = table->answers[table->count - 1].t_end;
    all.body[0] = all.body[1] = SIZE_MAX;
    return all;
}

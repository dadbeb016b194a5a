/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"
#include "tools/bench/kernel_time.h"

#include <math.h>
#include <stdio.h>

/* --- Numbers as words ------------------------------------------------------------------------- */

typedef struct cell {
    char text[40];
} cell;

static cell cell_count(double x, bool at_least)
{
    cell c;
    snprintf(c.text, sizeof c.text, "%s%.0f", at_least ? ">" : "", x);
    return c;
}

/* Three digits or so, and the unit; `units` are `step` apart, the first is that of x. */
static cell cell_unit(double x, double step, const char *const units[3], bool at_least)
{
    cell c;
    int unit = 0;
    for (; unit < 2 && x >= step; ++unit) x /= step;
    snprintf(c.text, sizeof c.text, "%s%.*f %s", at_least ? ">" : "",
             x < 10    ? 2
             : x < 100 ? 1
                       : 0,
             x, units[unit]);
    return c;
}

static cell cell_seconds(double seconds, bool at_least)
{
    static const char *const units[] = {"us", "ms", "s"};
    return cell_unit(1e6 * seconds, 1000, units, at_least);
}

static cell cell_bytes(double bytes)
{
    static const char *const units[] = {"K", "M", "G"};
    return cell_unit(bytes / 1024, 1024, units, false);
}

/* Returns how many times as much the baseline took; where a budget ended, only a bound is known. */
static cell cell_ratio(double x, const bench_tally *tally, double y, const bench_tally *baseline)
{
    cell c = {"-"};
    if ((tally->ended > 0 && baseline->ended > 0 && tally != baseline) || !(x > 0)) return c;
    const char *side = tally == baseline ? "" : baseline->ended > 0 ? ">" : "<";
    snprintf(c.text, sizeof c.text, "%s%.*f", tally->ended + baseline->ended > 0 ? side : "",
             y / x < 10 ? 2 : 0, y / x);
    return c;
}

/* --- Tables ----------------------------------------------------------------------------------- */

void bench_print_request(const bench_request *request)
{
    puts(
        "Means over the scenes of a case; greatest, heap and memory are the greatest of all. Times "
        "are\nthe processor's, for the search alone.");
    if (request->only) return;
    puts("ratio: how many times as many pairs, and as much time, the paper's method takes.");
    if (request->max_pairs > 0)
        printf("The paper's method ends at %llu pairs a scene: '>' is what it came to.\n",
               (unsigned long long)request->max_pairs);
}

void bench_print_head(const bench_set *set, const bench_request *request)
{
    printf("\n%s\n%s\n\n", set->name, set->about);
    printf("%-26s%8s%6s%6s%11s%11s%9s%9s%9s%9s%10s%10s", "", "contact", "clear", "open", "pairs",
           "greatest", "nodes", "searches", "heap", "memory", "time", "median");
    if (!request->only) printf("%9s%9s", "ratio", "of time");
    puts("");
}

static void print_reference(const bench_tally *t)
{
    printf("    verdict of the reference: %zu of %zu", t->agreed, t->references);
    if (!isnan(t->earliest)) printf("; t_lower earlier by at most %.3g", -t->earliest);
    if (t->latest > 0)
        printf(", later by at most %.3g", t->latest);
    else if (!isnan(t->latest))
        printf(", never later");
    puts("");
}

static void print_certificates(const bench_tally *t)
{
    const bench_certificates *c = &t->certificates;
    printf("    certificate: %.0f bytes, %.1f a pair; verified in %s, %.0f times the search",
           c->bytes.mean, c->bytes.mean / t->pairs.mean, cell_seconds(c->seconds.mean, false).text,
           bench_verify_over_solve(t));
    printf("; %zu of %zu hold\n", c->hold, c->count);
    if (!c->has_kernel) return;
    printf("    kernel: %zu of %zu elaborated within %d s", c->elaborated, c->count,
           KERNEL_TIME_LIMIT);
    if (c->elaborated > 0)
        printf(", %zu proved, in %s", c->proved, cell_seconds(c->kernel.mean, false).text);
    puts("");
}

static void print_goal(const bench_result *result, size_t row)
{
    static const char *const words[] = {[BENCH_GOAL_NONE] = "",
                                        [BENCH_GOAL_REACHED] = "",
                                        [BENCH_GOAL_MISSED] = " missed",
                                        [BENCH_GOAL_OPEN] = " open",
                                        [BENCH_GOAL_REACHED_NOW] = " reached now"};
    if (result->about->goal[row] > 0)
        printf("  goal %llu%s", (unsigned long long)result->about->goal[row],
               words[bench_goal_of(result, row)]);
}

static void print_row(const bench_result *result, size_t at)
{
    const bench_row *row = &result->rows[at], *baseline = result->baseline;
    const bench_tally *t = &row->tally;
    const bool ended = t->ended > 0;
    printf("  %-24s%8zu%6zu%6zu", row->method->name, t->verdicts[IMP_VERDICT_CONTACT],
           t->verdicts[IMP_VERDICT_CLEAR], t->verdicts[IMP_VERDICT_UNDECIDED]);
    printf("%11s%11s%9.0f%9.0f%9.0f", cell_count(t->pairs.mean, ended).text,
           cell_count(t->pairs.max, ended).text, t->nodes.mean, t->searches.mean, t->heap.max);
    printf("%9s%10s%10s", cell_bytes(t->bytes.max).text, cell_seconds(t->seconds.mean, ended).text,
           cell_seconds(t->seconds.median, ended).text);
    if (baseline != NULL) {
        const bench_tally *b = &baseline->tally;
        printf("%9s%9s", cell_ratio(t->pairs.mean, t, b->pairs.mean, b).text,
               cell_ratio(t->seconds.mean, t, b->seconds.mean, b).text);
    }
    print_goal(result, at);
    puts("");
    if (t->references > 0 && result->about->goal[at] == 0) print_reference(t);
    if (t->certificates.count > 0) print_certificates(t);
}

void bench_print_result(const bench_result *result)
{
    const bench_case *c = result->about;
    printf("%s", c->name);
    if (c->count > 1) printf(" (%zu scenes)", c->count);
    if (c->steps > 0) printf(" (%zu steps)", c->steps);
    puts("");
    for (size_t k = 0; k < result->row_count; ++k) print_row(result, k);
}

void bench_print_findings(const bench_finding *findings, size_t count)
{
    for (size_t k = 0; k < count; ++k) printf("%s%s\n", k == 0 ? "\n" : "", findings[k].text);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_ANSWER_H
#define TOOLS_CHECK_ANSWER_H

#include <stdbool.h>
#include <stdint.h>

/* What a check found
 * ==================
 * Lives in memory that the checking child shares with its parent, so that what a child was doing
 * is known even when the plugin has ended it. Plain data; pointers are to text of the command. */

typedef enum check_verdict { CHECK_PASS, CHECK_FAIL, CHECK_SKIP } check_verdict;

/* The call into the plugin that is under way. */
typedef struct check_call {
    const char *name; /* "eval", "rate", ...; NULL: none */
    int count;        /* numbers of interest */
    double number[8]; /* a point, or lower then upper ends of a region */
} check_call;

/* Claims about points and whole regions that were proved of a known formula. */
typedef struct check_proof {
    uint64_t claims, proved, regions, boxes;
    char open[480]; /* the first that was not settled */
} check_proof;

enum { CHECK_SCALES = 3 }; /* sizes of regions for which tightness is measured */

typedef struct check_answer {
    check_verdict verdict;
    char text[1600];
    uint64_t tests; /* comparisons made */

    /* Filled by `tightness` and `cost`; NAN: not known. */
    double rate_ratio[CHECK_SCALES], range_ratio[CHECK_SCALES]; /* bound / observed, medians */
    double eval_ns, rate_ns, include_ns;                        /* per point, per region */
    double pairs[2]; /* tested with a plane 1e-3 and 1e-6 of the size away */

    check_proof proof; /* filled by `proof` */

    check_call call;
} check_answer;

void answer_pass(check_answer *answer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void answer_skip(check_answer *answer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The first failure is the one that is told. Answers false, for `return answer_fail(...)`. */
bool answer_fail(check_answer *answer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif

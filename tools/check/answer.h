/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_ANSWER_H
#define TOOLS_CHECK_ANSWER_H

#include <stdbool.h>
#include <stdint.h>

/* The result of a check
 * =====================
 * Stored in memory that the child process shares with its parent, so that the call in progress is
 * known even if the plugin has ended the child. Plain data; pointers are to texts that live as long
 * as the command. */

/* A note reports something that may be intended. */
typedef enum check_verdict { CHECK_PASS, CHECK_FAIL, CHECK_SKIP, CHECK_NOTE } check_verdict;

/* The call into the plugin that is in progress. */
typedef struct check_call {
    const char *name; /* "eval", "rate", ...; NULL: none */
    int count;        /* numbers of interest */
    double number[8]; /* a point, or lower then upper ends of a region */
    char stage[200];  /* create and destroy: of what, "sphere radius=2" */
    const char *hint; /* what is special about it: ", whose arrays end ..."; or NULL */
} check_call;

/* Possible causes of a failure: one bug fails many checks, and is reported once. A failure without
 * any of these is reported separately. */
enum {
    FAULT_VALUE = 1,      /* eval rejects a point, or returns NaN or infinity */
    FAULT_ERROR = 2,      /* eval's errors */
    FAULT_RATE = 4,       /* rates, a model's included */
    FAULT_RANGE = 8,      /* a model's range */
    FAULT_REMAINDER = 16, /* a model's quadratic or remainder */
    FAULT_UNBOUNDED = 32, /* there is no bound at any size */
    FAULT_CRASH = 64,     /* the plugin ended the process, or timed out */
    FAULT_DOMAIN = 128,
    FAULT_ANY = 255 /* results that change from call to call can fail any check */
};

/* Claims about points and whole regions that were proved of a known formula. */
typedef struct check_proof {
    uint64_t claims, proved, regions, boxes;
    char open[480]; /* the first that was not settled */
} check_proof;

enum { CHECK_SCALES = 3 }; /* sizes of regions for which tightness is measured */

typedef struct check_answer {
    check_verdict verdict;
    char text[1600];
    uint64_t tests;  /* comparisons made */
    unsigned faults; /* of a failure: FAULT_RATE | ... */

    /* Filled by `tightness` and `cost`; NAN: not known. */
    double rate_ratio[CHECK_SCALES], range_ratio[CHECK_SCALES]; /* bound / observed, medians */
    double remainder_ratio[CHECK_SCALES]; /* remainder / what a quadratic needs, medians */
    double distance_ratio; /* of a tenth of the surface's size away / what is claimed, median */
    double eval_ns, rate_ns, include_ns; /* per point, per region */
    double pairs[2];                     /* tested with a plane 1e-3 and 1e-6 of the size away */

    check_proof proof; /* filled by `proof` */

    check_call call;

    /* Calls into the plugin are counted, so that any of them can be found again. */
    uint64_t calls;
    uint64_t claim_call, rate_call; /* the last that was no eval, and the last that was rate */
    uint64_t blamed;                /* of a failure: the call that is at fault; 0: not known */
    uint64_t stop_at;               /* tell a debugger before this call; 0: never */

    char said[2048]; /* the beginning of what was written to standard error */
} check_answer;

/* Counts the call that `call` describes, which is about to be made. */
void answer_count_call(check_answer *answer);

/* Takes back a failure. */
void answer_forget(check_answer *answer);

/* Puts a prefix and a colon in front of the answer's text. */
void answer_prefix(check_answer *answer, const char *words);

void answer_pass(check_answer *answer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void answer_skip(check_answer *answer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void answer_note(check_answer *answer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The first failure is reported. Returns false, for `return answer_fail(...)`. */
bool answer_fail(check_answer *answer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
bool answer_fail_for(check_answer *answer, unsigned faults, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_PAIR_H
#define TOOLS_CHECK_PAIR_H

#include "tools/check/subject.h"

/* Testing rates with two points
 * =============================
 * A row of rates claims |f(p) - f(q)| <= sum_j rate_j |p_j - q_j|. The values of f have errors, so
 * the claim is refuted only if the values differ by more than that bound plus both errors. */

typedef struct evaluated {
    double p[BOX_DIMS], x[3], error[3];
} evaluated;

/* Returns a lower bound of (|f(p) - f(q)|) / (what the rates allow), 0 if the errors explain
 * everything: above 1 the rates, or the errors, are refuted. */
double pair_ratio(int n, int coordinate, const double rate[BOX_DIMS], const evaluated *a,
                  const evaluated *b);

/* Returns a lower bound of the slope |f(p) - f(q)| / |p_j - q_j|. */
double pair_slope(int coordinate, int j, const evaluated *a, const evaluated *b);

/* The worst pair so far, and the claim it was compared with. */
typedef struct pair_finding {
    double ratio;
    int coordinate;
    box where; /* the rates hold over this */
    double rate[BOX_DIMS];
    evaluated a, b;
    uint64_t call; /* that made the claim */
} pair_finding;

/* Compares two points of a region with all three rows of its rates, which that call gave. Returns
 * the largest ratio. */
double pair_judge(const subject *s, const box *where, double rate[3][BOX_DIMS], uint64_t call,
                  const evaluated *a, const evaluated *b, pair_finding *worst);

/* Evaluates points; false, with or without a failure, if that cannot be done. */
bool pair_evaluate(const subject *s, size_t count, evaluated *points);

/* Fails the check if the pair refutes the claim. `claim` names it: "the rates". */
bool pair_conclude(const subject *s, const pair_finding *worst, const char *claim, unsigned faults);

#endif

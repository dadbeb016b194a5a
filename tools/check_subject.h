/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_SUBJECT_H
#define TOOLS_CHECK_SUBJECT_H

#include <impinge/impinge.h>

#include "check_answer.h"
#include "check_sampling.h"

/* What is examined: a surface or a map, each as one function of n numbers
 * =======================================================================
 * A surface is a function of (u, v, t), a map of (x, y, z, t), and both have three coordinates and
 * a rate for each of the numbers. Every call into the plugin goes through here, and is noted in the
 * answer before it is made. */

typedef struct subject {
    const imp_instance *instance;
    const imp_instance *twin; /* another of the same parameters */
    const imp_type_info *type;
    const char *stage;   /* what it was made from: "sphere radius=2" */
    const char *formula; /* what the user says it is, or NULL */
    check_answer *answer;
    int n;      /* 3: u, v, t. 4: x, y, z, t */
    box domain; /* where it is examined: infinite times are cut to a few units, and space to [-2,2]
                 */
} subject;

/* False, and the answer fails, if the domain makes no sense. */
bool subject_make(subject *s, const imp_instance *instance, const imp_instance *twin,
                  check_answer *answer);

/* `count` points p[n * k] to x[3 * k] and, unless NULL, error[3 * k]. */
imp_status subject_eval(const subject *s, size_t count, const double *p, double *x, double *error);

imp_status subject_rate(const subject *s, const box *where, double rate[3][BOX_DIMS]);

/* Surfaces that have it only. */
imp_status subject_include(const subject *s, const imp_region *region, imp_model model[3]);

/* Maps that have it only. */
imp_status subject_apply(const subject *s, const imp_model in[4], imp_model out[3]);

/* The same, with everything wrong that can be seen at once made a failure of the answer. True if
 * there are numbers to go on with; false with no failure where the type answers that it has no
 * bound there. */
bool subject_eval_sane(const subject *s, size_t count, const double *p, double *x, double *error);
bool subject_rate_sane(const subject *s, const box *where, double rate[3][BOX_DIMS]);

/* "u=0.5, v=1, t=0" and "u in [0, 1], v in [1, 1], t in [0, 1]", in digits that read back. */
typedef struct subject_text {
    char text[240];
} subject_text;
subject_text subject_point_text(int n, const double *p);
subject_text subject_box_text(int n, const double *lo, const double *hi);

/* What the call noted in an answer was about: "in eval at u=..., v=..., t=...". */
subject_text subject_call_text(const check_call *call);

/* "domain", "unbounded", ... */
const char *subject_status_name(imp_status status);

#endif

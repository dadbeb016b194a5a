/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_SUBJECT_H
#define TOOLS_CHECK_SUBJECT_H

#include <impinge/examine.h>
#include <impinge/impinge.h>

#include "tools/check/answer.h"
#include "tools/check/sampling.h"

/* The tested surface or map, as a function of n numbers
 * =====================================================
 * A surface is a function of (u, v, t), a map of (x, y, z, t), and both have three coordinates and
 * a rate for each of the numbers. Every call into the plugin is made here, and is recorded in the
 * answer first. */

typedef struct subject {
    imp_instance one, other; /* pieces of instances, where these consist of pieces */
    const imp_instance *instance;
    const imp_instance *twin; /* another of the same parameters */
    const imp_registry *registry;
    const imp_type_info *type;
    const char *stage;       /* its stage: "sphere radius=2" */
    const char *formula;     /* stated by the user, or NULL */
    const char *said_domain; /* the same of its domain */
    const char *search;      /* directories of other plugins, or NULL */
    check_answer *answer;
    int n;          /* 3: u, v, t. 4: x, y, z, t */
    box domain;     /* examined: infinite times are cut to a few units, space to [-2,2] */
    double ends[2]; /* of its times, as it states them: may be infinite */
} subject;

/* False, and the check fails, if the domain is invalid. Where instances consist of pieces, their
 * k-th; it must not be copied then. */
bool subject_make(subject *s, const imp_instance *instance, const imp_instance *twin, size_t k,
                  check_answer *answer);

/* Returns the number of an instance's pieces; 0: it is one surface, or a map. */
size_t subject_piece_count(const imp_instance *instance, check_answer *answer);

/* From a stage, "sphere radius=2", and back. */
imp_code subject_create(imp_registry *registry, imp_type_kind kind, const char *stage,
                        imp_instance *made, imp_error *error, check_answer *answer);
void subject_destroy(imp_instance *made, const char *stage, check_answer *answer);

/* Records that a call without numbers is in progress; NULL: it has returned. `hint`: as in
 * check_call. */
void subject_note_call(check_answer *answer, const char *name, const char *hint);

/* Records that one of the two is in progress. NULL: it has returned. */
void subject_note_stage(check_answer *answer, const char *name, const char *stage);

/* `count` points p[n * k] to x[3 * k] and, unless NULL, error[3 * k]. */
imp_status subject_eval(const subject *s, size_t count, const double *p, double *x, double *error);

imp_status subject_rate(const subject *s, const box *where, double rate[3][BOX_DIMS]);

/* Only for surfaces that have it. */
imp_status subject_include(const subject *s, const imp_region *region, imp_model model[3]);

/* Only for maps that have it. */
imp_status subject_apply(const subject *s, const imp_model in[4], imp_model out[3]);

/* Only for surfaces, and for maps, that have it. */
imp_status subject_net(const subject *s, const imp_region *region, imp_net *net);
imp_status subject_map_net(const subject *s, const imp_region *region, imp_net *net);

/* Whether it is a map that has poses; that over the times of a box. IMP_STATUS_OK with zeros: it
 * has none. */
bool subject_is_rigid(const subject *s);
imp_status subject_pose(const subject *s, const imp_region *span, imp_pose *pose);

/* The region whose times are those of a box of a map: for poses. */
imp_region subject_span(const box *where);

/* Whether it is a surface that has it, and for those. */
bool subject_has_distance(const subject *s);
imp_status subject_distance(const subject *s, const imp_model point[4], imp_model *distance);

/* Tells how the surface can be moved within itself. IMP_STATUS_UNBOUNDED: it cannot. */
imp_status subject_symmetry(const subject *s, imp_symmetry *symmetry);

/* Whether it is a surface that has it, and for those. */
bool subject_has_tube(const subject *s);
imp_status subject_tube(const subject *s, const imp_region *region, imp_tube *tube);

/* include or apply, whichever it has, over a box; a map's operands are x, y, z themselves, as if
 * they were u, v, t. IMP_STATUS_OK with zeros: it has neither. */
imp_status subject_model(const subject *s, box where, imp_model model[3]);

/* The operands of that. */
void subject_operands(const box *where, imp_model in[4]);

/* Call the subject, and fail the check if a result is directly seen to be wrong. True if the
 * results can be used; false without a failure if the type returns that it has no bound there. */
bool subject_eval_sane(const subject *s, size_t count, const double *p, double *x, double *error);
bool subject_rate_sane(const subject *s, const box *where, double rate[3][BOX_DIMS]);

/* "u=0.5, v=1, t=0" and "u in [0, 1], v in [1, 1], t in [0, 1]", in digits that read back. */
typedef struct subject_text {
    char text[400];
} subject_text;
subject_text subject_point_text(int n, const double *p);
subject_text subject_box_text(int n, const double *lo, const double *hi);

/* Returns words for the call recorded in an answer: "in eval at u=..., v=..., t=...". */
subject_text subject_call_text(const check_call *call);

/* "domain", "unbounded", ... */
const char *subject_status_name(imp_status status);

#endif

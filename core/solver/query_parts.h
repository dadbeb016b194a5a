/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_QUERY_PARTS_H
#define CORE_SOLVER_QUERY_PARTS_H

#include <stdatomic.h>

#include "core/solver/clearance.h"
#include "core/solver/examined_times.h"

/* What the files of the query share: query.c runs it, query_answer.c and query_clearance.c tell how
 * far it has come. */

struct imp_query {
    imp_scene *scene;
    imp_options options;
    examined_times examined;
    imp_stats stats; /* bytes: of the trees, without the heap */
    uint64_t peak_bytes;
    double next_report; /* seconds spent when options.progress is called next */
    bool failed;
    imp_verdict verdict;
    bool at_rest; /* CONTACT: of two surfaces that do not move */
    imp_reason reason;
    atomic_bool cancelled;
    candidate_list candidates;
    clearance_search *clearance; /* NULL: the earliest contact is asked for, by the following */
    impact impact;
    size_t candidates_tested; /* how many candidate pairs have been tested */
};

#endif

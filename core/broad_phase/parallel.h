/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_PARALLEL_H
#define CORE_BROAD_PHASE_PARALLEL_H

#include "core/scene/scene.h"

/* Threads that a program lends to a query (imp_options.parallel)
 * ==============================================================
 * They work ahead: they fill fixed slots with results that the search will need next, and the
 * thread that steps the query uses each in its turn. A slot that was not filled, because a limit
 * was near or something failed, is filled in its turn, as all slots are without threads: so limits,
 * errors and counts are those of one thread. */

static inline bool parallel_is_on(const imp_options *options) { return options->parallel != NULL; }

/* Calls work(of, 0) to work(of, count - 1), each in the library's own floating-point environment,
 * and returns when all have returned. */
void parallel_run(const imp_options *options, void (*work)(void *of, size_t index), void *of,
                  size_t count);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_TUNE_H
#define TOOLS_BENCH_TUNE_H

#include "tools/bench/bench.h"

/* What other values of one tuning constant (core/bounds/tuning.h) cost or save. */

/* Prints, for each set and value, the sums of pairs, nodes, witness searches and instructions of
 * the default method over all scenes. `asked` is the constant's name, or NAME=VALUE[,VALUE...].
 * `sets` is NULL-terminated. Only tools/impinge-tunable can do it; the installed command
 * complains. */
exit_status bench_tune(imp_registry *registry, const bench_request *request, const char *asked,
                       const bench_set *const *sets);

#endif

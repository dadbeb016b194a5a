/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_TUNABLE_H
#define CORE_COMMON_TUNABLE_H

#include <impinge/surface.h>

/* Tuning constants as variables
 * =============================
 * tools/impinge-tunable is the command with the library linked in, compiled with IMP_TUNABLE: the
 * constants of core/bounds/tuning.h are then variables, which `bench --tune` changes between two
 * queries. No other program has this function; in them the constants are constants. */

/* Receives one constant: either `integer` or `number` points to its variable, the other is
 * NULL. */
typedef void tunable_visitor(const char *name, int *integer, double *number, void *data);

/* Calls `visit` for each constant, in the order of tuning.h. */
IMP_EXPORT void tunables_visit(tunable_visitor *visit, void *data);

#endif

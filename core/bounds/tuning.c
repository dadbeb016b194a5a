/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

/* The tuning constants as variables, for tools/impinge-tunable alone. tuning.h is read twice: it
 * defines the variables, then it lists them. */
#define TUNING_INTEGER(name, value) int name = value
#define TUNING_NUMBER(name, value) double name = value
#include "core/bounds/tuning.h"

#include <stddef.h>

#include "core/common/tunable.h"

#undef TUNING_INTEGER
#undef TUNING_NUMBER
#undef CORE_BOUNDS_TUNING_H
#define TUNING_INTEGER(name, value) visit(#name, &name, NULL, data)
#define TUNING_NUMBER(name, value) visit(#name, NULL, &name, data)

void tunables_visit(tunable_visitor *visit, void *data)
{
#include "core/bounds/tuning.h"
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_CLEARANCE_MEASURE_H
#define TOOLS_CLI_CLEARANCE_MEASURE_H

#include "tools/cli/arguments.h"
#include "tools/cli/clearance.h"

/* Measures a scene without parameters as the arguments of `impinge clearance` say, and prints the
 * answers. */
exit_status clearance_measure(imp_scene *scene, const imp_clearance_options *asked,
                              const arguments *args);

/* Answers --each and --profile of a scene with parameters: about all their values. */
exit_status clearance_survey(imp_scene *scene, const imp_clearance_options *asked,
                             const arguments *args);

#endif

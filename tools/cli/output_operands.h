/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_OUTPUT_OPERANDS_H
#define TOOLS_CLI_OUTPUT_OPERANDS_H

#include "tools/cli/verbs.h"

/* Refuses an option that names one of the operands, such as the scene, as the file to write. */
exit_status output_spares_operands(const arguments *args, const char *name);

#endif

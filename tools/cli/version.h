/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_VERSION_H
#define TOOLS_CLI_VERSION_H

#include "tools/cli/arguments.h"

/* Prints --version: a line or, with --json, the versions, and the capabilities of the surface ABI
 * that this host uses (tools/schema/version.schema.json). */
exit_status version_print(const arguments *args);

#endif

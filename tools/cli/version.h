/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_VERSION_H
#define TOOLS_CLI_VERSION_H

#include "tools/cli/arguments.h"

/* Answers --version: a line or, with --json, the versions, and what this host uses of the surface
 * ABI (tools/schema/version.schema.json). */
exit_status version_print(const arguments *args);

#endif

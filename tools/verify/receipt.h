/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_RECEIPT_H
#define TOOLS_VERIFY_RECEIPT_H

#include "tools/verify/statement.h"

enum { HOLDS, REFUSED, USAGE, STALE }; /* exit statuses of impinge-verify */

/* Returns HOLDS if the certificate is of this scene file, of this version, and of the plugin files
 * that are found in the folders of `plugin_path` (NULL: none), then where the command looks for
 * them; else prints what has changed and returns STALE, or USAGE if the scene cannot be read. */
int receipt_check(const statement *s, const char *scene, const char *plugin_path);

#endif

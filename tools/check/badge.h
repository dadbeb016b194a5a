/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_BADGE_H
#define TOOLS_CHECK_BADGE_H

#include <jansson.h>

#include "tools/cli/message.h"

/* check --badge: what a repository publishes of its plugin
 * ========================================================
 * A JSON object, as tools/schema/badge.schema.json says, with the verdict of each check and how
 * tight the bounds are. Its first keys are those of a shields.io endpoint, so that its address is
 * all that a picture needs. */

typedef struct badge_facts {
    const char *plugin, *version; /* of the plugin file */
    const char *formula;          /* of --formula, or NULL */
} badge_facts;

/* Writes the badge of a report (check.schema.json) to `path`, whole or not at all; "-" is standard
 * output. Complains on behalf of `verb`. */
exit_status badge_write(const char *path, const json_t *report, const badge_facts *facts,
                        const char *verb);

/* Returns the label that the whole report earns: the worst of its types, "failed" where the file
 * itself failed a check. */
const char *badge_label(const json_t *report);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_HELP_TOPICS_H
#define TOOLS_CLI_HELP_TOPICS_H

/* What `impinge help TOPIC` tells beside verbs: each in short, with the manual that tells more. */
typedef struct help_topic {
    const char *name, *summary;
    const char *text; /* paragraphs, each line ended */
} help_topic;

extern const help_topic help_topics[]; /* ends with a name that is NULL */

#endif

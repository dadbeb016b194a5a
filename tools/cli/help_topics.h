/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_HELP_TOPICS_H
#define TOOLS_CLI_HELP_TOPICS_H

/* Topics of `impinge help TOPIC` other than verbs: a summary, and the manual page with the
 * details. */
typedef struct help_topic {
    const char *name, *summary;
    const char *text; /* paragraphs, each line ended */
} help_topic;

extern const help_topic help_topics[]; /* ends with a name that is NULL */

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_PARSER_H
#define PLUGINS_EXPRESSION_PARSER_H

#include "plugins/expression/builder.h"

/* Reads one text and builds it. Answers the index of its value; on failure `error`, all but `at`,
 * is set. */
bool parser_read(const expression_scope *scope, const char *text, builder *b, uint16_t *value,
                 expression_error *error);

#endif

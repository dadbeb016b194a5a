/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_STATEMENT_INTERNAL_H
#define TOOLS_VERIFY_STATEMENT_INTERNAL_H

#include "tools/verify/statement.h"

enum { STATEMENT_LINE_MAX = 1 << 24, STATEMENT_PIECES_MAX = 1 << 24 };

/* Reads a stage: the rest of its line, then a line with the formula of each of its pieces. */
bool statement_read_stage(statement *s, input *in, bool is_map, char **rest);

#endif

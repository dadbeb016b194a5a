/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_PIECES_H
#define TOOLS_CHECK_PIECES_H

#include "tools/check/subject.h"

/* Instances of many surfaces: piece_count and piece answer, within limits, and the same each time,
 * also after the pieces were asked; all pieces have the same times. Types without pieces pass. */
void pieces_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                  check_answer *answer);

#endif

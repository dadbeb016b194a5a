/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_SAID_H
#define TOOLS_CHECK_SAID_H

#include <impinge/impinge.h>

#include "check_formula.h"

/* The formula of a surface or map, where someone says it
 * ======================================================
 * Either whoever asks for the check, "X; Y; Z", or the surface itself: a type whose parameters x, y
 * and z are texts is what these texts say. Which type that is we do not know.
 *
 * Constants in it are the numbers among the stage's parameters, by their names; those of a list
 * with their place behind the name, as in center0; and those of a table by their own names. */

/* NULL: `fault` says what is wrong with it, or is empty if there is none. The caller frees it. */
formula *said_formula(const imp_type_info *type, const char *stage, const char *given, char *fault,
                      size_t size);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_COQ_TEXT_H
#define TOOLS_VERIFY_COQ_TEXT_H

#include <stdio.h>

#include "tools/verify/enclose.h"

/* Formulas as terms of Coq's real numbers */

/* Returns the formulas of the stages of a place whose parts hold the box, in parts[]; false: a box
 * lies in no single part, or `interval` does not know their functions, or they are too long when
 * they are written out. `parts`: of->maps + 1. */
bool coq_find_parts(const place *of, const box3 *where, const part *parts[]);

/* Writes definitions NAME_x, NAME_y and NAME_z of u, v, t and of the constants of all stages that
 * are known as intervals; returns how many there are of these, k0, k1, ... So is, for each stage
 * that follows another clock than T, a value of that. */
size_t coq_put_definitions(FILE *to, const char *name, const place *of, const part *const parts[]);

/* Writes " k0 k1 ..." with this letter; or what is known of them, "LO <= k0 <= HI -> ...". */
void coq_put_constants(FILE *to, char letter, size_t count);
void coq_put_ranges(FILE *to, char letter, const place *of, const part *const parts[]);

/* Writes ", i_bisect k0" of each constant that is a clock's value. */
void coq_put_bisections(FILE *to, const place *of, const part *const parts[]);

/* Writes the names that a proof unfolds. */
void coq_put_names(FILE *to, const char *name, const place *of);

#endif

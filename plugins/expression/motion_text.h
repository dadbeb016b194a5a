/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_MOTION_TEXT_H
#define PLUGINS_EXPRESSION_MOTION_TEXT_H

#include <impinge/plugin.h>

/* A rigid motion by formulas in t, as one text (imp_map_type.formula). Numbers are defined in it by
 * names that are no constant's, whatever the constants are called. */
typedef struct motion_text {
    const imp_value *constants; /* a table */
    double lo, hi;              /* times; -INFINITY, INFINITY: all */
    const char *const *offset;  /* three texts */
    const char *angle;          /* NULL: it does not turn, and neither axis nor center is read */
    const double *axis, *center;
} motion_text;

void motion_text_write(const motion_text *m, const imp_text_sink *to);

#endif

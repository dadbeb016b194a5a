/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_UNITS_H
#define PLUGINS_COMMON_UNITS_H

#include <stdbool.h>

#include <impinge/interval.h>

/* Units of tables
 * ===============
 * Angles of the host are in rad. Lengths and times have no unit there; a table whose head names one
 * is converted to that of the scene. */

typedef enum unit_kind { UNIT_TIME, UNIT_LENGTH, UNIT_ANGLE } unit_kind;

/* The unit in terms of the first of its kind (s, m, rad): top / bottom, both whole numbers; of
 * degrees, times pi. */
typedef struct unit {
    double top, bottom;
    bool is_of_pi;
} unit;

/* Finds a unit by its name. False: there is none of that kind by this name. */
bool unit_find(unit_kind kind, const char *name, unit *found);

/* Writes the names of a kind, with commas between them: "s, ms, us, min and h". */
const char *unit_names(unit_kind kind);

/* Converts from one unit to another of the same kind; nothing is rounded where both are equal. */
imp_interval unit_convert(double number, const unit *from, const unit *to);

/* The nearest number, for times, which are exact in tables. */
double unit_convert_near(double number, const unit *from, const unit *to);

#endif

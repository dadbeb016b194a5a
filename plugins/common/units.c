/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/units.h"

#include <string.h>

typedef struct named_unit {
    const char *name;
    unit unit;
} named_unit;

/* What else a name may be written as follows it. Whole numbers, so that products of two are
 * exact. */
static const named_unit times[] = {{"s", {1, 1, false}},
                                   {"ms", {1, 1000, false}},
                                   {"us", {1, 1000000, false}},
                                   {"\xC2\xB5s", {1, 1000000, false}},
                                   {"\xCE\xBCs", {1, 1000000, false}},
                                   {"min", {60, 1, false}},
                                   {"h", {3600, 1, false}},
                                   {NULL, {0, 0, false}}};
static const named_unit lengths[] = {{"m", {1, 1, false}},
                                     {"cm", {1, 100, false}},
                                     {"mm", {1, 1000, false}},
                                     {"um", {1, 1000000, false}},
                                     {"\xC2\xB5m", {1, 1000000, false}},
                                     {"\xCE\xBCm", {1, 1000000, false}},
                                     {"nm", {1, 1000000000, false}},
                                     {"km", {1000, 1, false}},
                                     {"in", {254, 10000, false}},
                                     {"ft", {3048, 10000, false}},
                                     {NULL, {0, 0, false}}};
static const named_unit angles[] = {{"rad", {1, 1, false}},
                                    {"deg", {1, 180, true}},
                                    {"\xC2\xB0", {1, 180, true}},
                                    {NULL, {0, 0, false}}};
static const named_unit *const kinds[] = {
    [UNIT_TIME] = times, [UNIT_LENGTH] = lengths, [UNIT_ANGLE] = angles};

bool unit_find(unit_kind kind, const char *name, unit *found)
{
    for (const named_unit *u = kinds[kind]; u->name != NULL; ++u)
        if (strcmp(u->name, name) == 0) {
            *found = u->unit;
            return true;
        }
    return false;
}

const char *unit_names(unit_kind kind)
{
    static const char *const names[] = {[UNIT_TIME] = "s, ms, us, min and h",
                                        [UNIT_LENGTH] = "m, cm, mm, um, nm, km, in and ft",
                                        [UNIT_ANGLE] = "rad, deg and \xC2\xB0"};
    return names[kind];
}

/* Both numbers are products of whole numbers below 2^53. */
static void ratio(const unit *from, const unit *to, double *top, double *bottom)
{
    *top = from->top * to->bottom;
    *bottom = from->bottom * to->top;
}

imp_interval unit_convert(double number, const unit *from, const unit *to)
{
    double top, bottom;
    imp_interval x = imp_interval_make(number, number);
    ratio(from, to, &top, &bottom);
    if (from->is_of_pi && !to->is_of_pi)
        x = imp_interval_mul(x, imp_interval_make(IMP_PI_LOWER, IMP_PI_UPPER));
    if (top != bottom && top != 1) x = imp_interval_mul(x, imp_interval_make(top, top));
    if (top != bottom && bottom != 1) x = imp_interval_div(x, imp_interval_make(bottom, bottom));
    return x;
}

double unit_convert_near(double number, const unit *from, const unit *to)
{
    double top, bottom;
    ratio(from, to, &top, &bottom);
    return top == bottom ? number : bottom == 1 ? number * top : number * top / bottom;
}

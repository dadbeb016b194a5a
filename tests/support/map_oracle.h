/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_MAP_ORACLE_H
#define TESTS_SUPPORT_MAP_ORACLE_H

#include "tests/support/type_oracle.h"

/* Maps once more, as their equations say, in numbers of 200 bits. Where a plugin avoids a division
 * by something small, or a sum of large numbers, an oracle does not. */

typedef void map_oracle(const type_arguments *arguments, const number p[4], number x[3]);

map_oracle scale_oracle, screw_oracle, taper_oracle, twist_oracle, bend_oracle, wave_oracle,
    keyframes_oracle, trajectory_oracle, ffd_oracle;

/* Number i of the map's table, if it has one: "times", and the rows called `values`. */
bool table_oracle(const type_arguments *arguments, const char *values, size_t i, number t,
                  number *x);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* Every rigid displacement within tolerances: a rotation by an angle of at most A about any axis
 * through the centre, then an offset of a length of at most d.
 *
 * Lemma. The parts hold all of these. A rotation matrix R whose angle is at most A < pi/2 has
 * R_ii = cos a + (1 - cos a) n_i^2 >= cos A on its diagonal, a <= A its angle and n its axis. No
 * other entry exceeds sin A: columns are of unit length, so that R_ij^2 <= 1 - R_jj^2. R is
 * Rz(c) Ry(b) Rx(a) with sin b = -R_31, tan a = R_32 / R_33, tan c = R_21 / R_11; hence |b| <= A,
 * and |tan a| and |tan c| are at most sin A / cos A, so that |a| and |c| are at most A, too. Each
 * coordinate of an offset of length at most d is at most d. */

enum { OFFSET, ANGLE, CENTER };

/* Below a right angle, as the lemma needs. */
#define ANGLE_MAX 1.5

static const imp_parameter parameters[] = {
    [OFFSET] = IMP_ROW_BETWEEN("offset", "length", "0", 0, INFINITY,
                               "every point may be so far from its place, in any direction"),
    [ANGLE] = IMP_ROW_BETWEEN("angle", "rad", "0", 0, ANGLE_MAX,
                              "it may be turned by so much, about any axis through the centre"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "the point it is turned about"),
};

static imp_status tolerance_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)why;
    *self = malloc(1);
    return *self != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

/* In the middle of all tolerances nothing is displaced. */
static void tolerance_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                              imp_model out[3])
{
    (void)self, (void)t;
    out[0] = x, out[1] = y, out[2] = z;
}
IMP_MAP_FORMULA(tolerance_formula)
IMP_MAP_AT_ALL_TIMES(tolerance)

#define TURN(AXIS) "rotate axis=" AXIS " rate=1 center=$center clock=-$angle,$angle"
#define SHIFT(AXIS) "translate velocity=" AXIS " clock=-$offset,$offset"

static const imp_map_type tolerance = {
    IMP_MAP_FIELDS(tolerance, tolerance_formula),
    .formula = "x; y; z",
    .parts = TURN("1,0,0") " ! " TURN("0,1,0") " ! " TURN("0,0,1") " ! " SHIFT("1,0,0") " ! " SHIFT(
        "0,1,0") " ! " SHIFT("0,0,1"),
    .summary = "anywhere within an offset and an angle of its place: for all of these at once",
    .equation =
        "center + R ((x,y,z) - center) + d for every rotation R by at most angle, and every "
        "d no longer than offset",
    .example = "tolerance offset=0.1 angle=0.01",
};

PUBLISH_MAP(tolerance);

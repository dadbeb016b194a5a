/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/carried.h"

bool symmetry_is_sane(const imp_symmetry *found)
{
    const uint32_t of_axis = IMP_SYMMETRY_ORBIT_U | IMP_SYMMETRY_ORBIT_V | IMP_SYMMETRY_ZONE,
                   of_ball = IMP_SYMMETRY_ORBIT_ALL | IMP_SYMMETRY_ZONE,
                   closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ZONE,
                   all = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_NEARLY | of_axis | of_ball;
    double most = 0;
    if (found->kind < IMP_SYMMETRY_ABOUT_POINT || found->kind > IMP_SYMMETRY_SCREW_LEFT)
        return false;
    if (symmetry_is_screw(found) && found->is_closed > IMP_SYMMETRY_CLOSED) return false;
    const bool is_ball = found->kind == IMP_SYMMETRY_ABOUT_POINT;
    for (int i = 0; i < 3; ++i) {
        if (!isfinite(found->center[i]) || !isfinite(found->axis[i])) return false;
        if (fabs(found->axis[i]) > most) most = fabs(found->axis[i]);
    }
    if (found->is_closed > all) return false;
    if ((found->is_closed & IMP_SYMMETRY_NEARLY) != 0 && (found->is_closed & closed) == 0)
        return false;
    if (!is_ball && (found->is_closed & of_ball) != 0) return false;
    if (is_ball && (found->is_closed & of_axis) == 0) return true;
    return most > AXIS_LEAST && most < AXIS_MOST;
}

bool surface_has_symmetry(const surface *s)
{
    return IMP_OFFERS(s->type, symmetry) && surface_has_distance(s);
}

imp_status surface_symmetry(const surface *s, imp_symmetry *found)
{
    memset(found, 0, sizeof *found);
    if (!surface_has_symmetry(s)) return IMP_STATUS_UNBOUNDED;
    const surface_call call = surface_call_begin(s->type->name, "symmetry");
    imp_status status = s->type->symmetry(s->self, found);
    status = surface_call_end(call, status);
    if (status != IMP_STATUS_OK) return status;
    return symmetry_is_sane(found) ? IMP_STATUS_OK : SURFACE_BAD_SYMMETRY;
}

/* Like surface_closed_symmetry, for what is no surface of several pieces. */
static imp_status closed_alone(const surface *s, imp_symmetry *found)
{
    const imp_status status = surface_symmetry(s, found);
    if (status != IMP_STATUS_OK) return status;
    if (!symmetry_is_round(found)) return IMP_STATUS_UNBOUNDED;
    const bool is_whole = (found->is_closed & IMP_SYMMETRY_CLOSED) != 0;
    if (found->kind != IMP_SYMMETRY_ABOUT_POINT || !is_whole) found->kind = IMP_SYMMETRY_ABOUT_LINE;
    return IMP_STATUS_OK;
}

/* Whether x is y + d. Lemma (Knuth's sum of two): the rounding of w = x - y is (x - (w - b)) - (y +
 * b), b = w - x, exactly. */
static bool is_exact_sum(double x, double y, double d)
{
    const double w = x - y, b = w - x;
    return w == d && (x - (w - b)) - (y + b) == 0;
}

/* Whether x lies on the line of `line`, or is its center or the end of the axis from there: in
 * exact arithmetic, so that few lines other than those along coordinates are known to hold another
 * point. */
static bool is_on_line(const imp_symmetry *line, const double x[3])
{
    int along = 0;
    bool is_center = true, is_end = true, is_beside = false;
    for (int i = 0; i < 3; ++i) {
        along += line->axis[i] != 0;
        is_center = is_center && x[i] == line->center[i];
        is_end = is_end && is_exact_sum(x[i], line->center[i], line->axis[i]);
        is_beside = is_beside || (line->axis[i] == 0 && x[i] != line->center[i]);
    }
    const bool is_along = is_end || (along == 1 && !is_beside);
    return is_center || (line->kind != IMP_SYMMETRY_ABOUT_POINT && is_along);
}

static bool has_axis_of(const imp_symmetry *x, const imp_symmetry *line)
{
    bool same = true;
    for (int i = 0; i < 3; ++i) same = same && x->axis[i] == line->axis[i];
    return same;
}

/* Takes one more piece into the rotations that keep all pieces so far. False: they have none in
 * common that is known. */
static bool join_symmetry(imp_symmetry *all, const imp_symmetry *one)
{
    const bool is_point = one->kind == IMP_SYMMETRY_ABOUT_POINT;
    if (all->kind != IMP_SYMMETRY_ABOUT_POINT)
        return is_on_line(all, one->center) && (is_point || has_axis_of(one, all));
    if (!is_on_line(one, all->center)) return false;
    if (!is_point) *all = *one;
    return true;
}

enum { PIECES_ASKED = 64 };

/* Lemma. If each piece is closed under the rotations about one line, so is the surface; of pieces
 * that are nearly closed, each is no larger than the surface. */
static imp_status closed_together(const surface *s, imp_symmetry *found)
{
    if (s->piece_count > PIECES_ASKED) return IMP_STATUS_UNBOUNDED;
    imp_status status = closed_alone(surface_piece(s, 0), found);
    uint32_t nearly = found->is_closed & IMP_SYMMETRY_NEARLY;
    for (size_t k = 1; k < s->piece_count && status == IMP_STATUS_OK; ++k) {
        imp_symmetry one;
        status = closed_alone(surface_piece(s, k), &one);
        if (status == IMP_STATUS_OK && !join_symmetry(found, &one)) status = IMP_STATUS_UNBOUNDED;
        if (status == IMP_STATUS_OK) nearly |= one.is_closed & IMP_SYMMETRY_NEARLY;
    }
    found->is_closed |= nearly;
    return status;
}

imp_status surface_closed_symmetry(const surface *s, bool of_pieces, imp_symmetry *found)
{
    if (!IMP_OFFERS(s->type, symmetry) || (s->piece_count > 1 && !of_pieces))
        return IMP_STATUS_UNBOUNDED;
    return s->piece_count > 1 ? closed_together(s, found) : closed_alone(s, found);
}

/* Two points of the box are no farther apart than its corners. Roundings: differences, squares,
 * sums 2, halved by the root, root, product. */
PAD_COVERS(8, 1 + 2 + 1 + 1);
double symmetry_slack_upper(const imp_symmetry *found, const double lo[3], const double hi[3])
{
    double sum = 0;
    if ((found->is_closed & IMP_SYMMETRY_NEARLY) == 0) return 0;
    for (int i = 0; i < 3; ++i) sum += (hi[i] - lo[i]) * (hi[i] - lo[i]);
    return padded_upper(IMP_NEARLY_SLACK * sqrt(sum), 8) + ROOT_UNDERFLOW;
}

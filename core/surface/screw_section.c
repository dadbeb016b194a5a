/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/screw_piece.h"
#include "core/surface/screws.h"

/* Lemma. At one time let F be a rigid motion that takes the line of b's screws to that of a's, L,
 * and moves no point of b farther than s; both have one lead p and one hand. Let H be a half plane
 * that ends at L, and W a stretch of L, one lead long. Let x on a and y on b be within d of each
 * other. Of the screws about L one, S, takes F y to z in H, at a height of W. If all of W is
 * between heights of F b, then y' = F^-1 z is on b, within s of z, since F^-1 S F is one of b's
 * screws. x' = S x is within |x - F y| <= d + s of z. If a reaches d + s beyond W, then x' is on
 * a, and
 *
 *   |x' - y'| <= |S x - S F y| + s <= |x - y| + 2 s.
 *
 * So of b only what is within s of H at heights of W needs to be looked at, and of a only what is
 * within d + s of that. Claims are true but for `loose`: it is added to each way, and twice to the
 * distance. It counts the leads, too, which may differ by IMP_SCREW_SLACK of one for each turn:
 * screws turn by no more than 2 reach / p + 1. */
typedef struct section {
    const screw_piece *piece;
    const feature *f;
    int cut, other;  /* b and a: the side that H cuts, and the other one */
    double reach;    /* of all points from a's center, and of b's points from b's; length */
    double slip;     /* s */
    double loose;    /* length */
    double from, to; /* heights of W, from the foot of b's center; length */
    double gap;      /* by which W may be shorter than a lead; length */
} section;

/* Chooses W in the middle of what is possible. False: b is shorter than a lead, or a does not reach
 * far enough beyond. Roundings: all heights are below 4 reach, or there is no such W, so that some
 * tens of them are less than the margin. */
static bool choose_stretch(section *c, double near)
{
    const screw_piece *p = &c->piece[c->cut], *q = &c->piece[c->other];
    const feature *f = &c->f[c->other];
    const double length = feature_inverse_length(&f->of), margin = 0x1p-44 * c->reach;
    imp_model way[3], axis[3];
    double cosine = 0;
    feature_difference(c->f[c->cut].center, f->center, way);
    for (int i = 0; i < 3; ++i) {
        axis[i] = imp_scale(f->axis[i], length);
        cosine += f->axis[i].a * c->f[c->cut].axis[i].a;
    }
    const imp_model along = imp_dot3(axis, way);
    const imp_interval foot = imp_model_range(&along);
    const double room = near + c->slip + c->loose + 4 * margin;
    const double lowest = cosine > 0 ? p->lowest : -p->highest,
                 highest = cosine > 0 ? p->highest : -p->lowest;
    double lead = highest - lowest - 2 * margin;
    if (lead > p->lead) lead = p->lead;
    const double least = lowest + margin, most = highest - margin - lead;
    const double least_other = q->lowest + room - foot.lo,
                 most_other = q->highest - room - foot.hi - lead;
    const double lo = least > least_other ? least : least_other,
                 hi = most < most_other ? most : most_other;
    if (!(lead > 0 && lo <= hi)) return false;
    c->from = 0.5 * lo + 0.5 * hi;
    c->to = c->from + lead;
    c->gap = p->lead - lead + margin;
    return c->gap <= 0x1p-32 * p->lead;
}

/* Fills *h for points within `away` of what the lemma keeps of b. Lemma. Where W is shorter than a
 * lead, a z beyond its end is screwed back to the end: by 2 pi gap / p, at most 8 reach gap / p
 * away from H. Let n be L's unit vector, k the constant one that is taken for it, |k - n| <=
 * tilted, and w the way from the foot of b's center to z, |w| <= 4 reach. Then k.w is within 4
 * reach tilted of the height n.w, and the foot is within s of b's center. The pad covers some
 * products and sums of numbers >= 0. */
PAD_COVERS(64, 16);
static bool hold_section(const section *c, double away, half_plane *h)
{
    const feature *line = &c->f[c->other], *cut = &c->f[c->cut];
    const double length = feature_inverse_length(&line->of);
    const double turned = 8 * c->reach * (c->gap / c->piece[c->cut].lead);
    const double beside = padded_upper(c->slip + c->loose + turned + away, 16);
    imp_model up[3], tilt[3];
    if (!half_plane_hold(line, 2 * c->reach, beside, h)) return false;
    for (int i = 0; i < 3; ++i) {
        h->up[i] = line->axis[i].a * length;
        up[i] = imp_num(h->up[i]);
        tilt[i] = imp_sub(imp_scale(line->axis[i], length), up[i]);
    }
    const double tilted = surface_size_upper(tilt) + AXES_OFF;
    const imp_model foot = imp_dot3(up, cut->center);
    const imp_interval range = imp_model_range(&foot);
    const double room =
        padded_upper(4 * c->reach * tilted + (1 + tilted) * (2 * beside + c->slip), 64);
    h->height_lo = difference_lower(difference_lower(range.lo, -c->from), room);
    h->height_hi = sum_upper(sum_upper(range.hi, c->to), room);
    return h->height_lo > -INFINITY && h->height_hi < INFINITY;
}

static bool section_of(section *c, const half_plane_boxes *boxes, double near, half_plane of[2],
                       double *slip)
{
    const screw_piece *p = c->piece;
    const feature *a = &c->f[c->other], *b = &c->f[c->cut];
    double off = 0, angle = 0;
    feature_compare_lines(a, b, &off, &angle);
    const double own = feature_reach_upper(boxes->lo[c->cut], boxes->hi[c->cut], b->center);
    c->slip = padded_upper(own * angle + off, 16);
    c->reach = sum_upper(c->slip, own);
    for (int k = 0; k < 2; ++k) {
        const double far = feature_reach_upper(boxes->lo[k], boxes->hi[k], a->center);
        c->reach = sum_upper(c->reach, far);
    }
    c->loose = 2 * screw_loose_upper(c->reach, p[0].lead + p[1].lead);
    const bool in_reach = 2 * c->reach / p[c->cut].lead + 2 <= IMP_SCREW_TURNS;
    if (!(in_reach && choose_stretch(c, near))) return false;
    if (!hold_section(c, 0, &of[c->cut])) return false;
    if (!hold_section(c, near + c->slip + c->loose, &of[c->other])) return false;
    *slip = padded_upper(2 * c->slip + 2 * c->loose, 16);
    return true;
}

/* The shorter piece is cut, if that is possible. */
imp_status surface_screw_section(const surface *const s[2], const half_plane_boxes *boxes,
                                 const imp_region *times, double near, half_plane of[2],
                                 double *slip, int *asked)
{
    screw_piece piece[2];
    feature f[2];
    *slip = INFINITY;
    for (int k = 0; k < 2; ++k) {
        bool is_one;
        *asked = k;
        imp_status status = screw_piece_measure(s[k], times, &piece[k], &is_one);
        if (status != IMP_STATUS_OK || !is_one) return status;
        status = feature_carry(s[k], &piece[k].of, times, &f[k]);
        if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    }
    const double off = fabs(piece[0].lead - piece[1].lead);
    if (piece[0].of.kind != piece[1].of.kind || !(off <= IMP_SCREW_SLACK * piece[0].lead))
        return IMP_STATUS_OK;
    const double height[2] = {piece[0].highest - piece[0].lowest,
                              piece[1].highest - piece[1].lowest};
    section c = {.piece = piece, .f = f, .cut = height[1] <= height[0]};
    for (int attempt = 0; attempt < 2 && !(*slip < INFINITY); ++attempt, c.cut = !c.cut) {
        c.other = !c.cut;
        if (!section_of(&c, boxes, near, of, slip)) *slip = INFINITY;
    }
    return IMP_STATUS_OK;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/coil_surface.h"

#include <impinge/formula.h>
#include <string.h>

static int greater_of(const coil_surface *s)
{
    return fabs(s->form.w[0]) >= fabs(s->form.w[1]) ? 0 : 1;
}

/* R depends on w = a u + b v alone, so that any u and v with this w will do: one of them is 0. */
static imp_model radius_of(const coil_surface *s, imp_model w)
{
    imp_model variables[EXPRESSION_VARIABLES_MAX], out[3];
    for (int j = 0; j < EXPRESSION_VARIABLES_MAX; ++j) variables[j] = imp_num(0);
    variables[greater_of(s)] = near_scale(w, s->inverse);
    expression_models(s->radius, variables, out);
    return out[0];
}

static imp_model radius_at(const void *self, imp_model phase)
{
    const coil_surface *s = self;
    return radius_of(s, imp_add(phase, imp_between(-s->slack, s->slack)));
}

static imp_model radius_over(const coil_surface *s, double lo, double hi)
{
    const double from[3] = {lo, 0, 0}, to[3] = {hi, 0, 0};
    const imp_region region = imp_region_between(from, to);
    return radius_of(s, imp_param(&region, 0));
}

static double slope_upper(const void *self, imp_interval phase)
{
    const coil_surface *s = self;
    const double lo = imp_sum_down(phase.lo - s->slack), hi = imp_sum_up(phase.hi + s->slack);
    return radius_over(s, lo, hi).rate[0];
}

/* --- Beginning -------------------------------------------------------------------------------- */

static near_constant quotient(double sign, near_constant x, near_constant y)
{
    near_constant q = near_of(imp_div(near_model(x), near_model(y)));
    q.value *= sign;
    return q;
}

enum { PARTS = 64, FAR = 16 };

/* Finds the least and the greatest radius within one period. */
static bool find_radii(coil_surface *s, double period)
{
    s->base.root = INFINITY;
    s->base.crest = 0;
    for (int k = 0; k < PARTS; ++k) {
        const double lo = period * k / PARTS, hi = period * (k + 1) / PARTS;
        const imp_model radius = radius_over(s, lo - s->slack, hi + s->slack);
        if (!(radius.lo > 0)) return false;
        s->base.root = imp_smaller(s->base.root, radius.lo);
        s->base.crest = imp_larger(s->base.crest, radius.hi);
    }
    return s->base.root < INFINITY && s->base.crest < INFINITY;
}

/* At least |R'| over one period, where it is moved as slack says. */
static double steepest_upper(const coil_surface *s, double period)
{
    double most = 0;
    for (int k = 0; k < PARTS; ++k) {
        const double lo = period * k / PARTS, hi = period * (k + 1) / PARTS;
        most = imp_larger(most, radius_over(s, lo - s->slack, hi + s->slack).rate[0]);
    }
    return most;
}

/* Lemma. Let phi be given by one parameter that turns it by 2 pi (1 - e) at least, and zeta by the
 * other one. A screw by the angle A takes a point to one of the same w at phi + A. If its zeta is
 * one of the surface's, the surface has a point of that zeta at phi + A - 2 pi k, |k| <= |A| / 2
 * pi + 1, but for 2 pi e; its w differs by k turns of phi, so that R does by steepest |k| P drift
 * at most, P the period. The lead is off by its error and a rounding, 2^-52 of it. Each of these
 * is at most a quarter of IMP_SCREW_SLACK: of the radius for e, 2 pi e < 2^-46, of the lead for a
 * turn. */
static bool goes_around(const coil_surface *s, const double lo[2], const double hi[2],
                        near_constant lead, double period)
{
    const coil_form *f = &s->form;
    if (f->around < 0) return false;
    const double width = imp_sum_down(hi[f->around] - lo[f->around]);
    const double turned =
        imp_round_down(imp_sum_down(fabs(f->turning.value) - f->turning.error) * width);
    const double room = 0.25 * IMP_SCREW_SLACK * s->lead;
    const double moved = imp_round_up(imp_round_up(steepest_upper(s, period) * period) * f->drift);
    return turned >= IMP_TWO_PI_UPPER * (1 - 0x1p-49) && moved <= room &&
           imp_sum_up(lead.error + 0x1p-52 * s->lead) <= room;
}

/* Lemma. Let W be the coil's points whose phase is in a range of a whole period that holds those of
 * all points of the surface. A screw motion of exactly this lead keeps phases, so that it takes the
 * surface into W; one of the rounded lead is off by at most lead_off within IMP_SCREW_TURNS turns,
 * and so is the distance.
 *
 * Let p have the phase w by one of its angles, |w| <= far, and y be the nearest to p in W. The
 * phase of y, |.| <= far / FAR, goes on continuously to one of p, at w + k P, P = 2 pi p / kappa,
 * where the way of the lemma in coil.h keeps it within far: |k P| <= 4 far. The F of that branch
 * differs from that of w by as much as R changes where each w in it is moved by some 4 far drift at
 * most, and so does its slope. One of p's branches is in the range, so that y is no farther away
 * than its |F|. The least radius and the greatest are those over one period, from 0 on, and its
 * drift. */
bool coil_surface_begin(coil_surface *s, const double lo[2], const double hi[2])
{
    const coil_form *f = &s->form;
    const imp_model two_pi = imp_scale(imp_const_pi(), 2);
    const near_constant lead = near_of(imp_mul(two_pi, near_model(f->p)));
    const near_constant period = quotient(1, lead, f->kappa);
    imp_interval w = imp_interval_make(0, 0);
    for (int j = 0; j < 2; ++j)
        w = imp_interval_add(w, imp_interval_scale(imp_interval_make(lo[j], hi[j]), f->w[j]));
    const double turn = coil_size_upper(period);
    s->inverse = quotient(1, near_exact(1), near_exact(f->w[greater_of(s)]));
    s->base = (coil){quotient(-1, f->p, f->kappa),
                     quotient(-1, near_exact(1), f->kappa),
                     quotient(-1, f->rest, f->kappa),
                     0,
                     0,
                     FAR * imp_sum_up(imp_interval_mag(w) + turn),
                     NULL,
                     radius_at,
                     slope_upper};
    s->slack = imp_round_up(imp_round_up(4 * s->base.far) * f->drift);
    s->lead = fabs(lead.value);
    s->lead_off = imp_round_up(imp_sum_up(lead.error + 0x1p-52 * s->lead) * IMP_SCREW_TURNS);
    if (!(s->lead >= 1e-100 && s->lead <= 1e100 && s->base.far < 1e100 && s->slack < turn))
        return false;
    s->is_left = (lead.value < 0) != f->is_mirrored;
    s->form.center[f->along] = 0;
    if (!find_radii(s, turn)) return false;
    s->is_closed = goes_around(s, lo, hi, lead, turn);
    return true;
}

/* --- Callbacks -------------------------------------------------------------------------------- */

imp_model coil_surface_gap(const coil_surface *s, const imp_model x[3])
{
    coil c = s->base;
    const int k = s->form.along;
    int i = (k + 1) % 3, j = (k + 2) % 3;
    if (s->form.is_mirrored) {
        const int kept = i;
        i = j, j = kept;
    }
    c.self = s;
    const imp_model gap = coil_gap(&c, imp_shift(x[i], -s->form.center[i]),
                                   imp_shift(x[j], -s->form.center[j]), x[k]);
    return imp_add(gap, imp_between(-s->lead_off, s->lead_off));
}

imp_status coil_surface_symmetry(const coil_surface *s, imp_symmetry *symmetry)
{
    symmetry->kind = s->is_left ? IMP_SYMMETRY_SCREW_LEFT : IMP_SYMMETRY_SCREW_RIGHT;
    symmetry->axis[s->form.along] = s->lead;
    if (s->is_closed) symmetry->is_closed = IMP_SYMMETRY_CLOSED;
    memcpy(symmetry->center, s->form.center, sizeof symmetry->center);
    return IMP_STATUS_OK;
}

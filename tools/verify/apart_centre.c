/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/apart_internal.h"

/* Tests of a leaf before its surfaces' centres are guessed; and boxes that may be wasted by centres
 * of both surfaces. */
enum { TESTS_BEFORE_CENTRES = 3, WASTE_MOST = 1 << 15 };

/* Boxes that the centre of one surface may take beyond GAINED for each cell that it parts. A ball
 * of radius 1 in a bore of 1.01 takes some 1,000 for its first cell, and few for those after it. */
enum { CREDIT = 1 << 12, GAINED = 1 << 8 };

static bool are_worth_it(const prover *p)
{
    return p->centre_count == 1 ? p->spent <= CREDIT : p->wasted <= WASTE_MOST;
}

/* Whether a side turns about a line, so that its distance from that stays, though in this cell it
 * may be on one side of it. */
static bool turns_about(const prover *p, const cell *c, int side, const centre *at)
{
    const orbit *o = apart_orbit(p, c, side);
    return o != NULL && at->is_line && orbit_is_about(o, at->c, at->d, at->size);
}

/* Keeps the centres to be tried, and counts them: those of both surfaces if they are shared, such
 * as of a shaft and its bore; else that of a ball at rest, from which it is everywhere as far as it
 * can be; or the line of one at rest, if the other has none, such as a disc in a bore. Lines that
 * move part little: the leaves of an arm beside a fixture took twice the tests with them; and what
 * is beside a centre, not around it, is parted by axes: a box on rollers took 400 times as long. */
static int choose_centres(prover *p, const cell *c, const place of[2], const bool found[2])
{
    centre *all = p->centres;
    if (found[0] && found[1] && centre_is_shared(&all[0], &all[1])) return 2;
    for (int side = 0; side < 2; ++side) {
        if (!found[side] || (all[side].is_line && found[!side])) continue;
        place other;
        const cell *all_of_it = p->leaf->count[!side] == 1 ? p->leaf : c;
        const box3 where = cell_area(p, all_of_it, !side, 0, &other);
        if (!centre_rests(p->known, &of[side], c->t, &all[side]) ||
            !(turns_about(p, c, !side, &all[side]) ||
              centre_is_amid(p->known, &all[side], &other, &where)))
            continue;
        all[0] = all[side];
        return 1;
    }
    return 0;
}

static void guess_centres(prover *p, const cell *c)
{
    bool found[2];
    place of[2];
    for (int side = 0; side < 2; ++side) of[side] = cell_piece(p, side, c->first[side]);
    p->has_guessed = true;
    if (p->has_missed && p->missed[0] == of[0].piece && p->missed[1] == of[1].piece) return;
    const double t = middle(c->t[0], c->t[1]);
    for (int side = 0; side < 2; ++side)
        found[side] = centre_guess(p->known, &of[side], t, &p->centres[side]);
    p->centre_count = choose_centres(p, c, of, found);
    p->has_missed = !found[0] && !found[1];
    for (int side = 0; side < 2; ++side) p->missed[side] = of[side].piece;
}

/* Notes how many boxes a centre took. */
static void note_cost(prover *p, apart_outcome o, unsigned long cast)
{
    p->wasted = o == APART ? 0 : p->wasted + p->areas[0].count + p->areas[1].count;
    if (p->centre_count != 1) return;
    const size_t gained = o == APART ? GAINED : 0;
    p->spent = p->spent + cast > gained ? p->spent + cast - gained : 0;
}

apart_outcome apart_by_centres(prover *p, const cell *c, apart_trial *tried)
{
    place of[2];
    box3 where[2];
    apart_trial own;
    if (!p->has_guessed && p->tests > TESTS_BEFORE_CENTRES) guess_centres(p, c);
    if (!are_worth_it(p)) return DIVIDE;
    for (int side = 0; side < 2; ++side) where[side] = cell_area(p, c, side, 0, &of[side]);
    for (int k = 0; k < p->centre_count; ++k) {
        aim a[2];
        double change_upper;
        if (!centre_aims(p->known, &p->centres[k], of, where, p->apart, a, &change_upper)) continue;
        const unsigned long before = p->areas[0].cast + p->areas[1].cast;
        const apart_outcome o = apart_try_aims(p, c, a, change_upper, &own);
        note_cost(p, o, p->areas[0].cast + p->areas[1].cast - before);
        /* One centre that does not part even the points that are known says not what to divide. */
        if (p->centre_count > 1 || own.left > -INFINITY) *tried = own;
        if (o != DIVIDE) return o;
    }
    return DIVIDE;
}

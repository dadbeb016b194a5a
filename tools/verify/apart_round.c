/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "tools/verify/apart_internal.h"

/* Where the angle of a map changes by less, all its angles at once bound no better; where one
 * changes by more, they are tried first. */
#define TURNS_LITTLE 0.0625
#define TURNS_MUCH 8

/* Tests of a leaf before all angles are tried of what does not turn much; boxes that they may take
 * beyond GAINED for each cell that they part, and one for so many tests. */
enum { TESTS_BEFORE = 8, CREDIT = 256, GAINED = 128, TESTS_A_BOX = 16 };

static double span_of(const prover *p, const cell *c, int side)
{
    size_t unused;
    const place of = cell_piece(p, side, c->first[side]);
    return orbit_span(&of, c->t[0], c->t[1], &unused);
}

const orbit *apart_orbit(const prover *p, const cell *c, int side)
{
    if (!(span_of(p, c, side) > TURNS_LITTLE)) return NULL;
    const place of = cell_piece(p, side, c->first[side]);
    const orbit *o = look_orbit(p->known, &of, c->t[0], c->t[1]);
    return o->is_known && o->turns ? o : NULL;
}

/* The greatest span of an angle; 0: it is little. */
static double greatest_span(const prover *p, const cell *c)
{
    const double most = proof_larger(span_of(p, c, 0), span_of(p, c, 1));
    return most > TURNS_LITTLE ? most : 0;
}

static bool is_worth_it(const prover *p, double span)
{
    return (span > TURNS_MUCH || p->round_helps || p->tests > TESTS_BEFORE) &&
           p->round_spent <= CREDIT + p->tests / TESTS_A_BOX;
}

bool apart_is_round(const prover *p, const cell *c)
{
    const double span = greatest_span(p, c);
    return span > 0 && is_worth_it(p, span) &&
           (apart_orbit(p, c, 0) != NULL || apart_orbit(p, c, 1) != NULL);
}

bool apart_is_round_first(const prover *p, const cell *c)
{
    return apart_is_round(p, c) && (p->round_helps || greatest_span(p, c) > TURNS_MUCH);
}

/* Whether dividing a cell along u and v may part known points, by how much what was bounded depends
 * on these. */
static bool may_help(const apart_trial *tried)
{
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += tried->size[k / 2][k % 2];
    return tried->beyond < 2 * sum && sum < INFINITY;
}

/* Whether the bound of all angles of both loses little, at the middle of the box: one of its four
 * groups is all of it. */
static bool is_one_group(const orbit_rows *rows, int turns, const kept_circle *of)
{
    orbit_parts r;
    orbit_take_parts(rows->centre, turns, of->centre, CIRCLE_PARTS, &r);
    double x[3][3], most = 0, sum = 0;
    for (int m = 0; m < 3; ++m)
        for (int k = 0; k < 3; ++k) x[m][k] = m < r.turns ? ld_interval_mid(r.at[m][k].v) : 0;
    const double size[4] = {hypot(x[0][1], x[0][2]), hypot(x[1][0], x[2][0]),
                            hypot(x[1][1] + x[2][2], x[2][1] - x[1][2]),
                            hypot(x[1][1] - x[2][2], x[2][1] + x[1][2])};
    for (int k = 0; k < 4; ++k) sum += size[k], most = proof_larger(most, size[k]);
    return sum - most <= 1e-9 * sum;
}

/* Whether all u of a side shall count: it is one piece whose points are circles, which turn about
 * their own axis, or do not turn and are whole. */
static bool has_circles(const prover *p, const cell *c, int side, const double n[3])
{
    place of;
    if (c->count[side] > 1) return false;
    const box3 where = cell_area(p, c, side, 0, &of);
    box3 whole = where;
    piece_box(&of, &whole);
    const kept_circle *circles = look_circle(p->known, &of, &where);
    const orbit *o = look_orbit(p->known, &of, c->t[0], c->t[1]);
    if (circles == NULL || !o->is_known) return false;
    const bool is_whole = where.lo[U] == whole.lo[U] && where.hi[U] == whole.hi[U];
    if (!is_whole && !(o->span > TURNS_MUCH)) return false;
    const orbit_rows *rows = look_rows(p->known, &of, c->t[0], c->t[1], n);
    return is_one_group(rows, o->turns ? 3 : 1, circles);
}

static void note_cost(prover *p, apart_outcome o, unsigned long cast)
{
    const size_t gained = o == APART ? GAINED : 0;
    p->round_helps = o == APART;
    p->round_spent = p->round_spent + cast > gained ? p->round_spent + cast - gained : 0;
}

/* Lemma. For each side either bound holds at each time of the cell (shadow.c), so any of them do
 * together. */
apart_outcome apart_by_all_angles(prover *p, const cell *c, const aim a[2], double change_upper,
                                  apart_trial *tried)
{
    aim all[2] = {a[0], a[1]};
    for (int side = 0; side < 2; ++side) {
        all[side].circles = has_circles(p, c, side, a[side].n);
        all[side].is_round = all[side].circles || apart_orbit(p, c, side) != NULL;
    }
    const unsigned long before = p->areas[0].cast + p->areas[1].cast;
    const apart_outcome o = apart_try_aims(p, c, all, change_upper, tried);
    note_cost(p, o, p->areas[0].cast + p->areas[1].cast - before);
    return o;
}

apart_outcome apart_by_angles(prover *p, const cell *c, const aim a[2], double change_upper,
                              apart_trial *tried)
{
    const bool some = apart_is_round(p, c), is_first = some && apart_is_round_first(p, c);
    apart_trial other;
    if (is_first) {
        const apart_outcome o = apart_by_all_angles(p, c, a, change_upper, tried);
        if (o != DIVIDE || tried->cut.along >= 0 || may_help(tried)) return o;
    }
    const apart_outcome o = apart_try_aims(p, c, a, change_upper, tried);
    if (o != DIVIDE || !some || is_first || tried->cut.along >= 0) return o;
    const apart_outcome by_angles = apart_by_all_angles(p, c, a, change_upper, &other);
    if (other.left > tried->left) *tried = other;
    return by_angles;
}

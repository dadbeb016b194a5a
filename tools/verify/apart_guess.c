/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "tools/verify/apart_internal.h"

/* Pieces of a side that are looked at: all of fewer than this many, else every so many. */
enum { SEEN = 16 };

/* Corners of pieces, four at each end of the time, and the box around the pieces' middles. */
typedef struct seen {
    int count;
    bool is_all;
    double corner[SEEN][8][3], lo[3], hi[3];
} seen;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* du x dv of a piece, from the means of the corners of each edge. */
static void take_normal(double corner[8][3], double n[3])
{
    double u[3] = {0, 0, 0}, v[3] = {0, 0, 0};
    for (int k = 0; k < 8; ++k)
        for (int i = 0; i < 3; ++i) {
            u[i] += (k & 1) != 0 ? corner[k][i] : -corner[k][i];
            v[i] += (k & 2) != 0 ? corner[k][i] : -corner[k][i];
        }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        n[i] = u[j] * v[l] - u[l] * v[j];
    }
}

static void look_at_side(prover *p, const cell *c, int side, seen *s)
{
    const size_t count = c->count[side], step = count >= SEEN ? count / (SEEN / 2) : 1;
    s->count = 0;
    s->is_all = count < SEEN;
    for (int i = 0; i < 3; ++i) s->lo[i] = INFINITY, s->hi[i] = -INFINITY;
    for (size_t k = 0; k < count && s->count < SEEN; k += step) {
        place of;
        form x;
        split unused;
        double mid[3];
        const box3 where = cell_area(p, c, side, k, &of);
        if (look_net(p->known, &of, &where, &x, &unused) != ENCLOSED || x.net == NULL) continue;
        net_points(&x, s->corner[s->count++], mid);
        for (int i = 0; i < 3; ++i) {
            s->lo[i] = proof_smaller(s->lo[i], mid[i]);
            s->hi[i] = proof_larger(s->hi[i], mid[i]);
        }
    }
}

/* How far the corners of B are beyond those of A along n, for its length, at the worse end. */
static double room_along(seen side[2], const double n[3])
{
    double room = INFINITY;
    for (int end = 0; end < 2; ++end) {
        double most[2] = {-INFINITY, -INFINITY};
        for (int s = 0; s < 2; ++s)
            for (int k = 0; k < side[s].count; ++k)
                for (int j = 4 * end; j < 4 * end + 4; ++j)
                    most[s] = fmax(most[s], (s == 0 ? 1 : -1) * dot(side[s].corner[k][j], n));
        room = fmin(room, -most[0] - most[1]);
    }
    return room / sqrt(dot(n, n));
}

/* Chooses the normal of a piece, of a side of several such as a box, that seems to part the sides:
 * of the face on which a part slides or turns. The direction of the centres misses it by more than
 * the gap leaves. 0: none does. */
static void choose_face(const prover *p, seen side[2], int own, double to[3])
{
    double most = p->apart, n[3];
    memset(to, 0, 3 * sizeof *to);
    for (int k = 0; k < side[own].count && side[own].is_all; ++k) {
        take_normal(side[own].corner[k], n);
        for (int sign = 0; sign < 2; ++sign) {
            for (int i = 0; i < 3; ++i) n[i] = -n[i];
            const double room = room_along(side, n);
            if (!(room > most)) continue;
            most = room;
            memcpy(to, n, sizeof n);
        }
    }
}

/* --- Sides that turn -------------------------------------------------------------------------- */

/* The middle of a side's middles: where it is, if it does not turn, or else the middle of its
 * orbit, and the radius of that. */
typedef struct amid {
    double at[3], radius, axis[3];
    bool turns;
} amid;

/* False: it is not known. */
static bool take_amid(prover *p, const cell *c, int side, const seen *s, amid *to)
{
    const orbit *o = apart_orbit(p, c, side);
    place bare;
    *to = (amid){.turns = o != NULL && orbit_axis(o, to->axis)};
    for (int i = 0; i < 3; ++i) to->at[i] = 0.5 * s->lo[i] + 0.5 * s->hi[i];
    if (!to->turns) return s->count > 0;
    double x[3] = {0, 0, 0}, turned[3], square = 0;
    const size_t count = c->count[side] < SEEN ? c->count[side] : 1;
    for (size_t k = 0; k < count; ++k) {
        const box3 where = cell_area(p, c, side, k, &bare);
        bare.maps = 0;
        const kept *of = look_jets(p->known, &bare, &where);
        if (of->result != ENCLOSED) return false;
        for (int i = 0; i < 3; ++i) x[i] += ld_interval_mid(of->centre[i].v) / (double)count;
    }
    orbit_points(o, x, to->at, turned);
    for (int i = 0; i < 3; ++i) square += turned[i] * turned[i];
    to->radius = sqrt(square);
    return true;
}

/* Moves the middle of an orbit to the point of it that is nearest to another middle, about. Writes
 * the direction in which that is seen from the middle, across the axis. */
static void face(amid *side, const double other[3], double out[3])
{
    double along = 0;
    for (int i = 0; i < 3; ++i) out[i] = other[i] - side->at[i];
    for (int i = 0; i < 3; ++i) along += out[i] * side->axis[i];
    for (int i = 0; i < 3; ++i) out[i] -= along * side->axis[i];
    const double length = sqrt(dot(out, out));
    for (int i = 0; i < 3 && length > 0; ++i) side->at[i] += side->radius * out[i] / length;
}

static void find_turning_axes(prover *p, const cell *c, const seen side[2], double n[4][3])
{
    amid of[2], was[2];
    memset(n, 0, 4 * sizeof n[0]);
    for (int s = 0; s < 2; ++s)
        if (!take_amid(p, c, s, &side[s], &of[s])) return;
    if (!of[0].turns && !of[1].turns) return;
    memcpy(was, of, sizeof was);
    for (int s = 0; s < 2; ++s) {
        double out[3];
        if (!of[s].turns) continue;
        face(&of[s], was[!s].at, out);
        for (int i = 0; i < 3 && (s == 0 || !of[0].turns); ++i) n[1][i] = s == 0 ? out[i] : -out[i];
        memcpy(n[2 + s], of[s].axis, sizeof n[0]);
    }
    for (int i = 0; i < 3; ++i) n[0][i] = of[1].at[i] - of[0].at[i];
    for (int k = 2; k < 4; ++k) {
        const double sign = dot(n[k], n[0]) < 0 ? -1 : 1;
        for (int i = 0; i < 3; ++i) n[k][i] *= sign;
    }
}

void apart_find_axes(prover *p, const cell *c, double n[AXES][3])
{
    seen side[2];
    memset(n, 0, AXES * sizeof n[0]);
    for (int s = 0; s < 2; ++s) look_at_side(p, c, s, &side[s]);
    for (int i = 0; i < 3; ++i)
        n[0][i] =
            0.5 * side[1].lo[i] + 0.5 * side[1].hi[i] - (0.5 * side[0].lo[i] + 0.5 * side[0].hi[i]);
    for (int s = 0; s < 2; ++s) {
        double *to = n[1 + s];
        memset(to, 0, sizeof n[0]);
        if (c->count[s] > 1) {
            choose_face(p, side, s, to);
        } else if (side[s].count == 1) {
            take_normal(side[s].corner[0], to);
            const double sign = dot(to, n[0]) < 0 ? -1 : 1;
            for (int i = 0; i < 3; ++i) to[i] *= sign;
        }
    }
    if (apart_is_round(p, c)) {
        double first[3];
        find_turning_axes(p, c, side, &n[AXES_AT_REST]);
        memcpy(first, n[AXES_AT_REST], sizeof first);
        if (!apart_is_round_first(p, c)) return;
        memcpy(n[AXES_AT_REST], n[0], sizeof first);
        memcpy(n[0], first, sizeof first);
    }
}

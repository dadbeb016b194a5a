/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/glance.h"

#include <math.h>
#include <string.h>

#include "core/surface/carried.h"

static const double moments[GLANCES] = {0, 0.37, 1};

#define SURELY_APART 0x1p-12

static double distance(const double x[3], const double y[3])
{
    double square = 0;
    for (int i = 0; i < 3; ++i) square += (y[i] - x[i]) * (y[i] - x[i]);
    return sqrt(square);
}

imp_status surface_find_middle(const surface *s, glance_middle *found)
{
    const imp_status status = surface_closed_symmetry(s, true, &found->closed);
    found->is_closed = status == IMP_STATUS_OK;
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

/* Replaces the end of an axis by its direction. */
static void take_axis(const double from[3], double axis[3])
{
    const double length = distance(from, axis);
    for (int i = 0; i < 3; ++i) axis[i] = (axis[i] - from[i]) / length;
}

void surface_glance_at(const surface *s, const glance_middle *middle, double from, double to,
                       surface_glance *g)
{
    imp_symmetry own;
    const imp_symmetry *const closed = &middle->closed;
    const bool is_closed = middle->is_closed;
    *g = (surface_glance){.from = from, .to = to, .has_middle = true, .is_known = true};
    g->has_axis = is_closed && closed->kind == IMP_SYMMETRY_ABOUT_LINE;
    g->is_about = is_closed && surface_symmetry(s, &own) == IMP_STATUS_OK &&
                  (own.kind == IMP_SYMMETRY_ABOUT_POINT || own.kind == IMP_SYMMETRY_ABOUT_LINE);
    for (int k = 0; k < GLANCES; ++k) {
        double x[2][3];
        const double t = from + moments[k] * (to - from);
        memcpy(x[0], is_closed ? closed->center : middle->point, sizeof x[0]);
        for (int i = 0; i < 3; ++i) x[1][i] = x[0][i] + (g->has_axis ? closed->axis[i] : 0);
        const size_t count = g->has_axis ? 2 : 1;
        if (surface_move_outward(s, 0, t, count, x[0]) != IMP_STATUS_OK) g->is_known = false;
        if (g->has_axis) take_axis(x[0], x[1]);
        memcpy(g->at[k], x[0], sizeof x[0]);
        memcpy(g->axis[k], x[1], sizeof x[1]);
    }
}

/* The least and the greatest distance of the middles. */
static void find_extremes(const surface_glance *a, const surface_glance *b, double *least,
                          double *most)
{
    *least = INFINITY, *most = 0;
    for (int k = 0; k < GLANCES; ++k) {
        const double apart = distance(a->at[k], b->at[k]);
        if (!(apart >= *least)) *least = apart;
        if (!(apart <= *most)) *most = apart;
    }
}

bool glances_part(const surface_glance *a, const surface_glance *b)
{
    double least, most;
    find_extremes(a, b, &least, &most);
    return a->is_known && b->is_known && most - least > SURELY_APART * most;
}

/* Lemma. Let x be carried by a, and c(t) be b's middle as a sees it. A motion that takes c(t0) to
 * c(t) moves it by |c(t) - c(t0)|, so that this is no greater than the slip, whatever the moment
 * t0. Of two times, one differs from t0 by at least half of ||c(t1) - x| - |c(t2) - x||. */
double glances_vary(const surface_glance *a, const surface_glance *b)
{
    double least, most;
    find_extremes(a, b, &least, &most);
    return a->is_known && b->is_known && b->is_about ? 0.5 * (most - least) : 0;
}

double glance_turns(const surface_glance *g)
{
    double most = 0;
    for (int k = 1; k < GLANCES && g->is_known && g->has_axis; ++k)
        for (int j = 0; j < k; ++j) {
            const double turn = distance(g->axis[j], g->axis[k]);
            if (turn > most) most = turn;
        }
    return 0.5 * most;
}

bool glances_are_off_line(const surface_glance *a, const surface_glance *b, double most)
{
    double square = 0, size = 0;
    if (!a->is_known || !b->is_known || !a->has_axis) return false;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double across = (b->at[0][j] - a->at[0][j]) * a->axis[0][k] -
                              (b->at[0][k] - a->at[0][k]) * a->axis[0][j];
        square += across * across;
        size += fabs(a->at[0][i]) + fabs(b->at[0][i]);
    }
    return sqrt(square) > most + 0x1p-40 * size;
}

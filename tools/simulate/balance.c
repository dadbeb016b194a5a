/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/balance.h"

#include <stdlib.h>
#include <string.h>

/* What is computed with: the start, and impulses of all points in a row. */
typedef struct descent {
    impact_body *bodies, *start;
    size_t body_count, count, points;
    impact_contact *contacts;
    vec *now, *ahead, *next, *slope; /* impulses, where the slope is taken, the next; the slope */
} descent;

/* Computes the bodies after these impulses. Returns their kinetic energy. */
static double apply(const descent *d, const vec *impulse)
{
    double energy = 0;
    size_t n = 0;
    memcpy(d->bodies, d->start, d->body_count * sizeof *d->bodies);
    for (size_t k = 0; k < d->count; ++k)
        for (size_t i = 0; i < d->contacts[k].count; ++i, ++n) {
            const impact_contact *c = &d->contacts[k];
            impact_exchange(&d->bodies[c->body[0]], &d->bodies[c->body[1]], c->point[i].at,
                            impulse[n]);
        }
    for (size_t b = 0; b < d->body_count; ++b) energy += impact_energy(&d->bodies[b]);
    return energy;
}

/* The point of the cone of friction that is nearest to x. */
static vec project(vec x, vec normal, double mu)
{
    const double along = vec_dot(x, normal);
    const vec across = vec_along(x, -along, normal);
    const double size = vec_length(across);
    if (size <= mu * along) return x;
    if (mu * size <= -along) return (vec){{0, 0, 0}};
    const double height = (along + mu * size) / (1 + mu * mu);
    return vec_along(vec_scale(height, normal), size > 0 ? mu * height / size : 0, across);
}

/* Computes the velocities at all points: the slope of the energy. Returns the greatest. */
static double find_slope(const descent *d)
{
    double most = 0;
    size_t n = 0;
    for (size_t k = 0; k < d->count; ++k)
        for (size_t i = 0; i < d->contacts[k].count; ++i, ++n) {
            d->slope[n] = impact_velocity(d->bodies, &d->contacts[k], i);
            most = fmax(most, vec_length(d->slope[n]));
        }
    for (size_t b = 0; b < d->body_count; ++b)
        if (d->bodies[b].yields) most = fmax(most, vec_length(d->bodies[b].velocity));
    return most;
}

/* Takes one step of the length 1 / steepness from d->ahead to d->next. Returns what the energy may
 * be at most if the step is not too long. */
static double step(const descent *d, double energy, double steepness)
{
    size_t n = 0;
    double bound = energy;
    for (size_t k = 0; k < d->count; ++k)
        for (size_t i = 0; i < d->contacts[k].count; ++i, ++n) {
            const impact_contact *c = &d->contacts[k];
            const vec down = vec_along(d->ahead[n], -1 / steepness, d->slope[n]);
            d->next[n] = project(down, c->normal, c->friction);
            const vec way = vec_sub(d->next[n], d->ahead[n]);
            bound += vec_dot(d->slope[n], way) + steepness / 2 * vec_dot(way, way);
        }
    return bound;
}

/* Goes on to the next impulses and ahead of them. Returns whether the way has turned uphill. */
static bool advance(const descent *d, double momentum)
{
    double climb = 0;
    for (size_t n = 0; n < d->points; ++n) {
        const vec way = vec_sub(d->next[n], d->now[n]);
        climb += vec_dot(vec_sub(d->ahead[n], d->next[n]), way);
        d->now[n] = d->next[n];
        d->ahead[n] = vec_along(d->next[n], momentum, way);
    }
    return climb > 0;
}

/* A sum of impulses that stop one body of the least mass is found in steps of about this steepness.
 */
static double first_steepness(const descent *d)
{
    double most = 0;
    for (size_t b = 0; b < d->body_count; ++b)
        if (d->bodies[b].yields) most = fmax(most, 1 / d->bodies[b].mass);
    return most;
}

static void descend(descent *d, double enough)
{
    enum { STEPS_MAX = 4000, PATIENCE = 200 };
    double theta = 1, steepness = first_steepness(d), best = INFINITY, last = INFINITY;
    if (!(steepness > 0)) return;
    for (int n = 0; n < STEPS_MAX; ++n) {
        const double energy = apply(d, d->ahead);
        best = fmin(best, energy);
        if (find_slope(d) <= enough) break;
        if (n % PATIENCE == PATIENCE - 1) {
            if (best > 0.9 * last) break;
            last = best;
        }
        double bound = step(d, energy, steepness);
        while (apply(d, d->next) > bound + 1e-12 * energy && steepness < 1e300) {
            steepness *= 2;
            bound = step(d, energy, steepness);
        }
        const double square = theta * theta;
        const double after = (sqrt(square * square + 4 * square) - square) / 2;
        if (advance(d, theta * (1 - theta) / (square + after))) {
            memcpy(d->ahead, d->now, d->points * sizeof *d->now);
            theta = 1;
        } else {
            theta = after;
        }
        steepness *= 0.97;
    }
}

void balance_find(impact_body *bodies, size_t body_count, impact_contact *contacts, size_t count,
                  double enough)
{
    descent d = {.bodies = bodies, .body_count = body_count, .contacts = contacts, .count = count};
    for (size_t k = 0; k < count; ++k) d.points += contacts[k].count;
    d.start = malloc((body_count + 1) * sizeof *d.start);
    vec *room = calloc(4 * d.points + 1, sizeof *room);
    if (d.start != NULL && room != NULL) {
        memcpy(d.start, bodies, body_count * sizeof *bodies);
        d.now = room, d.ahead = room + d.points;
        d.next = room + 2 * d.points, d.slope = room + 3 * d.points;
        descend(&d, enough);
    }
    free(d.start);
    free(room);
}

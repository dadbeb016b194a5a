/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/mover.h"

#include <stdlib.h>

#include "core/common/array.h"

/* --- Keys ------------------------------------------------------------------------------------- */

static bool keys_add(mover_keys *k, mover_key key)
{
    mover_key *grown = array_reserve(k->key, k->count, &k->capacity, sizeof *grown);
    if (grown == NULL) return false;
    k->key = grown;
    k->key[k->count++] = key;
    return true;
}

/* Returns the last key at t or before. */
static const mover_key *key_before(const mover_keys *k, double t)
{
    size_t lo = 0, hi = k->count;
    while (hi - lo > 1) {
        const size_t middle = lo + (hi - lo) / 2;
        if (k->key[middle].t <= t)
            lo = middle;
        else
            hi = middle;
    }
    return &k->key[lo];
}

/* --- Turning ---------------------------------------------------------------------------------- */

static vec spin_of(const mover *m, quat rotation, vec momentum)
{
    const mat3 axes = mat3_of_quat(rotation);
    const vec inner = mat3_apply(&m->inverse, mat3_apply_transposed(&axes, momentum));
    return mat3_apply(&axes, inner);
}

/* Returns one step of the classical Runge-Kutta method for dq/dt = (0, spin(q)) q / 2. */
static quat runge_kutta(const mover *m, quat q, vec momentum, double h)
{
    quat at = q, sum = {0, {{0, 0, 0}}};
    static const double part[4] = {0.5, 0.5, 1, 0}, weight[4] = {1, 2, 2, 1};
    for (int k = 0; k < 4; ++k) {
        const vec half = vec_scale(0.5, spin_of(m, quat_unit(at), momentum));
        const quat slope = {-vec_dot(half, at.v),
                            vec_add(vec_scale(at.w, half), vec_cross(half, at.v))};
        sum.w += weight[k] * slope.w;
        sum.v = vec_along(sum.v, weight[k], slope.v);
        at = (quat){q.w + part[k] * h * slope.w, vec_along(q.v, part[k] * h, slope.v)};
    }
    return quat_unit((quat){q.w + h / 6 * sum.w, vec_along(q.v, h / 6, sum.v)});
}

/* Returns the rotation vector that leads from p to q, at most half a turn. */
static vec turn_between(quat p, quat q)
{
    const quat back = {p.w, vec_scale(-1, p.v)};
    quat d = quat_mul(q, back);
    if (d.w < 0) d = (quat){-d.w, vec_scale(-1, d.v)};
    const double sine = vec_length(d.v);
    return sine > 0 ? vec_scale(2 * atan2(sine, d.w) / sine, d.v) : d.v;
}

#define SUBSTEP_ANGLE 0.2  /* radians a sub-step turns at most */
#define SUBSTEP_ERROR 2e-4 /* radians between the orientation shown and the one computed */
#define SUBSTEPS_MAX 20000 /* of one path; beyond it they grow longer, and the error with them */
#define SUBSTEP_PARTS 8
#define PRINCIPAL_SLACK 1e-9

/* Returns how long a sub-step may be; at most `span`. The spin changes at most by |spin|^2 a unit
 * of time. */
static double substep(const mover *m, vec momentum, quat rotation, double span)
{
    const vec spin = spin_of(m, rotation, momentum);
    const double rate = vec_length(spin), size = rate * vec_length(momentum);
    const double known = isnan(m->actor->mass_error) ? 0 : 4 * m->actor->mass_error;
    const double off = vec_length(vec_cross(spin, momentum));
    if (!(off > fmax(PRINCIPAL_SLACK, known) * size)) return span;
    const mat3 axes = mat3_of_quat(rotation), inverse = mat3_turned(&axes, &m->inverse);
    const double change =
        vec_length(mat3_apply(&inverse, vec_cross(momentum, spin))); /* |d spin/dt|, about */
    const double h = fmin(SUBSTEP_ANGLE / rate, sqrt(8 * SUBSTEP_ERROR / change));
    return fmin(span, fmax(h, span / SUBSTEPS_MAX));
}

/* One key of the path; *at goes on to the time `to`, its place not yet. */
static bool add_substep(mover *m, mover_key *at, vec momentum, double to)
{
    const double h = to - at->t;
    quat q = at->rotation, middle = q;
    for (int k = 0; k < SUBSTEP_PARTS; ++k) {
        q = runge_kutta(m, q, momentum, h / SUBSTEP_PARTS);
        if (2 * (k + 1) == SUBSTEP_PARTS) middle = q;
    }
    at->spin = vec_scale(1 / h, turn_between(at->rotation, q));
    const quat shown = quat_mul(quat_of_spin(at->spin, h / 2), at->rotation);
    const double off = vec_length(turn_between(shown, middle));
    if (off > m->substep_error) m->substep_error = off;
    if (!keys_add(&m->path, *at)) return false;
    at->rotation = q;
    return true;
}

/* Moves the centre along its parabola up to a time. */
static void fly(mover_key *at, double to)
{
    const double h = to - at->t;
    at->position =
        vec_along(vec_along(at->position, h, at->velocity), 0.5 * h * h, at->acceleration);
    at->velocity = vec_along(at->velocity, h, at->acceleration);
    at->t = to;
}

/* Without sub-steps if one holds for all of the path. */
static bool add_path(mover *m, mover_key at, double end)
{
    const double span = end - at.t;
    while (at.t < end) {
        const double h = substep(m, m->momentum, at.rotation, span);
        const double to = at.t + h > at.t && at.t + h < end ? at.t + h : end;
        if (h < span) {
            if (!add_substep(m, &at, m->momentum, to)) return false;
        } else {
            const vec spin = spin_of(m, at.rotation, m->momentum);
            at.spin = vec_length(spin) > 1e-90 ? spin : (vec){{0, 0, 0}};
            if (!keys_add(&m->path, at)) return false;
            at.rotation = quat_mul(quat_of_spin(at.spin, to - at.t), at.rotation);
        }
        fly(&at, to);
    }
    return keys_add(&m->path, at);
}

/* --- As a map --------------------------------------------------------------------------------- */

static json_t *vector_json(vec v) { return json_pack("[f,f,f]", v.x[0], v.x[1], v.x[2]); }

static json_t *rotation_json(quat q)
{
    return json_pack("[f,f,f,f]", q.w, q.v.x[0], q.v.x[1], q.v.x[2]);
}

static bool turns(const mover_key *keys, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (vec_length(keys[i].spin) > 0 || vec_length(keys[i].rotation.v) > 0) return true;
    return false;
}

static json_t *keys_json(const mover *m, const mover_key *keys, size_t count)
{
    json_t *map = json_pack("{s:s, s:o, s:[], s:[], s:[]}", "type", "trajectory", "center",
                            vector_json(m->actor->center), "times", "positions", "accelerations");
    json_t *times = json_object_get(map, "times"), *positions = json_object_get(map, "positions");
    json_t *accelerations = json_object_get(map, "accelerations");
    json_t *rotations = NULL, *spins = NULL;
    int failed = map == NULL;
    if (turns(keys, count)) {
        rotations = json_array(), spins = json_array();
        failed |= json_object_set_new(map, "rotations", rotations);
        failed |= json_object_set_new(map, "spins", spins);
    }
    for (size_t i = 0; i < count; ++i) {
        const mover_key *key = &keys[i];
        failed |= json_array_append_new(times, json_real(key->t));
        failed |= json_array_append_new(positions, vector_json(key->position));
        if (rotations != NULL)
            failed |= json_array_append_new(rotations, rotation_json(key->rotation));
        if (i + 1 == count) break;
        failed |= json_array_append_new(accelerations, vector_json(key->acceleration));
        if (spins != NULL) failed |= json_array_append_new(spins, vector_json(key->spin));
    }
    if (!failed) return map;
    json_decref(map);
    return NULL;
}

/* --- One mover -------------------------------------------------------------------------------- */

static mover_key key_of(const mover *m, double t, const mover_state *s)
{
    return (mover_key){.t = t,
                       .position = s->position,
                       .velocity = s->velocity,
                       .acceleration = m->acceleration,
                       .rotation = s->rotation};
}

static bool new_path(mover *m, double t, const mover_state *state, vec acceleration, double end)
{
    m->acceleration = acceleration;
    m->momentum = state->momentum;
    m->path.count = 0;
    json_decref(m->map);
    m->map = NULL;
    if (!add_path(m, key_of(m, t, state), end)) return false;
    m->map = keys_json(m, m->path.key, m->path.count);
    return m->map != NULL;
}

bool mover_begin(mover *m, const actor *a, vec gravity, double start, double end)
{
    *m = (mover){.actor = a, .inverse = mat3_inverse(&a->inertia)};
    const mover_state state = {.position = a->center,
                               .velocity = a->velocity,
                               .rotation = quat_identity(),
                               .momentum = mat3_apply(&a->inertia, a->spin),
                               .spin = a->spin};
    return new_path(m, start, &state, gravity, end);
}

static bool is_moderate(vec x, double most)
{
    for (int i = 0; i < 3; ++i)
        if (!(fabs(x.x[i]) <= most)) return false;
    return true;
}

double mover_overflow(const mover *m)
{
    for (size_t i = 0; i < m->path.count; ++i) {
        const mover_key *key = &m->path.key[i];
        const double span = m->path.key[m->path.count - 1].t - key->t;
        if (!is_moderate(key->position, VALUE_MAX) || !is_moderate(key->velocity, VALUE_MAX) ||
            !is_moderate(m->momentum, VALUE_MAX * VALUE_MAX) ||
            !is_moderate(key->spin, VALUE_MAX) || !(vec_length(key->spin) * span <= TURN_MAX))
            return key->t;
    }
    return NAN;
}

void mover_free(mover *m)
{
    free(m->done.key);
    free(m->path.key);
    json_decref(m->map);
}

mover_state mover_at(const mover *m, double t)
{
    mover_key key = *key_before(&m->path, t);
    const quat turned = quat_mul(quat_of_spin(key.spin, t - key.t), key.rotation);
    fly(&key, t);
    return (mover_state){.position = key.position,
                         .velocity = key.velocity,
                         .rotation = turned,
                         .momentum = m->momentum,
                         .spin = spin_of(m, turned, m->momentum)};
}

bool mover_turn(mover *m, double t, const mover_state *state, vec acceleration, double end)
{
    for (size_t i = 0; i < m->path.count && m->path.key[i].t < t; ++i)
        if (!keys_add(&m->done, m->path.key[i])) return false;
    return new_path(m, t, state, acceleration, end);
}

mat3 mover_axes(const mover_state *s) { return mat3_of_quat(s->rotation); }

mat3 mover_inverse_inertia(const mover *m, const mover_state *s)
{
    const mat3 axes = mover_axes(s);
    return mat3_turned(&axes, &m->inverse);
}

void mover_spin_update(const mover *m, mover_state *s)
{
    s->spin = spin_of(m, s->rotation, s->momentum);
}

double mover_kinetic_energy(const mover *m, const mover_state *s)
{
    return 0.5 *
           (m->actor->mass * vec_dot(s->velocity, s->velocity) + vec_dot(s->spin, s->momentum));
}

json_t *mover_trajectory(const mover *m, double t)
{
    mover_keys all = {0};
    bool good = true;
    for (size_t i = 0; i < m->done.count && good; ++i) good = keys_add(&all, m->done.key[i]);
    for (size_t i = 0; i < m->path.count && good && m->path.key[i].t < t; ++i)
        good = keys_add(&all, m->path.key[i]);
    const mover_state last = mover_at(m, t);
    if (good) good = keys_add(&all, key_of(m, t, &last));
    json_t *map = good ? keys_json(m, all.key, all.count) : NULL;
    free(all.key);
    return map;
}

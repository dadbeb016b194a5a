/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/actor.h"

#include "tools/simulate/mass.h"
#include "tools/simulate/mover.h"
#include "tools/simulate/values.h"

static const char *const actor_keys[] = {"mass", "inertia",     "center",   "velocity",
                                         "spin", "restitution", "friction", NULL};
static const char *const moving_keys[] = {"inertia", "center", "velocity", "spin", NULL};

void actor_strip(json_t *body)
{
    for (const char *const *key = actor_keys; *key != NULL; ++key) json_object_del(body, *key);
}

/* --- Mass properties -------------------------------------------------------------------------- */

static exit_status refuse_shape(value_place at, shape_verdict verdict, vec where,
                                const imp_error *error)
{
    static const char cure[] = "give \"inertia\" and \"center\"";
    at.key = "surfaces";
    switch (verdict) {
    case SHAPE_FOUND:
    case SHAPE_STOPPED:
        break;
    case SHAPE_OPEN:
        return value_refuse(at,
                            "found an open surface: nothing borders on its edge at [%g,%g,%g], so "
                            "it encloses no volume to integrate; close it, or %s",
                            where.x[0], where.x[1], where.x[2], cure);
    case SHAPE_ONE_SIDED:
        return value_refuse(at,
                            "found a surface without an inside: it returns to [%g,%g,%g] with its "
                            "other side; %s",
                            where.x[0], where.x[1], where.x[2], cure);
    case SHAPE_FLAT:
        return value_refuse(at, "found surfaces that enclose no volume to integrate; %s", cure);
    case SHAPE_UNBOUNDED:
        return value_refuse(at,
                            "found points farther than 1e50 from the origin, too far to integrate; "
                            "choose other units, or %s",
                            cure);
    case SHAPE_NO_MEMORY:
        return complain_of_memory("simulate");
    case SHAPE_FAULT:
        return complain_of(error, "simulate");
    }
    return EXIT_ANSWERED;
}

/* Returns the inertia of the mass about its center, from that of uniform density (Steiner's
 * theorem). */
static mat3 inertia_of(const actor *a, const mass_properties *found)
{
    const vec d = vec_sub(a->center, found->center);
    mat3 inertia;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            inertia.m[i][j] =
                a->mass * (found->inertia.m[i][j] + (i == j ? vec_dot(d, d) : 0) - d.x[i] * d.x[j]);
    return inertia;
}

static exit_status integrate(setup *s, value_place at, bool has_inertia, bool has_center)
{
    actor *a = &s->actors[at.body];
    patches p;
    mass_properties found;
    vec where = {{0, 0, 0}};
    imp_error error = {0};
    shape_verdict verdict =
        patches_read(&p, s->still, at.body, s->options.t_start, &s->limits, &error);
    if (verdict == SHAPE_FOUND) verdict = mass_integrate(&p, &found, &where, &error);
    patches_free(&p);
    if (verdict == SHAPE_STOPPED) {
        a->inertia_known = has_inertia;
        if (!has_inertia) a->inertia = mat3_diagonal(a->mass);
    }
    if (verdict != SHAPE_FOUND) return refuse_shape(at, verdict, where, &error);
    a->volume = found.volume;
    a->mass_error = found.error;
    if (!has_center) a->center = found.center;
    if (!has_inertia) a->inertia = inertia_of(a, &found);
    const double size = mat3_greatest(&a->inertia);
    if (size >= 1 / VALUE_MAX && size <= VALUE_MAX) return EXIT_ANSWERED;
    at.key = "mass";
    return value_refuse(at, "found an inertia of %g, must be from %g to %g; choose other units",
                        size, 1 / VALUE_MAX, VALUE_MAX);
}

static exit_status find_mass(setup *s, value_place at, const json_t *object)
{
    actor *a = &s->actors[at.body];
    const bool has_inertia = json_object_get(object, "inertia") != NULL;
    const bool has_center = json_object_get(object, "center") != NULL;
    at.key = "center";
    exit_status status = value_vector(at, object, &a->center);
    at.key = "inertia";
    if (status == EXIT_ANSWERED) status = value_inertia(at, object, &a->inertia);
    if (status != EXIT_ANSWERED || (has_inertia && has_center)) return status;
    return integrate(s, at, has_inertia, has_center);
}

/* --- One body --------------------------------------------------------------------------------- */

static exit_status check_parent(const setup *s, value_place at, const json_t *object)
{
    at.key = "parent";
    const json_t *parent = json_object_get(object, at.key);
    if (parent == NULL) return EXIT_ANSWERED;
    if (json_object_get(object, "mass") != NULL)
        return value_refuse(at, "found on a body with a mass, which moves by itself; remove one of "
                                "them");
    const size_t found = setup_find(s, json_string_value(parent));
    const json_t *bodies = json_object_get(s->root, "bodies");
    if (found < s->count && json_object_get(json_array_get(bodies, found), "mass") != NULL)
        return value_refuse(at, "got \"%.80s\", which has a mass; must be a body without",
                            json_string_value(parent));
    return EXIT_ANSWERED;
}

static exit_status read_motion(const setup *s, value_place at, const json_t *object)
{
    actor *a = &s->actors[at.body];
    at.key = "velocity";
    exit_status status = value_vector(at, object, &a->velocity);
    at.key = "spin";
    if (status == EXIT_ANSWERED) status = value_vector(at, object, &a->spin);
    if (status != EXIT_ANSWERED) return status;
    const double turn = vec_length(a->spin) * (s->options.t_end - s->options.t_start);
    if (turn <= TURN_MAX) return EXIT_ANSWERED;
    return value_refuse(at, "found a turn by %g rad in the time from %g to %g, must be at most %g",
                        turn, s->options.t_start, s->options.t_end, TURN_MAX);
}

exit_status actor_read(setup *s, size_t body)
{
    actor *a = &s->actors[body];
    const json_t *object = json_array_get(json_object_get(s->root, "bodies"), body);
    value_place at = {.file = s->name, .body = body};
    a->restitution = 1;
    a->volume = a->mass_error = NAN;
    a->inertia_known = true;
    a->moves = json_object_get(object, "mass") != NULL;
    for (const char *const *key = moving_keys; *key != NULL && !a->moves; ++key) {
        at.key = *key;
        if (json_object_get(object, *key) != NULL)
            return value_refuse(at, "found on a body without \"mass\", which stays fixed or "
                                    "moves by its own maps; give a mass, or remove it");
    }
    at.key = "restitution";
    exit_status status = value_number(at, object, 0, 1, &a->restitution);
    at.key = "friction";
    if (status == EXIT_ANSWERED) status = value_number(at, object, 0, VALUE_MAX, &a->friction);
    at.key = "mass";
    if (status == EXIT_ANSWERED) status = value_positive(at, object, &a->mass);
    if (status == EXIT_ANSWERED) status = read_motion(s, at, object);
    if (status == EXIT_ANSWERED) status = check_parent(s, at, object);
    if (status == EXIT_ANSWERED && a->moves) status = find_mass(s, at, object);
    return status;
}

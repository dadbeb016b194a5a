/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_SETUP_H
#define TOOLS_SIMULATE_SETUP_H

#include <jansson.h>

#include "tools/cli/arguments.h"
#include "tools/simulate/outline.h"

/* The scene of a simulation
 * =========================
 * A scene file whose bodies have the keys "mass" and so on beside those of every scene. What is
 * asked of the library's reader is the scene without them: bodies as they are at the start, under
 * their own maps. */

typedef struct actor {
    const char *name;
    json_t *json;    /* the body without the keys of a simulation; borrowed */
    bool moves;      /* it has a mass */
    outline outline; /* where it varies, it is driven, or, with a mass, it deforms */
    double mass, restitution, friction;
    vec center;                /* of mass, at the start */
    mat3 inertia;              /* about the center, in the axes of the start */
    double volume, mass_error; /* integrated; NAN: given, or not known */
    bool inertia_known;        /* false: a limit came before it was integrated */
    vec velocity, spin;
} actor;

typedef struct setup {
    json_t *root, *stripped; /* the scene as it is, and without the keys of a simulation */
    const char *name;        /* of the file, for messages and for relative names */
    imp_registry *registry;
    imp_scene *still; /* of `stripped` */
    imp_options options;
    limits limits;
    double max_seconds; /* that were asked for; 0: no limit */
    double begun;       /* on the clock of the thread */
    vec gravity;
    actor *actors;
    size_t count;
} setup;

/* Reads the scene that the operand names. Complains, with EXIT_UNDECIDED where --max-seconds leaves
 * no time to write a motion. Where a limit comes first, masses are not integrated, and the
 * simulation must end at its start. Call setup_free in any case. */
exit_status setup_read(setup *s, const arguments *args);
void setup_free(setup *s);

/* Returns the body of that name, or SIZE_MAX. */
size_t setup_find(const setup *s, const char *name);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/record.h"

#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/output_file.h"

/* --- The scene -------------------------------------------------------------------------------- */

/* Replaces the maps of a body; its other keys stay. */
static int record_body(const simulation *s, size_t i, json_t *body)
{
    if (!s->setup->actors[i].moves) return 0;
    json_t *maps = json_object_get(body, "maps");
    if (maps == NULL) {
        maps = json_array();
        if (json_object_set_new(body, "maps", maps) != 0) return 1;
    }
    json_object_del(body, "velocity");
    json_object_del(body, "spin");
    /* A trajectory over no time at all has no pieces: then write the one that was begun. */
    const double start = s->setup->options.t_start;
    return json_array_append_new(
        maps, mover_trajectory(&s->movers[i], s->t > start ? s->t : s->search.end));
}

/* Asked with twice gamma, and gamma as gamma_clear, the scene answers with its first event: there
 * the bodies are within gamma. With the numbers of the simulation contact and clear would both be
 * right. */
static json_t *scene_json(const simulation *s)
{
    json_t *root = json_deep_copy(s->setup->root);
    const imp_options *o = &s->setup->options;
    int failed = root == NULL;
    json_object_del(root, "gravity");
    failed |= json_object_set_new(root, "time", json_pack("[f,f]", o->t_start, s->t));
    failed |= json_object_set_new(root, "gamma", json_real(2 * o->gamma));
    failed |= json_object_set_new(root, "gamma_clear", json_real(o->gamma));
    size_t i;
    json_t *body;
    json_array_foreach(json_object_get(root, "bodies"), i, body) failed |= record_body(s, i, body);
    failed |= json_object_set(root, "events", s->log);
    if (!failed) return root;
    json_decref(root);
    return NULL;
}

exit_status record_write(const simulation *s, const char *path)
{
    output_file out;
    char *text = output_json_line(scene_json(s));
    if (text == NULL) return complain_of_memory("simulate");
    exit_status status = output_file_begin(&out, path, "simulate");
    if (status == EXIT_ANSWERED) {
        fprintf(out.file, "%s\n", text);
        status = output_file_end(&out, true);
    }
    free(text);
    return status;
}

/* --- Energy and momentum ---------------------------------------------------------------------- */

/* Returns the change of energy that neither events nor gravity explain. */
static double energy_drift(const simulation *s)
{
    return s->end.energy - (s->start.energy - s->energy_lost);
}

static vec momentum_drift(const simulation *s)
{
    const vec expected = vec_add(s->start.momentum, vec_add(s->from_gravity, s->from_fixed));
    return vec_sub(s->end.momentum, expected);
}

static void print_label(const char *label) { printf("  %-10s ", label); }

static void print_vector(vec v) { printf("[%.9g, %.9g, %.9g]", v.x[0], v.x[1], v.x[2]); }

void record_print(const simulation *s, const char *path)
{
    const imp_options *o = &s->setup->options;
    printf("%s%s%s from t = %.9g to %.9g: %zu impact%s, %zu contacts that last, %zu come to rest\n",
           output_colour(s->reason == NULL ? OUTPUT_GREEN : OUTPUT_YELLOW),
           s->reason == NULL ? "simulated" : "ended early", output_colour(OUTPUT_PLAIN), o->t_start,
           s->t, s->impacts, s->impacts == 1 ? "" : "s", s->events - s->impacts, s->held);
    if (s->reason != NULL) {
        print_label("because");
        printf("%s: nothing is known of times after %.9g", s->reason, s->t);
        printf("%s%s\n", s->hint[0] != '\0' ? "; " : "", s->hint);
    }
    print_label("proved");
    printf("never nearer than %.9g\n", o->gamma_clear);
    print_label("energy");
    printf("%.9g -> %.9g, lost in contacts %.9g, drift %.3g\n", s->start.energy, s->end.energy,
           s->energy_lost, energy_drift(s));
    print_label("momentum");
    print_vector(s->start.momentum);
    printf(" -> ");
    print_vector(s->end.momentum);
    printf(", drift %.3g\n", vec_length(momentum_drift(s)));
    const double error = simulation_substep_error(s);
    if (error > 0) {
        print_label("sub-steps");
        printf("orientations within %.3g rad of torque-free motion's\n", error);
    }
    print_label("cost");
    printf("%ju searches, %ju pairs\n", (uintmax_t)s->search.searches,
           (uintmax_t)s->search.limits.pairs);
    print_label("written");
    printf("%s\n", path);
}

static json_t *vector_json(vec v)
{
    return json_pack("[o,o,o]", output_json_number(v.x[0]), output_json_number(v.x[1]),
                     output_json_number(v.x[2]));
}

static json_t *bodies_json(const simulation *s)
{
    json_t *list = json_array();
    for (size_t i = 0; i < s->setup->count; ++i) {
        const actor *a = &s->setup->actors[i];
        if (!a->moves) continue;
        json_t *rows = a->inertia_known ? json_array() : json_null();
        for (int k = 0; k < 3 && a->inertia_known; ++k)
            json_array_append_new(rows, vector_json(vec_of(a->inertia.m[k])));
        json_t *one =
            json_pack("{s:o, s:f, s:o, s:o, s:o, s:o, s:b}", "name", output_json_text(a->name),
                      "mass", a->mass, "center", vector_json(a->center), "inertia", rows, "volume",
                      output_json_number(a->volume), "error", output_json_number(a->mass_error),
                      "rests", (int)s->rests[i]);
        json_array_append_new(list, one);
    }
    return list;
}

json_t *record_json(const simulation *s, const char *path)
{
    const imp_options *o = &s->setup->options;
    json_t *energy = json_pack("{s:f, s:f, s:f, s:f}", "start", s->start.energy, "end",
                               s->end.energy, "lost", s->energy_lost, "drift", energy_drift(s));
    json_t *momentum =
        json_pack("{s:o, s:o, s:o, s:o}", "start", vector_json(s->start.momentum), "end",
                  vector_json(s->end.momentum), "from_fixed", vector_json(s->from_fixed), "drift",
                  output_json_number(vec_length(momentum_drift(s))));
    json_t *angular = json_pack("{s:o, s:o}", "start", vector_json(s->start.angular), "end",
                                vector_json(s->end.angular));
    json_t *stats = json_pack("{s:I, s:I}", "searches", (json_int_t)s->search.searches, "pairs",
                              (json_int_t)s->search.limits.pairs);
    return json_pack(
        "{s:o, s:o, s:[f,f], s:s?, s:o, s:I, s:I, s:I, s:f, s:f, s:o, s:o, s:o, s:f, s:o, "
        "s:O, s:o}",
        "scene", output_json_text(s->setup->name), "out", output_json_text(path), "time",
        o->t_start, s->t, "reason", s->reason, "hint",
        output_json_text(s->hint[0] != '\0' ? s->hint : NULL), "impacts", (json_int_t)s->impacts,
        "resting", (json_int_t)(s->events - s->impacts), "held", (json_int_t)s->held, "gamma",
        o->gamma, "gamma_clear", o->gamma_clear, "energy", energy, "momentum", momentum,
        "angular_momentum", angular, "substep_error", simulation_substep_error(s), "bodies",
        bodies_json(s), "events", s->log, "stats", stats);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/setup.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/input.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"
#include "tools/simulate/mass.h"

static const char speaker[] = "simulate";

/* --- Values --------------------------------------------------------------------------------- */

/* "scene.json: /bodies/2/mass: got ..., must be ...". */
static exit_status refuse(const setup *s, size_t body, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static exit_status refuse(const setup *s, size_t body, const char *key, const char *format, ...)
{
    char text[600], where[64] = "";
    va_list more;
    va_start(more, format);
    vsnprintf(text, sizeof text, format, more);
    va_end(more);
    if (body != SIZE_MAX) snprintf(where, sizeof where, "/bodies/%zu", body);
    return complain(EXIT_DATA, speaker, "%.300s: %s/%s: %s", s->name, where, key, text);
}

/* The start of a value's JSON text, for messages. */
typedef struct value_text {
    char at[80];
} value_text;

static value_text text_of(const json_t *value)
{
    value_text t = {"nothing"};
    char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(15));
    if (text != NULL) snprintf(t.at, sizeof t.at, "%.70s", text);
    free(text);
    return t;
}

static bool read_numbers(const json_t *value, size_t count, double *to)
{
    if (!json_is_array(value) || json_array_size(value) != count) return false;
    for (size_t i = 0; i < count; ++i) {
        const json_t *one = json_array_get(value, i);
        if (!json_is_number(one)) return false;
        to[i] = json_number_value(one);
    }
    return true;
}

/* Three numbers at the key, if it is there. */
static exit_status read_vector(const setup *s, size_t body, const json_t *object, const char *key,
                               vec *to)
{
    const json_t *value = json_object_get(object, key);
    if (value == NULL || read_numbers(value, 3, to->x)) return EXIT_ANSWERED;
    return refuse(s, body, key, "got %s, must be three numbers, [x,y,z]", text_of(value).at);
}

/* One number of lo to hi at the key, if it is there; `lo` itself only if not open. */
static exit_status read_number(const setup *s, size_t body, const json_t *object, const char *key,
                               double lo, bool open, double hi, double *to)
{
    const json_t *value = json_object_get(object, key);
    if (value == NULL) return EXIT_ANSWERED;
    const double number = json_number_value(value);
    if (json_is_number(value) && number <= hi && (open ? number > lo : number >= lo)) {
        *to = number;
        return EXIT_ANSWERED;
    }
    if (hi < INFINITY)
        return refuse(s, body, key, "got %s, must be a number from %g to %g", text_of(value).at, lo,
                      hi);
    return refuse(s, body, key, "got %s, must be a number %s %g", text_of(value).at,
                  open ? "greater than" : "of at least", lo);
}

/* Symmetric to rounding, and positive definite (all leading minors > 0). */
static exit_status read_inertia(const setup *s, size_t body, const json_t *value, mat3 *to)
{
    bool good = json_is_array(value) && json_array_size(value) == 3;
    for (size_t i = 0; good && i < 3; ++i)
        good = read_numbers(json_array_get(value, i), 3, to->m[i]);
    if (!good)
        return refuse(s, body, "inertia", "got %s, must be three rows of three numbers",
                      text_of(value).at);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j) {
            const double size = fabs(to->m[i][i]) + fabs(to->m[j][j]);
            if (!(fabs(to->m[i][j] - to->m[j][i]) <= 1e-12 * size))
                return refuse(s, body, "inertia",
                              "got %g in row %d, column %d, and %g in row %d, column %d; must be "
                              "symmetric",
                              to->m[i][j], i, j, to->m[j][i], j, i);
            to->m[j][i] = to->m[i][j];
        }
    const double minor = to->m[0][0] * to->m[1][1] - to->m[0][1] * to->m[1][0];
    if (to->m[0][0] > 0 && minor > 0 && mat3_determinant(to) > 0) return EXIT_ANSWERED;
    return refuse(s, body, "inertia", "got %s, must be positive definite", text_of(value).at);
}

/* --- Mass properties ------------------------------------------------------------------------- */

static exit_status refuse_surface(const setup *s, size_t body, mass_verdict verdict, vec where,
                                  const imp_error *error)
{
    static const char cure[] = "give \"inertia\" and \"center\"";
    switch (verdict) {
    case MASS_FOUND:
        break;
    case MASS_OPEN:
        return refuse(s, body, "surfaces",
                      "found an open surface: nothing borders on its edge at [%g,%g,%g], so it "
                      "encloses no volume to integrate; %s",
                      where.x[0], where.x[1], where.x[2], cure);
    case MASS_DISORDER:
        return refuse(
            s, body, "surfaces",
            "found normals (du x dv) that point neither all outward nor all inward, or no "
            "volume; exchange u and v of some surfaces, or %s",
            cure);
    case MASS_UNBOUNDED:
        return refuse(s, body, "surfaces", "found a surface that is not bounded; %s", cure);
    case MASS_TOO_MANY:
        return refuse(s, body, "surfaces",
                      "found %zu surfaces, integrated are at most %u of a body; %s",
                      imp_scene_surface_count(s->still, body), MASS_SURFACES_MAX, cure);
    case MASS_NO_MEMORY:
        return complain_of_memory(speaker);
    case MASS_FAULT:
        return complain_of(error, speaker);
    }
    return EXIT_ANSWERED;
}

/* What is not given is integrated. */
static exit_status find_mass(const setup *s, size_t body, const json_t *object)
{
    actor *a = &s->actors[body];
    const json_t *inertia = json_object_get(object, "inertia");
    const bool has_center = json_object_get(object, "center") != NULL;
    mass_properties found;
    vec where;
    imp_error error = {0};
    exit_status status = read_vector(s, body, object, "center", &a->center);
    if (status == EXIT_ANSWERED && inertia != NULL)
        status = read_inertia(s, body, inertia, &a->inertia);
    if (status != EXIT_ANSWERED || (inertia != NULL && has_center)) return status;
    const mass_verdict verdict =
        mass_integrate(s->still, body, s->options.t_start, &found, &where, &error);
    if (verdict != MASS_FOUND) return refuse_surface(s, body, verdict, where, &error);
    a->volume = found.volume;
    a->mass_error = found.error;
    if (inertia == NULL) {
        /* About another centre than that of uniform density: Steiner. */
        const vec d = has_center ? vec_sub(a->center, found.center) : (vec){{0, 0, 0}};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                a->inertia.m[i][j] = a->mass * (found.inertia.m[i][j] +
                                                (i == j ? vec_dot(d, d) : 0) - d.x[i] * d.x[j]);
    }
    if (!has_center) a->center = found.center;
    return EXIT_ANSWERED;
}

/* --- One body --------------------------------------------------------------------------------- */

static const char *const actor_keys[] = {"mass", "inertia",     "center",   "velocity",
                                         "spin", "restitution", "friction", NULL};
static const char *const moving_keys[] = {"inertia", "center", "velocity", "spin", NULL};

static exit_status check_parent(const setup *s, size_t body, const json_t *object)
{
    const json_t *parent = json_object_get(object, "parent");
    if (parent == NULL) return EXIT_ANSWERED;
    if (json_object_get(object, "mass") != NULL)
        return refuse(s, body, "parent",
                      "found on a body with a mass, which moves by itself; remove one of them");
    const size_t found = setup_find(s, json_string_value(parent));
    const json_t *bodies = json_object_get(s->root, "bodies");
    if (found < s->count && json_object_get(json_array_get(bodies, found), "mass") != NULL)
        return refuse(s, body, "parent", "got \"%.80s\", which has a mass; must be a body without",
                      json_string_value(parent));
    return EXIT_ANSWERED;
}

static exit_status read_actor(const setup *s, size_t body, const json_t *object)
{
    actor *a = &s->actors[body];
    a->restitution = 1;
    a->volume = a->mass_error = NAN;
    a->moves = json_object_get(object, "mass") != NULL;
    for (const char *const *key = moving_keys; *key != NULL && !a->moves; ++key)
        if (json_object_get(object, *key) != NULL)
            return refuse(s, body, *key,
                          "found on a body without \"mass\", which stays fixed or "
                          "moves by its own maps; give a mass, or remove it");
    exit_status status = read_number(s, body, object, "restitution", 0, false, 1, &a->restitution);
    if (status == EXIT_ANSWERED)
        status = read_number(s, body, object, "friction", 0, false, INFINITY, &a->friction);
    if (status == EXIT_ANSWERED)
        status = read_number(s, body, object, "mass", 0, true, INFINITY, &a->mass);
    if (status == EXIT_ANSWERED) status = read_vector(s, body, object, "velocity", &a->velocity);
    if (status == EXIT_ANSWERED) status = read_vector(s, body, object, "spin", &a->spin);
    if (status == EXIT_ANSWERED) status = check_parent(s, body, object);
    if (status == EXIT_ANSWERED && a->moves) status = find_mass(s, body, object);
    return status;
}

/* Whether a surface of the body depends on time: the rates of its inclusion over all of it say. */
static bool depends_on_time(const setup *s, size_t body)
{
    for (size_t k = 0; k < imp_scene_surface_count(s->still, body); ++k) {
        double lo[3], hi[3];
        imp_model model[3];
        imp_scene_domain(s->still, body, k, lo, hi);
        lo[2] = fmax(lo[2], s->options.t_start);
        hi[2] = fmin(hi[2], s->options.t_end);
        if (imp_scene_include(s->still, body, k, lo, hi, model, NULL) != IMP_SUCCESS) return true;
        for (int i = 0; i < 3; ++i)
            if (!(model[i].rate[2] == 0)) return true;
    }
    return false;
}

/* --- The scene --------------------------------------------------------------------------------- */

size_t setup_find(const setup *s, const char *name)
{
    for (size_t i = 0; name != NULL && i < s->count; ++i)
        if (strcmp(s->actors[i].name, name) == 0) return i;
    return SIZE_MAX;
}

static void strip(json_t *root)
{
    size_t i;
    json_t *body, *bodies = json_object_get(root, "bodies");
    json_object_del(root, "gravity");
    json_object_del(root, "events");
    json_array_foreach(bodies, i, body) for (const char *const *key = actor_keys; *key != NULL;
                                             ++key) json_object_del(body, *key);
}

/* Syntax is the library's to judge: it says where. */
static exit_status read_json(setup *s, const input_text *text)
{
    imp_error error = {0};
    const int flags = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL;
    const char *given = text->text != NULL ? text->text : "";
    s->root = json_loadb(given, text->length, flags, NULL);
    s->stripped = json_deep_copy(s->root);
    if (s->root != NULL && s->stripped == NULL) return complain_of_memory(speaker);
    char *stripped = NULL;
    if (s->stripped != NULL) {
        strip(s->stripped);
        stripped = json_dumps(s->stripped, JSON_REAL_PRECISION(17));
        if (stripped == NULL) return complain_of_memory(speaker);
        given = stripped;
    }
    s->still = imp_scene_from_json(
        s->registry, given, stripped != NULL ? strlen(stripped) : text->length, s->name, &error);
    free(stripped);
    return s->still != NULL ? EXIT_ANSWERED : complain_of(&error, speaker);
}

static exit_status read_text(setup *s, const arguments *args)
{
    input_text text = {0};
    FILE *file = input_open(args->operands[0], speaker);
    if (file == NULL) return EXIT_DATA;
    exit_status status = EXIT_DATA;
    if (input_read(file, s->name, speaker, &text)) status = read_json(s, &text);
    input_close(file);
    free(text.text);
    return status;
}

static exit_status read_actors(setup *s)
{
    const json_t *bodies = json_object_get(s->root, "bodies");
    const json_t *stripped = json_object_get(s->stripped, "bodies");
    s->count = imp_scene_body_count(s->still);
    s->actors = calloc(s->count, sizeof *s->actors);
    if (s->actors == NULL) return complain_of_memory(speaker);
    for (size_t i = 0; i < s->count; ++i) {
        s->actors[i].name = imp_scene_body_name(s->still, i);
        s->actors[i].json = json_array_get(stripped, i);
    }
    exit_status status = read_vector(s, SIZE_MAX, s->root, "gravity", &s->gravity);
    bool moves = false;
    for (size_t i = 0; i < s->count && status == EXIT_ANSWERED; ++i) {
        status = read_actor(s, i, json_array_get(bodies, i));
        s->actors[i].varies = depends_on_time(s, i);
        moves |= s->actors[i].moves;
    }
    if (status == EXIT_ANSWERED && !moves)
        return complain(EXIT_DATA, speaker,
                        "%.300s: no body has a \"mass\"; give one to what moves", s->name);
    return status;
}

exit_status setup_read(setup *s, const arguments *args)
{
    *s = (setup){.name = input_name(args->operands[0])};
    s->registry = query_registry(args);
    if (s->registry == NULL) return EXIT_DATA;
    exit_status status = read_text(s, args);
    if (status != EXIT_ANSWERED) return status;
    s->options = query_options(s->still, args);
    if (s->options.clearance < 0) s->options.clearance = s->options.gamma / 2;
    if (!(s->options.clearance < s->options.gamma))
        return complain(EXIT_USAGE, speaker, "the clearance %g must be less than gamma, %g",
                        s->options.clearance, s->options.gamma);
    if (!(s->options.t_start < s->options.t_end))
        return complain(EXIT_USAGE, speaker, "the time from %g to %g is empty; must be longer",
                        s->options.t_start, s->options.t_end);
    return read_actors(s);
}

void setup_free(setup *s)
{
    free(s->actors);
    imp_scene_free(s->still);
    query_registry_free(s->registry);
    json_decref(s->root);
    json_decref(s->stripped);
}

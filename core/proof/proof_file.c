/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/proof/proof_file.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/common/array.h"
#include "core/common/sha256.h"
#include "core/surface/formula_text.h"

typedef struct file {
    const imp_scene *scene;
    const proof_source *trees;
    const proof_claim *claim;
    const proof_sink *to;
    sha256 hash;
    size_t *first_chain;             /* number of each body's first surface among all surfaces */
    const shared_instance **written; /* instances, in the order of their numbers */
    size_t count, capacity;
    uint8_t held[4096]; /* bytes that the sink has not got yet */
    size_t held_count;
} file;

/* --- Bytes and lines -------------------------------------------------------------------------- */

static void hand_over(file *f)
{
    if (f->held_count > 0) f->to->write(f->to->context, f->held, f->held_count);
    f->held_count = 0;
}

static void put_bytes(void *context, const void *bytes, size_t size)
{
    file *f = context;
    sha256_add(&f->hash, bytes, size);
    if (size > sizeof f->held - f->held_count) hand_over(f);
    if (size > sizeof f->held) {
        f->to->write(f->to->context, bytes, size);
        return;
    }
    memcpy(f->held + f->held_count, bytes, size);
    f->held_count += size;
}

__attribute__((format(printf, 2, 3))) static void put(file *f, const char *format, ...)
{
    char text[1000];
    va_list arguments;
    va_start(arguments, format);
    const int size = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (size > 0) put_bytes(f, text, (size_t)size < sizeof text ? (size_t)size : sizeof text - 1);
}

/* Writes a name of any length; % and bytes that are no printable ASCII as % and two digits, so that
 * no character is a control, or hidden, or looks like another one. */
static void put_name(file *f, const char *name)
{
    for (; *name != '\0'; ++name)
        if (*name >= ' ' && *name <= '~' && *name != '%')
            put_bytes(f, name, 1);
        else
            put(f, "%%%02x", (unsigned char)*name);
}

static size_t chain_of(const file *f, size_t body, size_t at) { return f->first_chain[body] + at; }

/* --- What is claimed -------------------------------------------------------------------------- */

static size_t parameter_count(const file *f)
{
    return f->claim->ranges != NULL ? scene_parameters_read(f->scene)->count : 0;
}

static void put_claim(file *f, const char *stated)
{
    const proof_claim *c = f->claim;
    put(f, "impinge certificate %d\nprogram impinge %s\n", c->ranges != NULL ? 2 : 1,
        PACKAGE_VERSION);
    if (stated != NULL) put_bytes(f, stated, strlen(stated));
    put(f, "verdict %s\napart %a\nfrom %a\nto %a\n", c->verdict, c->apart, c->from, c->to);
    for (size_t k = 0; k < parameter_count(f); ++k) {
        const char *name = scene_parameters_read(f->scene)->at[k].name;
        put(f, "parameter %a %a ", c->ranges[2 * k], c->ranges[2 * k + 1]);
        put_name(f, name);
        put(f, "\n");
    }
    if (!c->has_points) return;
    put(f, "within %a at %a", c->within, c->t);
    for (size_t k = 0; k < parameter_count(f); ++k) put(f, " %a", c->values[k]);
    put(f, "\n");
    for (int side = 0; side < 2; ++side) {
        const proof_point *p = &c->point[side];
        put(f, "point %zu %zu %a %a\n", chain_of(f, p->body, p->surface), p->piece, p->u, p->v);
    }
}

/* --- Formulas --------------------------------------------------------------------------------- */

/* Writes the formula of a stage of a surface, or of its piece, on one line; an empty one if it has
 * none. */
static imp_code put_formula(file *f, const surface *s, size_t stage, imp_error *error)
{
    char *text;
    const bool is_clocked = f->claim->ranges != NULL && surface_origin(s, stage)->inner != NULL;
    const imp_status status =
        is_clocked ? surface_own_formula(s, stage, &text) : surface_formula(s, stage, &text);
    if (status != IMP_STATUS_OK) {
        surface_fault(s, error, ": %s", surface_status_message(s, status).text);
        return surface_set_code(status, error);
    }
    for (char *at = text; at != NULL && *at != '\0'; ++at)
        if (*at == '\n') *at = ' ';
    if (text != NULL) put_bytes(f, text, strlen(text));
    put(f, "\n");
    free(text);
    return IMP_SUCCESS;
}

/* Writes an instance that was not written yet: each of its formulas is a line, empty where the type
 * has none. */
static imp_code put_stage(file *f, const surface *s, size_t stage, imp_error *error)
{
    const shared_instance *p = surface_origin(s, stage);
    for (size_t k = 0; k < f->count; ++k)
        if (f->written[k] == p) return IMP_SUCCESS;
    const shared_instance **grown =
        array_reserve(f->written, f->count, &f->capacity, sizeof *grown);
    if (grown == NULL) return error_set_memory(error);
    f->written = grown;
    f->written[f->count++] = p;
    const size_t pieces = stage == 0 ? surface_piece_count(s) : 0;
    put(f, "%s %zu %s", stage == 0 ? "shape" : "map", pieces > 0 ? pieces : 1,
        stage == 0 ? p->surface->name : p->map->name);
    if (f->claim->ranges != NULL && p->inner != NULL) put(f, " clock %zu", (size_t)p->clock + 1);
    put(f, "\n");
    if (pieces == 0) return put_formula(f, s, stage, error);
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < pieces && code == IMP_SUCCESS; ++k)
        code = put_formula(f, surface_piece(s, k), stage, error);
    return code;
}

static size_t number_of(const file *f, const shared_instance *p)
{
    size_t k = 0;
    while (f->written[k] != p) ++k;
    return k;
}

/* Writes a chain, which is a surface: the number of its type's instance, then those of its maps in
 * order. */
static imp_code put_chain(file *f, size_t body, const surface *s, imp_error *error)
{
    const size_t maps = surface_map_count(s);
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k <= maps && code == IMP_SUCCESS; ++k) code = put_stage(f, s, k, error);
    if (code != IMP_SUCCESS) return code;
    put(f, "surface %zu", body);
    for (size_t k = 0; k <= maps; ++k) put(f, " %zu", number_of(f, surface_origin(s, k)));
    put(f, "\n");
    return IMP_SUCCESS;
}

static imp_code put_scene(file *f, imp_error *error)
{
    const size_t bodies = scene_body_count(f->scene);
    imp_code code = IMP_SUCCESS;
    for (size_t b = 0; b < bodies; ++b) {
        const char *name = imp_scene_body_name(f->scene, b);
        put(f, "body ");
        put_name(f, name);
        put(f, "\n");
        for (size_t k = 0; k < scene_surface_count(f->scene, b) && code == IMP_SUCCESS; ++k)
            code = put_chain(f, b, scene_surface(f->scene, b, k), error);
    }
    for (size_t a = 0; a < bodies; ++a)
        for (size_t b = a + 1; b < bodies; ++b)
            if (scene_ignores(f->scene, a, b)) put(f, "ignore %zu %zu\n", a, b);
    return code;
}

/* --- Trees ------------------------------------------------------------------------------------ */

/* Writes a tree for each pair of surfaces that is tested, in the order of the scene. */
static void put_trees(file *f)
{
    const size_t bodies = scene_body_count(f->scene);
    const proof_sink own = {put_bytes, f};
    size_t body[2], at[2];
    for (body[0] = 0; body[0] < bodies; ++body[0])
        for (body[1] = body[0] + 1; body[1] < bodies; ++body[1])
            for (at[0] = 0; at[0] < scene_surface_count(f->scene, body[0]); ++at[0])
                for (at[1] = 0; at[1] < scene_surface_count(f->scene, body[1]); ++at[1]) {
                    if (scene_ignores(f->scene, body[0], body[1])) continue;
                    for (int side = 0; side < 2; ++side)
                        proof_put_count(&own, chain_of(f, body[side], at[side]));
                    f->trees->put(f->trees->context, body, at, &own);
                }
}

/* --- The file --------------------------------------------------------------------------------- */

static size_t *number_chains(const imp_scene *scene)
{
    const size_t bodies = scene_body_count(scene);
    size_t *first = malloc((bodies + 1) * sizeof *first), count = 0;
    for (size_t b = 0; first != NULL && b < bodies; ++b) {
        first[b] = count;
        count += scene_surface_count(scene, b);
    }
    return first;
}

imp_code proof_file_write(const imp_scene *scene, const proof_source *trees,
                          const proof_claim *claim, const char *stated, const proof_sink *to,
                          imp_error *error)
{
    file f = {.scene = scene, .trees = trees, .claim = claim, .to = to};
    sha256_begin(&f.hash);
    f.first_chain = number_chains(scene);
    imp_code code = IMP_SUCCESS;
    if (f.first_chain == NULL) code = error_set_memory(error);
    if (code == IMP_SUCCESS) {
        put_claim(&f, stated);
        code = put_scene(&f, error);
    }
    if (code == IMP_SUCCESS) {
        uint8_t digest[SHA256_BYTES];
        put(&f, "trees\n");
        put_trees(&f);
        sha256_end(&f.hash, digest);
        hand_over(&f);
        to->write(to->context, digest, sizeof digest);
    }
    free(f.written);
    free(f.first_chain);
    return code;
}

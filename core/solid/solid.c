/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/solid_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/surface/region.h"

/* --- Creation and destruction ----------------------------------------------------------------- */

size_t solid_bytes(size_t count)
{
    const solid *s = NULL;
    return sizeof *s + count * (sizeof *s->patches.patch + sizeof *s->shells.facing +
                                sizeof *s->shells.is_repeated + 2 * sizeof *s->boxes);
}

imp_code solid_new(const imp_scene *scene, size_t body, double t, double slack,
                   const limit_watch *watch, solid **made, imp_error *error)
{
    solid *s = calloc(1, sizeof *s);
    *made = s;
    if (s == NULL) return error_set_memory(error);
    *s = (solid){.scene = scene, .body = body, .watch = watch, .slack = slack};
    const imp_code code = solid_patches_read(&s->patches, scene, body, t, error);
    if (code == IMP_SUCCESS && s->patches.count > 0) return code;
    solid_free(s);
    *made = NULL;
    return code;
}

void solid_free(solid *s)
{
    if (s == NULL) return;
    solid_patches_free(&s->patches);
    solid_shells_free(&s->shells);
    free(s->boxes);
    free(s);
}

/* --- Boxes ------------------------------------------------------------------------------------ */

void solid_box_around(const imp_model model[3], solid_box *box)
{
    for (int i = 0; i < 3; ++i) {
        box->lo[i] = model[i].lo > -INFINITY ? model[i].lo : -INFINITY;
        box->hi[i] = model[i].hi < INFINITY ? model[i].hi : INFINITY;
    }
}

void solid_box_add(solid_box *to, const solid_box *box)
{
    for (int i = 0; i < 3; ++i) {
        if (!(box->lo[i] >= to->lo[i])) to->lo[i] = box->lo[i];
        if (!(box->hi[i] <= to->hi[i])) to->hi[i] = box->hi[i];
    }
}

static imp_code make_boxes(solid *s, imp_error *error)
{
    const patches *p = &s->patches;
    s->boxes = malloc((p->count + s->shells.count + 1) * sizeof *s->boxes);
    if (s->boxes == NULL) return error_set_memory(error);
    for (size_t k = 0; k < s->shells.count; ++k) s->boxes[p->count + k] = solid_box_none();
    for (size_t k = 0; k < p->count; ++k) {
        const patch *one = &p->patch[k];
        const imp_region region = region_make((double[3]){one->lo[0], one->lo[1], p->t},
                                              (double[3]){one->hi[0], one->hi[1], p->t});
        imp_model model[3];
        const imp_code code = patch_include(one, &region, model, error);
        if (code != IMP_SUCCESS) return code;
        solid_box_around(model, &s->boxes[k]);
        const size_t shell = s->shells.facing[k].shell;
        if (shell != SIZE_MAX) solid_box_add(&s->boxes[p->count + shell], &s->boxes[k]);
    }
    return IMP_SUCCESS;
}

/* Finds the shells, if that was not done before. */
static imp_code read_shells(solid *s, imp_error *error)
{
    if (s->is_read) return IMP_SUCCESS;
    solid_shells_free(&s->shells);
    free(s->boxes);
    s->boxes = NULL;
    imp_code code =
        solid_shells_find(&s->shells, &s->patches, s->slack, s->watch, &s->closure, error);
    if (code == IMP_SUCCESS && s->patches.bounded) code = make_boxes(s, error);
    s->is_read = code == IMP_SUCCESS && s->closure.verdict != IMP_CLOSURE_STOPPED;
    return code;
}

/* --- How often a shell winds around a point --------------------------------------------------- */

/* Lemma. A closed shell does not wind around points out of its box. */
imp_code solid_wind(const solid *s, size_t shell, vec3 x, double off, winding_number *found,
                    imp_error *error)
{
    *found = (winding_number){.is_whole = true};
    if (!s->shells.is_doubtful && solid_box_excludes(solid_shell_box(s, shell), x, off))
        return IMP_SUCCESS;
    return shell_wind(&s->shells, &s->patches, shell, x, off, found, error);
}

/* --- Not closed ------------------------------------------------------------------------------- */

/* Writes "; they wind 0.36 times around (0, 0, 0)", or nothing if that is not known. */
static imp_code tell_number(const solid *s, vec3 x, char text[160], imp_error *error)
{
    winding_sum sum;
    text[0] = '\0';
    if (!s->patches.bounded || s->boxes == NULL) return IMP_SUCCESS;
    const imp_code code = shell_solid_angle(&s->shells, &s->patches, SIZE_MAX, x, &sum, error);
    if (code == IMP_SUCCESS && sum.seen.error < 0.1 * FULL_ANGLE)
        snprintf(text, 160, "; they wind %.3g times around (%g, %g, %g)",
                 sum.seen.angle / FULL_ANGLE, x.x[0], x.x[1], x.x[2]);
    return code;
}

static imp_code refuse(const solid *s, vec3 x, imp_error *error)
{
    static const char cure[] = "close it, raise gamma if these are gaps, or leave out \"solid\"";
    const char *name = imp_scene_body_name(s->scene, s->body);
    const imp_closure *c = &s->closure;
    char number[160];
    const imp_code code = tell_number(s, x, number, error);
    if (code != IMP_SUCCESS) return code;
    switch (c->verdict) {
    case IMP_CLOSURE_OPEN:
        return error_set(error, IMP_ERROR_SCENE,
                         "body '%.80s' is solid, but its surfaces are not closed within %g: "
                         "nothing, or one too many, borders on the edge of surface %zu, piece %zu, "
                         "at (%g, %g, %g)%s; %s",
                         name, s->shells.slack, c->at.surface, c->at.piece, c->where[0],
                         c->where[1], c->where[2], number, cure);
    case IMP_CLOSURE_ONE_SIDED:
        return error_set(error, IMP_ERROR_SCENE,
                         "body '%.80s' is solid, but its surfaces have no inside: they return to "
                         "(%g, %g, %g), on surface %zu, piece %zu, with the other side%s; %s",
                         name, c->where[0], c->where[1], c->where[2], c->at.surface, c->at.piece,
                         number, cure);
    case IMP_CLOSURE_UNBOUNDED:
    case IMP_CLOSURE_EMPTY:
        return error_set(error, IMP_ERROR_SCENE,
                         "body '%.80s' is solid, but its surfaces %s; leave out \"solid\"%s", name,
                         c->verdict == IMP_CLOSURE_EMPTY
                             ? "are a single point"
                             : "reach farther than 1e50, too far to tell what they bound",
                         c->verdict == IMP_CLOSURE_EMPTY ? "" : ", or choose other units");
    case IMP_CLOSURE_CLOSED:
    case IMP_CLOSURE_STOPPED:
        break;
    }
    return error_set(error, IMP_ERROR_SCENE,
                     "body '%.80s' is solid, but its surfaces bound no volume%s, which is no whole "
                     "number; %s",
                     name, number, cure);
}

/* --- On which side? --------------------------------------------------------------------------- */

/* The shells that wind around a point, and in how many of them each one is. */
typedef struct enclosing {
    size_t *shell, *depth;
    size_t count;
} enclosing;

/* Lists the shells that wind around x. *side becomes something else than OUTSIDE if one of them
 * does not bound a volume, or is so near to x that this cannot be told. */
static imp_code find_enclosing(const solid *s, vec3 x, double off, enclosing *around,
                               solid_side *side, bool *stopped, imp_error *error)
{
    *side = SOLID_OUTSIDE;
    for (size_t k = 0; k < s->shells.count && *side == SOLID_OUTSIDE; ++k) {
        winding_number found;
        *stopped = !limit_watch_goes_on(s->watch);
        if (*stopped) return IMP_SUCCESS;
        const imp_code code = solid_wind(s, k, x, off, &found, error);
        if (code != IMP_SUCCESS) return code;
        if (!found.is_whole)
            *side = SOLID_NOT_CLOSED;
        else if (found.is_near)
            *side = SOLID_TOO_NEAR;
        else if (found.times != 0)
            around->shell[around->count++] = k;
    }
    return IMP_SUCCESS;
}

/* Decides on the side from the shells around x: those at even depth are outer walls, and those at
 * odd depth are walls of cavities in them. A shell that is there twice, inside of others or around
 * them, may be a cavity's wall and that of a part that fills it: then nothing is known. */
static imp_code count_walls(const solid *s, enclosing *around, solid_side *side, bool *stopped,
                            imp_error *error)
{
    long outer = 0;
    bool known = true;
    imp_code code = IMP_SUCCESS;
    around->depth[0] = 0;
    for (size_t k = 0; k < around->count && around->count > 1; ++k)
        known = known && !s->shells.is_repeated[around->shell[k]];
    if (around->count > 1 && known)
        code = solid_depths(s, around->shell, around->count, around->depth, &known, stopped, error);
    for (size_t k = 0; code == IMP_SUCCESS && !*stopped && k < around->count; ++k)
        outer += around->depth[k] % 2 == 0 ? 1 : -1;
    if (!known)
        *side = SOLID_TOO_NEAR;
    else if (outer > 0)
        *side = SOLID_INSIDE;
    return code;
}

imp_code solid_side_of(solid *s, vec3 x, double off, solid_side *side, bool *stopped,
                       imp_error *error)
{
    *stopped = false;
    imp_code code = read_shells(s, error);
    if (code != IMP_SUCCESS) return code;
    *stopped = s->closure.verdict == IMP_CLOSURE_STOPPED;
    *side = SOLID_NOT_CLOSED;
    if (*stopped) return IMP_SUCCESS;
    if (s->closure.verdict != IMP_CLOSURE_CLOSED) return refuse(s, x, error);
    enclosing around = {calloc(s->shells.count + 1, sizeof *around.shell),
                        calloc(s->shells.count + 1, sizeof *around.depth), 0};
    if (around.shell == NULL || around.depth == NULL)
        code = error_set_memory(error);
    else
        code = find_enclosing(s, x, off, &around, side, stopped, error);
    if (code == IMP_SUCCESS && !*stopped && *side == SOLID_OUTSIDE && around.count > 0)
        code = count_walls(s, &around, side, stopped, error);
    free(around.shell);
    free(around.depth);
    return code == IMP_SUCCESS && *side == SOLID_NOT_CLOSED && !*stopped ? refuse(s, x, error)
                                                                         : code;
}

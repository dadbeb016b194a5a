/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/broad_phase/frame_list.h"
#include "core/common/array.h"
#include "core/surface/screws.h"

/* Pairs in the frame that both surfaces move in, and pairs searched at one moment
 * ===============================================================================
 * Lemma. Let both surfaces of a pair end with the same maps, each of which is x -> R(t) x + c(t)
 * with an exact rotation R(t). At each time such a map preserves the distance of any two points. So
 * everything proved for the surfaces without these maps (a time before which nothing is near, a
 * gap, a minimum distance) holds for the surfaces under all of their maps, with the same u, v and
 * t. Times at which one of these maps does not exist are in no tree: a tree has the times of the
 * whole surface.
 *
 * Parts that a moving body carries are then at rest, and cost as little as bodies at rest. Two maps
 * are the same if they are one instance: a parent's maps are shared, and the reader shares equal
 * maps.
 *
 * Lemma. Let the distance of two surfaces at any time differ by at most s from what it is at a
 * moment (surface_pair_slip). If it is above c + s at the moment, it is above c at all times; a
 * contact at the moment, the first at which both exist, is the earliest. So such a pair has trees
 * of that moment alone. */

size_t collection_common_motion(const imp_scene *scene)
{
    const surface *first = NULL;
    size_t common = 0;
    for (size_t b = 0; b < scene_body_count(scene); ++b)
        for (size_t k = 0; k < scene_surface_count(scene, b); ++k) {
            const surface *s = scene_surface(scene, b, k);
            const size_t n = surface_common_motion(first != NULL ? first : s, s);
            if (first == NULL || n < common) common = n;
            if (first == NULL) first = s;
            if (common == 0) return 0;
        }
    return common;
}

/* --- Which pairs need frames ------------------------------------------------------------------ */

static size_t motion_of(const candidate_pair *p)
{
    return surface_common_motion(tree_surface(p->side[0]->tree), tree_surface(p->side[1]->tree));
}

/* Whether the pair may turn only within itself: all maps are rigid, at least one surface moves, and
 * one has a symmetry. */
static bool may_turn_within(const collection *all, const candidate_pair *p)
{
    if (all->slip_most < 0) return false;
    const surface *const s[2] = {tree_surface(p->side[0]->tree), tree_surface(p->side[1]->tree)};
    bool moves = false, turns = false;
    for (int k = 0; k < 2; ++k) {
        if (surface_map_count(s[k]) > 0 && !surface_is_rigid(s[k])) return false;
        moves = moves || surface_map_count(s[k]) > 0;
        turns = turns || surface_has_symmetry(s[k]);
    }
    return moves && turns;
}

static bool any_has_frame(const collection *all)
{
    const candidate_list *list = all->list;
    bool any = false;
    for (size_t k = 0; k < list->pair_count && !any; ++k)
        any = motion_of(&list->pairs[k]) > 0 || may_turn_within(all, &list->pairs[k]) ||
              frames_may_have_half_planes(all, &list->pairs[k]) ||
              frames_may_be_held(all, &list->pairs[k]) ||
              frames_may_set_aside(all, &list->pairs[k]);
    return any;
}

/* --- Frames ----------------------------------------------------------------------------------- */

/* A frame with a half plane belongs to one pair. */
static bool are_equal(const frame *x, const surface_view *y)
{
    const double moment = x->view.moment;
    return x->made.half == NULL && x->view.left_out == y->left_out &&
           held_maps_are_equal(x->view.held, y->held) &&
           maps_aside_are_equal(x->view.aside, y->aside) &&
           (moment == y->moment || (isnan(moment) && isnan(y->moment)));
}

imp_code frames_find(collection *all, frame_list *frames, const candidate *c,
                     const surface_view *view, size_t *found, imp_error *error)
{
    const size_t of = (size_t)(c - all->list->candidates);
    for (*found = frames->first[of]; *found != NONE; *found = frames->at[*found].next)
        if (are_equal(&frames->at[*found], view)) return IMP_SUCCESS;
    frame *made = frame_list_next(frames);
    if (made == NULL) return error_set_memory(error);
    *made = (frame){.of = of,
                    .next = frames->first[of],
                    .view = *view,
                    .made = *c,
                    .seen = {.from = INFINITY},
                    .aside = {.from = INFINITY}};
    bool exists = true;
    if (view->left_out != c->left_out || view->held.count > 0 || view->aside.which != 0 ||
        !isnan(view->moment)) {
        if (collection_must_end(all)) return IMP_SUCCESS;
        const imp_code code = collection_make_tree(all, view, &made->made, &exists, error);
        if (code != IMP_SUCCESS) return code;
    }
    *found = frames->first[of] = frames->count++;
    return IMP_SUCCESS;
}

/* Like surface_pair_slip, for a pair of which one moves along the other by its screw motions, and
 * whose distances slip by `before` already. No verifier knows these. */
static imp_code find_screw_slip(collection *all, candidate *const side[2],
                                const screw_rest_times *at, const imp_model bare[2][3],
                                double before, double *slip, imp_error *error)
{
    const surface *const s[2] = {tree_surface(side[0]->tree), tree_surface(side[1]->tree)};
    screw_rest rest;
    double near = sum_upper(all->gamma_clear, before);
    int asked = 0;
    const imp_status status = surface_screw_rest(s, bare, at, &rest, &asked);
    if (status != IMP_STATUS_OK) return distance_fault(s[asked], status, error);
    if (!(rest.slip < INFINITY)) return IMP_SUCCESS;
    tree *const t[2] = {side[0]->tree, side[1]->tree};
    imp_code code = IMP_SUCCESS;
    if (!(near < INFINITY)) code = frames_some_distance(t, at->moment, &near, error);
    if (code == IMP_SUCCESS && near <= rest.near) *slip = rest.slip;
    return code;
}

static bool may_screw(const collection *all, const surface *const s[2])
{
    return all->may_halve && (surface_is_screw_piece(s[0]) || surface_is_screw_piece(s[1]));
}

/* Bounds in *slip how much the distance of the pair of these frames, which slips by `before`,
 * changes with time. */
static imp_code find_slip(collection *all, candidate *const side[2], const time_window *times,
                          double before, double *slip, imp_error *error)
{
    imp_model bare[2][3];
    const surface *s[2];
    *slip = INFINITY;
    for (int k = 0; k < 2; ++k) {
        s[k] = tree_surface(side[k]->tree);
        if (!node_bare_models(tree_root(side[k]->tree), bare[k])) return IMP_SUCCESS;
    }
    const imp_region all_times = window_region(times);
    int asked = 1;
    /* impinge-verify finds no such turn itself, and needs leaves that are short in time. */
    const bool of_pieces = all->may_halve;
    const imp_status status =
        surface_pair_slip(s, of_pieces, bare, &all_times, times->lo, slip, &asked);
    const screw_rest_times at = {&all_times, times->lo, 0.5 * all->slip_most};
    if (status == IMP_STATUS_OK && !all->in_slices && !(*slip <= all->slip_most) &&
        may_screw(all, s))
        return find_screw_slip(all, side, &at, bare, before, slip, error);
    if (status == IMP_STATUS_OK) return IMP_SUCCESS;
    const surface_message what = surface_status_message(s[asked], status);
    if (status == SURFACE_BAD_SYMMETRY)
        surface_fault(s[asked], error, ": %s", what.text);
    else
        surface_fault(s[asked], error, "over t [%.17g, %.17g]: %s", times->lo, times->hi,
                      what.text);
    return surface_set_code(status, error);
}

/* Whether the maps of the surface may depend on time. */
static bool may_move(const surface *s, const imp_region *times)
{
    imp_pose pose;
    if (surface_map_count(s) == 0) return false;
    if (surface_pose(s, times, &pose) != IMP_STATUS_OK) return true;
    bool depends = false;
    for (int i = 0; i < 3; ++i) {
        depends = depends || pose.shift[i].depends != 0;
        for (int j = 0; j < 3; ++j) depends = depends || pose.turn[i][j].depends != 0;
    }
    return depends;
}

/* Notes that a pair has trees of one moment in each slice, or may have them, since it is screwed
 * along a thread: candidates_rest makes them. Lemma. If its distance at any time differs by at most
 * s from that of one moment, it differs by at most 2 s from that of any other. */
static void rest_in_slices(collection *all, candidate_pair *p, candidate *const side[2],
                           const time_window *times, double own, double *found)
{
    const double slip = sum_upper(2 * own, *found);
    const imp_region over = window_region(times);
    const surface *const s[2] = {tree_surface(side[0]->tree), tree_surface(side[1]->tree)};
    bool moves = false;
    p->screws = !(slip <= all->slip_most) && may_screw(all, s);
    if (!(slip <= all->slip_most)) return;
    for (int k = 0; k < 2; ++k) moves = moves || may_move(s[k], &over);
    if (!moves) return;
    p->rests = true;
    *found = slip;
    if (slip > all->list->slip) all->list->slip = slip;
}

/* Gives a pair that only turns within itself trees of one moment, and adds what that slips to
 * *found. */
static imp_code rest_pair(collection *all, frame_list *frames, size_t k, double *found,
                          imp_error *error)
{
    candidate_pair *p = &all->list->pairs[k];
    size_t *of_pair = frames->of_pair[k];
    time_window times;
    double slip;
    imp_code code = frames_make_roots(all, frames, k, &times, error);
    if (code != IMP_SUCCESS || times.lo > times.hi) return code;
    bool may_rest;
    code = frames_look_at_pair(all, frames, k, &times, &may_rest, error);
    if (code != IMP_SUCCESS || !may_rest) return code;
    /* impinge-verify would have to divide what turns beside another line until it hardly turns. */
    if (!all->may_halve && frames_have_two_lines(frames, k)) return IMP_SUCCESS;
    candidate *const side[2] = {&frames->at[of_pair[0]].made, &frames->at[of_pair[1]].made};
    code = find_slip(all, side, &times, *found, &slip, error);
    if (code == IMP_SUCCESS && all->in_slices) {
        rest_in_slices(all, p, side, &times, slip, found);
        return IMP_SUCCESS;
    }
    slip = sum_upper(slip, *found);
    if (code != IMP_SUCCESS || !(slip <= all->slip_most)) return code;
    *found = slip;
    for (int j = 0; j < 2 && code == IMP_SUCCESS; ++j) {
        surface_view view = frames->at[of_pair[j]].view;
        view.moment = times.lo;
        code = frames_find(all, frames, p->side[j], &view, &of_pair[j], error);
        if (of_pair[j] == NONE) return code;
    }
    if (slip > all->list->slip) all->list->slip = slip;
    return code;
}

/* What gives a pair frames that slip, in this order: each adds to the slip what the one before has
 * found. */
static const struct {
    bool (*may)(const collection *all, const candidate_pair *p);
    imp_code (*change)(collection *all, frame_list *frames, size_t k, double *slip,
                       imp_error *error);
} steps[] = {{frames_may_set_aside, frames_set_aside},
             {may_turn_within, rest_pair},
             {frames_may_be_held, frames_hold_pair}};

enum { PAIRS_PER_CHECK = 64 }; /* pairs between checks of the limits: some milliseconds */

static imp_code find_frames(collection *all, frame_list *frames, bool *done, imp_error *error)
{
    const candidate_list *list = all->list;
    for (size_t k = 0; k < list->count; ++k) frames->first[k] = NONE;
    for (size_t k = 0; k < list->pair_count; ++k) {
        const candidate_pair *p = &list->pairs[k];
        const size_t motion = motion_of(p);
        imp_code code = IMP_SUCCESS;
        *done = k % PAIRS_PER_CHECK != PAIRS_PER_CHECK - 1 || !collection_must_end(all);
        for (int side = 0; side < 2 && *done && code == IMP_SUCCESS; ++side) {
            const candidate *c = p->side[side];
            const surface_view view = {.body = c->body,
                                       .surface = c->surface,
                                       .left_out = c->left_out + motion,
                                       .moment = NAN};
            code = frames_find(all, frames, c, &view, &frames->of_pair[k][side], error);
            *done = frames->of_pair[k][side] != NONE;
        }
        double slip = 0;
        for (size_t j = 0; j < sizeof steps / sizeof *steps && *done && code == IMP_SUCCESS; ++j) {
            if (!steps[j].may(all, p)) continue;
            code = steps[j].change(all, frames, k, &slip, error);
            *done = frames->of_pair[k][0] != NONE && frames->of_pair[k][1] != NONE;
        }
        if (code == IMP_SUCCESS && *done && frames_may_have_half_planes(all, p))
            code = frames_halve_pair(all, frames, k, slip, error);
        *done = *done && code == IMP_SUCCESS;
        if (!*done) return code;
    }
    return IMP_SUCCESS;
}

/* Replaces the candidates by their frames, in the same order; frames of one candidate are
 * neighbours. False: no memory. */
static bool take_frames(candidate_list *list, frame_list *frames)
{
    candidate *made = arena_store_room(list->store, (frames->count + 1) * sizeof *made);
    if (made == NULL) return false;
    size_t *at = arena_store_room(list->store, (frames->count + 1) * sizeof *at), count = 0;
    if (at == NULL) return arena_store_free_room(list->store, made), false;
    for (size_t k = 0; k < list->count; ++k)
        for (size_t f = frames->first[k]; f != NONE; f = frames->at[f].next) {
            made[count] = frames->at[f].made;
            at[f] = count++;
        }
    for (size_t k = 0; k < list->pair_count; ++k)
        for (int side = 0; side < 2; ++side)
            list->pairs[k].side[side] = &made[at[frames->of_pair[k][side]]];
    arena_store_free_room(list->store, at);
    if (list->candidates != list->at_hand) arena_store_free_room(list->store, list->candidates);
    list->candidates = made;
    list->count = count;
    return true;
}

imp_code collection_use_frames(collection *all, bool *done, imp_error *error)
{
    candidate_list *list = all->list;
    if (!any_has_frame(all)) return IMP_SUCCESS;
    arena_store *store = list->store;
    frame_list frames = {
        .first = arena_store_room(store, (list->count + 1) * sizeof *frames.first),
        .of_pair = arena_store_room(store, (list->pair_count + 1) * sizeof *frames.of_pair),
        .store = store};
    imp_code code = IMP_SUCCESS;
    if (frames.first == NULL || frames.of_pair == NULL) code = error_set_memory(error);
    if (code == IMP_SUCCESS) code = find_frames(all, &frames, done, error);
    const bool taken = code == IMP_SUCCESS && *done && take_frames(list, &frames);
    if (code == IMP_SUCCESS && *done && !taken) code = error_set_memory(error);
    if (!taken) frames_forget_half_planes(list, &frames);
    arena_store_free_room(store, frames.at);
    arena_store_free_room(store, frames.first);
    arena_store_free_room(store, frames.of_pair);
    return code;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/shared.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/solid/copies.h"
#include "core/solid/shell_winding.h"

/* Lemma. Let a part be put together of closed shells S_1, ..., S_n, patch p being in c_p of them.
 * The patches with odd c_p are the sum of the shells modulo 2. So, for a point x on no patch, the
 * number of shells that wind around x an odd number of times is odd exactly if that sum does. If
 * the sum winds so around x, at least one shell does, and x is inside of the union. Conversely,
 * where shells share patches and no volume, the sum winds around each point inside of the union.
 * Whether they share none is not known, but seen where it matters: a patch that is left out and has
 * the outside at one of its sides, as the common face of two boxes inside each other has, is not
 * inside of the sum, and the part is not read so. Nor is it if a third shell covers that face:
 * patches at its edges are then neither of the shell around it nor inside of it. (c_p is known but
 * for a common factor, which rule 3 takes away.)
 *
 * Where one of each patch is closed (rule 1), further copies of patches are further copies of
 * shells of the union, or of nothing: the union is the same. */

typedef struct reading {
    const patches *all;
    double slack;
    const limit_watch *watch;
    imp_error *error;
    edges of;           /* of all */
    size_t *one;        /* by patch: the one that stands for it (copies.h) */
    size_t *times;      /* by patch that stands for others: how many they are, it included */
    size_t *part;       /* by patch: if it is the root of a part, the first patch of that */
    size_t *next;       /* by patch: the next one of its part; SIZE_MAX: none */
    size_t factor;      /* all patches of the body are there so often, or a multiple */
    bool *is_kept;      /* by patch */
    bool is_stopped;    /* by the watch */
    bool is_changed;    /* a patch is not kept */
    bool *is_repeated;  /* by patch: it is of a part that is there several times */
    patch *list;        /* room for those of one part, or of all */
    imp_facing *facing; /* of the list */
} reading;

/* --- Copies and parts ------------------------------------------------------------------------- */

/* Patches at whose edges others run along only for a while may belong to any part: then there is
 * one part. */
static void join_loose_edges(const edges *e, const size_t *partner, union_find *sets)
{
    bool is_loose = false;
    for (size_t i = 0; i < e->count; ++i)
        is_loose = is_loose || (partner[i] == SEAM_NONE && !edge_is_point(e, i));
    for (size_t i = 1; i < e->patches->count && is_loose; ++i) union_find_join(sets, 0, i, 1);
}

static void list_parts(reading *r, union_find *sets)
{
    for (size_t i = 0; i < r->all->count; ++i) {
        r->times[i] = 0, r->part[i] = SIZE_MAX;
        r->is_kept[i] = true, r->is_repeated[i] = false;
    }
    for (size_t i = r->all->count; i-- > 0;) {
        size_t *first = &r->part[union_find_root(sets, i, NULL)];
        r->next[i] = *first;
        *first = i;
        r->times[r->one[i]] += 1;
    }
}

static imp_code find_parts(reading *r)
{
    edges *const e = &r->of;
    union_find sets;
    const bool has_sets = union_find_make(&sets, r->all->count);
    size_t *partner = malloc((4 * r->all->count + 1) * sizeof *partner);
    imp_code code = edges_read(e, r->all, r->slack, r->error);
    if (code == IMP_SUCCESS && (!has_sets || partner == NULL || !edges_match(e, partner, &sets) ||
                                !copies_find(e, r->one)))
        code = error_set_memory(r->error);
    if (code == IMP_SUCCESS) {
        join_loose_edges(e, partner, &sets);
        list_parts(r, &sets);
    }
    free(partner);
    if (has_sets) union_find_clear(&sets);
    return code;
}

/* --- Rules ------------------------------------------------------------------------------------ */

/* Which patches of a part a rule keeps. */
typedef enum rule { RULE_ALL, RULE_ONCE, RULE_ODD } rule;

/* Returns whether the rule keeps patch i, which is there `times` times but for a common factor. */
static bool keeps(const reading *r, rule which, size_t i, size_t factor)
{
    if (which == RULE_ALL) return true;
    return r->one[i] == i && (which == RULE_ONCE || r->times[i] / factor % 2 == 1);
}

static size_t common_divisor(size_t a, size_t b)
{
    while (b != 0) {
        const size_t rest = a % b;
        a = b, b = rest;
    }
    return a;
}

static size_t factor_of(const reading *r, size_t first)
{
    size_t factor = 0;
    for (size_t i = first; i != SIZE_MAX; i = r->next[i])
        if (r->one[i] == i) factor = common_divisor(r->times[i], factor);
    return factor;
}

/* Returns whether each patch of a part is there more often than the body as a whole. */
static bool is_repeated(const reading *r, size_t first)
{
    size_t i = first;
    while (i != SIZE_MAX && r->times[r->one[i]] > r->factor) i = r->next[i];
    return i == SIZE_MAX;
}

/* Finds the shells of a list of patches, and whether they are closed. */
static imp_code find_listed(reading *r, size_t count, shells *found, patches *listed,
                            bool *is_closed)
{
    imp_closure closure = {.struct_size = (uint32_t)sizeof closure};
    *listed = *r->all;
    listed->patch = r->list;
    listed->count = count;
    *found = (shells){.facing = r->facing};
    *is_closed = false;
    if (count == 0) return IMP_SUCCESS;
    const imp_code code =
        solid_shells_within(found, listed, r->slack, r->watch, &closure, r->error);
    r->is_stopped = r->is_stopped || closure.verdict == IMP_CLOSURE_STOPPED;
    *is_closed =
        code == IMP_SUCCESS && closure.verdict == IMP_CLOSURE_CLOSED && !found->is_doubtful;
    return code;
}

/* The shells of what is kept of a part. */
typedef struct cover {
    shells found;
    patches listed;
    imp_error *error;
} cover;

static bool share_an_edge(const edges *e, size_t p, size_t q)
{
    bool found = false;
    for (size_t k = 0; k < 16 && !found; ++k) {
        const size_t i = 4 * p + k / 4, j = 4 * q + k % 4;
        found = !edge_is_point(e, i) && !edge_is_point(e, j) && edge_compare(e, i, j) != 0;
    }
    return found;
}

/* How often a shell winds around the middle of a patch. */
static imp_code wind_middle(const cover *c, size_t shell, const patch *p, winding_number *wound)
{
    const double uv[1][2] = {
        {patch_between(p->lo[0], p->hi[0], 1, 2), patch_between(p->lo[1], p->hi[1], 1, 2)}};
    double off[1];
    vec3 x;
    const imp_code code = patch_eval(p, c->listed.t, 1, uv, &x, off, c->error);
    return code == IMP_SUCCESS
               ? shell_wind(&c->found, &c->listed, shell, x, off[0], wound, c->error)
               : code;
}

static bool is_known(const winding_number *wound) { return !wound->is_near && wound->is_whole; }

/* Sets *around to the only shell that winds around the middle of a patch; SIZE_MAX: it is not known
 * that there is just one. */
static imp_code find_around(const cover *c, const patch *p, size_t *around)
{
    bool known = true;
    *around = SIZE_MAX;
    for (size_t k = 0; k < c->found.count && known; ++k) {
        winding_number wound;
        const imp_code code = wind_middle(c, k, p, &wound);
        if (code != IMP_SUCCESS) return code;
        known = is_known(&wound) && (wound.times == 0 || *around == SIZE_MAX);
        if (wound.times != 0) *around = k;
    }
    if (!known) *around = SIZE_MAX;
    return IMP_SUCCESS;
}

/* Sets *fits to whether one shell winds around the middle of patch i, and what is kept and shares
 * an edge with the patch is of that shell or inside of it. */
static imp_code is_within(const reading *r, const cover *c, size_t first, size_t factor, size_t i,
                          bool *fits)
{
    size_t around, k = 0;
    imp_code code = find_around(c, &r->all->patch[i], &around);
    *fits = around != SIZE_MAX;
    for (size_t j = first; j != SIZE_MAX && *fits && code == IMP_SUCCESS; j = r->next[j]) {
        winding_number wound;
        if (!keeps(r, RULE_ODD, j, factor) || c->found.facing[k++].shell == around ||
            !share_an_edge(&r->of, i, j))
            continue;
        code = wind_middle(c, around, &r->all->patch[j], &wound);
        *fits = code == IMP_SUCCESS && is_known(&wound) && wound.times != 0;
    }
    return code;
}

/* Sets *fits to whether what the rule keeps of a part is closed, and all patches that it leaves out
 * but for copies of others lie inside (is_within). */
static imp_code try_rule(reading *r, size_t first, rule which, size_t factor, bool *fits)
{
    size_t count = 0;
    cover c = {.error = r->error};
    for (size_t i = first; i != SIZE_MAX; i = r->next[i])
        if (keeps(r, which, i, factor)) r->list[count++] = r->all->patch[i];
    imp_code code = find_listed(r, count, &c.found, &c.listed, fits);
    if (which != RULE_ODD) return code;
    for (size_t i = first; i != SIZE_MAX && *fits && code == IMP_SUCCESS; i = r->next[i]) {
        if (r->one[i] != i || keeps(r, which, i, factor)) continue;
        r->is_stopped = r->is_stopped || !limit_watch_goes_on(r->watch);
        if (r->is_stopped) return code;
        code = is_within(r, &c, first, factor, i, fits);
    }
    return code;
}

/* Reads the part that begins with this patch, by the first rule that fits. */
static imp_code read_part(reading *r, size_t first)
{
    static const rule rules[] = {RULE_ONCE, RULE_ALL, RULE_ODD};
    const size_t factor = factor_of(r, first);
    bool has_copies = false, fits = false;
    for (size_t i = first; i != SIZE_MAX; i = r->next[i]) has_copies |= r->one[i] != i;
    if (!has_copies) return IMP_SUCCESS;
    for (size_t k = 0; k < sizeof rules / sizeof *rules && !r->is_stopped; ++k) {
        const imp_code code = try_rule(r, first, rules[k], factor, &fits);
        if (code != IMP_SUCCESS || r->is_stopped) return code;
        if (!fits) continue;
        for (size_t i = first; i != SIZE_MAX; i = r->next[i]) {
            r->is_kept[i] = keeps(r, rules[k], i, factor);
            r->is_repeated[i] = rules[k] != RULE_ALL && is_repeated(r, first);
            r->is_changed = r->is_changed || !r->is_kept[i];
        }
        return code;
    }
    return IMP_SUCCESS;
}

/* --- All -------------------------------------------------------------------------------------- */

/* Takes the shells of the patches that are kept, if these are closed. */
static imp_code take_kept(reading *r, shells *s, imp_closure *closure)
{
    size_t count = 0;
    shells found;
    patches listed;
    bool is_closed;
    for (size_t i = 0; i < r->all->count; ++i)
        if (r->is_kept[i]) r->list[count++] = r->all->patch[i];
    const imp_code code = find_listed(r, count, &found, &listed, &is_closed);
    if (code != IMP_SUCCESS || !is_closed) return code;
    closure->verdict = IMP_CLOSURE_CLOSED;
    s->count = found.count;
    s->slack = found.slack;
    s->shares_edges = found.shares_edges;
    s->is_doubtful = false;
    size_t k = 0;
    for (size_t i = 0; i < r->all->count; ++i) {
        s->facing[i] = r->is_kept[i] ? found.facing[k++] : (imp_facing){SIZE_MAX, 0};
        if (r->is_kept[i] && r->is_repeated[i]) s->is_repeated[s->facing[i].shell] = true;
    }
    return code;
}

static imp_code read_parts(reading *r, shells *s, imp_closure *closure)
{
    imp_code code = find_parts(r);
    for (size_t i = 0; i < r->all->count && code == IMP_SUCCESS; ++i)
        if (r->one[i] == i) r->factor = common_divisor(r->times[i], r->factor);
    for (size_t i = 0; i < r->all->count && code == IMP_SUCCESS && !r->is_stopped; ++i)
        if (r->part[i] != SIZE_MAX) code = read_part(r, r->part[i]);
    if (code == IMP_SUCCESS && r->is_changed && !r->is_stopped) code = take_kept(r, s, closure);
    if (r->is_stopped) closure->verdict = IMP_CLOSURE_STOPPED;
    return code;
}

size_t solid_shared_bytes(size_t count)
{
    const reading *r = NULL;
    return edges_bytes(count) + count * (4 * sizeof *r->one + 2 * sizeof *r->is_kept +
                                         sizeof *r->list + sizeof *r->facing);
}

imp_code solid_shells_shared(shells *s, const patches *p, double slack, const limit_watch *watch,
                             imp_closure *closure, imp_error *error)
{
    const size_t room = p->count + 1;
    reading r = {.all = p, .slack = slack, .watch = watch, .error = error};
    r.one = malloc(4 * room * sizeof *r.one);
    r.is_kept = malloc(2 * room * sizeof *r.is_kept);
    r.list = malloc(room * sizeof *r.list);
    r.facing = calloc(room, sizeof *r.facing);
    const bool has_room = r.one != NULL && r.is_kept != NULL && r.list != NULL && r.facing != NULL;
    imp_code code = has_room ? IMP_SUCCESS : error_set_memory(error);
    if (has_room) {
        r.is_repeated = r.is_kept + room;
        r.times = r.one + room, r.part = r.times + room, r.next = r.part + room;
        code = read_parts(&r, s, closure);
    }
    edges_free(&r.of);
    free(r.one);
    free(r.is_kept);
    free(r.list);
    free(r.facing);
    return code;
}

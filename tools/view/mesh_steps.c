/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"
#include "tools/view/mesh.h"

/* Where patches join
 * ==================
 * Each patch has four sides. Two sides of patches of one body are one line in space if both ends
 * and the middle coincide; then the patches join there, smoothly or at an angle. Sides are found by
 * a hash table of their middles. */

/* --- Sides ------------------------------------------------------------------------------------ */

typedef enum join {
    JOIN_ALONE,  /* no other patch continues there */
    JOIN_SMOOTH, /* one does, with the same tangent plane, */
    JOIN_FOLD,   /* at a small angle, */
    JOIN_CREASE, /* or at a large one; or several do */
    JOIN_DONE    /* it is a point, or the other side is drawn */
} join;

typedef struct side {
    uint32_t mesh, patch;
    uint32_t next; /* in the same cell of the hash table, counted from 1 */
    uint8_t which; /* 0: least u, 1: greatest u, 2: least v, 3: greatest v */
    uint8_t join;
    bool other_is_flat;
} side;

/* Points of a side: first + k step, k < count; `inward` leads to the neighbour off the side. */
typedef struct side_points {
    size_t first, step, count, middle;
    ptrdiff_t inward;
} side_points;

static size_t middle_of(const double *at, size_t count)
{
    const double middle = 0.5 * (at[0] + at[count - 1]);
    size_t best = 0;
    for (size_t k = 1; k < count; ++k)
        if (fabs(at[k] - middle) < fabs(at[best] - middle)) best = k;
    return best;
}

static side_points points_of(const mesh *m, const mesh_patch *p, unsigned which)
{
    const size_t along_u = p->nv * (p->nu - 1), along_v = p->nv - 1;
    const ptrdiff_t nv = (ptrdiff_t)p->nv;
    if (which < 2)
        return (side_points){p->first_point + (which == 1 ? along_u : 0), 1, p->nv,
                             middle_of(mesh_v(m, p), p->nv), which == 1 ? -nv : nv};
    return (side_points){p->first_point + (which == 3 ? along_v : 0), p->nv, p->nu,
                         middle_of(mesh_u(m, p), p->nu), which == 3 ? -1 : 1};
}

/* A side in space, for comparing two sides. */
typedef struct side_shape {
    vec from, middle, to;
    vec inward; /* unit length, in the tangent plane at the middle, at right angles to the side */
} side_shape;

static side_shape shape_of(const mesh *m, const mesh_patch *p, unsigned which)
{
    const side_points s = points_of(m, p, which);
    const size_t last = s.first + (s.count - 1) * s.step, at = s.first + s.middle * s.step;
    const size_t before = s.middle > 0 ? at - s.step : at;
    const size_t after = s.middle + 1 < s.count ? at + s.step : at;
    const size_t beside = (size_t)((ptrdiff_t)at + s.inward);
    side_shape shape = {.from = m->point[s.first], .middle = m->point[at], .to = m->point[last]};
    vec in = vec_sub(m->point[beside], m->point[at]);
    if (s.count == 2) {
        const size_t beside_last = (size_t)((ptrdiff_t)last + s.inward);
        const size_t beside_first = (size_t)((ptrdiff_t)s.first + s.inward);
        shape.middle = vec_scale(0.5, vec_add(shape.from, shape.to));
        in = vec_sub(vec_scale(0.5, vec_add(m->point[beside_first], m->point[beside_last])),
                     shape.middle);
    }
    const vec tangent = vec_unit(vec_sub(m->point[after], m->point[before]));
    const vec across = vec_unit(vec_cross(m->normal[at], tangent));
    shape.inward = vec_scale(vec_dot(across, in) < 0 ? -1 : 1, across);
    return shape;
}

static bool are_near(vec a, vec b, double slack) { return vec_length(vec_sub(a, b)) <= slack; }

static bool are_one(const side_shape *a, const side_shape *b, double slack)
{
    if (!are_near(a->middle, b->middle, slack)) return false;
    return (are_near(a->from, b->from, slack) && are_near(a->to, b->to, slack)) ||
           (are_near(a->from, b->to, slack) && are_near(a->to, b->from, slack));
}

/* Cosines of the angles up to which patches join smoothly, and in a fold: 1 and 30 degrees. */
static const double smooth_cosine = 0.99985, fold_cosine = 0.866;

static join join_of(const side_shape *a, const side_shape *b)
{
    const double cosine = -vec_dot(a->inward, b->inward);
    return cosine >= smooth_cosine ? JOIN_SMOOTH : cosine >= fold_cosine ? JOIN_FOLD : JOIN_CREASE;
}

/* --- Which sides are one ---------------------------------------------------------------------- */

typedef struct joiner {
    const mesh *meshes;
    side *sides;
    size_t count;
    uint32_t *heads; /* of lists, by cell; 0: empty */
    size_t mask;     /* number of cells, a power of 2, less 1 */
    double slack;    /* length: points no farther apart are one */
} joiner;

static side_shape shape_at(const joiner *j, size_t k)
{
    const mesh *m = &j->meshes[j->sides[k].mesh];
    return shape_of(m, &m->patches[j->sides[k].patch], j->sides[k].which);
}

/* Cells are four slacks wide; `half` moves a point by a slack to either side. */
static size_t cell_of(const joiner *j, vec p, unsigned halves)
{
    uint64_t hash = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const double shift = halves >> i & 1 ? j->slack : -j->slack;
        const double number = floor((p.x[i] + shift) / (4 * j->slack));
        const int64_t whole = fabs(number) < 0x1p62 ? (int64_t)number : 0;
        hash = (hash ^ (uint64_t)whole) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 29;
    }
    return (size_t)hash & j->mask;
}

/* Returns the earlier side that coincides with this one; SIZE_MAX: none. */
static size_t partner_of(const joiner *j, const side_shape *shape)
{
    for (unsigned halves = 0; halves < 8; ++halves)
        for (uint32_t at = j->heads[cell_of(j, shape->middle, halves)]; at != 0;) {
            const side_shape other = shape_at(j, at - 1);
            if (are_one(shape, &other, j->slack)) return at - 1;
            at = j->sides[at - 1].next;
        }
    return SIZE_MAX;
}

/* Returns whether the patch lies flat on this side. */
static bool is_flat(const joiner *j, const side *s)
{
    return j->meshes[s->mesh].patches[s->patch].is_flat;
}

static void put_side(joiner *j, size_t k)
{
    side *own = &j->sides[k];
    const side_shape shape = shape_at(j, k);
    if (are_near(shape.from, shape.middle, j->slack) &&
        are_near(shape.middle, shape.to, j->slack)) {
        own->join = JOIN_DONE;
        return;
    }
    const size_t partner = partner_of(j, &shape);
    if (partner != SIZE_MAX) {
        const side_shape other = shape_at(j, partner);
        side *first = &j->sides[partner];
        first->other_is_flat = is_flat(j, own);
        first->join = first->join == JOIN_ALONE ? (uint8_t)join_of(&shape, &other) : JOIN_CREASE;
        own->join = JOIN_DONE;
        return;
    }
    uint32_t *head = &j->heads[cell_of(j, shape.middle, 0)];
    own->next = *head;
    *head = (uint32_t)k + 1;
}

static bool joiner_begin(joiner *j, size_t count)
{
    size_t patches = 0, cells = 16, at = 0;
    for (size_t k = 0; k < count; ++k) patches += j->meshes[k].patch_count;
    while (cells < 8 * patches) cells *= 2;
    j->count = 4 * patches, j->mask = cells - 1;
    j->sides = calloc(j->count + 1, sizeof *j->sides);
    j->heads = calloc(cells, sizeof *j->heads);
    if (j->sides == NULL || j->heads == NULL) return false;
    for (size_t k = 0; k < count; ++k)
        for (size_t p = 0; p < j->meshes[k].patch_count; ++p)
            for (uint8_t which = 0; which < 4; ++which)
                j->sides[at++] = (side){(uint32_t)k, (uint32_t)p, 0, which, JOIN_ALONE, true};
    return true;
}

/* --- Steps ------------------------------------------------------------------------------------ */

static bool add_step(mesh *m, size_t from, size_t to, mesh_step_kind kind)
{
    mesh_step *steps = array_reserve(m->steps, m->step_count, &m->step_room, sizeof *steps);
    if (steps == NULL) return false;
    m->steps = steps;
    m->steps[m->step_count++] = (mesh_step){(uint32_t)from, (uint32_t)to, kind};
    return true;
}

static bool add_side(const joiner *j, const side *s, mesh *m)
{
    static const mesh_step_kind kinds[] = {MESH_EDGE, MESH_LINE, MESH_FOLD, MESH_EDGE};
    const mesh_patch *p = &m->patches[s->patch];
    const side_points at = points_of(m, p, s->which);
    if (s->join == JOIN_DONE || (s->join == JOIN_SMOOTH && is_flat(j, s) && s->other_is_flat))
        return true;
    bool good = true;
    for (size_t k = 0; k + 1 < at.count && good; ++k)
        good = add_step(m, at.first + k * at.step, at.first + (k + 1) * at.step, kinds[s->join]);
    return good;
}

/* Adds the marked lines between the sides. */
static bool add_lines(mesh *m, const mesh_patch *p)
{
    const bool *marked_u = m->marked + p->first_line, *marked_v = marked_u + p->nu;
    const size_t first = p->first_point, nv = p->nv;
    bool good = true;
    for (size_t i = 1; i + 1 < p->nu; ++i)
        for (size_t j = 0; j + 1 < nv && marked_u[i] && good; ++j)
            good = add_step(m, first + i * nv + j, first + i * nv + j + 1, MESH_LINE);
    for (size_t j = 1; j + 1 < nv; ++j)
        for (size_t i = 0; i + 1 < p->nu && marked_v[j] && good; ++i)
            good = add_step(m, first + i * nv + j, first + (i + 1) * nv + j, MESH_LINE);
    return good;
}

/* Folds shorter than this part of all there is, in the mean, would only darken a surface. */
static const double fold_share = 0.012;

static void drop_short_folds(mesh *m, double size)
{
    double sum = 0;
    size_t folds = 0, kept = 0;
    for (size_t k = 0; k < m->step_count; ++k) {
        const mesh_step *s = &m->steps[k];
        if (s->kind != MESH_FOLD) continue;
        sum += vec_length(vec_sub(m->point[s->to], m->point[s->from]));
        folds += 1;
    }
    if (sum >= fold_share * size * (double)folds) return;
    for (size_t k = 0; k < m->step_count; ++k)
        if (m->steps[k].kind != MESH_FOLD) m->steps[kept++] = m->steps[k];
    m->step_count = kept;
}

/* Points no farther apart than this part of all there is are one. */
static const double join_share = 1e-6;

static imp_code look(allowance *l, size_t done, imp_error *error)
{
    enum { ITEMS_A_LOOK = 1024 };
    return done % ITEMS_A_LOOK == 0 ? allowance_check(l, "lines were chosen", error) : IMP_SUCCESS;
}

static imp_code add_steps(const joiner *j, mesh *meshes, size_t count, allowance *l,
                          imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < j->count && code == IMP_SUCCESS; ++k) {
        code = look(l, k, error);
        if (code == IMP_SUCCESS && !add_side(j, &j->sides[k], &meshes[j->sides[k].mesh]))
            code = mesh_no_memory(error);
    }
    for (size_t k = 0; k < count; ++k)
        for (size_t p = 0; p < meshes[k].patch_count && code == IMP_SUCCESS; ++p) {
            code = look(l, p, error);
            if (code == IMP_SUCCESS && !meshes[k].patches[p].is_flat &&
                !add_lines(&meshes[k], &meshes[k].patches[p]))
                code = mesh_no_memory(error);
        }
    return code;
}

imp_code mesh_find_steps(mesh *meshes, size_t count, double size, allowance *l, imp_error *error)
{
    joiner j = {.meshes = meshes, .slack = join_share * size};
    imp_code code = joiner_begin(&j, count) ? IMP_SUCCESS : mesh_no_memory(error);
    for (size_t k = 0; k < j.count && code == IMP_SUCCESS; ++k) {
        code = look(l, k, error);
        if (code == IMP_SUCCESS) put_side(&j, k);
    }
    if (code == IMP_SUCCESS) code = add_steps(&j, meshes, count, l, error);
    for (size_t k = 0; k < count && code == IMP_SUCCESS; ++k) drop_short_folds(&meshes[k], size);
    free(j.sides);
    free(j.heads);
    return code;
}

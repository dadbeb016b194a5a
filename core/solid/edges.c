/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/edges.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/status.h"
#include "core/solid/cell_hash.h"

/* An edge in the list of its bucket. */
typedef struct edge_link {
    uint32_t next; /* END: it is the last */
    uint32_t tag;  /* bits of its cell's hash: most others of the bucket have other ones */
} edge_link;

/* --- Reading ---------------------------------------------------------------------------------- */

/* Bodies of many patches get fewer points for each edge. */
static int steps_for(size_t count) { return count <= 256 ? 16 : count <= 65536 ? 4 : 2; }

static imp_code read_patch(edges *e, size_t index, imp_error *error)
{
    enum { STEPS_MAX = 16 };
    const patch *p = &e->patches->patch[index];
    const int points = e->steps + 1;
    double uv[4 * (STEPS_MAX + 1)][2];
    for (int k = 0; k < 4 * points; ++k) {
        double from[2], to[2];
        patch_corner(p, k / points, from);
        patch_corner(p, (k / points + 1) % 4, to);
        for (int i = 0; i < 2; ++i) uv[k][i] = patch_between(from[i], to[i], k % points, e->steps);
    }
    vec3 *at = e->at + 4 * index * (size_t)points;
    const imp_code code =
        patch_eval(p, e->patches->t, (size_t)(4 * points), (const double(*)[2])uv, at, NULL, error);
    for (int k = 0; code == IMP_SUCCESS && k < 4 * points; ++k)
        e->bounded = e->bounded && vec3_norm1(at[k]) < INFINITY;
    return code;
}

size_t edges_bytes(size_t count)
{
    const size_t links = sizeof(edge_link) + 2 * sizeof(uint32_t); /* up to 2 buckets an edge */
    return 4 * count * ((size_t)(steps_for(count) + 1) * sizeof(vec3) + links);
}

imp_code edges_read(edges *e, const patches *p, double slack, imp_error *error)
{
    *e = (edges){.patches = p,
                 .count = 4 * p->count,
                 .steps = steps_for(p->count),
                 .slack = slack,
                 .bounded = true};
    e->at = malloc((e->count + 1) * (size_t)(e->steps + 1) * sizeof *e->at);
    if (e->at == NULL) return error_set_memory(error);
    for (size_t i = 0; i < p->count; ++i) {
        const imp_code code = read_patch(e, i, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

void edges_free(edges *e)
{
    free(e->at);
    *e = (edges){0};
}

/* --- Comparing two ---------------------------------------------------------------------------- */

static double distance(vec3 a, vec3 b) { return vec3_norm(vec3_sub(a, b)); }

bool edge_is_point(const edges *e, size_t i)
{
    const vec3 *x = edge_points(e, i);
    for (int k = 1; k <= e->steps; ++k)
        if (!(distance(x[k], x[0]) <= e->slack)) return false;
    return true;
}

int edge_compare(const edges *e, size_t i, size_t j)
{
    const vec3 *x = edge_points(e, i), *y = edge_points(e, j);
    const int n = e->steps;
    bool same = true, opposite = true;
    for (int k = 0; k <= n && (same || opposite); ++k) {
        same &= distance(x[k], y[k]) <= e->slack;
        opposite &= distance(x[k], y[n - k]) <= e->slack;
    }
    return opposite ? -1 : same ? 1 : 0;
}

/* Finds the nearest point of edge j to x between its points a and b (numbers, not whole), by golden
 * section search. Returns its distance, and sets *where to its number. */
static double refine(const edges *e, size_t j, double a, double b, vec3 x, double *where)
{
    const double ratio = 0.6180339887498949;
    const patch *p = &e->patches->patch[j / 4];
    double from[2], to[2], least = INFINITY;
    patch_corner(p, (int)(j % 4), from);
    patch_corner(p, (int)(j % 4 + 1) % 4, to);
    for (int n = 0; n < 60; ++n) {
        const double number[2] = {b - ratio * (b - a), a + ratio * (b - a)};
        double at[2][2], d[2];
        vec3 y[2];
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 2; ++k)
                at[i][k] = from[k] + (to[k] - from[k]) * (number[i] / e->steps);
        if (patch_eval(p, e->patches->t, 2, (const double(*)[2])at, y, NULL, NULL) != IMP_SUCCESS)
            return INFINITY;
        for (int i = 0; i < 2; ++i) {
            d[i] = distance(y[i], x);
            if (d[i] < least) least = d[i], *where = number[i];
        }
        if (d[0] < d[1])
            b = number[1];
        else
            a = number[0];
    }
    return least;
}

/* Returns the direction of an edge at its point number k, which need not be whole. */
static vec3 direction_at(const edges *e, size_t i, double k)
{
    const vec3 *x = edge_points(e, i);
    const int before = (int)fmin(fmax(floor(k - 0.5), 0), e->steps - 1);
    const int after = (int)fmax(fmin(ceil(k + 0.5), e->steps), before + 1);
    return vec3_sub(x[after], x[before]);
}

/* Returns the number of the point of edge j that is nearest to x, among those farther than one step
 * from number `but`; -1: there is none. */
static int nearest_number(const edges *e, size_t j, vec3 x, int but)
{
    const vec3 *y = edge_points(e, j);
    int best = -1;
    for (int n = 0; n <= e->steps; ++n)
        if ((but < 0 || abs(n - but) > 1) && (best < 0 || distance(y[n], x) < distance(y[best], x)))
            best = n;
    return best;
}

/* Returns the distance of x from edge j near its point number n, and sets *where to the number of
 * the nearest place. A distance of more than four steps is not refined. */
static double distance_near(const edges *e, size_t j, int n, vec3 x, double *where)
{
    const vec3 *y = edge_points(e, j);
    const int a = n > 0 ? n - 1 : 0, b = n < e->steps ? n + 1 : e->steps;
    const double least = distance(y[n], x);
    *where = n;
    if (least <= e->slack) return least;
    if (least > 4 * (distance(y[a], y[n]) + distance(y[n], y[b])) + e->slack) return least;
    return refine(e, j, a, b, x, where);
}

/* Between its ends, an edge runs along another where their directions, chords of two steps, differ
 * by less than 60 degrees. Else the other only ends there, as where two halves of a face meet at
 * the edge of a whole one. */
#define LEAST_COSINE 0.5

int edge_passes(const edges *e, size_t i, int k, size_t j)
{
    const vec3 x = edge_points(e, i)[k];
    double where;
    /* A closed edge comes near a point at both of its ends. */
    int n = nearest_number(e, j, x, -1);
    if (!(distance_near(e, j, n, x, &where) <= e->slack)) {
        n = nearest_number(e, j, x, n);
        if (n < 0 || !(distance_near(e, j, n, x, &where) <= e->slack)) return 0;
    }
    const vec3 along = direction_at(e, i, k), other = direction_at(e, j, where);
    const double product = vec3_dot(along, other);
    const bool is_inner = k > 0 && k < e->steps;
    if (is_inner && fabs(product) < LEAST_COSINE * vec3_norm(along) * vec3_norm(other)) return 0;
    return product >= 0 ? 1 : -1;
}

/* --- Matching all ----------------------------------------------------------------------------- */

/* Edges by the cell of their middle point. Cells are larger than slack: points within slack of each
 * other are in the same cell or in neighbours. */
typedef struct cells {
    const edges *edges;
    union_find *sets;         /* of patches, which seams join; NULL: nobody asked for them */
    const imp_facing *facing; /* of patches; NULL: not known */
    double size;              /* of a cell */
    uint32_t *first;          /* of each bucket; END: it is empty */
    edge_link *link;          /* of each edge */
    size_t buckets;           /* a power of 2 */
} cells;

enum { CELL_MIN = 4, CELL_MAX = 64 }; /* size in slacks */
#define END UINT32_MAX

/* Returns the size of a cell. A box of 2 slack around a middle point lies in (1 + 2 slack / size)^3
 * cells on average, 3.4 of the least size and 1.1 of the greatest, and each costs a miss of the
 * cache. But a cell must not have many edges: N edges of a surface of size s are s / sqrt(N)
 * apart. */
static double cell_size(const edges *e)
{
    const double apart = e->patches->size / sqrt((double)(e->count + 1));
    return fmin(fmax(apart / 4, CELL_MIN * e->slack), CELL_MAX * e->slack);
}

/* Returns a point's cell. Cells are counted from the first point of all edges, so that their
 * numbers stay small wherever the body is. */
static double cell_number(const cells *c, vec3 x, int i, double shift)
{
    return floor((x.x[i] - c->edges->at[0].x[i] + shift) / c->size) + 0.0; /* 0, not -0 */
}

static size_t bucket_of(const cells *c, size_t hash) { return hash & (c->buckets - 1); }

static uint32_t tag_of(size_t hash) { return (uint32_t)(hash >> (8 * sizeof hash - 32)); }

static vec3 middle_of(const edges *e, size_t i) { return edge_points(e, i)[e->steps / 2]; }

static bool cells_fill(cells *c, const edges *e, union_find *sets)
{
    *c = (cells){.edges = e, .sets = sets, .size = cell_size(e), .buckets = 16};
    if (e->count >= END) return false; /* their points would take 300 GB */
    while (c->buckets < e->count) c->buckets *= 2;
    c->first = malloc(c->buckets * sizeof *c->first);
    c->link = malloc((e->count + 1) * sizeof *c->link);
    if (c->first == NULL || c->link == NULL) return false;
    for (size_t k = 0; k < c->buckets; ++k) c->first[k] = END;
    for (size_t i = 0; i < e->count; ++i) {
        if (edge_is_point(e, i)) continue;
        double at[3];
        for (int k = 0; k < 3; ++k) at[k] = cell_number(c, middle_of(e, i), k, 0);
        const size_t hash = cell_hash(at);
        uint32_t *first = &c->first[bucket_of(c, hash)];
        c->link[i] = (edge_link){*first, tag_of(hash)};
        *first = (uint32_t)i;
    }
    return true;
}

/* How many partners of one edge were found, and one of them. */
typedef struct partners {
    size_t count, first;
    int sum; /* of the directions of those of the same shell, with the signs of their patches */
} partners;

/* Looks for partners of edge i in the cells of one hash. */
static void match_cell(const cells *c, size_t i, size_t hash, partners *found)
{
    for (uint32_t j = c->first[bucket_of(c, hash)]; j != END; j = c->link[j].next) {
        if (c->link[j].tag != tag_of(hash)) continue;
        const int direction = j == i ? 0 : edge_compare(c->edges, i, j);
        if (direction == 0) continue;
        if (found->count++ == 0) found->first = j;
        if (c->facing != NULL && c->facing[j / 4].shell == c->facing[i / 4].shell)
            found->sum += direction * c->facing[j / 4].sign;
        if (c->sets != NULL) union_find_join(c->sets, i / 4, j / 4, 1);
    }
}

static partners find_partners(const cells *c, size_t i)
{
    const vec3 middle = middle_of(c->edges, i);
    size_t seen[8];
    int count = 0;
    partners found = {0, SEAM_NONE, 0};
    for (int corner = 0; corner < 8; ++corner) {
        double at[3];
        for (int k = 0; k < 3; ++k) {
            const double shift = corner >> k & 1 ? c->edges->slack : -c->edges->slack;
            at[k] = cell_number(c, middle, k, shift);
        }
        const size_t hash = cell_hash(at);
        bool again = false;
        for (int k = 0; k < count; ++k) again |= seen[k] == hash;
        if (again) continue;
        seen[count++] = hash;
        match_cell(c, i, hash, &found);
    }
    return found;
}

static size_t match_edge(const cells *c, size_t i)
{
    const partners found = find_partners(c, i);
    if (found.count < 2) return found.first;
    return found.count % 2 == 1 ? SEAM_EVEN : SEAM_ODD;
}

bool edges_match(const edges *e, size_t *partner, union_find *sets)
{
    cells c;
    const bool filled = cells_fill(&c, e, sets);
    for (size_t i = 0; filled && i < e->count; ++i)
        partner[i] = edge_is_point(e, i) ? SEAM_NONE : match_edge(&c, i);
    free(c.first);
    free(c.link);
    return filled;
}

bool edges_cancel(const edges *e, const size_t *partner, const imp_facing *facing, bool *cancel)
{
    cells c;
    const bool filled = cells_fill(&c, e, NULL);
    c.facing = facing;
    *cancel = true;
    for (size_t i = 0; filled && *cancel && i < e->count; ++i)
        if (partner[i] == SEAM_EVEN && !edge_is_point(e, i))
            *cancel = find_partners(&c, i).sum + facing[i / 4].sign == 0;
    free(c.first);
    free(c.link);
    return filled;
}

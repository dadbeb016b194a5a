/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_BOX_STACKS_H
#define TESTS_SUPPORT_BOX_STACKS_H

#include "tests/support/solid_helpers.h"

/* Unit boxes in the cells of a grid, as surfaces of type box and as triangles of one mesh. */

enum { N = 3, CELLS = N * N * N, MIDDLE = CELLS / 2 };

/* How often the unit box of each cell is there. */
typedef struct stack {
    int times[CELLS];
} stack;

static inline stack stack_of(const char *cells)
{
    stack s;
    for (int k = 0; k < CELLS; ++k) s.times[k] = cells[k] - '0';
    return s;
}

static inline void cell_at(int k, int at[3])
{
    at[0] = k % N, at[1] = k / N % N, at[2] = k / (N * N);
}

/* The stack as surfaces of type box. */
static inline scene_words boxes_of(const stack *s)
{
    scene_words w;
    int length = 0;
    for (int k = 0; k < CELLS; ++k)
        for (int n = 0; n < s->times[k]; ++n) {
            int at[3];
            cell_at(k, at);
            length += snprintf(w.text + length, sizeof w.text - (size_t)length,
                               "%s{\"type\": \"box\", \"size\": [1, 1, 1], \"center\": [%d.5, "
                               "%d.5, %d.5]}",
                               length > 0 ? ", " : "", at[0], at[1], at[2]);
        }
    return w;
}

/* Triangles of one mesh, whose corners are numbers of points in a grid. */
typedef struct triangles {
    int corner[4096][3];
    int count;
} triangles;

/* Adds the two triangles of a square, each with its corners in some order. */
static inline void add_square(triangles *t, const int corner[4], uint64_t *state)
{
    static const int halves[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (int half = 0; half < 2; ++half) {
        const int from = (int)random_between(state, 0, 3);
        const int way = random_between(state, 0, 1) < 0.5 ? 1 : 2;
        ck_assert_int_lt(t->count, 4096);
        for (int k = 0; k < 3; ++k)
            t->corner[t->count][k] = corner[halves[half][(from + way * k) % 3]];
        t->count += 1;
    }
}

/* Adds the box of these corners; points are numbered in rows of N + 1. */
static inline void add_box(triangles *t, const int lo[3], const int hi[3], uint64_t *state)
{
    for (int i = 0; i < 3; ++i)
        for (int side = 0; side < 2; ++side) {
            int corner[4];
            for (int k = 0; k < 4; ++k) {
                int at[3];
                at[i] = side == 0 ? lo[i] : hi[i];
                at[(i + 1) % 3] = k == 1 || k == 2 ? hi[(i + 1) % 3] : lo[(i + 1) % 3];
                at[(i + 2) % 3] = k >= 2 ? hi[(i + 2) % 3] : lo[(i + 2) % 3];
                corner[k] = at[0] + (N + 1) * (at[1] + (N + 1) * at[2]);
            }
            add_square(t, corner, state);
        }
}

static inline void add_stack(triangles *t, const stack *s, uint64_t *state)
{
    for (int k = 0; k < CELLS; ++k)
        for (int n = 0; n < s->times[k]; ++n) {
            int lo[3];
            cell_at(k, lo);
            add_box(t, lo, (const int[3]){lo[0] + 1, lo[1] + 1, lo[2] + 1}, state);
        }
}

/* The mesh; points 1 and 2 of a row are at `inner` and 3 - inner. */
static inline scene_words mesh_of(const triangles *t, double inner)
{
    const double place[N + 1] = {0, inner, N - inner, N};
    scene_words w;
    int length = snprintf(w.text, sizeof w.text, "{\"type\": \"mesh\", \"points\": [");
    for (int k = 0; k < (N + 1) * (N + 1) * (N + 1); ++k)
        length += snprintf(w.text + length, sizeof w.text - (size_t)length, "%s[%.17g,%.17g,%.17g]",
                           k > 0 ? "," : "", place[k % (N + 1)], place[k / (N + 1) % (N + 1)],
                           place[k / (N + 1) / (N + 1)]);
    length += snprintf(w.text + length, sizeof w.text - (size_t)length, "], \"faces\": [");
    for (int k = 0; k < t->count; ++k)
        length += snprintf(w.text + length, sizeof w.text - (size_t)length, "%s[%d,%d,%d]",
                           k > 0 ? "," : "", t->corner[k][0], t->corner[k][1], t->corner[k][2]);
    length += snprintf(w.text + length, sizeof w.text - (size_t)length, "]}");
    ck_assert_int_lt(length, (int)sizeof w.text - 1024);
    return w;
}

#endif

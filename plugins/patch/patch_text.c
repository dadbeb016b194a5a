/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/patch_text.h"

#include "plugins/patch/bernstein.h"

#include <impinge/interval.h>

/* --- Words ------------------------------------------------------------------------------------ */

void patch_add_name(const imp_text_sink *to, char letter, size_t number, const char *after)
{
    to->add(to, &letter, 1);
    imp_add_whole(to, number);
    imp_add_text(to, after);
}

/* " * base^power", nothing for the power 0. */
static void add_power(const imp_text_sink *to, const char *base, int power)
{
    if (power == 0) return;
    imp_add_text(to, "*");
    imp_add_text(to, base);
    if (power == 1) return;
    imp_add_text(to, "^");
    imp_add_whole(to, (uint64_t)power);
}

void bernstein_define(const imp_text_sink *to, char letter, int n, char variable)
{
    const char up[] = {variable, '\0'}, down[] = {'(', '1', ' ', '-', ' ', variable, ')', '\0'};
    for (int i = 0; i <= n; ++i) {
        patch_add_name(to, letter, (size_t)i, " = ");
        imp_add_number(to, bernstein_choose(n, i));
        add_power(to, up, i);
        add_power(to, down, n - i);
        imp_add_text(to, "; ");
    }
}

/* --- Sums over control points ----------------------------------------------------------------- */

/* Control points as they were given; velocities and weights are NULL where there are none. */
typedef struct given_points {
    const double *points, *velocities, *weights;
} given_points;

enum { WEIGHTS = 3 }; /* instead of a coordinate */

/* w (P + V t) of one point and coordinate, or w. */
static void add_term(const imp_text_sink *to, const given_points *g, size_t at, size_t axis)
{
    if (g->weights != NULL) imp_add_number(to, g->weights[at]);
    if (axis == WEIGHTS) return;
    if (g->weights != NULL) imp_add_text(to, "*");
    if (g->velocities != NULL) imp_add_text(to, "(");
    imp_add_number(to, g->points[3 * at + axis]);
    if (g->velocities == NULL) return;
    imp_add_text(to, " + ");
    imp_add_number(to, g->velocities[3 * at + axis]);
    imp_add_text(to, "*t)");
}

/* What a double sum runs over: point i, j is number first + i * row + j. */
typedef struct point_grid {
    size_t first, rows, columns, row;
    char along_u, along_v; /* letters of both bases; along_v 0: columns is 1, and there is none */
} point_grid;

static void add_sum(const imp_text_sink *to, const given_points *g, const point_grid *grid,
                    size_t axis)
{
    for (size_t i = 0; i < grid->rows; ++i) {
        if (i > 0) imp_add_text(to, " + ");
        patch_add_name(to, grid->along_u, i, "*(");
        for (size_t j = 0; j < grid->columns; ++j) {
            if (j > 0) imp_add_text(to, " + ");
            if (grid->along_v != 0) patch_add_name(to, grid->along_v, j, "*");
            add_term(to, g, grid->first + i * grid->row + j, axis);
        }
        imp_add_text(to, ")");
    }
}

/* "max(LEAST, ": W is a mean of the weights, so no less than the least of them; intervals of large
 * regions know it by this. */
static void begin_weight(const imp_text_sink *to, const given_points *g, const point_grid *grid)
{
    double least = g->weights[grid->first];
    for (size_t i = 0; i < grid->rows; ++i)
        for (size_t j = 0; j < grid->columns; ++j)
            least = imp_smaller(least, g->weights[grid->first + i * grid->row + j]);
    imp_add_text(to, "max(");
    imp_add_number(to, least);
    imp_add_text(to, ", ");
}

/* The three coordinates, with ';' between them. */
static void add_coordinates(const imp_text_sink *to, const given_points *g, const point_grid *grid)
{
    if (g->weights != NULL) {
        imp_add_text(to, "W = ");
        begin_weight(to, g, grid);
        add_sum(to, g, grid, WEIGHTS);
        imp_add_text(to, "); ");
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        imp_add_text(to, axis > 0 ? "; (" : "(");
        add_sum(to, g, grid, axis);
        imp_add_text(to, g->weights != NULL ? ")/W" : ")");
    }
}

/* --- Patches and curves ----------------------------------------------------------------------- */

static given_points given_of(const patch *f)
{
    const size_t points = patch_points(f->degree);
    given_points g = {.points = f->given};
    const double *next = f->given + 3 * points;
    if (f->lanes == PATCH_LANES_MAX) {
        g.velocities = next;
        next += 3 * points;
    }
    if (f->rational) g.weights = next;
    return g;
}

void patch_write(const patch *f, const imp_text_sink *to)
{
    const given_points g = given_of(f);
    const size_t rows = (size_t)f->degree[0] + 1, columns = (size_t)f->degree[1] + 1;
    const point_grid grid = {0, rows, columns, columns, 'a', 'b'};
    imp_add_text(to, "u in [0, 1]; v in [0, 1]; ");
    bernstein_define(to, 'a', f->degree[0], 'u');
    bernstein_define(to, 'b', f->degree[1], 'v');
    add_coordinates(to, &g, &grid);
}

void curve_write(const patch *f, char letter, char variable, const imp_text_sink *to)
{
    const given_points g = given_of(f);
    const size_t count = (size_t)f->degree[0] + 1;
    const char basis = (char)(letter - 'a' + 'A');
    const point_grid grid = {0, count, 1, 1, basis, 0};
    bernstein_define(to, basis, f->degree[0], variable);
    for (size_t axis = 0; axis < 3; ++axis) {
        patch_add_name(to, letter, axis, " = (");
        add_sum(to, &g, &grid, axis);
        imp_add_text(to, ")");
        if (g.weights != NULL) imp_add_text(to, "/");
        if (g.weights != NULL) begin_weight(to, &g, &grid);
        if (g.weights != NULL) add_sum(to, &g, &grid, WEIGHTS);
        imp_add_text(to, g.weights != NULL ? "); " : "; ");
    }
}

/* --- Triangles -------------------------------------------------------------------------------- */

/* sum_j C_j(v) of degree k over the first k + 1 points of row k. */
static void add_row(const imp_text_sink *to, const given_points *g, int n, int k, size_t axis)
{
    for (int j = 0; j <= k; ++j) {
        if (j > 0) imp_add_text(to, " + ");
        imp_add_number(to, bernstein_choose(k, j));
        add_power(to, "v", j);
        add_power(to, "(1 - v)", k - j);
        imp_add_text(to, "*");
        add_term(to, g, (size_t)(k * (n + 1) + j), axis);
    }
}

static void add_rows(const imp_text_sink *to, const given_points *g, int n, size_t axis)
{
    for (int k = 0; k <= n; ++k) {
        if (k > 0) imp_add_text(to, " + ");
        patch_add_name(to, 'a', (size_t)k, "*(");
        add_row(to, g, n, k, axis);
        imp_add_text(to, ")");
    }
}

void triangle_write(const patch *f, const imp_text_sink *to)
{
    const given_points g = given_of(f);
    imp_add_text(to, "u in [0, 1]; v in [0, 1]; ");
    bernstein_define(to, 'a', f->degree[0], 'u');
    if (g.weights != NULL) {
        const size_t side = (size_t)f->degree[0] + 1;
        imp_add_text(to, "W = ");
        begin_weight(to, &g, &(point_grid){.rows = side, .columns = side, .row = side});
        add_rows(to, &g, f->degree[0], WEIGHTS);
        imp_add_text(to, "); ");
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        imp_add_text(to, axis > 0 ? "; (" : "(");
        add_rows(to, &g, f->degree[0], axis);
        imp_add_text(to, g.weights != NULL ? ")/W" : ")");
    }
}

/* --- NURBS surfaces --------------------------------------------------------------------------- */

/* "(u - FROM)/(END - FROM)*", which rises from 0 at one number to 1 at the other. */
static void add_ramp(const imp_text_sink *to, char variable, double from, double end)
{
    imp_add_text(to, "(");
    to->add(to, &variable, 1);
    imp_add_text(to, " - ");
    imp_add_number(to, from);
    imp_add_text(to, ")/(");
    imp_add_number(to, end);
    imp_add_text(to, " - ");
    imp_add_number(to, from);
    imp_add_text(to, ")*");
}

/* Basis function r of degree d in a span is letter, d, '_', r, and of the highest degree letter and
 * r alone. */
static void add_basis(const imp_text_sink *to, char letter, int d, int degree, int r)
{
    if (d < degree) patch_add_name(to, letter, (size_t)d, "_");
    if (d == degree) to->add(to, &letter, 1);
    imp_add_whole(to, (uint64_t)r);
}

/* Defines the p + 1 basis functions that are not 0 in the span, by the recursion of Cox and de Boor
 * from the constant 1: with q the knot where the span begins, function r of degree d is that of
 * number q - d + r, and
 *
 *   N_j,d = (u - k_j)/(k_(j+d) - k_j) N_j,d-1 + (k_(j+d+1) - u)/(k_(j+d+1) - k_(j+1)) N_j+1,d-1;
 *
 * both knots of each quotient enclose the span, so they differ. */
static void define_basis(const imp_text_sink *to, const knots *k, size_t span, char letter,
                         char variable)
{
    const double *knot = k->at + k->last[span];
    for (int d = 1; d <= k->degree; ++d)
        for (int r = 0; r <= d; ++r) {
            const int j = r - d;
            add_basis(to, letter, d, k->degree, r);
            imp_add_text(to, " = ");
            if (r > 0) {
                add_ramp(to, variable, knot[j], knot[j + d]);
                if (d > 1) add_basis(to, letter, d - 1, k->degree, r - 1);
                if (d == 1) imp_add_text(to, "1");
            }
            if (r > 0 && r < d) imp_add_text(to, " + ");
            if (r < d) {
                add_ramp(to, variable, knot[j + d + 1], knot[j + 1]);
                if (d > 1) add_basis(to, letter, d - 1, k->degree, r);
                if (d == 1) imp_add_text(to, "1");
            }
            imp_add_text(to, "; ");
        }
}

static void write_cell(const nurbs_instance *f, size_t i, size_t j, const imp_text_sink *to)
{
    const knots *u = &f->side[0], *v = &f->side[1];
    const size_t rows = (size_t)u->degree + 1, columns = (size_t)v->degree + 1;
    const given_points g = {f->points, f->velocities, f->weights};
    const point_grid grid = {(u->last[i] + 1 - rows) * v->count + v->last[j] + 1 - columns,
                             rows,
                             columns,
                             v->count,
                             'a',
                             'b'};
    imp_add_range(to, "u", u->ends[i], u->ends[i + 1]);
    imp_add_range(to, "v", v->ends[j], v->ends[j + 1]);
    define_basis(to, u, i, 'a', 'u');
    define_basis(to, v, j, 'b', 'v');
    add_coordinates(to, &g, &grid);
}

void nurbs_write(const nurbs_instance *f, const imp_text_sink *to)
{
    for (size_t i = 0; i < f->side[0].spans; ++i)
        for (size_t j = 0; j < f->side[1].spans; ++j) {
            if (i + j > 0) imp_add_text(to, " | ");
            write_cell(f, i, j, to);
        }
}

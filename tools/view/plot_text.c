/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "tools/view/plot.h"

/* A grid of characters; row 0 is the top. */
typedef struct grid {
    const plot *plot;
    plot_scale scale;
    size_t columns, rows;
    char *cells;
} grid;

static void put(grid *g, size_t column, size_t row, char c)
{
    if (column < g->columns && row < g->rows) g->cells[row * g->columns + column] = c;
}

static size_t index_of(double place, size_t count)
{
    if (!(place > 0)) return 0;
    return place < 1 ? (size_t)(place * (double)count) : count - 1;
}

static size_t row_of(const grid *g, double y)
{
    const double place = plot_place(g->plot, &g->scale, 1, y);
    return g->rows - 1 - index_of(place, g->rows);
}

/* Each column shows the lowest and the highest of the steps it touches. */
static void print_band(grid *g, const plot_series *s)
{
    for (size_t k = 0; k < s->count; ++k) {
        const size_t from = index_of(plot_place(g->plot, &g->scale, 0, s->x[k]), g->columns);
        const size_t to = index_of(plot_place(g->plot, &g->scale, 0, s->x[k + 1]), g->columns);
        const size_t low = row_of(g, s->y[k]), high = row_of(g, s->high[k]);
        for (size_t c = from; c < to || c == from; ++c)
            for (size_t r = high; r <= low; ++r) put(g, c, r, s->letter);
    }
}

static void print_curve(grid *g, const plot_series *s)
{
    for (size_t k = 0; k < s->count; ++k) {
        const double x = plot_place(g->plot, &g->scale, 0, s->x[k]);
        if (isfinite(x) && isfinite(plot_place(g->plot, &g->scale, 1, s->y[k])))
            put(g, index_of(x, g->columns), row_of(g, s->y[k]), s->letter);
    }
}

static void fill_grid(grid *g)
{
    const plot *p = g->plot;
    memset(g->cells, ' ', g->columns * g->rows);
    for (size_t k = 0; k < p->count; ++k)
        if (p->series[k].kind == PLOT_BAND) print_band(g, &p->series[k]);
    const double mark = p->marked ? plot_place(p, &g->scale, 0, p->mark) : NAN;
    for (size_t r = 0; r < g->rows && isfinite(mark); ++r) {
        const size_t at = index_of(mark, g->columns);
        if (g->cells[r * g->columns + at] == ' ') put(g, at, r, '|');
    }
    const double level = p->has_level ? plot_place(p, &g->scale, 1, p->level) : NAN;
    for (size_t c = 0; c < g->columns && isfinite(level); ++c) {
        const size_t row = row_of(g, p->level);
        if (g->cells[row * g->columns + c] == ' ') put(g, c, row, '-');
    }
    for (size_t k = 0; k < p->count; ++k)
        if (p->series[k].kind != PLOT_BAND) print_curve(g, &p->series[k]);
    const double x = p->has_point ? plot_place(p, &g->scale, 0, p->point[0]) : NAN;
    if (isfinite(x) && isfinite(plot_place(p, &g->scale, 1, p->point[1])))
        put(g, index_of(x, g->columns), row_of(g, p->point[1]), '*');
}

enum { MARGIN = 11 }; /* columns of the vertical scale */

static void print_rows(const grid *g, FILE *to)
{
    double ticks[16];
    const size_t n = plot_ticks(g->plot, &g->scale, 1, ticks, 16);
    for (size_t r = 0; r < g->rows; ++r) {
        char label[32] = "";
        for (size_t k = 0; k < n; ++k)
            if (row_of(g, ticks[k]) == r) snprintf(label, sizeof label, "%.4g", ticks[k]);
        size_t length = g->columns;
        while (length > 0 && g->cells[r * g->columns + length - 1] == ' ') --length;
        fprintf(to, "%*s |%.*s\n", MARGIN - 2, label, (int)length, g->cells + r * g->columns);
    }
}

static void print_x_axis(const grid *g, FILE *to)
{
    double ticks[16];
    const size_t n = plot_ticks(g->plot, &g->scale, 0, ticks, 16);
    size_t column = 0;
    fprintf(to, "%*s+", MARGIN - 1, "");
    for (size_t c = 0; c < g->columns; ++c) fputc('-', to);
    fprintf(to, "\n%*s", MARGIN, "");
    for (size_t k = 0; k < n; ++k) {
        char label[32];
        const size_t length = (size_t)snprintf(label, sizeof label, "%.4g", ticks[k]);
        const size_t at = index_of(plot_place(g->plot, &g->scale, 0, ticks[k]), g->columns);
        size_t begin = at > length / 2 ? at - length / 2 : 0;
        if (begin + length > g->columns) begin = g->columns - length;
        if (k > 0 && begin < column + 1) continue;
        fprintf(to, "%*s%s", (int)(begin - column), "", label);
        column = begin + length;
    }
    fprintf(to, "\n%*s%s\n", MARGIN, "", g->plot->x_label);
}

/* So many characters of a text, and the line's end. */
static void print_line(const char *text, size_t columns, FILE *to)
{
    for (; *text != '\0'; ++text) {
        const bool begins = ((unsigned char)*text & 0xC0) != 0x80;
        if (begins && columns-- == 0) break;
        fputc(*text, to);
    }
    fputc('\n', to);
}

static void print_legend(const plot *p, size_t columns, FILE *to)
{
    for (size_t k = 0; k < p->count; ++k)
        fprintf(to, "  %c  %s\n", p->series[k].letter, p->series[k].name);
    if (p->marked) fprintf(to, "  |  %s\n", p->mark_label);
    if (p->has_level) fprintf(to, "  -  %s\n", p->level_label);
    if (p->has_point) {
        fputs("  *  ", to);
        print_line(p->point_label, columns - 5, to);
    }
}

bool plot_print(const plot *p, FILE *to, size_t columns, size_t rows)
{
    grid g = {.plot = p, .scale = plot_measure(p), .columns = columns - MARGIN, .rows = rows - 4};
    g.cells = malloc(g.columns * g.rows);
    if (g.cells == NULL) return false;
    fill_grid(&g);
    print_line(p->title, columns, to);
    print_line(p->y_label, columns, to);
    print_rows(&g, to);
    print_x_axis(&g, to);
    print_legend(p, columns, to);
    free(g.cells);
    return true;
}

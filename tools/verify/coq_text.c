/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/coq_text.h"

#include <math.h>
#include <stdlib.h>

#include "tools/verify/coq_term.h"

/* Operations of a coordinate when all is written out: Coq takes seconds for a thousand. */
#define LENGTH_MAX 3000.0

/* --- Parts ------------------------------------------------------------------------------------ */

static const part *part_of(const piece *all, const box3 *where)
{
    for (size_t k = 0; k < all->count; ++k) {
        bool inside = true;
        for (int j = 0; j < VARIABLES; ++j)
            inside = inside && all->parts[k].lo[j] <= where->lo[j] &&
                     where->hi[j] <= all->parts[k].hi[j];
        if (inside) return &all->parts[k];
    }
    return NULL;
}

/* Sets length[i] to the operations of coordinate i written out, from those of x, y and z before.
 * False: a step is not known to `interval`, or it is too long. */
static bool find_lengths(const formula *f, bool is_map, double length[3])
{
    double *of = malloc((size_t)f->count * sizeof *of);
    bool good = of != NULL;
    for (int k = 0; k < f->count && good; ++k) {
        const step *s = &f->steps[k];
        const bool is_coordinate = is_map && s->kind == STEP_VARIABLE && s->operand[0] < 3;
        good = term_is_known(f, s);
        of[k] = is_coordinate ? length[s->operand[0]] : 1;
        for (int i = 0; i < s->count; ++i)
            of[k] += of[s->operand[i]] * (s->kind == STEP_MIN || s->kind == STEP_MAX ? 2 : 1);
    }
    for (int i = 0; i < 3 && good; ++i) {
        length[i] = of[f->out[i]];
        good = length[i] <= LENGTH_MAX;
    }
    free(of);
    return good;
}

bool coq_find_parts(const place *of, const box3 *where, const part *parts[])
{
    double length[3] = {1, 1, 1};
    const box3 times = {{-INFINITY, -INFINITY, where->lo[T]}, {INFINITY, INFINITY, where->hi[T]}};
    for (size_t k = 0; k <= of->maps; ++k) {
        const stage *g = &of->of->stages[of->chain->stages[k]];
        const box3 own = place_box(of, k, k == 0 ? where : &times);
        parts[k] = part_of(&g->pieces[k == 0 ? of->piece : 0], &own);
        if (parts[k] == NULL || !find_lengths(parts[k]->f, k > 0, length)) return false;
    }
    return true;
}

/* --- Definitions ------------------------------------------------------------------------------ */

static size_t count_ranges(const formula *f)
{
    size_t n = 0;
    for (int k = 0; k < f->count; ++k) n += term_is_range(&f->steps[k]);
    return n;
}

/* Counts the constants of a stage: the value of a clock other than T comes first. Lemma. What holds
 * for each value that a stage's t has, whatever those of other stages are, holds where stages
 * follow one clock. */
static size_t count_constants(const place *of, const part *const parts[], size_t k)
{
    return count_ranges(parts[k]->f) + !place_follows_main(of, k);
}

void coq_put_constants(FILE *to, char letter, size_t count)
{
    for (size_t k = 0; k < count; ++k) fprintf(to, " %c%zu", letter, k);
}

/* Writes a coordinate of a stage as a function of the variables and of all constants. */
static void put_stage(const writer *w, const char *name, size_t at, int i, size_t constants)
{
    fprintf(w->to, "Definition %s_%zu_%c (", name, at, "xyz"[i]);
    for (int j = 0; w->variables[j] != '\0'; ++j) fprintf(w->to, "%c ", w->variables[j]);
    coq_put_constants(w->to, 'k', constants);
    fputs(" : R) : R :=\n  ", w->to);
    term_put(w, w->f->out[i]);
    fputs(".\n", w->to);
}

/* Writes a stage's coordinate applied to those of the stage before. */
static void put_applied(FILE *to, const char *name, size_t at, int i, size_t constants)
{
    const size_t before = at - 1;
    fprintf(to, "%s_%zu_%c", name, at, "xyz"[i]);
    if (at == 0) fputs(" u v t", to);
    if (at > 0) fprintf(to, " x%zu y%zu z%zu t", before, before, before);
    coq_put_constants(to, 'k', constants);
}

/* Writes a coordinate after all stages. */
static void put_whole(FILE *to, const char *name, size_t stages, int i, size_t constants)
{
    fprintf(to, "Definition %s_%c (u v t", name, "xyz"[i]);
    coq_put_constants(to, 'k', constants);
    fputs(" : R) : R :=", to);
    for (size_t k = 0; k + 1 < stages; ++k)
        for (int j = 0; j < 3; ++j) {
            fprintf(to, " let %c%zu := ", "xyz"[j], k);
            put_applied(to, name, k, j, constants);
            fputs(" in", to);
        }
    fputc(' ', to);
    put_applied(to, name, stages - 1, i, constants);
    fputs(".\n", to);
}

size_t coq_put_definitions(FILE *to, const char *name, const place *of, const part *const parts[])
{
    size_t constants = 0, first = 0;
    for (size_t k = 0; k <= of->maps; ++k) constants += count_constants(of, parts, k);
    for (size_t k = 0; k <= of->maps; ++k) {
        const bool has_clock = !place_follows_main(of, k);
        const writer w = {to, parts[k]->f, k == 0 ? "uvt" : "xyzt", first + has_clock,
                          has_clock ? first : SIZE_MAX};
        for (int i = 0; i < 3; ++i) put_stage(&w, name, k, i, constants);
        first += count_constants(of, parts, k);
    }
    for (int i = 0; i < 3; ++i) put_whole(to, name, of->maps + 1, i, constants);
    return constants;
}

static void put_range(FILE *to, double lo, char letter, size_t n, double hi)
{
    coq_put_number(to, lo);
    fprintf(to, " <= %c%zu <= ", letter, n);
    coq_put_number(to, hi);
    fputs(" -> ", to);
}

void coq_put_ranges(FILE *to, char letter, const place *of, const part *const parts[])
{
    size_t n = 0;
    for (size_t k = 0; k <= of->maps; ++k) {
        const size_t clock = of->of->stages[of->chain->stages[k]].clock;
        if (!place_follows_main(of, k))
            put_range(to, of->when->lo[clock], letter, n++, of->when->hi[clock]);
        for (int j = 0; j < parts[k]->f->count; ++j) {
            const step *s = &parts[k]->f->steps[j];
            if (term_is_range(s)) put_range(to, s->constant.lo, letter, n++, s->constant.hi);
        }
    }
}

void coq_put_bisections(FILE *to, const place *of, const part *const parts[])
{
    size_t n = 0;
    for (size_t k = 0; k <= of->maps; ++k) {
        if (!place_follows_main(of, k)) fprintf(to, ", i_bisect k%zu", n);
        n += count_constants(of, parts, k);
    }
}

void coq_put_names(FILE *to, const char *name, const place *of)
{
    for (int i = 0; i < 3; ++i) {
        fprintf(to, " %s_%c", name, "xyz"[i]);
        for (size_t k = 0; k <= of->maps; ++k) fprintf(to, " %s_%zu_%c", name, k, "xyz"[i]);
    }
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/statement_internal.h"
#include "tools/verify/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PARTS_MAX = 1 << 16 };

/* Takes over the domain of a part of a formula. A surface must have a finite one of u and v; a map
 * may have one of t alone. */
static bool take_part(input *in, bool is_map, const formula_range said[FORMULA_VARIABLES], part *p)
{
    for (int j = 0; j < 3; ++j) {
        const int variable = is_map && j == 2 ? 3 : j;
        const formula_range *range = &said[variable];
        p->lo[j] = range->is_said ? range->lo.lo : -INFINITY;
        p->hi[j] = range->is_said ? range->hi.hi : INFINITY;
        p->inner_lo[j] = range->is_said ? range->lo.hi : -INFINITY;
        p->inner_hi[j] = range->is_said ? range->hi.lo : INFINITY;
        if (!is_map && j < 2 && !(p->lo[j] > -INFINITY && p->hi[j] < INFINITY))
            return input_refuse(in, "a formula says no finite domain of %c", "uv"[j]);
        if (is_map && j < 2 && said[j].is_said)
            return input_refuse(in, "a map has a domain of x or y");
    }
    if (is_map && said[2].is_said) return input_refuse(in, "a map has a domain of z");
    return true;
}

/* Returns false for a part of no size beside others, such as a curve at the edge of a surface, or
 * one moment: no box that is examined would contain it. */
static bool has_size(const piece *p, const part *q)
{
    for (int j = 0; j < 3; ++j)
        for (size_t i = 0; i < p->count && q->lo[j] == q->hi[j]; ++i)
            if (j == 2 || p->parts[i].lo[j] != q->lo[j] || p->parts[i].hi[j] != q->hi[j])
                return false;
    return true;
}

/* Returns whether two parts overlap, so that one of them would be left out. */
static bool overlap(const part *a, const part *b)
{
    bool both = true;
    for (int j = 0; j < 3; ++j)
        both = both && fmax(a->inner_lo[j], b->inner_lo[j]) < fmin(a->inner_hi[j], b->inner_hi[j]);
    return both;
}

static bool check_parts(input *in, const piece *p)
{
    for (size_t k = 0; k < p->count && !input_is_refused(in); ++k) {
        if (!has_size(p, &p->parts[k])) input_refuse(in, "a part of a formula has no size");
        for (size_t i = 0; i < k; ++i)
            if (overlap(&p->parts[i], &p->parts[k]))
                input_refuse(in, "parts %zu and %zu of a formula overlap", i + 1, k + 1);
    }
    return !input_is_refused(in);
}

static bool read_piece(statement *s, input *in, bool is_map, piece *p)
{
    const formula_scope scope = {.variables = is_map ? "xyzt" : "uvt"};
    char *line = input_line(in, STATEMENT_LINE_MAX), fault[600];
    const char *text = line != NULL && *line != '\0' ? line : NULL;
    size_t room = 0;
    while (text != NULL && WORDS_GROW(in, p->parts, p->count, room)) {
        formula_range said[FORMULA_VARIABLES];
        if (p->count == PARTS_MAX) {
            input_refuse(in, "a formula has more than %d parts", PARTS_MAX);
            break;
        }
        part *made = &p->parts[p->count];
        made->f = formula_read_part(&scope, text, said, fault, sizeof fault);
        if (made->f == NULL) {
            input_refuse(in, "a formula: %s", fault);
            break;
        }
        p->count += 1;
        formula_drop_values(made->f);
        if (formula_steps(made->f) > s->steps) s->steps = formula_steps(made->f);
        if (!take_part(in, is_map, said, made)) break;
        text = formula_next_part(text);
    }
    free(line);
    return check_parts(in, p);
}

bool statement_read_stage(statement *s, input *in, bool is_map, char **rest)
{
    if (!WORDS_GROW(in, s->stages, s->stage_count, s->stage_room)) return false;
    stage *made = &s->stages[s->stage_count++];
    *made = (stage){.is_map = is_map};
    const size_t count = words_whole(in, rest, STATEMENT_PIECES_MAX);
    words_copy(in, made->type, sizeof made->type, words_take(in, rest));
    if (*rest != NULL && s->has_parameters) {
        if (strcmp(words_take(in, rest), "clock") != 0) input_refuse(in, "expected 'clock'");
        made->clock = words_whole(in, rest, s->clock_count);
    }
    if (is_map && count != 1) input_refuse(in, "a map has pieces");
    size_t room = 0;
    for (size_t k = 0; k < count && !input_is_refused(in); ++k)
        if (WORDS_GROW(in, made->pieces, k, room)) {
            made->pieces[made->count++] = (piece){NULL, 0};
            read_piece(s, in, is_map, &made->pieces[k]);
        }
    return !input_is_refused(in);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/proof/reader_internal.h"

/* Parts of texts: definitions and ranges, then three coordinates. */

static void define(reader *r, const char *word)
{
    const bool is_variable = word[1] == '\0' && strchr(r->scope->variables, word[0]) != NULL;
    if (is_variable || reader_is_function(word) || reader_find_defined(r, word) != NULL ||
        strspn(word, "0123456789_") > 0 || strcmp(word, "inf") == 0 || strcmp(word, "pi") == 0 ||
        strcmp(word, "e") == 0)
        reader_fail(r, "'%s' cannot be defined: it %s", word,
                    is_variable ? "is a variable"
                                : "has a meaning already, or begins with no letter");
    const int value = reader_sum(r);
    if (r->fault[0] != '\0') return;
    if (r->defined_count == r->defined_capacity) {
        const int wanted = 2 * r->defined_capacity + 16;
        defined_name *grown = realloc(r->defined, (size_t)wanted * sizeof *grown);
        if (grown == NULL) {
            reader_fail(r, "memory ran out");
            return;
        }
        r->defined = grown;
        r->defined_capacity = wanted;
    }
    memcpy(r->defined[r->defined_count].text, word, strlen(word) + 1);
    r->defined[r->defined_count++].step = value;
}

/* One end of a range, whose steps hold no variable. The domain is known as well as its ends are:
 * from differences of large numbers it could be any. */
static bool read_end(reader *r, ld_interval *end)
{
    bool is_negative = false;
    const char *from = r->at;
    char word[WORD_SIZE];
    for (; reader_peek(r) == '+' || reader_peek(r) == '-'; ++r->at) is_negative ^= *r->at == '-';
    if (reader_take_word(r, word) && strcmp(word, "inf") == 0) {
        *end = ld_interval_of(is_negative ? -INFINITY : INFINITY);
        return true;
    }
    r->at = from;
    const int value = reader_sum(r);
    if (r->fault[0] != '\0') return false;
    if (!formula_constant(r->f, value, end))
        reader_fail(r, "an end of a range has variables in it, or no value");
    else if (!(end->hi - end->lo <= 0x1p-44 * proof_size(end->lo) && isfinite(end->lo)))
        reader_fail(r, "an end of a range is not known well");
    return r->fault[0] == '\0';
}

static void read_range(reader *r, const char *word, formula_range *ranges)
{
    const char *variable = word[1] == '\0' ? strchr(r->scope->variables, word[0]) : NULL;
    if (variable == NULL) {
        reader_fail(r, "'%s' is no variable (%s)", word, r->scope->variables);
        return;
    }
    formula_range *range = &ranges[variable - r->scope->variables];
    if (range->is_said) reader_fail(r, "the range of %s is said twice", word);
    range->is_said = true;
    if (!reader_take(r, '[') || !read_end(r, &range->lo) || !reader_take(r, ',') ||
        !read_end(r, &range->hi) || !reader_take(r, ']'))
        reader_fail(r, "expected a range, [LO, HI]");
    else if (!(range->hi.hi - range->lo.lo >= 0)) /* nor from inf to inf */
        reader_fail(r, "the range of %s ends before it begins", word);
}

/* Reads a definition or a range; false: it is a coordinate, of which nothing has been read. */
static bool read_item(reader *r, formula_range *ranges)
{
    char word[WORD_SIZE];
    reader_peek(r);
    const char *from = r->at;
    if (reader_take_word(r, word)) {
        if (reader_take(r, '=')) {
            define(r, word);
            return true;
        }
        char in[WORD_SIZE];
        reader_peek(r);
        if (reader_take_word(r, in) && strcmp(in, "in") == 0) {
            read_range(r, word, ranges);
            return true;
        }
    }
    r->at = from;
    return false;
}

bool reader_read_part(const formula_scope *scope, const char *text, formula *f,
                      formula_range ranges[FORMULA_VARIABLES], char *fault, size_t size)
{
    reader r = {.scope = scope, .f = f, .fault = fault, .size = size, .text = text, .at = text};
    int coordinates = 0;
    fault[0] = '\0';
    memset(ranges, 0, FORMULA_VARIABLES * sizeof *ranges);
    reader_add_variables(&r);
    for (;;) {
        reader_peek(&r);
        r.text = r.at;
        if (coordinates > 0 || !read_item(&r, ranges)) f->out[coordinates++] = reader_sum(&r);
        if (coordinates == 3 || !reader_take(&r, ';')) break;
    }
    if (fault[0] == '\0' &&
        (coordinates < 3 || (reader_peek(&r) != '\0' && reader_peek(&r) != '|')))
        reader_fail(&r, coordinates < 3 ? "expected three formulas with ';' between them"
                                        : "expected an operator or the end");
    free(r.defined);
    return fault[0] == '\0';
}

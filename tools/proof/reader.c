/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/proof/reader_internal.h"

enum { DEPTH_MAX = 200 };

int reader_fail(reader *r, const char *format, ...)
{
    if (r->fault[0] == '\0') {
        const int used = snprintf(r->fault, r->size, "'%.60s', character %d: ", r->text,
                                  (int)(r->at - r->text) + 1);
        va_list arguments;
        va_start(arguments, format);
        if (used >= 0 && (size_t)used < r->size)
            vsnprintf(r->fault + used, r->size - (size_t)used, format, arguments);
        va_end(arguments);
    }
    r->at = "";
    return 0;
}

static bool is_same(const step *a, const step *b)
{
    return a->kind == b->kind && a->count == b->count && a->function == b->function &&
           memcmp(a->operand, b->operand, sizeof a->operand) == 0 && a->number == b->number;
}

/* What was computed before is not computed again. */
int reader_add_step(reader *r, step s)
{
    formula *f = r->f;
    for (int k = f->count - 1; k >= 0; --k)
        if (is_same(&f->steps[k], &s)) return k;
    if (f->count == STEPS_MAX)
        return reader_fail(r, "the formulas have more than %d steps", STEPS_MAX);
    f->steps[f->count] = s;
    return f->count++;
}

int reader_join(reader *r, step_kind k, int a, int b)
{
    return reader_add_step(r, (step){.kind = k, .operand = {a, b}, .count = 2});
}

char reader_peek(reader *r)
{
    while (*r->at == ' ' || *r->at == '\t' || *r->at == '\n' || *r->at == '\r') ++r->at;
    return *r->at;
}

bool reader_take(reader *r, char sign)
{
    if (reader_peek(r) != sign) return false;
    ++r->at;
    return true;
}

/* --- Grammar ---------------------------------------------------------------------------------- */

static int read_signed(reader *r);

static int read_call(reader *r, const char *word)
{
    int argument[ARGUMENTS_MAX], count = 0;
    do {
        if (count == ARGUMENTS_MAX) return reader_fail(r, "more than %d arguments", ARGUMENTS_MAX);
        argument[count++] = reader_sum(r);
    } while (reader_take(r, ','));
    if (!reader_take(r, ')')) return reader_fail(r, "expected ',' or ')'");
    return reader_apply(r, word, argument, count);
}

/* False: there is no word here, or one that is too long. */
bool reader_take_word(reader *r, char word[WORD_SIZE])
{
    const size_t length = strspn(r->at, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                        "0123456789");
    if (length == 0 || length >= WORD_SIZE) return false;
    memcpy(word, r->at, length);
    word[length] = '\0';
    r->at += length;
    return true;
}

static int read_word(reader *r)
{
    char word[WORD_SIZE];
    if (!reader_take_word(r, word)) return reader_fail(r, "expected a number, a name or '('");
    return reader_take(r, '(') ? read_call(r, word) : reader_name(r, word);
}

static int read_number(reader *r)
{
    char *end;
    const double value = strtod(r->at, &end);
    if (!isfinite(value)) return reader_fail(r, "this number overflows");
    r->at = end;
    return reader_number(r, value);
}

static int read_operand(reader *r)
{
    const char c = reader_peek(r);
    if ((c >= '0' && c <= '9') || c == '.') return read_number(r);
    if (!reader_take(r, '(')) return read_word(r);
    const int x = reader_sum(r);
    return reader_take(r, ')') ? x : reader_fail(r, "expected an operator or ')'");
}

static int read_power(reader *r)
{
    const int x = read_operand(r);
    return reader_take(r, '^') ? reader_join(r, STEP_POWER, x, read_signed(r)) : x;
}

static int read_signed(reader *r)
{
    bool negative = false;
    if (r->depth == DEPTH_MAX) return reader_fail(r, "more than %d levels deep", DEPTH_MAX);
    for (; reader_peek(r) == '+' || reader_peek(r) == '-'; ++r->at) negative ^= *r->at == '-';
    ++r->depth;
    const int x = read_power(r);
    --r->depth;
    return negative ? reader_add_step(r, (step){.kind = STEP_NEGATE, .operand = {x}, .count = 1})
                    : x;
}

static int read_product(reader *r)
{
    int x = read_signed(r);
    for (;;) {
        if (reader_take(r, '*'))
            x = reader_join(r, STEP_MULTIPLY, x, read_signed(r));
        else if (reader_take(r, '/'))
            x = reader_join(r, STEP_DIVIDE, x, read_signed(r));
        else
            return x;
    }
}

int reader_sum(reader *r)
{
    int x = read_product(r);
    for (;;) {
        if (reader_take(r, '+'))
            x = reader_join(r, STEP_ADD, x, read_product(r));
        else if (reader_take(r, '-'))
            x = reader_join(r, STEP_SUBTRACT, x, read_product(r));
        else
            return x;
    }
}

/* --- Texts ------------------------------------------------------------------------------------ */

void reader_add_variables(reader *r)
{
    for (int j = 0; r->scope->variables[j] != '\0'; ++j)
        reader_add_step(r, (step){.kind = STEP_VARIABLE, .operand = {j}, .number = j});
}

static void read_text(reader *r, const char *text, int *out)
{
    r->text = r->at = text;
    *out = reader_sum(r);
    if (r->fault[0] == '\0' && reader_peek(r) != '\0')
        reader_fail(r, "expected an operator or the end");
}

bool reader_read(const formula_scope *scope, const char *const text[3], formula *f, char *fault,
                 size_t size)
{
    reader r = {.scope = scope, .f = f, .fault = fault, .size = size};
    fault[0] = '\0';
    reader_add_variables(&r);
    for (int i = 0; i < 3 && fault[0] == '\0'; ++i) read_text(&r, text[i], &f->out[i]);
    return fault[0] == '\0';
}

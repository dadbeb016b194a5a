/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/proof/steps.h"

enum { DEPTH_MAX = 200, ARGUMENTS_MAX = 16, WORD_SIZE = 64 };

/* What a part of a text calls a name of its own. */
typedef struct defined_name {
    char text[WORD_SIZE];
    int step;
} defined_name;

typedef struct reader {
    const formula_scope *scope;
    formula *f;
    const char *text, *at;
    int depth;
    defined_name *defined;
    int defined_count, defined_capacity;
    char *fault; /* empty: none. Afterwards the text counts as ended. */
    size_t size;
} reader;

__attribute__((format(printf, 2, 3))) static int fail(reader *r, const char *format, ...)
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
static int add_step(reader *r, step s)
{
    formula *f = r->f;
    for (int k = f->count - 1; k >= 0; --k)
        if (is_same(&f->steps[k], &s)) return k;
    if (f->count == STEPS_MAX) return fail(r, "the formulas have more than %d steps", STEPS_MAX);
    f->steps[f->count] = s;
    return f->count++;
}

static int join(reader *r, step_kind k, int a, int b)
{
    return add_step(r, (step){.kind = k, .operand = {a, b}, .count = 2});
}

static char peek(reader *r)
{
    while (*r->at == ' ' || *r->at == '\t' || *r->at == '\n' || *r->at == '\r') ++r->at;
    return *r->at;
}

static bool take(reader *r, char sign)
{
    if (peek(r) != sign) return false;
    ++r->at;
    return true;
}

/* --- Names ------------------------------------------------------------------------------------ */

typedef struct name {
    const char *text;
    step_kind kind;
    jet_function *function;
    int least, most;
} name;

static const name functions[] = {
    {"abs", STEP_FUNCTION, jet_abs_, 1, 1},    {"fabs", STEP_FUNCTION, jet_abs_, 1, 1},
    {"acos", STEP_FUNCTION, jet_acos_, 1, 1},  {"asin", STEP_FUNCTION, jet_asin_, 1, 1},
    {"atan", STEP_FUNCTION, jet_atan_, 1, 1},  {"cbrt", STEP_FUNCTION, jet_cbrt_, 1, 1},
    {"cos", STEP_FUNCTION, jet_cos_, 1, 1},    {"cosh", STEP_FUNCTION, jet_cosh_, 1, 1},
    {"exp", STEP_FUNCTION, jet_exp_, 1, 1},    {"ln", STEP_FUNCTION, jet_log_, 1, 1},
    {"log", STEP_FUNCTION, jet_log_, 1, 1},    {"sin", STEP_FUNCTION, jet_sin_, 1, 1},
    {"sinh", STEP_FUNCTION, jet_sinh_, 1, 1},  {"sq", STEP_FUNCTION, jet_sqr_, 1, 1},
    {"sqr", STEP_FUNCTION, jet_sqr_, 1, 1},    {"sqrt", STEP_FUNCTION, jet_sqrt_, 1, 1},
    {"tan", STEP_FUNCTION, jet_tan_, 1, 1},    {"tanh", STEP_FUNCTION, jet_tanh_, 1, 1},
    {"atan2", STEP_ANGLE, NULL, 2, 2},         {"copysign", STEP_COPYSIGN, NULL, 2, 2},
    {"hypot", STEP_LENGTH, NULL, 2, 3},        {"pow", STEP_POWER, NULL, 2, 2},
    {"min", STEP_MIN, NULL, 2, ARGUMENTS_MAX}, {"fmin", STEP_MIN, NULL, 2, ARGUMENTS_MAX},
    {"max", STEP_MAX, NULL, 2, ARGUMENTS_MAX}, {"fmax", STEP_MAX, NULL, 2, ARGUMENTS_MAX},
};

static int number(reader *r, double value)
{
    return add_step(r, (step){.kind = STEP_NUMBER, .number = value});
}

static int function(reader *r, jet_function *g, int x)
{
    return add_step(r, (step){.kind = STEP_FUNCTION, .operand = {x}, .count = 1, .function = g});
}

/* Functions that are composed of others; -1: not one of them. */
static int apply_composite(reader *r, const char *f, const int *a, int count)
{
    if (count == 1 && strcmp(f, "log2") == 0)
        return join(r, STEP_DIVIDE, function(r, jet_log_, a[0]),
                    function(r, jet_log_, number(r, 2)));
    if (count == 1 && strcmp(f, "log10") == 0)
        return join(r, STEP_DIVIDE, function(r, jet_log_, a[0]),
                    function(r, jet_log_, number(r, 10)));
    if (count == 1 && strcmp(f, "exp2") == 0) return join(r, STEP_POWER, number(r, 2), a[0]);
    if (count == 3 && strcmp(f, "clamp") == 0)
        return join(r, STEP_MIN, join(r, STEP_MAX, a[0], a[1]), a[2]);
    if (count == 3 && strcmp(f, "lerp") == 0)
        return join(r, STEP_ADD, a[0],
                    join(r, STEP_MULTIPLY, a[2], join(r, STEP_SUBTRACT, a[1], a[0])));
    return -1;
}

static int apply_name(reader *r, const name *f, const int *a, int count)
{
    if (f->kind != STEP_MIN && f->kind != STEP_MAX) {
        step s = {.kind = f->kind, .count = count, .function = f->function};
        memcpy(s.operand, a, (size_t)count * sizeof *a);
        return add_step(r, s);
    }
    int x = a[0];
    for (int k = 1; k < count; ++k) x = join(r, f->kind, x, a[k]);
    return x;
}

static int apply(reader *r, const char *f, const int *a, int count)
{
    if (r->fault[0] != '\0') return 0;
    for (size_t k = 0; k < sizeof functions / sizeof *functions; ++k)
        if (strcmp(functions[k].text, f) == 0 && count >= functions[k].least &&
            count <= functions[k].most)
            return apply_name(r, &functions[k], a, count);
    const int made = apply_composite(r, f, a, count);
    return made >= 0 ? made : fail(r, "there is no function %s of %d arguments", f, count);
}

typedef struct constants {
    char text[240];
} constants;

/* ", radius, center0 ... center2": elements of a list follow each other. */
static constants constants_text(const formula_scope *s)
{
    constants c = {""};
    for (size_t k = 0; k < s->count; ++k) {
        const size_t stem = strcspn(s->name[k], "0123456789"), used = strlen(c.text);
        const size_t first = k;
        while (k + 1 < s->count && s->name[k][stem] != '\0' &&
               strcspn(s->name[k + 1], "0123456789") == stem &&
               strncmp(s->name[k + 1], s->name[k], stem) == 0)
            ++k;
        snprintf(c.text + used, sizeof c.text - used, ", %s%s%s", s->name[first],
                 k > first ? " ... " : "", k > first ? s->name[k] : "");
    }
    return c;
}

static const defined_name *find_defined(const reader *r, const char *word)
{
    for (int k = 0; k < r->defined_count; ++k)
        if (strcmp(r->defined[k].text, word) == 0) return &r->defined[k];
    return NULL;
}

static int read_name(reader *r, const char *word)
{
    const formula_scope *s = r->scope;
    const char *variable = word[1] == '\0' ? strchr(s->variables, word[0]) : NULL;
    if (variable != NULL) return (int)(variable - s->variables);
    const defined_name *own = find_defined(r, word);
    if (own != NULL) return own->step;
    for (size_t k = 0; k < s->count; ++k)
        if (strcmp(s->name[k], word) == 0) return number(r, s->value[k]);
    if (strcmp(word, "pi") == 0) return add_step(r, (step){.kind = STEP_PI});
    if (strcmp(word, "e") == 0) return add_step(r, (step){.kind = STEP_E});
    return fail(r, "'%s' is neither a variable (%s) nor a constant; these are pi, e%s", word,
                s->variables, constants_text(s).text);
}

/* --- Grammar ---------------------------------------------------------------------------------- */

static int read_sum(reader *r);
static int read_signed(reader *r);

static int read_call(reader *r, const char *word)
{
    int argument[ARGUMENTS_MAX], count = 0;
    do {
        if (count == ARGUMENTS_MAX) return fail(r, "more than %d arguments", ARGUMENTS_MAX);
        argument[count++] = read_sum(r);
    } while (take(r, ','));
    if (!take(r, ')')) return fail(r, "expected ',' or ')'");
    return apply(r, word, argument, count);
}

/* False: there is no word here, or one that is too long. */
static bool take_word(reader *r, char word[WORD_SIZE])
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
    if (!take_word(r, word)) return fail(r, "expected a number, a name or '('");
    return take(r, '(') ? read_call(r, word) : read_name(r, word);
}

static int read_number(reader *r)
{
    char *end;
    const double value = strtod(r->at, &end);
    if (!isfinite(value)) return fail(r, "this number overflows");
    r->at = end;
    return number(r, value);
}

static int read_operand(reader *r)
{
    const char c = peek(r);
    if ((c >= '0' && c <= '9') || c == '.') return read_number(r);
    if (!take(r, '(')) return read_word(r);
    const int x = read_sum(r);
    return take(r, ')') ? x : fail(r, "expected an operator or ')'");
}

static int read_power(reader *r)
{
    const int x = read_operand(r);
    return take(r, '^') ? join(r, STEP_POWER, x, read_signed(r)) : x;
}

static int read_signed(reader *r)
{
    bool negative = false;
    if (r->depth == DEPTH_MAX) return fail(r, "more than %d levels deep", DEPTH_MAX);
    for (; peek(r) == '+' || peek(r) == '-'; ++r->at) negative ^= *r->at == '-';
    ++r->depth;
    const int x = read_power(r);
    --r->depth;
    return negative ? add_step(r, (step){.kind = STEP_NEGATE, .operand = {x}, .count = 1}) : x;
}

static int read_product(reader *r)
{
    int x = read_signed(r);
    for (;;) {
        if (take(r, '*'))
            x = join(r, STEP_MULTIPLY, x, read_signed(r));
        else if (take(r, '/'))
            x = join(r, STEP_DIVIDE, x, read_signed(r));
        else
            return x;
    }
}

static int read_sum(reader *r)
{
    int x = read_product(r);
    for (;;) {
        if (take(r, '+'))
            x = join(r, STEP_ADD, x, read_product(r));
        else if (take(r, '-'))
            x = join(r, STEP_SUBTRACT, x, read_product(r));
        else
            return x;
    }
}

/* --- Texts ------------------------------------------------------------------------------------ */

static void add_variables(reader *r)
{
    for (int j = 0; r->scope->variables[j] != '\0'; ++j)
        add_step(r, (step){.kind = STEP_VARIABLE, .operand = {j}, .number = j});
}

static void read_text(reader *r, const char *text, int *out)
{
    r->text = r->at = text;
    *out = read_sum(r);
    if (r->fault[0] == '\0' && peek(r) != '\0') fail(r, "expected an operator or the end");
}

bool reader_read(const formula_scope *scope, const char *const text[3], formula *f, char *fault,
                 size_t size)
{
    reader r = {.scope = scope, .f = f, .fault = fault, .size = size};
    fault[0] = '\0';
    add_variables(&r);
    for (int i = 0; i < 3 && fault[0] == '\0'; ++i) read_text(&r, text[i], &f->out[i]);
    return fault[0] == '\0';
}

/* --- Parts of texts --------------------------------------------------------------------------- */

static bool is_function(const char *word)
{
    static const char *const composed[] = {"log2", "log10", "exp2", "clamp", "lerp"};
    for (size_t k = 0; k < sizeof functions / sizeof *functions; ++k)
        if (strcmp(functions[k].text, word) == 0) return true;
    for (size_t k = 0; k < sizeof composed / sizeof *composed; ++k)
        if (strcmp(composed[k], word) == 0) return true;
    return false;
}

static void define(reader *r, const char *word)
{
    const bool is_variable = word[1] == '\0' && strchr(r->scope->variables, word[0]) != NULL;
    if (is_variable || is_function(word) || find_defined(r, word) != NULL ||
        strspn(word, "0123456789_") > 0)
        fail(r, "'%s' cannot be defined: it %s", word,
             is_variable ? "is a variable" : "has a meaning already, or begins with no letter");
    const int value = read_sum(r);
    if (r->fault[0] != '\0') return;
    if (r->defined_count == r->defined_capacity) {
        const int wanted = 2 * r->defined_capacity + 16;
        defined_name *grown = realloc(r->defined, (size_t)wanted * sizeof *grown);
        if (grown == NULL) {
            fail(r, "memory ran out");
            return;
        }
        r->defined = grown;
        r->defined_capacity = wanted;
    }
    memcpy(r->defined[r->defined_count].text, word, strlen(word) + 1);
    r->defined[r->defined_count++].step = value;
}

/* One end of a range, whose steps hold no variable. */
static bool read_end(reader *r, ld_interval *end)
{
    bool is_negative = false;
    const char *from = r->at;
    char word[WORD_SIZE];
    for (; peek(r) == '+' || peek(r) == '-'; ++r->at) is_negative ^= *r->at == '-';
    if (take_word(r, word) && strcmp(word, "inf") == 0) {
        *end = ld_interval_of(is_negative ? -INFINITY : INFINITY);
        return true;
    }
    r->at = from;
    const int value = read_sum(r);
    if (r->fault[0] != '\0') return false;
    if (!formula_constant(r->f, value, end))
        fail(r, "an end of a range has variables in it, or no value");
    return r->fault[0] == '\0';
}

static void read_range(reader *r, const char *word, formula_range *ranges)
{
    const char *variable = word[1] == '\0' ? strchr(r->scope->variables, word[0]) : NULL;
    if (variable == NULL) {
        fail(r, "'%s' is no variable (%s)", word, r->scope->variables);
        return;
    }
    formula_range *range = &ranges[variable - r->scope->variables];
    if (range->is_said) fail(r, "the range of %s is said twice", word);
    range->is_said = true;
    if (!take(r, '[') || !read_end(r, &range->lo) || !take(r, ',') || !read_end(r, &range->hi) ||
        !take(r, ']'))
        fail(r, "expected a range, [LO, HI]");
    else if (range->lo.lo > range->hi.hi)
        fail(r, "the range of %s ends before it begins", word);
}

/* Reads a definition or a range; false: it is a coordinate, of which nothing has been read. */
static bool read_item(reader *r, formula_range *ranges)
{
    char word[WORD_SIZE];
    peek(r);
    const char *from = r->at;
    if (take_word(r, word)) {
        if (take(r, '=')) {
            define(r, word);
            return true;
        }
        char in[WORD_SIZE];
        peek(r);
        if (take_word(r, in) && strcmp(in, "in") == 0) {
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
    add_variables(&r);
    for (;;) {
        peek(&r);
        r.text = r.at;
        if (coordinates > 0 || !read_item(&r, ranges)) f->out[coordinates++] = read_sum(&r);
        if (coordinates == 3 || !take(&r, ';')) break;
    }
    if (fault[0] == '\0' && (coordinates < 3 || (peek(&r) != '\0' && peek(&r) != '|')))
        fail(&r, coordinates < 3 ? "expected three formulas with ';' between them"
                                 : "expected an operator or the end");
    free(r.defined);
    return fault[0] == '\0';
}

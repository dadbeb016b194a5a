/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "check_formula.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Steps --------------------------------------------------------------------------------------
 */

typedef enum kind {
    NUMBER,
    PI,
    E,
    VARIABLE,
    NEGATE,
    ADD,
    SUBTRACT,
    MULTIPLY,
    DIVIDE,
    POWER,
    MIN,
    MAX,
    ANGLE,
    LENGTH,
    COPYSIGN,
    FUNCTION
} kind;

enum { STEPS_MAX = 4096, DEPTH_MAX = 200, ARGUMENTS_MAX = 16 };

typedef struct step {
    kind kind;
    int operand[3], count; /* earlier steps; of VARIABLE, its index */
    double number;
    jet_function *function;
} step;

struct formula {
    int count, out[3];
    step steps[STEPS_MAX];
    jet *value; /* of each step */
};

/* --- Reading ------------------------------------------------------------------------------------
 */

typedef struct reader {
    const formula_scope *scope;
    formula *f;
    const char *text, *at;
    int depth;
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

static int join(reader *r, kind k, int a, int b)
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

/* --- Names ---------------------------------------------------------------------------------------
 */

typedef struct name {
    const char *text;
    kind kind;
    jet_function *function;
    int least, most;
} name;

static const name functions[] = {
    {"abs", FUNCTION, jet_abs_, 1, 1},    {"fabs", FUNCTION, jet_abs_, 1, 1},
    {"acos", FUNCTION, jet_acos_, 1, 1},  {"asin", FUNCTION, jet_asin_, 1, 1},
    {"atan", FUNCTION, jet_atan_, 1, 1},  {"cbrt", FUNCTION, jet_cbrt_, 1, 1},
    {"cos", FUNCTION, jet_cos_, 1, 1},    {"cosh", FUNCTION, jet_cosh_, 1, 1},
    {"exp", FUNCTION, jet_exp_, 1, 1},    {"ln", FUNCTION, jet_log_, 1, 1},
    {"log", FUNCTION, jet_log_, 1, 1},    {"sin", FUNCTION, jet_sin_, 1, 1},
    {"sinh", FUNCTION, jet_sinh_, 1, 1},  {"sq", FUNCTION, jet_sqr_, 1, 1},
    {"sqr", FUNCTION, jet_sqr_, 1, 1},    {"sqrt", FUNCTION, jet_sqrt_, 1, 1},
    {"tan", FUNCTION, jet_tan_, 1, 1},    {"tanh", FUNCTION, jet_tanh_, 1, 1},
    {"atan2", ANGLE, NULL, 2, 2},         {"copysign", COPYSIGN, NULL, 2, 2},
    {"hypot", LENGTH, NULL, 2, 3},        {"pow", POWER, NULL, 2, 2},
    {"min", MIN, NULL, 2, ARGUMENTS_MAX}, {"fmin", MIN, NULL, 2, ARGUMENTS_MAX},
    {"max", MAX, NULL, 2, ARGUMENTS_MAX}, {"fmax", MAX, NULL, 2, ARGUMENTS_MAX},
};

static int number(reader *r, double value)
{
    return add_step(r, (step){.kind = NUMBER, .number = value});
}

static int function(reader *r, jet_function *g, int x)
{
    return add_step(r, (step){.kind = FUNCTION, .operand = {x}, .count = 1, .function = g});
}

/* Functions that are made of others; -1: it is none of them. */
static int apply_composite(reader *r, const char *f, const int *a, int count)
{
    if (count == 1 && strcmp(f, "log2") == 0)
        return join(r, DIVIDE, function(r, jet_log_, a[0]), function(r, jet_log_, number(r, 2)));
    if (count == 1 && strcmp(f, "log10") == 0)
        return join(r, DIVIDE, function(r, jet_log_, a[0]), function(r, jet_log_, number(r, 10)));
    if (count == 1 && strcmp(f, "exp2") == 0) return join(r, POWER, number(r, 2), a[0]);
    if (count == 3 && strcmp(f, "clamp") == 0) return join(r, MIN, join(r, MAX, a[0], a[1]), a[2]);
    if (count == 3 && strcmp(f, "lerp") == 0)
        return join(r, ADD, a[0], join(r, MULTIPLY, a[2], join(r, SUBTRACT, a[1], a[0])));
    return -1;
}

static int apply_name(reader *r, const name *f, const int *a, int count)
{
    if (f->kind != MIN && f->kind != MAX) {
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

static int read_name(reader *r, const char *word)
{
    const formula_scope *s = r->scope;
    const char *variable = word[1] == '\0' ? strchr(s->variables, word[0]) : NULL;
    if (variable != NULL) return (int)(variable - s->variables);
    for (size_t k = 0; k < s->count; ++k)
        if (strcmp(s->name[k], word) == 0) return number(r, s->value[k]);
    if (strcmp(word, "pi") == 0) return add_step(r, (step){.kind = PI});
    if (strcmp(word, "e") == 0) return add_step(r, (step){.kind = E});
    return fail(r, "'%s' is neither a variable (%s) nor a constant", word, s->variables);
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

static int read_word(reader *r)
{
    char word[64];
    const size_t length = strspn(r->at, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                        "0123456789");
    if (length == 0 || length >= sizeof word) return fail(r, "expected a number, a name or '('");
    memcpy(word, r->at, length);
    word[length] = '\0';
    r->at += length;
    return take(r, '(') ? read_call(r, word) : read_name(r, word);
}

static int read_number(reader *r)
{
    char *end;
    const double value = strtod(r->at, &end);
    if (!isfinite(value)) return fail(r, "this number is beyond the largest");
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
    return take(r, '^') ? join(r, POWER, x, read_signed(r)) : x;
}

static int read_signed(reader *r)
{
    bool negative = false;
    if (r->depth == DEPTH_MAX) return fail(r, "more than %d levels deep", DEPTH_MAX);
    for (; peek(r) == '+' || peek(r) == '-'; ++r->at) negative ^= *r->at == '-';
    ++r->depth;
    const int x = read_power(r);
    --r->depth;
    return negative ? add_step(r, (step){.kind = NEGATE, .operand = {x}, .count = 1}) : x;
}

static int read_product(reader *r)
{
    int x = read_signed(r);
    for (;;) {
        if (take(r, '*'))
            x = join(r, MULTIPLY, x, read_signed(r));
        else if (take(r, '/'))
            x = join(r, DIVIDE, x, read_signed(r));
        else
            return x;
    }
}

static int read_sum(reader *r)
{
    int x = read_product(r);
    for (;;) {
        if (take(r, '+'))
            x = join(r, ADD, x, read_product(r));
        else if (take(r, '-'))
            x = join(r, SUBTRACT, x, read_product(r));
        else
            return x;
    }
}

static void read_text(reader *r, const char *text, int *out)
{
    r->text = r->at = text;
    *out = read_sum(r);
    if (r->fault[0] == '\0' && peek(r) != '\0') fail(r, "expected an operator or the end");
}

formula *formula_read(const formula_scope *scope, const char *const text[3], char *fault,
                      size_t size)
{
    formula *f = calloc(1, sizeof *f);
    reader r = {.scope = scope, .f = f, .fault = fault, .size = size};
    snprintf(fault, size, "%s", f != NULL ? "" : "memory ran out");
    if (f == NULL) return NULL;
    for (int j = 0; scope->variables[j] != '\0'; ++j)
        add_step(&r, (step){.kind = VARIABLE, .operand = {j}, .count = 0, .number = j});
    for (int i = 0; i < 3 && fault[0] == '\0'; ++i) read_text(&r, text[i], &f->out[i]);
    f->value = fault[0] == '\0' ? calloc((size_t)f->count, sizeof *f->value) : NULL;
    if (f->value != NULL) return f;
    if (fault[0] == '\0') snprintf(fault, size, "memory ran out");
    formula_free(f);
    return NULL;
}

void formula_free(formula *f)
{
    if (f != NULL) free(f->value);
    free(f);
}

/* --- Computing ----------------------------------------------------------------------------------
 */

static jet joined(const step *s, const jet *x, const jet *y)
{
    switch (s->kind) {
    case ADD:
        return jet_add(x, y);
    case SUBTRACT:
        return jet_sub(x, y);
    case MULTIPLY:
        return x == y ? jet_apply(jet_sqr_, x) : jet_mul(x, y);
    case DIVIDE:
        return jet_div(x, y);
    case POWER:
        return jet_power(x, y);
    case MIN:
        return jet_min(x, y);
    case MAX:
        return jet_max(x, y);
    case ANGLE:
        return jet_angle(x, y);
    default:
        return jet_copysign(x, y);
    }
}

static jet computed(const formula *f, const step *s, int n)
{
    const jet *a[3];
    for (int k = 0; k < 3; ++k) a[k] = &f->value[k < s->count ? s->operand[k] : 0];
    switch (s->kind) {
    case NUMBER:
        return jet_constant(n, span_of(s->number));
    case PI:
        return jet_constant(n, span_pi());
    case E:
        return jet_constant(n, span_e());
    case NEGATE:
        return jet_neg(a[0]);
    case FUNCTION:
        return jet_apply(s->function, a[0]);
    case LENGTH:
        return jet_length(a, s->count);
    default:
        return joined(s, a[0], a[1]);
    }
}

void formula_jets(formula *f, const jet *variables, jet out[3])
{
    for (int k = 0; k < f->count; ++k) {
        const step *s = &f->steps[k];
        f->value[k] =
            s->kind == VARIABLE ? variables[s->operand[0]] : computed(f, s, variables[0].n);
    }
    for (int i = 0; i < 3; ++i) out[i] = f->value[f->out[i]];
}

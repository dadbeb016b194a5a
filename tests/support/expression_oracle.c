/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/expression_oracle.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Functions -------------------------------------------------------------------------------- */

/* The hull of both, or NaN. */
static number hull(number x, number y)
{
    mpfi_ptr r = num_fresh();
    mpfi_union(r, x, y);
    return r;
}

static bool surely_negative(number x) { return num_is_less(x, num(0)); }

static bool surely_not_negative(number x) { return mpfr_sgn(&x->left) >= 0; }

static number minimum(number x, number y)
{
    return num_div(num_sub(num_add(x, y), num_abs(num_sub(x, y))), num(2));
}

static number maximum(number x, number y)
{
    return num_div(num_add(num_add(x, y), num_abs(num_sub(x, y))), num(2));
}

static number copied_sign(number x, number y)
{
    number size = num_abs(x);
    if (surely_not_negative(y)) return size;
    return surely_negative(y) ? num_neg(size) : hull(size, num_neg(size));
}

/* MPFI seeks the quadrant of a number by ever more digits, and for the least of all it never
 * ends. These are taken for anything as small as 2^-1000. */
static number calm(number x)
{
    mpfi_ptr r = num_fresh();
    mpfi_set_d(r, 0x1p-1000);
    mpfr_neg(&r->left, &r->right, MPFR_RNDD);
    bool is_least = mpfr_cmpabs(&x->left, &r->right) < 0 && mpfr_cmpabs(&x->right, &r->right) < 0;
    return is_least ? r : x;
}

static number sine(number x) { return num_sin(calm(x)); }
static number cosine(number x) { return num_cos(calm(x)); }
static number tangent(number x) { return num_tan(calm(x)); }

static bool is_point(number x) { return mpfr_equal_p(&x->left, &x->right) != 0; }

static number whole_power(number x, long n)
{
    number r = num(1), square = x;
    for (unsigned long m = (unsigned long)labs(n); m > 0; m /= 2) {
        if (m % 2) r = num_mul(r, square);
        square = num_sqr(square);
    }
    return n < 0 ? num_div(num(1), r) : r;
}

static number raised(number x, number y)
{
    if (is_point(y) && mpfr_integer_p(&y->left) && mpfr_fits_slong_p(&y->left, MPFR_RNDN))
        return whole_power(x, mpfr_get_si(&y->left, MPFR_RNDN));
    if (is_point(x) && mpfr_zero_p(&x->left) && num_is_less(num(0), y)) return num(0);
    return num_exp(num_mul(y, num_log(x)));
}

static const struct unary {
    const char *name;
    number (*function)(number x);
} unary[] = {
    {"abs", num_abs},   {"fabs", num_abs},  {"sqrt", num_sqrt}, {"cbrt", num_cbrt},
    {"exp", num_exp},   {"log", num_log},   {"ln", num_log},    {"sin", sine},
    {"cos", cosine},    {"tan", tangent},   {"asin", num_asin}, {"acos", num_acos},
    {"atan", num_atan}, {"sinh", num_sinh}, {"cosh", num_cosh}, {"tanh", num_tanh},
    {"sq", num_sqr},    {"sqr", num_sqr},
};

static const struct binary {
    const char *name;
    number (*function)(number x, number y);
} binary[] = {
    {"atan2", num_atan2}, {"pow", raised},  {"copysign", copied_sign}, {"min", minimum},
    {"fmin", minimum},    {"max", maximum}, {"fmax", maximum},         {"hypot", num_hypot},
};

static number other_call(const char *name, const number *x)
{
    if (strcmp(name, "log2") == 0) return num_div(num_log(x[0]), num_log(num(2)));
    if (strcmp(name, "log10") == 0) return num_div(num_log(x[0]), num_log(num(10)));
    if (strcmp(name, "exp2") == 0) return raised(num(2), x[0]);
    if (strcmp(name, "lerp") == 0) return num_add(x[0], num_mul(x[2], num_sub(x[1], x[0])));
    if (strcmp(name, "clamp") == 0) return minimum(maximum(x[0], x[1]), x[2]);
    abort();
}

static number call(const char *name, const number *x, size_t count)
{
    for (size_t i = 0; count == 1 && i < sizeof unary / sizeof unary[0]; ++i)
        if (strcmp(name, unary[i].name) == 0) return unary[i].function(x[0]);
    for (size_t i = 0; count >= 2 && i < sizeof binary / sizeof binary[0]; ++i) {
        if (strcmp(name, binary[i].name) != 0) continue;
        number r = binary[i].function(x[0], x[1]);
        for (size_t k = 2; k < count; ++k) r = binary[i].function(r, x[k]);
        return r;
    }
    return other_call(name, x);
}

/* --- Two stacks ------------------------------------------------------------------------------- */

enum { STACK = 1000, NAME = 32 };

/* Waiting: an operator ('n' is the minus in front), '(' or, with a name, a function's. */
typedef struct waiting {
    char sign;
    char name[NAME];
    size_t arguments;
} waiting;

typedef struct machine {
    number value[STACK];
    size_t values;
    waiting stack[STACK];
    size_t depth;
} machine;

static void push(machine *m, number x)
{
    if (m->values == STACK) abort();
    m->value[m->values++] = x;
}

static number pop(machine *m)
{
    if (m->values == 0) abort();
    return m->value[--m->values];
}

static void hold(machine *m, char sign, const char *name)
{
    if (m->depth == STACK) abort();
    waiting *w = &m->stack[m->depth++];
    *w = (waiting){.sign = sign, .arguments = 1};
    snprintf(w->name, sizeof w->name, "%s", name);
}

static int rank(char sign)
{
    switch (sign) {
    case '+':
    case '-':
        return 1;
    case '*':
    case '/':
        return 2;
    case 'n':
        return 3;
    case '^':
        return 4;
    default:
        return 0;
    }
}

static void operate(machine *m)
{
    char sign = m->stack[--m->depth].sign;
    number y = pop(m);
    if (sign == 'n') {
        push(m, num_neg(y));
        return;
    }
    number x = pop(m);
    push(m, sign == '+'   ? num_add(x, y)
            : sign == '-' ? num_sub(x, y)
            : sign == '*' ? num_mul(x, y)
            : sign == '/' ? num_div(x, y)
                          : raised(x, y));
}

/* Does what waits and binds at least as tightly; all up to a parenthesis for rank 1. */
static void settle(machine *m, int least)
{
    while (m->depth > 0 && m->stack[m->depth - 1].sign != '(' &&
           rank(m->stack[m->depth - 1].sign) >= least)
        operate(m);
}

static void close_group(machine *m)
{
    settle(m, 1);
    if (m->depth == 0) abort();
    waiting open = m->stack[--m->depth];
    if (open.name[0] == '\0') return;
    if (m->values < open.arguments) abort();
    m->values -= open.arguments;
    number r = call(open.name, &m->value[m->values], open.arguments);
    push(m, r);
}

/* An operator, a comma or a closing parenthesis. True if an operand must follow. */
static bool take_sign(machine *m, char sign, bool operand)
{
    if (sign == '(') {
        hold(m, '(', "");
        return true;
    }
    if (operand) {
        if (sign == '-') hold(m, 'n', "");
        if (sign != '-' && sign != '+') abort();
        return true;
    }
    if (sign == ')') {
        close_group(m);
        return false;
    }
    if (sign == ',') {
        settle(m, 1);
        if (m->depth == 0) abort();
        ++m->stack[m->depth - 1].arguments;
        return true;
    }
    if (rank(sign) == 0) abort();
    settle(m, sign == '^' ? 5 : rank(sign));
    hold(m, sign, "");
    return true;
}

static number named(const char *name, const oracle_names *names)
{
    for (size_t i = 0; i < names->count; ++i)
        if (strcmp(name, names->name[i]) == 0) return names->value[i];
    if (strcmp(name, "pi") == 0) return num_pi();
    if (strcmp(name, "e") == 0) return num_exp(num(1));
    abort();
}

/* A name, or a function and its parenthesis. Answers where it ends; *operand: one must follow. */
static const char *take_name(machine *m, const char *text, const oracle_names *names, bool *operand)
{
    char name[NAME] = "";
    size_t length = 0;
    while (isalnum((unsigned char)text[length]) || text[length] == '_') ++length;
    if (length >= NAME) abort();
    memcpy(name, text, length);
    text += length;
    while (*text == ' ') ++text;
    *operand = *text == '(';
    if (!*operand) {
        push(m, named(name, names));
        return text;
    }
    hold(m, '(', name);
    return text + 1;
}

/* Beyond this numbers count as infinite: the sine of 2^(10^9) would take a gigabyte. */
#define EXPONENT_MAX 20000

number expression_oracle(const char *text, const oracle_names *names)
{
    mpfr_set_emax(EXPONENT_MAX);
    mpfr_set_emin(-EXPONENT_MAX);
    machine m = {.values = 0};
    bool operand = true;
    while (*text) {
        char *end;
        if (isspace((unsigned char)*text)) {
            ++text;
        } else if (isdigit((unsigned char)*text) || *text == '.') {
            push(&m, num(strtod(text, &end)));
            text = end;
            operand = false;
        } else if (isalpha((unsigned char)*text)) {
            text = take_name(&m, text, names, &operand);
        } else {
            operand = take_sign(&m, *text++, operand);
        }
    }
    settle(&m, 1);
    if (m.values != 1 || m.depth != 0) abort();
    return m.value[0];
}

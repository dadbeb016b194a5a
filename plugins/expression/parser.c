/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/parser.h"
#include "plugins/expression/names.h"
#include "plugins/expression/rules.h"
#include "plugins/expression/token.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* One function per rule of the grammar (expression.h). After an error the rest of the text is
 * ignored, so that all of them return soon, and their results are not used. */
typedef struct parser {
    const expression_scope *scope;
    const char *text;
    builder *b;
    token now;
    int depth;
    bool failed;
    expression_error *error;
} parser;

/* --- Faults ----------------------------------------------------------------------------------- */

__attribute__((format(printf, 3, 4))) static uint16_t fail(parser *p, size_t at, const char *format,
                                                           ...)
{
    p->now = (token){TOKEN_END, at, 0};
    if (p->failed) return 0;
    p->failed = true;
    text_place place = token_place(p->text, at);
    char *to = p->error->message;
    size_t size = sizeof p->error->message;
    int used = snprintf(to, size, "line %zu, column %zu: ", place.line, place.column);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(to + used, size - (size_t)used, format, arguments);
    va_end(arguments);
    return 0;
}

/* A token in a message: quoted, control characters spelt, long ones cut. */
typedef struct shown {
    char text[48];
} shown;

static shown show(const parser *p, token t)
{
    shown s;
    unsigned char first = (unsigned char)p->text[t.at];
    int length = t.length < 40 ? (int)t.length : 40;
    if (t.kind == TOKEN_END)
        snprintf(s.text, sizeof s.text, "the end");
    else if (first < 0x20 || first == 0x7f)
        snprintf(s.text, sizeof s.text, "the character %u", first);
    else
        snprintf(s.text, sizeof s.text, "'%.*s'", length, p->text + t.at);
    return s;
}

/* --- Tokens ----------------------------------------------------------------------------------- */

static bool next_is(const parser *p, char sign)
{
    return p->now.kind == TOKEN_SIGN && p->now.length == 1 && p->text[p->now.at] == sign;
}

static token take(parser *p)
{
    token t = p->now;
    p->now = token_next(p->text, t.at + t.length);
    return t;
}

static uint16_t fail_refused(parser *p, token t, const char *why)
{
    return fail(p, t.at, "%s %s", show(p, t).text, why);
}

static const char *refusal_of(const parser *p, token t)
{
    return names_refusal(p->text + t.at, t.length);
}

/* The text has another token than `expected`. Signs of other languages are explained. */
static uint16_t fail_expected(parser *p, const char *expected, const char *hint)
{
    token t = p->now;
    const char *why = t.kind == TOKEN_SIGN ? refusal_of(p, t) : NULL;
    if (why != NULL) return fail_refused(p, t, why);
    if (next_is(p, '[') || next_is(p, '{')) hint = "; parentheses are '(' and ')'";
    return fail(p, t.at, "expected %s, got %s%s", expected, show(p, t).text, hint);
}

static uint16_t fail_operand(parser *p)
{
    return fail_expected(p, "a number, a name or '('",
                         next_is(p, '*') ? "; powers are written x^y" : "");
}

static uint16_t fail_operator(parser *p, const char *expected)
{
    bool is_factor = p->now.kind == TOKEN_NUMBER || p->now.kind == TOKEN_NAME || next_is(p, '(');
    return fail_expected(p, expected, is_factor ? "; products are written with '*'" : "");
}

/* A closing parenthesis for the one that was opened at `open`. */
static void take_closing(parser *p, size_t open)
{
    char expected[100];
    text_place place = token_place(p->text, open);
    snprintf(expected, sizeof expected, "an operator or ')' for the '(' at line %zu, column %zu",
             place.line, place.column);
    if (next_is(p, ')'))
        take(p);
    else
        fail_operator(p, expected);
}

/* --- Values ----------------------------------------------------------------------------------- */

/* The builder's result, or its error, which is reported at the place `at`. */
static uint16_t checked(parser *p, size_t at, uint16_t value)
{
    return p->b->fault[0] != '\0' ? fail(p, at, "%s", p->b->fault) : value;
}

static uint16_t apply(parser *p, size_t at, int which, const uint16_t *argument, size_t count)
{
    if (p->failed) return 0;
    return checked(p, at, rules_apply(p->b, which, argument, count));
}

static uint16_t join(parser *p, size_t at, int which, uint16_t x, uint16_t y)
{
    const uint16_t argument[] = {x, y};
    return apply(p, at, which, argument, 2);
}

static uint16_t read_number(parser *p)
{
    double value = 0;
    token t = take(p);
    const char *why = token_number(p->text, t, &value);
    if (why != NULL) return fail(p, t.at, "%s", why);
    return checked(p, t.at, builder_number(p->b, value));
}

static uint16_t fail_unknown(parser *p, token name)
{
    char hint[150]; /* the rest of a message after the place and the name */
    const char *text = p->text + name.at;
    bool call = next_is(p, '(');
    const char *why = names_refusal(text, name.length);
    if (call && why != NULL) return fail_refused(p, name, why);
    if (!call && names_function(text, name.length) != NULL)
        return fail(p, name.at, "%s is a function: its arguments follow in parentheses",
                    show(p, name).text);
    names_hint(p->scope, call, text, name.length, hint, sizeof hint);
    return fail(p, name.at, "unknown %s %s%s", call ? "function" : "name", show(p, name).text,
                hint);
}

/* A name without arguments. */
static uint16_t read_name(parser *p, token name)
{
    const expression_scope *s = p->scope;
    const char *text = p->text + name.at;
    for (size_t i = 0; i < s->variable_count; ++i)
        if (names_are_equal(text, name.length, s->variable[i])) return (uint16_t)i;
    for (size_t i = 0; i < s->constant_count; ++i)
        if (names_are_equal(text, name.length, s->constant[i]))
            return checked(p, name.at, builder_number(p->b, s->constant_value[i]));
    if (names_are_equal(text, name.length, "pi"))
        return checked(p, name.at, builder_constant(p->b, rules_pi()));
    if (names_are_equal(text, name.length, "e"))
        return checked(p, name.at, builder_constant(p->b, rules_e()));
    return fail_unknown(p, name);
}

/* --- The grammar ------------------------------------------------------------------------------ */

static uint16_t read_sum(parser *p);
static uint16_t read_signed(parser *p);

static uint16_t fail_count(parser *p, token name, const function_name *f, size_t found)
{
    char allowed[40];
    if (f->least == f->most)
        snprintf(allowed, sizeof allowed, "%zu", f->least);
    else
        snprintf(allowed, sizeof allowed, "%zu to %zu", f->least, f->most);
    return fail(p, name.at, "%s takes %s argument%s, got %zu%s", f->name, allowed,
                f->most == 1 ? "" : "s", found, found > f->most ? " or more" : "");
}

static uint16_t read_call(parser *p, token name, const function_name *f)
{
    uint16_t argument[ARGUMENTS_MAX + 1];
    size_t count = 0;
    token open = take(p);
    if (next_is(p, ')')) return fail_count(p, name, f, 0);
    argument[count++] = read_sum(p);
    while (next_is(p, ',') && count <= f->most) {
        take(p);
        argument[count++] = read_sum(p);
    }
    if (p->failed) return 0;
    if (count > f->most) return fail_count(p, name, f, count);
    take_closing(p, open.at);
    if (p->failed) return 0;
    if (count < f->least) return fail_count(p, name, f, count);
    return apply(p, name.at, f->meaning, argument, count);
}

static uint16_t read_word(parser *p)
{
    token name = take(p);
    const function_name *f = names_function(p->text + name.at, name.length);
    bool is_call = next_is(p, '(');
    if (is_call && f != NULL) return read_call(p, name, f);
    return is_call && refusal_of(p, name) != NULL ? fail_unknown(p, name) : read_name(p, name);
}

static uint16_t read_operand(parser *p)
{
    if (p->now.kind == TOKEN_NUMBER) return read_number(p);
    if (p->now.kind == TOKEN_NAME) return read_word(p);
    if (!next_is(p, '(')) return fail_operand(p);
    token open = take(p);
    uint16_t x = read_sum(p);
    if (!p->failed) take_closing(p, open.at);
    return x;
}

static uint16_t read_power(parser *p)
{
    uint16_t x = read_operand(p);
    if (!next_is(p, '^')) return x;
    token sign = take(p);
    return join(p, sign.at, MEANING_POWER, x, read_signed(p));
}

/* Every level of nesting passes through this function. */
static uint16_t read_signed(parser *p)
{
    size_t at = p->now.at;
    bool negative = false;
    if (p->depth == EXPRESSION_DEPTH_MAX)
        return fail(p, at, "more than %d parentheses, functions or exponents inside each other",
                    EXPRESSION_DEPTH_MAX);
    while (next_is(p, '+') || next_is(p, '-')) negative ^= p->text[take(p).at] == '-';
    ++p->depth;
    uint16_t x = read_power(p);
    --p->depth;
    return negative ? apply(p, at, MEANING_NEGATE, &x, 1) : x;
}

static uint16_t read_product(parser *p)
{
    uint16_t x = read_signed(p);
    while (next_is(p, '*') || next_is(p, '/')) {
        token sign = take(p);
        int which = p->text[sign.at] == '*' ? MEANING_MULTIPLY : MEANING_DIVIDE;
        x = join(p, sign.at, which, x, read_signed(p));
    }
    return x;
}

static uint16_t read_sum(parser *p)
{
    uint16_t x = read_product(p);
    while (next_is(p, '+') || next_is(p, '-')) {
        token sign = take(p);
        int which = p->text[sign.at] == '+' ? MEANING_ADD : MEANING_SUBTRACT;
        x = join(p, sign.at, which, x, read_product(p));
    }
    return x;
}

bool parser_read(const expression_scope *scope, const char *text, builder *b, uint16_t *value,
                 expression_error *error)
{
    parser p = {.scope = scope, .text = text, .b = b, .error = error};
    p.now = token_next(text, 0);
    *value = read_sum(&p);
    if (!p.failed && next_is(&p, ')')) fail(&p, p.now.at, "')' without its '('");
    if (!p.failed && p.now.kind != TOKEN_END) fail_operator(&p, "an operator or the end");
    return !p.failed;
}

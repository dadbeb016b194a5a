/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/names.h"
#include "plugins/expression/rules.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))
#define SHOWN 40 /* bytes of a name in a message */

static const function_name functions[] = {
    {"abs", MEANING_OPERATION + OP_ABS, 1, 1},
    {"acos", MEANING_OPERATION + OP_ACOS, 1, 1},
    {"asin", MEANING_OPERATION + OP_ASIN, 1, 1},
    {"atan", MEANING_OPERATION + OP_ATAN, 1, 1},
    {"atan2", MEANING_OPERATION + OP_ATAN2, 2, 2},
    {"cbrt", MEANING_OPERATION + OP_CBRT, 1, 1},
    {"clamp", MEANING_CLAMP, 3, 3},
    {"copysign", MEANING_COPYSIGN, 2, 2},
    {"cos", MEANING_OPERATION + OP_COS, 1, 1},
    {"cosh", MEANING_OPERATION + OP_COSH, 1, 1},
    {"exp", MEANING_OPERATION + OP_EXP, 1, 1},
    {"exp2", MEANING_EXP2, 1, 1},
    {"fabs", MEANING_OPERATION + OP_ABS, 1, 1},
    {"fmax", MEANING_MAX, 2, ARGUMENTS_MAX},
    {"fmin", MEANING_MIN, 2, ARGUMENTS_MAX},
    {"hypot", MEANING_HYPOT, 2, 3},
    {"lerp", MEANING_LERP, 3, 3},
    {"ln", MEANING_OPERATION + OP_LOG, 1, 1},
    {"log", MEANING_OPERATION + OP_LOG, 1, 1},
    {"log10", MEANING_LOG10, 1, 1},
    {"log2", MEANING_LOG2, 1, 1},
    {"max", MEANING_MAX, 2, ARGUMENTS_MAX},
    {"min", MEANING_MIN, 2, ARGUMENTS_MAX},
    {"pow", MEANING_POWER, 2, 2},
    {"sin", MEANING_OPERATION + OP_SIN, 1, 1},
    {"sinh", MEANING_OPERATION + OP_SINH, 1, 1},
    {"sq", MEANING_SQUARE, 1, 1},
    {"sqr", MEANING_SQUARE, 1, 1},
    {"sqrt", MEANING_SQRT, 1, 1},
    {"tan", MEANING_OPERATION + OP_TAN, 1, 1},
    {"tanh", MEANING_OPERATION + OP_TANH, 1, 1},
};

#define JUMP "is discontinuous: a surface with a jump has no rate bound"
#define CHOICE                                                                                     \
    "can jump where the choice changes, and a surface with a jump has no rate bound; "             \
    "min, max, abs and clamp choose without jumps"

static const struct refusal {
    const char *name, *why;
} refusals[] = {
    {"floor", JUMP},    {"ceil", JUMP},      {"round", JUMP},  {"trunc", JUMP},
    {"rint", JUMP},     {"nearbyint", JUMP}, {"int", JUMP},    {"fract", JUMP},
    {"frac", JUMP},     {"sign", JUMP},      {"sgn", JUMP},    {"signum", JUMP},
    {"mod", JUMP},      {"fmod", JUMP},      {"rem", JUMP},    {"remainder", JUMP},
    {"step", JUMP},     {"heaviside", JUMP}, {"if", CHOICE},   {"ifelse", CHOICE},
    {"select", CHOICE}, {"where", CHOICE},   {"cond", CHOICE}, {"piecewise", CHOICE},
    {"%", JUMP},        {"<", CHOICE},       {">", CHOICE},    {"=", CHOICE},
    {"!", CHOICE},      {"?", CHOICE},       {":", CHOICE},    {"&", CHOICE},
    {"|", CHOICE},
};

bool names_are_equal(const char *name, size_t length, const char *other)
{
    return strlen(other) == length && memcmp(name, other, length) == 0;
}

bool names_is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool names_is_digit(char c) { return c >= '0' && c <= '9'; }

const function_name *names_function(const char *name, size_t length)
{
    for (size_t i = 0; i < COUNT_OF(functions); ++i)
        if (names_are_equal(name, length, functions[i].name)) return &functions[i];
    return NULL;
}

const char *names_refusal(const char *name, size_t length)
{
    for (size_t i = 0; i < COUNT_OF(refusals); ++i)
        if (names_are_equal(name, length, refusals[i].name)) return refusals[i].why;
    return NULL;
}

/* --- What was meant --------------------------------------------------------------------------- */

#define DISTANCE_MAX 32 /* longer names get no suggestion */

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* Letters to change, insert or remove to turn one name into the other, in either case; row by row
 * of Levenshtein's table. */
static size_t distance_between(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t row[DISTANCE_MAX + 1];
    if (a_length > DISTANCE_MAX || b_length > DISTANCE_MAX) return SIZE_MAX;
    for (size_t j = 0; j <= b_length; ++j) row[j] = j;
    for (size_t i = 0; i < a_length; ++i) {
        size_t diagonal = row[0]++;
        for (size_t j = 0; j < b_length; ++j) {
            size_t changed = diagonal + (lower(a[i]) != lower(b[j]));
            diagonal = row[j + 1];
            row[j + 1] = least(changed, 1 + least(row[j], row[j + 1]));
        }
    }
    return row[b_length];
}

typedef struct nearest {
    const char *wanted, *best;
    size_t length, distance;
} nearest;

/* At most one letter in three may differ. */
static void offer(nearest *n, const char *candidate)
{
    size_t distance = distance_between(n->wanted, n->length, candidate, strlen(candidate));
    if (distance > n->length / 3 || (n->best != NULL && distance >= n->distance)) return;
    n->best = candidate;
    n->distance = distance;
}

/* Appends to the text in to[size]; what does not fit is cut. */
__attribute__((format(printf, 3, 4))) static void append(char *to, size_t size, const char *format,
                                                         ...)
{
    size_t used = strlen(to);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(to + used, size - used, format, arguments);
    va_end(arguments);
}

static void list_names(const expression_scope *scope, char *to, size_t size)
{
    append(to, size, "; known: ");
    for (size_t i = 0; i < scope->variable_count; ++i) append(to, size, "%s, ", scope->variable[i]);
    append(to, size, "pi, e");
    for (size_t i = 0; i < scope->constant_count; ++i) {
        if (strlen(to) + strlen(scope->constant[i]) + sizeof ", , ..." > size) {
            append(to, size, ", ...");
            return;
        }
        append(to, size, ", %s", scope->constant[i]);
    }
}

void names_hint(const expression_scope *scope, bool function, const char *name, size_t length,
                char *to, size_t size)
{
    nearest n = {name, NULL, length, 0};
    for (size_t i = 0; function && i < COUNT_OF(functions); ++i) offer(&n, functions[i].name);
    for (size_t i = 0; !function && i < scope->variable_count; ++i) offer(&n, scope->variable[i]);
    for (size_t i = 0; !function && i < scope->constant_count; ++i) offer(&n, scope->constant[i]);
    if (!function) offer(&n, "pi");
    if (!function) offer(&n, "e");
    to[0] = '\0';
    if (n.best != NULL) append(to, size, ", did you mean '%s'?", n.best);
    if (!function) list_names(scope, to, size);
}

/* --- Constants -------------------------------------------------------------------------------- */

static bool is_name(const char *name)
{
    if (!names_is_letter(name[0])) return false;
    for (const char *c = name; *c != '\0'; ++c)
        if (!names_is_letter(*c) && !names_is_digit(*c)) return false;
    return true;
}

/* What the name of constant k means already; NULL: nothing. */
static const char *other_meaning(const expression_scope *scope, size_t k)
{
    const char *name = scope->constant[k];
    for (size_t i = 0; i < scope->variable_count; ++i)
        if (strcmp(name, scope->variable[i]) == 0) return "a variable";
    for (size_t i = 0; i < k; ++i)
        if (strcmp(name, scope->constant[i]) == 0) return "another constant";
    if (strcmp(name, "pi") == 0) return "3.14159...";
    if (strcmp(name, "e") == 0) return "2.71828...";
    return names_function(name, strlen(name)) != NULL ? "a function" : NULL;
}

bool names_check_constants(const expression_scope *scope, expression_error *error)
{
    error->at = EXPRESSION_AT_CONSTANTS;
    if (scope->constant_count > EXPRESSION_CONSTANTS_MAX) {
        snprintf(error->message, sizeof error->message, "got %zu constants, must be at most %d",
                 scope->constant_count, EXPRESSION_CONSTANTS_MAX);
        return false;
    }
    for (size_t k = 0; k < scope->constant_count; ++k) {
        const char *name = scope->constant[k], *other = other_meaning(scope, k);
        if (!is_name(name)) {
            snprintf(error->message, sizeof error->message,
                     "'%.*s' is not a name: must be letters, digits and '_', a letter first", SHOWN,
                     name);
            return false;
        }
        if (other != NULL) {
            snprintf(error->message, sizeof error->message,
                     "'%.*s' is %s already; take another name", SHOWN, name, other);
            return false;
        }
    }
    return true;
}

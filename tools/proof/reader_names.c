/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <string.h>

#include "tools/proof/reader_internal.h"

/* What the names in formulas mean: functions, variables, constants, definitions. */

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

int reader_number(reader *r, double value)
{
    return reader_add_step(r, (step){.kind = STEP_NUMBER, .number = value});
}

static int function(reader *r, jet_function *g, int x)
{
    return reader_add_step(
        r, (step){.kind = STEP_FUNCTION, .operand = {x}, .count = 1, .function = g});
}

/* Functions that are composed of others; -1: not one of them. */
static int apply_composite(reader *r, const char *f, const int *a, int count)
{
    if (count == 1 && strcmp(f, "log2") == 0)
        return reader_join(r, STEP_DIVIDE, function(r, jet_log_, a[0]),
                           function(r, jet_log_, reader_number(r, 2)));
    if (count == 1 && strcmp(f, "log10") == 0)
        return reader_join(r, STEP_DIVIDE, function(r, jet_log_, a[0]),
                           function(r, jet_log_, reader_number(r, 10)));
    if (count == 1 && strcmp(f, "exp2") == 0)
        return reader_join(r, STEP_POWER, reader_number(r, 2), a[0]);
    if (count == 3 && strcmp(f, "clamp") == 0)
        return reader_join(r, STEP_MIN, reader_join(r, STEP_MAX, a[0], a[1]), a[2]);
    if (count == 3 && strcmp(f, "lerp") == 0)
        return reader_join(
            r, STEP_ADD, a[0],
            reader_join(r, STEP_MULTIPLY, a[2], reader_join(r, STEP_SUBTRACT, a[1], a[0])));
    return -1;
}

static int apply_name(reader *r, const name *f, const int *a, int count)
{
    if (f->kind != STEP_MIN && f->kind != STEP_MAX) {
        step s = {.kind = f->kind, .count = count, .function = f->function};
        memcpy(s.operand, a, (size_t)count * sizeof *a);
        return reader_add_step(r, s);
    }
    int x = a[0];
    for (int k = 1; k < count; ++k) x = reader_join(r, f->kind, x, a[k]);
    return x;
}

int reader_apply(reader *r, const char *f, const int *a, int count)
{
    if (r->fault[0] != '\0') return 0;
    for (size_t k = 0; k < sizeof functions / sizeof *functions; ++k)
        if (strcmp(functions[k].text, f) == 0 && count >= functions[k].least &&
            count <= functions[k].most)
            return apply_name(r, &functions[k], a, count);
    const int made = apply_composite(r, f, a, count);
    return made >= 0 ? made : reader_fail(r, "there is no function %s of %d arguments", f, count);
}

bool reader_is_function(const char *word)
{
    static const char *const composed[] = {"log2", "log10", "exp2", "clamp", "lerp"};
    for (size_t k = 0; k < sizeof functions / sizeof *functions; ++k)
        if (strcmp(functions[k].text, word) == 0) return true;
    for (size_t k = 0; k < sizeof composed / sizeof *composed; ++k)
        if (strcmp(composed[k], word) == 0) return true;
    return false;
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

const defined_name *reader_find_defined(const reader *r, const char *word)
{
    for (int k = 0; k < r->defined_count; ++k)
        if (strcmp(r->defined[k].text, word) == 0) return &r->defined[k];
    return NULL;
}

int reader_name(reader *r, const char *word)
{
    const formula_scope *s = r->scope;
    const char *variable = word[1] == '\0' ? strchr(s->variables, word[0]) : NULL;
    if (variable != NULL) return (int)(variable - s->variables);
    const defined_name *own = reader_find_defined(r, word);
    if (own != NULL) return own->step;
    for (size_t k = 0; k < s->count; ++k)
        if (strcmp(s->name[k], word) == 0) return reader_number(r, s->value[k]);
    if (strcmp(word, "pi") == 0) return reader_add_step(r, (step){.kind = STEP_PI});
    if (strcmp(word, "e") == 0) return reader_add_step(r, (step){.kind = STEP_E});
    return reader_fail(r, "'%s' is neither a variable (%s) nor a constant; these are pi, e%s", word,
                       s->variables, constants_text(s).text);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/kernel/kernel.h"

#include <stdlib.h>
#include <string.h>

enum { STEPS_MAX = 16384, NAMES_MAX = 1024, DEPTH_MAX = 200, ARGUMENTS_MAX = 3, WORD = 64 };

/* A number, a variable (of number a), or a function of earlier steps a and b. */
typedef struct step {
    slope_unary *unary;
    slope_binary *binary;
    int a, b;
    range number;
    unsigned uses; /* bit j: it depends on variable j */
} step;

struct expression {
    int count, out[3];
    step steps[];
};

typedef struct reader {
    const char *at, *variables;
    const char *why; /* NULL: no fault; afterwards the text counts as ended */
    step steps[STEPS_MAX];
    int count, depth;
    unsigned ranges; /* bit j: that of variable j is read */
    struct {
        char text[WORD];
        int step;
    } names[NAMES_MAX];
    int name_count;
    const int *arguments; /* that a, b and c stand for; NULL: names are those of the text */
} reader;

/* Notes the first fault. Returns 0, which stands for a step. */
static int fail(reader *r, const char *why)
{
    if (r->why == NULL) r->why = why;
    r->at = "";
    return 0;
}

static int add_step(reader *r, step s)
{
    if (r->count == STEPS_MAX) return fail(r, "a formula has too many steps");
    r->steps[r->count] = s;
    return r->count++;
}

static int add_number(reader *r, range value) { return add_step(r, (step){.number = value}); }

/* Adds a function of steps; of numbers, the number. */
static int apply(reader *r, step s)
{
    const step *a = &r->steps[s.a], *b = &r->steps[s.b];
    s.uses = s.binary != NULL ? a->uses | b->uses : a->uses;
    if (s.uses != 0) return add_step(r, s);
    const slope x = slope_fixed(a->number), y = slope_fixed(b->number);
    const slope z = s.binary != NULL ? s.binary(&x, &y) : s.unary(&x);
    return z.is_undefined ? fail(r, "a number has no value") : add_number(r, z.v);
}

static int join(reader *r, slope_binary *f, int a, int b)
{
    return apply(r, (step){.binary = f, .a = a, .b = b});
}

static char peek(reader *r)
{
    r->at += strspn(r->at, " \t");
    return *r->at;
}

static bool take(reader *r, char sign)
{
    const bool is_there = peek(r) == sign;
    r->at += is_there;
    return is_there;
}

/* False: there is no word here, or one that is too long. */
static bool take_word(reader *r, char word[WORD])
{
    static const char signs[] = "0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const bool is_word = strchr("0123456789_", peek(r)) == NULL;
    const size_t length = strspn(r->at, signs);
    if (length == 0 || length >= WORD || !is_word) return false;
    memcpy(word, r->at, length);
    word[length] = '\0';
    r->at += length;
    return true;
}

/* A function is one of slopes, or the text that it stands for, of a, b and c. */
static const struct {
    const char *name;
    int count; /* of arguments */
    slope_unary *unary;
    slope_binary *binary;
    const char *text;
} functions[] = {
    {"abs", 1, .text = "max(max(a, -a), 0)"},
    {"cos", 1, .unary = slope_cos},
    {"sin", 1, .unary = slope_sin},
    {"pow", 2, .binary = slope_raised},
    {"max", 2, .binary = slope_greatest},
    {"min", 2, .text = "-max(-a, -b)"},
    {"clamp", 3, .text = "min(max(a, b), c)"},
    {"sqrt", 1, .text = "a^0.5"},
    {"tan", 1, .text = "sin(a)/cos(a)"},
    {"hypot", 2, .text = "sqrt(a^2 + b^2)"},
    {"hypot", 3, .text = "sqrt(a^2 + b^2 + c^2)"},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

static int read_level(reader *r, int level);

/* Reads the text that a function stands for. */
static int expand(reader *r, const char *text, const int *arguments)
{
    const char *behind = r->at;
    const int *outer = r->arguments;
    r->at = text;
    r->arguments = arguments;
    const int x = read_level(r, 0);
    r->arguments = outer;
    if (r->why == NULL) r->at = behind;
    return x;
}

static int read_call(reader *r, const char *word)
{
    int x[ARGUMENTS_MAX] = {0}, count = 0;
    do {
        if (count == ARGUMENTS_MAX) return fail(r, "a function has too many arguments");
        x[count++] = read_level(r, 0);
    } while (take(r, ','));
    if (!take(r, ')')) return fail(r, "a formula lacks ')'");
    for (int k = 0; k < FUNCTIONS; ++k) {
        if (strcmp(functions[k].name, word) != 0 || count != functions[k].count) continue;
        if (functions[k].text != NULL) return expand(r, functions[k].text, x);
        if (functions[k].binary != NULL) return join(r, functions[k].binary, x[0], x[1]);
        return apply(r, (step){.unary = functions[k].unary, .a = x[0]});
    }
    return fail(r, "a formula has a function that is not known here");
}

/* Returns the step that a name stands for; -1: none. */
static int find_name(reader *r, const char *word)
{
    const char *variable = word[1] == '\0' ? strchr(r->variables, word[0]) : NULL;
    if (r->arguments != NULL) return r->arguments[word[0] - 'a'];
    if (variable != NULL) return (int)(variable - r->variables);
    for (int k = 0; k < r->name_count; ++k)
        if (strcmp(r->names[k].text, word) == 0) return r->names[k].step;
    return strcmp(word, "pi") == 0 ? add_number(r, range_pi()) : -1;
}

static int read_operand(reader *r)
{
    char word[WORD], *end;
    const char c = peek(r);
    if ((c >= '0' && c <= '9') || c == '.') {
        const double value = strtod(r->at, &end);
        if (!(fabs(value) < INFINITY) || end == r->at) return fail(r, "a number is no double");
        r->at = end;
        return add_number(r, range_of(value));
    }
    if (take(r, '(')) {
        const int x = read_level(r, 0);
        return take(r, ')') ? x : fail(r, "a formula lacks ')'");
    }
    if (!take_word(r, word)) return fail(r, "a formula lacks a number, a name or '('");
    if (take(r, '(')) return read_call(r, word);
    const int known = find_name(r, word);
    return known >= 0 ? known : fail(r, "a formula has an unknown name");
}

static int read_signed(reader *r)
{
    bool is_negative = false;
    if (r->depth == DEPTH_MAX) return fail(r, "a formula is too deep");
    for (; peek(r) == '+' || peek(r) == '-'; ++r->at) is_negative ^= *r->at == '-';
    ++r->depth;
    int x = read_operand(r);
    if (take(r, '^')) x = join(r, slope_raised, x, read_signed(r));
    --r->depth;
    return is_negative ? join(r, slope_less, add_number(r, range_of(0)), x) : x;
}

/* Reads sums (level 0) of products (level 1). */
static int read_level(reader *r, int level)
{
    static const struct {
        char signs[3];
        slope_binary *f[2];
    } levels[] = {{"+-", {slope_sum, slope_less}}, {"*/", {slope_product, slope_quotient}}};
    int x = level == 0 ? read_level(r, 1) : read_signed(r);
    for (;;) {
        const int k = peek(r) == levels[level].signs[0] ? 0 : 1;
        if (!take(r, levels[level].signs[k])) return x;
        x = join(r, levels[level].f[k], x, level == 0 ? read_level(r, 1) : read_signed(r));
    }
}

static void define(reader *r, const char *word)
{
    bool is_known = find_name(r, word) >= 0 || strcmp(word, "inf") == 0;
    for (int k = 0; k < FUNCTIONS; ++k) is_known = is_known || strcmp(functions[k].name, word) == 0;
    if (is_known) fail(r, "a formula defines a name that has a meaning");
    const int x = read_level(r, 0);
    if (r->name_count == NAMES_MAX) fail(r, "a formula defines too many names");
    if (r->why != NULL) return;
    memcpy(r->names[r->name_count].text, word, WORD);
    r->names[r->name_count++].step = x;
}

static range read_end(reader *r)
{
    char word[WORD];
    const char *from = r->at;
    const double infinite = take(r, '-') ? -INFINITY : INFINITY;
    if (take_word(r, word) && strcmp(word, "inf") == 0) return range_of(infinite);
    r->at = from;
    const step *s = &r->steps[read_level(r, 0)];
    const double size = fabs(s->number.lo);
    if (s->uses != 0 || !(s->number.hi - s->number.lo <= 0x1p-44 * size && size < INFINITY))
        fail(r, "an end of a range has a variable in it, or is not known well");
    return s->number;
}

static void read_range(reader *r, const char *word, range said[EXPRESSION_VARIABLES])
{
    const char *variable = word[1] == '\0' ? strchr(r->variables, word[0]) : NULL;
    const size_t j = variable != NULL ? (size_t)(variable - r->variables) : 0;
    if (variable == NULL || (r->ranges >> j & 1) != 0 || !take(r, '['))
        fail(r, "a range is of no variable, or said twice, or lacks '['");
    r->ranges |= 1u << j;
    said[j].lo = read_end(r).lo;
    if (!take(r, ',')) fail(r, "a range lacks ','");
    said[j].hi = read_end(r).hi;
    if (!take(r, ']') || !(said[j].hi - said[j].lo >= 0)) fail(r, "a range is empty, or lacks ']'");
}

/* Reads a definition or a range; false: a coordinate, of which nothing is read. */
static bool read_item(reader *r, range said[EXPRESSION_VARIABLES])
{
    char word[WORD], in[WORD];
    const char *from = r->at;
    if (take_word(r, word)) {
        if (take(r, '=')) return define(r, word), true;
        if (take_word(r, in) && strcmp(in, "in") == 0) return read_range(r, word, said), true;
    }
    r->at = from;
    return false;
}

static void read_part(reader *r, int out[3], range said[EXPRESSION_VARIABLES])
{
    for (int j = 0; r->variables[j] != '\0'; ++j) {
        said[j] = RANGE_ALL;
        add_step(r, (step){.a = j, .uses = 1u << j});
    }
    while (r->why == NULL && read_item(r, said))
        if (!take(r, ';')) fail(r, "a formula lacks ';'");
    for (int i = 0; i < 3; ++i) {
        if (i > 0 && !take(r, ';')) fail(r, "a formula lacks a coordinate");
        out[i] = read_level(r, 0);
    }
    if (peek(r) != '\0' && *r->at != '|') fail(r, "a formula does not end");
}

expression *expression_read(const char **text, const char *variables,
                            range said[EXPRESSION_VARIABLES], const char **why)
{
    int out[3];
    expression *e = NULL;
    reader *r = calloc(1, sizeof *r);
    *why = "memory ran out";
    if (r == NULL) return NULL;
    r->at = *text, r->variables = variables;
    read_part(r, out, said);
    const size_t size = (size_t)r->count * sizeof(step);
    if (r->why != NULL) *why = r->why;
    if (r->why == NULL) e = malloc(sizeof *e + size);
    if (e != NULL) {
        *e = (expression){.count = r->count, .out = {out[0], out[1], out[2]}};
        memcpy(e->steps, r->steps, size);
        *text = *r->at == '|' ? r->at + 1 : NULL;
    }
    free(r);
    return e;
}

bool expression_compute(const expression *e, memo *m, int first, const slope *in, slope out[3])
{
    unsigned changed = (1u << first) - 1;
    if (m->of != e) {
        free(m->value);
        m->value = malloc((size_t)e->count * sizeof *m->value);
        changed = ~0u;
    }
    m->of = m->value != NULL ? e : NULL;
    for (int j = first; j < (first > 0 ? 4 : 3); ++j) {
        if (in[j].v.lo != m->at[j].lo || in[j].v.hi != m->at[j].hi) changed |= 1u << j;
        m->at[j] = in[j].v;
    }
    for (int k = 0; k < e->count && m->of != NULL; ++k) {
        const step *s = &e->steps[k];
        slope *to = &m->value[k];
        if (changed != ~0u && (s->uses & changed) == 0) continue;
        if (s->binary != NULL)
            *to = s->binary(&m->value[s->a], &m->value[s->b]);
        else if (s->unary != NULL)
            *to = s->unary(&m->value[s->a]);
        else
            *to = s->uses != 0 ? in[s->a] : slope_fixed(s->number);
    }
    for (int i = 0; i < 3 && m->of != NULL; ++i) out[i] = m->value[e->out[i]];
    return m->of != NULL;
}

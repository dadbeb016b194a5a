/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/coq_term.h"

#include <math.h>

void coq_put_number(FILE *to, double x)
{
    int power;
    double whole = frexp(x, &power) * 0x1p53;
    power -= 53;
    for (; whole != 0 && fmod(whole, 2) == 0; whole /= 2) ++power;
    if (whole == 0 || (power >= 0 && fabs(x) < 0x1p53))
        fprintf(to, x < 0 ? "(%.0f)" : "%.0f", whole == 0 ? 0 : x);
    else if (power > 0)
        fprintf(to, "(%.0f * 2 ^ %d)", whole, power);
    else
        fprintf(to, "(%.0f / 2 ^ %d)", whole, -power);
}

/* --- Steps ------------------------------------------------------------------------------------ */

/* How a function of one number is written: what stands before and behind it. */
static const struct {
    jet_function *function;
    const char *before, *behind;
} functions[] = {{jet_sqr_, "(", " ^ 2)"}, {jet_abs_, "(Rabs ", ")"}, {jet_sqrt_, "(sqrt ", ")"},
                 {jet_exp_, "(exp ", ")"}, {jet_log_, "(ln ", ")"},   {jet_sin_, "(sin ", ")"},
                 {jet_cos_, "(cos ", ")"}, {jet_tan_, "(tan ", ")"},  {jet_atan_, "(atan ", ")"}};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

static int find_function(const step *s)
{
    int k = 0;
    while (k < FUNCTIONS && functions[k].function != s->function) ++k;
    return k;
}

/* Returns the exponent of a power, or -1: it is no small whole number. */
static int exponent(const formula *f, const step *s)
{
    const step *b = &f->steps[s->operand[1]];
    const double n = b->constant.lo;
    if (b->kind != STEP_CONSTANT || !(n >= 0 && n <= 64) || b->constant.hi != n) return -1;
    return n == floor(n) ? (int)n : -1;
}

bool term_is_known(const formula *f, const step *s)
{
    switch (s->kind) {
    case STEP_CONSTANT:
        return ld_interval_is_finite(s->constant);
    case STEP_FUNCTION:
        return find_function(s) < FUNCTIONS;
    case STEP_POWER:
        return exponent(f, s) >= 0;
    case STEP_VARIABLE:
    case STEP_NEGATE:
    case STEP_ADD:
    case STEP_SUBTRACT:
    case STEP_MULTIPLY:
    case STEP_DIVIDE:
    case STEP_MIN:
    case STEP_MAX:
    case STEP_LENGTH:
        return true;
    default:
        return false;
    }
}

static size_t number_of(const writer *w, int which)
{
    size_t n = w->first;
    for (int k = 0; k < which; ++k) n += term_is_range(&w->f->steps[k]);
    return n;
}

static void put_two(const writer *w, const step *s, const char *sign)
{
    fputc('(', w->to);
    term_put(w, s->operand[0]);
    fputs(sign, w->to);
    term_put(w, s->operand[1]);
    fputc(')', w->to);
}

/* Lemma. min and max of a and b are (a + b - |a - b|) / 2 and (a + b + |a - b|) / 2. */
static void put_extreme(const writer *w, const step *s)
{
    fputc('(', w->to);
    put_two(w, s, " + ");
    fputs(s->kind == STEP_MIN ? " - Rabs " : " + Rabs ", w->to);
    put_two(w, s, " - ");
    fputs(") / 2", w->to);
}

static void put_length(const writer *w, const step *s)
{
    fputs("(sqrt (", w->to);
    for (int i = 0; i < s->count; ++i) {
        if (i > 0) fputs(" + ", w->to);
        term_put(w, s->operand[i]);
        fputs(" ^ 2", w->to);
    }
    fputs("))", w->to);
}

/* Writes all that is not an operation of two steps. */
static void put_other(const writer *w, int which)
{
    const step *s = &w->f->steps[which];
    if (s->kind == STEP_VARIABLE) {
        const char letter = w->variables[s->operand[0]];
        if (letter == 't' && w->clock != SIZE_MAX)
            fprintf(w->to, "k%zu", w->clock);
        else
            fputc(letter, w->to);
    } else if (term_is_range(s)) {
        fprintf(w->to, "k%zu", number_of(w, which));
    } else if (s->kind == STEP_CONSTANT) {
        coq_put_number(w->to, s->constant.lo);
    } else if (s->kind == STEP_NEGATE) {
        fputs("(- ", w->to);
        term_put(w, s->operand[0]);
        fputc(')', w->to);
    } else if (s->kind == STEP_LENGTH) {
        put_length(w, s);
    } else {
        const int k = find_function(s);
        fputs(functions[k].before, w->to);
        term_put(w, s->operand[0]);
        fputs(functions[k].behind, w->to);
    }
}

void term_put(const writer *w, int which)
{
    const step *s = &w->f->steps[which];
    switch (s->kind) {
    case STEP_ADD:
        return put_two(w, s, " + ");
    case STEP_SUBTRACT:
        return put_two(w, s, " - ");
    case STEP_MULTIPLY:
        return put_two(w, s, " * ");
    case STEP_DIVIDE:
        return put_two(w, s, " / ");
    case STEP_MIN:
    case STEP_MAX:
        fputc('(', w->to);
        put_extreme(w, s);
        fputc(')', w->to);
        return;
    case STEP_POWER:
        fputc('(', w->to);
        term_put(w, s->operand[0]);
        fprintf(w->to, " ^ %d)", exponent(w->f, s));
        return;
    default:
        put_other(w, which);
    }
}

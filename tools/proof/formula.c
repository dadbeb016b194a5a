/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/formula.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/proof/steps.h"

static jet computed(const jet *value, const step *s, int n);

static bool is_number(const formula *f, int k, double number)
{
    return f->steps[k].kind == STEP_CONSTANT && ld_interval_is(f->steps[k].constant, number);
}

/* The step whose value a sum with 0 or a product with 1 has, or -1. */
static int same_as(const formula *f, const step *s)
{
    const int a = s->operand[0], b = s->operand[1];
    const bool sum = s->kind == STEP_ADD, product = s->kind == STEP_MULTIPLY;
    if ((sum && is_number(f, a, 0)) || (product && is_number(f, a, 1))) return b;
    if (((sum || s->kind == STEP_SUBTRACT) && is_number(f, b, 0)) ||
        ((product || s->kind == STEP_DIVIDE) && is_number(f, b, 1)))
        return a;
    return -1;
}

/* Returns whether a step has a value for all values of the variables, as far as is seen here.
 * Constants have one. */
static bool is_total(const formula *f, const step *s)
{
    static jet_function *const partial[] = {jet_sqrt_, jet_log_, jet_tan_, jet_asin_, jet_acos_};
    bool total = true;
    for (int i = 0; i < s->count; ++i) total = total && f->steps[s->operand[i]].is_total;
    for (size_t k = 0; k < sizeof partial / sizeof *partial; ++k)
        total = total && !(s->kind == STEP_FUNCTION && s->function == partial[k]);
    if (s->kind != STEP_DIVIDE && s->kind != STEP_POWER) return total;
    const step *b = &f->steps[s->operand[1]];
    const ld_interval value = b->constant;
    if (!total || b->kind != STEP_CONSTANT) return false;
    if (s->kind == STEP_DIVIDE) return ld_interval_excludes_0(value);
    return value.lo >= 0 && value.lo == value.hi && floorl(value.lo) == value.lo;
}

/* Computes the steps that depend on no variable, and leaves out sums with 0 and products with 0 or
 * 1, which rotations about x, y or z are full of. What has no value is left as it is. place[k]: the
 * step that has the value of step k. */
static void fold(formula *f, jet *value, int *place)
{
    for (int k = 0; k < f->count; ++k) {
        step *s = &f->steps[k];
        bool is_fixed = s->kind != STEP_VARIABLE;
        for (int i = 0; i < s->count; ++i) {
            s->operand[i] = place[s->operand[i]];
            is_fixed = is_fixed && f->steps[s->operand[i]].kind == STEP_CONSTANT;
        }
        const int same = is_fixed || s->count != 2 ? -1 : same_as(f, s);
        place[k] = same >= 0 ? same : k;
        s->is_total = is_total(f, s);
        if (is_fixed) value[k] = computed(value, s, 0);
        if (s->kind == STEP_MULTIPLY && s->is_total &&
            (is_number(f, s->operand[0], 0) || is_number(f, s->operand[1], 0)))
            value[k] = jet_constant(0, ld_interval_of(0)), is_fixed = true;
        if (is_fixed && !value[k].is_undefined)
            *s = (step){.kind = STEP_CONSTANT, .constant = value[k].v, .is_total = true};
    }
    for (int i = 0; i < 3; ++i) f->out[i] = place[f->out[i]];
}

/* Drops the steps that no coordinate needs. place[k]: where step k goes. */
static void drop_unneeded(formula *f, int *place)
{
    memset(place, 0, (size_t)f->count * sizeof *place);
    for (int i = 0; i < 3; ++i) place[f->out[i]] = 1;
    for (int k = f->count - 1; k >= 0; --k)
        for (int i = 0; i < f->steps[k].count && place[k] != 0; ++i)
            place[f->steps[k].operand[i]] = 1;
    int count = 0;
    for (int k = 0; k < f->count; ++k) {
        if (place[k] == 0) continue;
        step s = f->steps[k];
        for (int i = 0; i < s.count; ++i) s.operand[i] = place[s.operand[i]];
        place[k] = count;
        f->steps[count++] = s;
    }
    for (int i = 0; i < 3; ++i) f->out[i] = place[f->out[i]];
    f->count = count;
}

static bool is_linear(const formula *f, const step *s)
{
    const bool by[2] = {s->count == 2 && f->steps[s->operand[0]].kind == STEP_CONSTANT,
                        s->count == 2 && f->steps[s->operand[1]].kind == STEP_CONSTANT};
    return s->kind == STEP_ADD || s->kind == STEP_SUBTRACT || s->kind == STEP_NEGATE ||
           (s->kind == STEP_MULTIPLY && (by[0] || by[1])) || (s->kind == STEP_DIVIDE && by[1]);
}

static void mark_uses(formula *f)
{
    for (int k = 0; k < f->count; ++k) {
        step *s = &f->steps[k];
        s->uses = s->kind == STEP_VARIABLE ? 1u << s->operand[0] : 0;
        for (int i = 0; i < s->count; ++i) s->uses |= f->steps[s->operand[i]].uses;
    }
}

/* Returns whether a step is a sum of terms that are each linear in a variable of its own: its
 * interval is its range, which nothing narrows. */
static bool is_tight(const formula *f, const step *s)
{
    unsigned before = 0;
    if (s->kind == STEP_CONSTANT || s->kind == STEP_VARIABLE) return true;
    bool tight = is_linear(f, s);
    for (int i = 0; i < s->count && tight; ++i) {
        const step *of = &f->steps[s->operand[i]];
        tight = of->is_tight && (before & of->uses) == 0;
        before |= of->uses;
    }
    return tight;
}

static void mark_narrowed(formula *f)
{
    for (int k = 0; k < f->count; ++k) f->steps[k].is_tight = is_tight(f, &f->steps[k]);
    for (int i = 0; i < 3; ++i) f->steps[f->out[i]].is_narrowed = true;
    for (int k = 0; k < f->count; ++k)
        for (int i = 0; i < f->steps[k].count && !is_linear(f, &f->steps[k]); ++i)
            f->steps[f->steps[k].operand[i]].is_narrowed = true;
    for (int k = 0; k < f->count; ++k)
        if (f->steps[k].is_tight) f->steps[k].is_narrowed = false;
}

/* False: memory ran out. */
static bool shorten(formula *f)
{
    jet *value = calloc((size_t)f->count, sizeof *value);
    int *place = malloc((size_t)f->count * sizeof *place);
    const bool has_room = value != NULL && place != NULL;
    if (has_room) {
        fold(f, value, place);
        drop_unneeded(f, place);
        mark_uses(f);
        mark_narrowed(f);
    }
    free(value);
    free(place);
    return has_room;
}

/* Makes room for the values of a formula that was read, or frees what is left of one that was
 * not. */
static formula *finished(formula *f, bool read, char *fault, size_t size)
{
    const bool has_room = !read || shorten(f);
    formula *fitting =
        read ? realloc(f, offsetof(formula, steps) + (size_t)f->count * sizeof *f->steps) : NULL;
    if (fitting != NULL) f = fitting;
    if (read && has_room) f->value = calloc((size_t)f->count, sizeof *f->value);
    if (read && f->value != NULL) return f;
    if (f == NULL || read) snprintf(fault, size, "memory ran out");
    formula_free(f);
    return NULL;
}

formula *formula_read(const formula_scope *scope, const char *const text[3], char *fault,
                      size_t size)
{
    formula *f = calloc(1, sizeof *f);
    return finished(f, f != NULL && reader_read(scope, text, f, fault, size), fault, size);
}

formula *formula_read_part(const formula_scope *scope, const char *text,
                           formula_range ranges[FORMULA_VARIABLES], char *fault, size_t size)
{
    formula *f = calloc(1, sizeof *f);
    return finished(f, f != NULL && reader_read_part(scope, text, f, ranges, fault, size), fault,
                    size);
}

const char *formula_next_part(const char *text)
{
    const char *sign = strchr(text, '|');
    return sign != NULL ? sign + 1 : NULL;
}

void formula_free(formula *f)
{
    if (f != NULL) free(f->value);
    free(f);
}

/* --- Computing -------------------------------------------------------------------------------- */

static jet joined(const step *s, const jet *x, const jet *y)
{
    switch (s->kind) {
    case STEP_ADD:
        return jet_add(x, y);
    case STEP_SUBTRACT:
        return jet_sub(x, y);
    case STEP_MULTIPLY:
        return x == y ? jet_apply(jet_sqr_, x) : jet_mul(x, y);
    case STEP_DIVIDE:
        return jet_div(x, y);
    case STEP_POWER:
        return jet_power(x, y);
    case STEP_MIN:
        return jet_min(x, y);
    case STEP_MAX:
        return jet_max(x, y);
    case STEP_ANGLE:
        return jet_angle(x, y);
    default:
        return jet_copysign(x, y);
    }
}

static jet computed(const jet *value, const step *s, int n)
{
    const jet *a[3];
    for (int k = 0; k < 3; ++k) a[k] = &value[k < s->count ? s->operand[k] : 0];
    switch (s->kind) {
    case STEP_NUMBER:
        return jet_constant(n, ld_interval_of(s->number));
    case STEP_CONSTANT:
        return jet_constant(n, s->constant);
    case STEP_PI:
        return jet_constant(n, ld_interval_pi());
    case STEP_E:
        return jet_constant(n, ld_interval_e());
    case STEP_NEGATE:
        return jet_neg(a[0]);
    case STEP_FUNCTION:
        return jet_apply(s->function, a[0]);
    case STEP_LENGTH:
        return jet_length(a, s->count);
    default:
        return joined(s, a[0], a[1]);
    }
}

int formula_steps(const formula *f) { return f->count; }

bool formula_depends(const formula *f, int variable)
{
    const unsigned uses =
        f->steps[f->out[0]].uses | f->steps[f->out[1]].uses | f->steps[f->out[2]].uses;
    return (uses >> variable & 1) != 0;
}

void formula_drop_values(formula *f)
{
    free(f->value);
    f->value = NULL;
}

void formula_jets_in(const formula *f, const jet *variables, jet *value, jet out[3])
{
    for (int k = 0; k < f->count; ++k) {
        const step *s = &f->steps[k];
        value[k] = s->kind == STEP_VARIABLE ? variables[s->operand[0]]
                                            : computed(value, s, variables[0].n);
    }
    for (int i = 0; i < 3; ++i) out[i] = value[f->out[i]];
}

void formula_jets_about(const formula *f, const formula_boxes *given, jet *value, jet out[3],
                        jet out_centre[3])
{
    jet *wide = value, *at = value + f->count;
    for (int k = 0; k < f->count; ++k) {
        const step *s = &f->steps[k];
        if (!given->is_first && (s->uses & given->changed) == 0) continue;
        if (s->kind == STEP_VARIABLE) {
            wide[k] = given->box[s->operand[0]];
            at[k] = given->centre[s->operand[0]];
            continue;
        }
        wide[k] = computed(wide, s, given->box[0].n);
        at[k] = computed(at, s, given->box[0].n);
        if (s->is_narrowed) jet_narrow(&wide[k], &at[k], given->offset);
    }
    for (int i = 0; i < 3; ++i) {
        out[i] = wide[f->out[i]];
        out_centre[i] = at[f->out[i]];
    }
}

void formula_jets(formula *f, const jet *variables, jet out[3])
{
    formula_jets_in(f, variables, f->value, out);
}

bool formula_constant(formula *f, int which, ld_interval *value)
{
    bool *has_variable = calloc((size_t)which + 1, sizeof *has_variable);
    jet *all = calloc((size_t)which + 1, sizeof *all);
    bool is_known = has_variable != NULL && all != NULL;
    f->value = all;
    for (int k = 0; k <= which && is_known; ++k) {
        const step *s = &f->steps[k];
        has_variable[k] = s->kind == STEP_VARIABLE;
        for (int i = 0; i < s->count; ++i)
            has_variable[k] = has_variable[k] || has_variable[s->operand[i]];
        if (!has_variable[k]) all[k] = computed(all, s, 0);
    }
    is_known = is_known && !has_variable[which] && !all[which].is_undefined;
    if (is_known) *value = all[which].v;
    f->value = NULL;
    free(all);
    free(has_variable);
    return is_known;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/builder.h"
#include "plugins/expression/names.h"
#include "plugins/expression/parser.h"
#include "plugins/expression/text_form.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Values live in slots. The first are the variables; a slot is reused as soon as its value is no
 * longer needed. */
typedef struct instruction {
    operation o; /* operands are slots */
    uint16_t to;
} instruction;

struct expression_program {
    size_t variables, length;
    uint16_t out[3]; /* slots */
    instruction instructions[];
};

void expression_free(expression_program *program) { free(program); }

size_t expression_length(const expression_program *program) { return program->length; }

/* --- From operations to instructions ---------------------------------------------------------- */

#define FOREVER UINT16_MAX

typedef struct allocation {
    uint16_t last_use[EXPRESSION_OPERATIONS_MAX]; /* 0: not needed; FOREVER: a result */
    uint16_t slot[EXPRESSION_OPERATIONS_MAX];
    uint16_t free_slot[EXPRESSION_SLOTS_MAX];
    size_t free_count, used;
} allocation;

/* Backwards: an operation that is needed is the last use of its operands, unless a later one uses
 * them. */
static void find_last_uses(const builder *b, const uint16_t out[3], allocation *a)
{
    memset(a->last_use, 0, sizeof a->last_use);
    for (int i = 0; i < 3; ++i) a->last_use[out[i]] = FOREVER;
    for (size_t i = b->count; i-- > 0;) {
        const operation *o = &b->operations[i];
        if (a->last_use[i] == 0) continue;
        for (int j = 0; j < opcode_operands(o->code); ++j)
            if (a->last_use[o->operand[j]] == 0) a->last_use[o->operand[j]] = (uint16_t)i;
    }
}

/* Frees the slots of operands that operation i is the last to need. */
static void release_operands(const builder *b, size_t variables, size_t i, allocation *a)
{
    const operation *o = &b->operations[i];
    for (int j = 0; j < opcode_operands(o->code); ++j) {
        uint16_t x = o->operand[j];
        if (x < variables || a->last_use[x] != i) continue;
        a->free_slot[a->free_count++] = a->slot[x];
        a->last_use[x] = FOREVER; /* freed once, even if it is both operands */
    }
}

static bool take_slot(allocation *a, uint16_t *slot)
{
    if (a->free_count == 0 && a->used == EXPRESSION_SLOTS_MAX) return false;
    *slot = a->free_count > 0 ? a->free_slot[--a->free_count] : (uint16_t)a->used++;
    return true;
}

static instruction instruct(const builder *b, size_t i, const allocation *a)
{
    instruction made = {.o = b->operations[i], .to = a->slot[i]};
    for (int j = 0; j < opcode_operands(made.o.code); ++j)
        made.o.operand[j] = a->slot[made.o.operand[j]];
    return made;
}

/* An operation may write its result to the slot of an operand: the result is computed before it is
 * stored. False: too few slots. */
static bool write_instructions(const builder *b, const uint16_t out[3], allocation *a,
                               expression_program *p)
{
    find_last_uses(b, out, a);
    a->free_count = 0;
    a->used = p->variables;
    p->length = 0;
    for (size_t i = 0; i < b->count; ++i) {
        bool is_variable = i < p->variables;
        if (is_variable) a->slot[i] = (uint16_t)i;
        if (is_variable || a->last_use[i] == 0) continue;
        release_operands(b, p->variables, i, a);
        if (!take_slot(a, &a->slot[i])) return false;
        p->instructions[p->length++] = instruct(b, i, a);
    }
    for (int i = 0; i < 3; ++i) p->out[i] = a->slot[out[i]];
    return true;
}

/* --- Compiling -------------------------------------------------------------------------------- */

static bool read_texts(const expression_scope *scope, const char *const text[3], builder *b,
                       uint16_t out[3], expression_error *error)
{
    if (!names_check_constants(scope, error)) return false;
    builder_begin(b, scope->whole, scope->variable_count);
    for (int i = 0; i < 3; ++i) {
        error->at = i;
        if (!parser_read(scope, text[i], b, &out[i], error)) return false;
    }
    return true;
}

static imp_status assemble(const builder *b, size_t variables, const uint16_t out[3], allocation *a,
                           expression_program **program, expression_error *error)
{
    expression_program *p = malloc(sizeof *p + b->count * sizeof p->instructions[0]);
    if (p == NULL) return IMP_STATUS_INTERNAL;
    p->variables = variables;
    if (write_instructions(b, out, a, p)) return *program = p, IMP_STATUS_OK;
    free(p);
    error->at = EXPRESSION_AT_ALL;
    snprintf(error->message, sizeof error->message,
             "x, y and z have more than %d common parts to be kept at once", EXPRESSION_SLOTS_MAX);
    return IMP_STATUS_PARAMETER;
}

/* Finds what the texts are besides, and what their section computes. */
static bool find_form(builder *b, const uint16_t out[3], text_form *form, uint16_t section[3])
{
    form->kind = TEXT_PLAIN;
    if (coil_form_find(b, out, &form->coil)) {
        form->kind = TEXT_COIL;
        section[0] = section[1] = section[2] = form->coil.radius;
    } else if (turned_form_find(b, out, &form->turned)) {
        form->kind = TEXT_TURNED;
        section[0] = form->turned.radius;
        section[1] = form->turned.height;
        section[2] = form->turned.angle;
    }
    return form->kind != TEXT_PLAIN;
}

/* `form` may be NULL. */
static imp_status compile(const expression_scope *scope, const char *const text[3], builder *b,
                          allocation *a, expression_program **program, text_form *form,
                          expression_program **section, expression_error *error)
{
    const size_t variables = scope->variable_count;
    uint16_t out[3], of_section[3];
    if (!read_texts(scope, text, b, out, error)) return IMP_STATUS_PARAMETER;
    imp_status status = assemble(b, variables, out, a, program, error);
    if (status != IMP_STATUS_OK || form == NULL || !find_form(b, out, form, of_section))
        return status;
    status = assemble(b, variables, of_section, a, section, error);
    if (status == IMP_STATUS_OK) return status;
    expression_free(*program);
    *program = NULL;
    return status;
}

imp_status expression_compile_form(const expression_scope *scope, const char *const text[3],
                                   expression_program **program, text_form *form,
                                   expression_program **section, expression_error *error)
{
    assert(scope->variable_count > 0 && scope->variable_count <= EXPRESSION_VARIABLES_MAX);
    imp_status status = IMP_STATUS_INTERNAL;
    builder *b = malloc(sizeof *b);
    allocation *a = malloc(sizeof *a);
    if (section != NULL) *section = NULL;
    if (a != NULL && b != NULL) status = compile(scope, text, b, a, program, form, section, error);
    free(a);
    free(b);
    return status;
}

imp_status expression_compile(const expression_scope *scope, const char *const text[3],
                              expression_program **program, expression_error *error)
{
    return expression_compile_form(scope, text, program, NULL, NULL, error);
}

/* --- Running ---------------------------------------------------------------------------------- */

/* False: undefined, whatever the variables are. */
static bool run_models(const expression_program *p, imp_model slot[])
{
    for (size_t i = 0; i < p->length; ++i) {
        const instruction *now = &p->instructions[i];
        if (operation_is_undefined(&now->o, slot)) return false;
        slot[now->to] = operation_model(&now->o, slot);
    }
    return true;
}

void expression_models(const expression_program *p, const imp_model *variables, imp_model out[3])
{
    imp_model slot[EXPRESSION_SLOTS_MAX];
    uint32_t depends = 0;
    memcpy(slot, variables, p->variables * sizeof slot[0]);
    for (size_t k = 0; k < p->variables; ++k) depends |= variables[k].depends;
    bool defined = run_models(p, slot);
    for (int i = 0; i < 3; ++i) out[i] = defined ? slot[p->out[i]] : imp_unbounded(depends);
}

/* False: something on the way is infinite or unknown; models may know more. */
static bool run_points(const expression_program *p, near_constant slot[])
{
    for (size_t i = 0; i < p->length; ++i) {
        const instruction *now = &p->instructions[i];
        slot[now->to] = operation_point(&now->o, slot);
        if (!(slot[now->to].error < INFINITY)) return false;
    }
    return true;
}

static imp_status point_by_models(const expression_program *p, const double *variables,
                                  near_constant out[3])
{
    imp_model model[3], number[EXPRESSION_VARIABLES_MAX];
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < p->variables; ++k) number[k] = imp_num(variables[k]);
    expression_models(p, number, model);
    for (int i = 0; i < 3; ++i) {
        out[i] = near_of(model[i]);
        if (!(out[i].error < INFINITY)) status = IMP_STATUS_DOMAIN;
    }
    return status;
}

imp_status expression_point(const expression_program *p, const double *variables, double x[3],
                            double *error)
{
    near_constant slot[EXPRESSION_SLOTS_MAX], out[3];
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < p->variables; ++k) {
        if (!(variables[k] - variables[k] == 0)) return IMP_STATUS_DOMAIN;
        slot[k] = near_exact(variables[k]);
    }
    if (!run_points(p, slot))
        status = point_by_models(p, variables, out);
    else
        for (int i = 0; i < 3; ++i) out[i] = slot[p->out[i]];
    for (int i = 0; i < 3; ++i) {
        x[i] = out[i].value;
        if (error != NULL) error[i] = out[i].error;
    }
    return status;
}

imp_status expression_points(const expression_program *p, size_t n, const double *variables,
                             double *x, double *error)
{
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < n && status == IMP_STATUS_OK; ++k)
        status = expression_point(p, variables + p->variables * k, x + 3 * k,
                                  error != NULL ? error + 3 * k : NULL);
    return status;
}

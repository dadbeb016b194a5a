/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/renewal.h"

#include <fenv.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/capabilities.h"
#include "tools/check/argument_list.h"
#include "tools/check/heap_growth.h"
#include "tools/check/purity.h"
#include "tools/check/values.h"
#include "tools/cli/catalogue.h"

/* --- Changed values --------------------------------------------------------------------------- */

static bool is_allowed(const imp_parameter *row, double x)
{
    const bool above = row->flags & IMP_PARAMETER_MIN_OPEN ? x > row->min : x >= row->min;
    const bool below = row->flags & IMP_PARAMETER_MAX_OPEN ? x < row->max : x <= row->max;
    return above && below;
}

/* Puts other numbers of the same shapes in the place of those of numbers; the caller frees
 * *numbers. False: no memory. */
static bool change_values(const imp_type_info *type, imp_value *values, double **numbers)
{
    size_t count = 0;
    for (size_t k = 0; k < type->parameter_count; ++k) count += values[k].count;
    double *next = *numbers = malloc((count + 1) * sizeof *next);
    if (next == NULL) return false;
    for (size_t k = 0; k < type->parameter_count; ++k) {
        const imp_parameter *row = catalogue_parameter(type, k);
        if (row->kind != IMP_KIND_NUMBER || values[k].number == NULL) continue;
        for (size_t i = 0; i < values[k].count; ++i) {
            const double x = values[k].number[i], changed = 0.875 * x;
            next[i] = is_allowed(row, changed) ? changed : x;
        }
        values[k].number = next;
        next += values[k].count;
    }
    return true;
}

/* --- Calls ------------------------------------------------------------------------------------ */

enum { BEYOND = 0xA5 };

/* What is called, and where faults go. */
typedef struct renewal {
    const imp_instance *host; /* of the stage's values */
    const char *stage;
    check_answer *answer;
} renewal;

/* What create or renew tells, and what stands behind it. */
typedef struct told {
    imp_create_error why;
    unsigned char beyond[64];
} told;

static void told_begin(told *t)
{
    t->why = (imp_create_error){.struct_size = sizeof t->why, .parameter = -1, .element = -1};
    memset(t->beyond, BEYOND, sizeof t->beyond);
}

static bool told_is_kept(const told *t)
{
    for (size_t k = 0; k < sizeof t->beyond; ++k)
        if (t->beyond[k] != BEYOND) return false;
    return true;
}

static imp_status create_from(const renewal *r, const imp_value *values, imp_instance *made,
                              told *t)
{
    told_begin(t);
    *made = *r->host;
    made->self = NULL; /* the host's is destroyed once */
    subject_note_stage(r->answer, "create", r->stage);
    const imp_status status = made->surface != NULL
                                  ? made->surface->create(values, &made->self, &t->why)
                                  : made->map->create(values, &made->self, &t->why);
    subject_note_stage(r->answer, NULL, NULL);
    return status;
}

static imp_status call_renew(const imp_value *values, const imp_instance *i, told *t)
{
    told_begin(t);
    return i->surface != NULL ? i->surface->renew(i->self, values, &t->why)
                              : i->map->renew(i->self, values, &t->why);
}

/* False, and the answer fails: the call broke a rule that its status does not show. */
static bool renew_from(const renewal *r, const imp_value *values, const imp_instance *i, told *t,
                       imp_status *status)
{
    const int rounding = fegetround();
    subject_note_stage(r->answer, "renew", r->stage);
    *status = call_renew(values, i, t);
    subject_note_stage(r->answer, NULL, NULL);
    if (fegetround() != rounding) {
        fesetround(rounding);
        return answer_fail(r->answer, "renew changes the rounding mode");
    }
    return told_is_kept(t) ||
           answer_fail(r->answer, "renew wrote beyond the imp_create_error it was given");
}

static void destroy(const renewal *r, imp_instance *i)
{
    if (i->self != NULL) subject_destroy(i, r->stage, r->answer);
    i->self = NULL;
}

/* --- Comparing -------------------------------------------------------------------------------- */

enum { PIECES_COMPARED = 8 };

static bool are_alike(const renewal *r, const imp_instance *renewed, const imp_instance *made)
{
    const size_t count = subject_piece_count(renewed, r->answer);
    const size_t expected = subject_piece_count(made, r->answer);
    if (count != expected)
        return answer_fail(r->answer, "an instance refilled by renew has %zu pieces, a new one %zu",
                           count, expected);
    for (size_t k = 0; k < (count > 0 ? count : 1) && k < PIECES_COMPARED; ++k) {
        subject x, y;
        uint64_t random = draw_stream(1, "renewal", r->stage);
        if (!subject_make(&x, renewed, renewed, k, r->answer)) return false;
        if (!subject_make(&y, made, made, k, r->answer)) return false;
        if (memcmp(&x.domain, &y.domain, sizeof x.domain) != 0 ||
            memcmp(x.ends, y.ends, sizeof x.ends) != 0)
            return answer_fail(r->answer,
                               "the domains of an instance refilled by renew and of a new one "
                               "differ");
        if (!purity_are_alike(&x, &y, &random,
                              "between an instance refilled by renew and a new one"))
            return false;
    }
    return true;
}

static bool notes_are_alike(const renewal *r, const told *renewed, const told *made)
{
    const imp_create_error *x = &renewed->why, *y = &made->why;
    if (x->note_count == y->note_count &&
        (x->note_count == 0 ||
         (x->note_parameter == y->note_parameter && strcmp(x->note, y->note) == 0)))
        return true;
    return answer_fail(r->answer, "renew notes '%.80s', and create '%.80s'",
                       x->note_count > 0 ? x->note : "", y->note_count > 0 ? y->note : "");
}

/* --- Memory ----------------------------------------------------------------------------------- */

typedef struct again {
    const imp_value *values;
    const imp_instance *instance;
} again;

static bool renew_again(const void *of)
{
    const again *a = of;
    told t;
    return call_renew(a->values, a->instance, &t) == IMP_STATUS_OK;
}

enum { ROUNDS = 64 };

static bool is_let_go(const renewal *r, const imp_value *values, const imp_instance *i)
{
    const again a = {values, i};
    subject_note_stage(r->answer, "renew", r->stage);
    const double grown = heap_growth_lower(renew_again, &a, ROUNDS);
    subject_note_stage(r->answer, NULL, NULL);
    return grown < HEAP_BLOCK_LEAST * ROUNDS ||
           answer_fail(r->answer, "%d calls of renew leak %.0f bytes", ROUNDS, grown);
}

/* --- The check -------------------------------------------------------------------------------- */

/* Compares *i, refilled from these values, with a new one. */
static bool is_like_new(const renewal *r, const imp_value *values, const imp_instance *i,
                        const told *renewed)
{
    imp_instance fresh;
    told made;
    if (create_from(r, values, &fresh, &made) != IMP_STATUS_OK)
        return answer_fail(r->answer, "renew accepts values that create refuses");
    const bool alike = notes_are_alike(r, renewed, &made) && are_alike(r, i, &fresh);
    destroy(r, &fresh);
    return alike;
}

/* Refills *i from changed values, if it takes them; else *i is made anew of the stage's. */
static bool renew_changed(const renewal *r, const imp_type_info *type, const imp_value *values,
                          imp_instance *i)
{
    const size_t size = type->parameter_count * sizeof *values;
    imp_value *changed = malloc(size + 1);
    double *numbers = NULL;
    bool alike = false;
    imp_status status;
    told t;
    if (changed != NULL) memcpy(changed, values, size);
    if (changed == NULL || !change_values(type, changed, &numbers)) {
        answer_skip(r->answer, "the arguments could not be created");
    } else if (renew_from(r, changed, i, &t, &status)) {
        if (status == IMP_STATUS_OK) {
            alike = is_like_new(r, changed, i, &t);
        } else {
            destroy(r, i);
            alike = create_from(r, values, i, &t) == IMP_STATUS_OK;
        }
    }
    free(changed);
    free(numbers);
    return alike;
}

static void check(const renewal *r, const imp_type_info *type, arguments_list *list)
{
    const imp_value *values = arguments_list_values(list);
    imp_instance made;
    imp_status status;
    told first, second;
    if (create_from(r, values, &made, &first) != IMP_STATUS_OK) {
        answer_fail(r->answer, "create refuses arguments that it accepted before");
        return;
    }
    if (renew_changed(r, type, values, &made) && renew_from(r, values, &made, &second, &status)) {
        const bool is_let_go_of = status != IMP_STATUS_OK || is_let_go(r, values, &made);
        arguments_list_hide(list);
        if (status != IMP_STATUS_OK)
            answer_pass(r->answer, "renew does not take these values, and create does");
        else if (is_let_go_of && notes_are_alike(r, &second, &first) &&
                 are_alike(r, &made, r->host))
            answer_pass(r->answer, "an instance that renew refills answers like a new one");
    }
    destroy(r, &made);
}

void renewal_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                   check_answer *answer)
{
    arguments_list list;
    imp_instance host;
    imp_error error;
    if (subject_create(registry, type->kind, stage, &host, &error, answer) != IMP_SUCCESS) {
        answer_fail(answer, "'%.300s' does not work: %s", stage, error.text);
        return;
    }
    if (surface_type_offers(host.surface, CAPABILITY_RENEW) ||
        map_type_offers(host.map, CAPABILITY_RENEW)) {
        json_t *given = stage_values(registry, type->kind, stage);
        const renewal r = {&host, stage, answer};
        if (arguments_list_make(&list, type, given))
            check(&r, type, &list);
        else
            answer_skip(answer, "the arguments could not be created");
        json_decref(given);
        arguments_list_free(&list);
    } else {
        answer_skip(answer, "it has no renew");
    }
    subject_destroy(&host, stage, answer);
}

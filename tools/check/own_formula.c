/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/own_formula.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"

enum { PARTS_MOST = 1 << 16 };

/* --- Its text --------------------------------------------------------------------------------- */

static void add(const imp_text_sink *sink, const char *text, size_t size)
{
    fwrite(text, 1, size, sink->host);
}

static imp_status print(const imp_instance *i, const imp_text_sink *to, check_answer *answer)
{
    const imp_surface_type *surface = i->surface;
    const imp_map_type *map = i->map;
    const bool writes =
        surface != NULL ? IMP_OFFERS(surface, write_formula) : IMP_OFFERS(map, write_formula);
    const char *text = surface != NULL ? IMP_OFFERS(surface, formula) ? surface->formula : NULL
                       : IMP_OFFERS(map, formula) ? map->formula
                                                  : NULL;
    if (!writes && text == NULL) return IMP_STATUS_UNBOUNDED;
    if (!writes) {
        to->add(to, text, strlen(text));
        return IMP_STATUS_OK;
    }
    subject_note_call(answer, "write_formula", NULL);
    const imp_status status =
        surface != NULL ? surface->write_formula(i->self, to) : map->write_formula(i->self, to);
    answer->call.name = NULL;
    return status;
}

/* NULL: it states nothing, or *fault is set. Free it. */
static char *text_of(const imp_instance *i, check_answer *answer, char *fault, size_t size)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out == NULL) return NULL;
    const imp_text_sink to = {.struct_size = sizeof to, .host = out, .add = add};
    const imp_status status = print(i, &to, answer);
    const bool whole = fclose(out) == 0;
    if (whole && status == IMP_STATUS_OK) return text;
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED)
        snprintf(fault, size, "write_formula answers %s", subject_status_name(status));
    free(text);
    return NULL;
}

/* --- Its parts -------------------------------------------------------------------------------- */

static bool add_part(own_formula *f, const stated_scope *scope, const char *text, char *fault,
                     size_t size)
{
    own_part *grown = array_reserve(f->parts, f->count, &f->capacity, sizeof *grown);
    if (grown == NULL) {
        snprintf(fault, size, "memory ran out");
        return false;
    }
    f->parts = grown;
    own_part *part = &f->parts[f->count];
    part->f = stated_scope_read(scope, text, part->range, fault, size);
    f->count += part->f != NULL;
    return part->f != NULL;
}

own_formula own_formula_read(const imp_registry *registry, const imp_type_info *type,
                             const char *stage, const imp_instance *instance, check_answer *answer,
                             char *fault, size_t size)
{
    own_formula f = {.count = 0};
    fault[0] = '\0';
    char *text = text_of(instance, answer, fault, size);
    stated_scope *scope = text != NULL ? stated_scope_new(registry, type, stage) : NULL;
    for (const char *at = text; scope != NULL && at != NULL; at = formula_next_part(at))
        if (f.count == PARTS_MOST || !add_part(&f, scope, at, fault, size)) break;
    stated_scope_free(scope);
    free(text);
    if (fault[0] != '\0') own_formula_free(&f);
    return f;
}

void own_formula_free(own_formula *f)
{
    for (size_t k = 0; k < f->count; ++k) formula_free(f->parts[k].f);
    free(f->parts);
    *f = (own_formula){.count = 0};
}

#define END_ULPS 4

long double own_end_slack(double size) { return END_ULPS * DBL_EPSILON * (long double)size; }

bool own_range_holds(const formula_range *range, double x, double size)
{
    const long double slack = own_end_slack(size);
    return !range->is_said || (x >= range->lo.lo - slack && x <= range->hi.hi + slack);
}

box own_part_box(const own_part *part, const subject *s)
{
    box b = s->domain;
    for (int j = 0; j < s->n; ++j) {
        if (!part->range[j].is_said) continue;
        b.lo[j] = fmin(fmax(b.lo[j], (double)part->range[j].lo.lo), s->domain.hi[j]);
        b.hi[j] = fmax(fmin(b.hi[j], (double)part->range[j].hi.hi), b.lo[j]);
    }
    return b;
}

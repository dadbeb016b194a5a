/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "surface.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "status.h"
#include "surface_parts.h"
#include "text.h"

/* Appends the text, or dots in its place: at the end of a label that is full. */
static void label_add(surface *s, const char *text)
{
    static const char dots[] = " ...";
    const size_t used = strlen(s->label), more = strlen(text);
    if (used + more + sizeof dots <= sizeof s->label)
        memcpy(s->label + used, text, more + 1);
    else if (used < sizeof dots || strcmp(s->label + used - (sizeof dots - 1), dots) != 0)
        memcpy(s->label + used, dots, sizeof dots);
}

/* Domains are asked for once; one that is not finite in u and v, inverted or NaN is a breach. */
static void take_domain(surface *s)
{
    const fp_mode mode = fp_mode_read();
    in_call_begin(s->type->name, "domain");
    s->type->domain(s->self, s->lo, s->hi);
    bool good = s->lo[0] > -INFINITY && s->lo[1] > -INFINITY;
    good = good && s->hi[0] < INFINITY && s->hi[1] < INFINITY;
    for (int j = 0; j < 3; ++j) good = good && s->lo[j] <= s->hi[j];
    s->breach = surface_guarded(mode, good ? IMP_OK : SURFACE_BAD_DOMAIN);
}

static void take_times(surface *s, const mapping *map)
{
    double start = -INFINITY, end = INFINITY;
    const fp_mode mode = fp_mode_read();
    in_call_begin(map->type->name, "time_domain");
    map->type->time_domain(map->self, &start, &end);
    s->breach = surface_guarded(mode, start <= end ? IMP_OK : SURFACE_BAD_DOMAIN);
    if (start > s->lo[2]) s->lo[2] = start;
    if (end < s->hi[2]) s->hi[2] = end;
}

/* What destroy does to the floating-point mode is undone. */
static void destroy(const char *type, void (*destroy_it)(void *), void *self)
{
    const fp_mode mode = fp_mode_read();
    in_call_begin(type, "destroy");
    destroy_it(self);
    surface_guarded(mode, IMP_OK);
}

surface *surface_new(const imp_surface_type *type, void *self)
{
    surface *s = malloc(sizeof *s);
    if (s == NULL) {
        destroy(type->name, type->destroy, self);
        return NULL;
    }
    *s = (surface){.type = type, .self = self};
    label_add(s, type->name);
    take_domain(s);
    return s;
}

imp_code surface_add_map(surface *s, const imp_map_type *type, void *self)
{
    mapping *maps = realloc(s->maps, (s->map_count + 1) * sizeof *maps);
    if (maps == NULL) {
        destroy(type->name, type->destroy, self);
        return IMP_ERROR_MEMORY;
    }
    s->maps = maps;
    maps[s->map_count] = (mapping){type, self};
    label_add(s, " ! ");
    label_add(s, type->name);
    take_times(s, &maps[s->map_count++]);
    return IMP_SUCCESS;
}

void surface_add_label(surface *s, const char *text) { label_add(s, text); }

void surface_free(surface *s)
{
    if (s == NULL) return;
    for (size_t k = 0; k < s->map_count; ++k)
        destroy(s->maps[k].type->name, s->maps[k].type->destroy, s->maps[k].self);
    free(s->maps);
    destroy(s->type->name, s->type->destroy, s->self);
    free(s);
}

const char *surface_label(const surface *s) { return s->label; }

void surface_set_body(surface *s, const char *body, size_t index)
{
    s->body = body;
    s->index = index;
}

imp_code surface_fault(const surface *s, imp_error *error, const char *format, ...)
{
    if (error == NULL) return IMP_ERROR_PLUGIN;
    char what[sizeof error->text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    error_set(error, IMP_ERROR_PLUGIN, "type '%s'%s%s", s->label, what[0] == ':' ? "" : " ", what);
    if (s->body != NULL) error_prefix(error, "body '%.80s', surface %zu", s->body, s->index);
    text_clean(error->text);
    return IMP_ERROR_PLUGIN;
}

imp_status surface_breach(const surface *s) { return s->breach; }

void surface_domain(const surface *s, double lo[3], double hi[3])
{
    memcpy(lo, s->lo, sizeof s->lo);
    memcpy(hi, s->hi, sizeof s->hi);
}

const char *surface_status_text(imp_status status)
{
    switch (status) {
    case IMP_DOMAIN:
        return "is undefined there, or too large for a double, though that lies in its domain; "
               "shrink the domain, or the times asked for, to where it (and each map on it) is "
               "defined";
    case IMP_UNBOUNDED:
        return "has no bounds there";
    case IMP_INTERNAL:
        return "reports an internal error";
    case SURFACE_CHANGED_MODE:
        return "changes the floating-point mode of its caller, which breaks every bound";
    case SURFACE_BAD_DOMAIN:
        return "has a domain that is empty, NaN, or infinite in u or v";
    case SURFACE_BAD_RATES:
        return "a rate is negative, infinite or NaN";
    case SURFACE_BAD_MODEL:
        return "a remainder is negative or NaN, a range inverted or NaN, or a rate negative or NaN";
    case SURFACE_CRASHED:
        return "crashes or ends its process, in which it runs isolated";
    case SURFACE_HUNG:
        return "does not answer within 5 s; it ran isolated, and its process was ended";
    default:
        return "answers a status that does not exist here";
    }
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/formula_text.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <impinge/formula_text.h>

#include "core/common/array.h"
#include "core/surface/clocked.h"
#include "core/surface/surface_internal.h"

/* --- A text that grows ------------------------------------------------------------------------ */

/* A callback may print at most this many bytes. */
#define TEXT_MAX ((size_t)1 << 30)

typedef struct text_buffer {
    char *at;
    size_t length, capacity;
    bool is_full;  /* no memory */
    bool is_wrong; /* a character was added that is neither printable nor a line end */
} text_buffer;

static void add(const imp_text_sink *sink, const char *text, size_t size)
{
    text_buffer *b = sink->host;
    for (size_t k = 0; k < size; ++k)
        b->is_wrong |= !(text[k] == '\n' || (text[k] >= ' ' && text[k] <= '~'));
    while (!b->is_full && (b->at == NULL || b->capacity - b->length <= size)) {
        char *grown = b->length + size < TEXT_MAX
                          ? array_reserve(b->at, b->length + size, &b->capacity, 1)
                          : NULL;
        b->is_full = grown == NULL;
        if (grown != NULL) b->at = grown;
    }
    if (b->is_full) return;
    memcpy(b->at + b->length, text, size);
    b->length += size;
    b->at[b->length] = '\0';
}

static imp_text_sink sink_of(text_buffer *b)
{
    return (imp_text_sink){.struct_size = sizeof(imp_text_sink), .host = b, .add = add};
}

/* --- Binding numbers -------------------------------------------------------------------------- */

static bool is_of_word(char c) { return isalnum((unsigned char)c) || c == '_'; }

/* Whether the part, of `length` characters, uses the name and does not define it: a definition
 * precedes all uses. A word that begins with a digit or a point is a number. */
static bool uses(const char *part, size_t length, const char *name, size_t name_length)
{
    for (size_t k = 0; k < length;) {
        const size_t from = k;
        while (k < length && (is_of_word(part[k]) || part[k] == '.')) ++k;
        if (k - from == name_length && memcmp(part + from, name, name_length) == 0)
            return part[k + strspn(part + k, " \n")] != '=';
        if (k == from) ++k;
    }
    return false;
}

/* Defines the numbers of one row that the part uses. */
static void bind_row(const imp_text_sink *to, const char *part, size_t length,
                     const imp_parameter *row, const double *number, size_t count)
{
    char name[96];
    for (size_t i = 0; i < count; ++i) {
        const int written = row->rank == 0 ? snprintf(name, sizeof name, "%s", row->name)
                                           : snprintf(name, sizeof name, "%s%zu", row->name, i);
        if (!isnan(number[i]) && written > 0 && uses(part, length, name, (size_t)written))
            imp_define(to, name, number[i]);
    }
}

static void bind_part(const imp_text_sink *to, const fixed_numbers *numbers, const char *part,
                      size_t length)
{
    const double *number = numbers->number;
    for (size_t k = 0; k < numbers->row_count; ++k) {
        const imp_parameter *row = fixed_numbers_row(numbers, k);
        const size_t count = fixed_numbers_of_row(row);
        bind_row(to, part, length, row, number, count);
        number += count;
    }
    to->add(to, part, length);
}

/* The text with the numbers bound, part for part. */
static void bind(text_buffer *out, const fixed_numbers *numbers, const char *text)
{
    const imp_text_sink to = sink_of(out);
    for (;;) {
        const size_t blank = strspn(text, " \n"), length = strcspn(text + blank, "|");
        bind_part(&to, numbers, text + blank, length);
        text += blank + length;
        if (*text == '\0') return;
        imp_add_text(&to, "| ");
        ++text;
    }
}

/* --- Callbacks -------------------------------------------------------------------------------- */

/* The two members of the type, or NULL. */
typedef struct statement {
    const char *type, *formula;
    imp_status (*write_formula)(const void *self, const imp_text_sink *to);
} statement;

#define STATEMENT_OF(TYPE)                                                                         \
    {                                                                                              \
        (TYPE)->name, IMP_OFFERS(TYPE, formula) ? (TYPE)->formula : NULL,                          \
            IMP_OFFERS(TYPE, write_formula) ? (TYPE)->write_formula : NULL                         \
    }

static statement statement_of(const shared_instance *origin)
{
    if (origin->surface != NULL) return (statement)STATEMENT_OF(origin->surface);
    return (statement)STATEMENT_OF(origin->map);
}

/* Appends the formula of the instance, or of its piece, as the type gives it. */
static imp_status add_formula(const shared_instance *origin, const void *self, text_buffer *raw)
{
    const imp_text_sink to = sink_of(raw);
    const statement from = statement_of(origin);
    if (from.write_formula != NULL) {
        const surface_call call = surface_call_begin(from.type, "write_formula");
        return surface_call_end(call, from.write_formula(self, &to));
    }
    if (from.formula == NULL || origin->piece_count > 0) return IMP_STATUS_UNBOUNDED;
    imp_add_text(&to, from.formula);
    return IMP_STATUS_OK;
}

static imp_status write_formula(const shared_instance *origin, const void *self, char **text)
{
    text_buffer raw = {.at = NULL}, closed = raw;
    *text = NULL;
    imp_status status = add_formula(origin, self, &raw);
    if (status == IMP_STATUS_OK && raw.is_full) status = SURFACE_NO_MEMORY;
    if (status == IMP_STATUS_OK && (raw.is_wrong || raw.length == 0)) status = SURFACE_BAD_FORMULA;
    if (status == IMP_STATUS_OK) bind(&closed, &origin->numbers, raw.at);
    if (status == IMP_STATUS_OK && closed.is_full) status = SURFACE_NO_MEMORY;
    if (status == IMP_STATUS_OK) *text = closed.at;
    if (*text == NULL) free(closed.at);
    free(raw.at);
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

imp_status surface_formula(const surface *s, size_t k, char **text)
{
    const shared_instance *origin = surface_origin(s, k);
    return write_formula(origin, k == 0 ? s->self : origin->self, text);
}

imp_status surface_own_formula(const surface *s, size_t k, char **text)
{
    const shared_instance *inner = surface_origin(s, k)->inner;
    return write_formula(inner, k == 0 ? clocked_self(s->self) : inner->self, text);
}

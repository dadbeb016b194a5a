/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/json_quick.h"

#include <string.h>

#include <impinge/decimal.h>

#include "core/common/json_size.h"

enum {
    DEPTH_MAX = 64, /* arrays and objects within each other; more are left to jansson */
    KEY_MAX = 64,   /* bytes of a key, including the final NUL */
    PART = 4096     /* bytes of text whose values are counted at once */
};

typedef struct quick_reader {
    const char *at, *end; /* what is left of the text */
    const char *counted;  /* values before this are in the budget */
    reading_budget *budget;
    int depth;
    json_quick_end ended; /* JSON_QUICK_DONE: it goes on */
} quick_reader;

static json_t *read_value(quick_reader *r);

static json_t *stop(quick_reader *r, json_quick_end why)
{
    if (r->ended == JSON_QUICK_DONE) r->ended = why;
    return NULL;
}

/* The value, or the end of the reading if there was no memory for it. */
static json_t *made(quick_reader *r, json_t *value)
{
    return value != NULL ? value : stop(r, JSON_QUICK_NO_MEMORY);
}

/* --- Tokens ----------------------------------------------------------------------------------- */

static void skip_blanks(quick_reader *r)
{
    while (r->at < r->end && (unsigned char)*r->at <= ' ' &&
           (*r->at == ' ' || *r->at == '\n' || *r->at == '\r' || *r->at == '\t'))
        ++r->at;
}

/* Takes the character if it is next, behind blanks. */
static bool take(quick_reader *r, char c)
{
    skip_blanks(r);
    if (r->at == r->end || *r->at != c) return false;
    ++r->at;
    return true;
}

/* A string, behind its quotation mark, without escapes. False: it is none. */
static bool take_string(quick_reader *r, const char **text, size_t *length)
{
    const char *at = r->at;
    while (at < r->end && *at != '"' && *at != '\\' && (unsigned char)*at >= ' ') ++at;
    if (at == r->end || *at != '"') return false;
    *text = r->at;
    *length = (size_t)(at - r->at);
    r->at = at + 1;
    return true;
}

/* The grammar of JSON has no plus sign, no zeros in front, and digits on both sides of a point. */
static bool is_of_json(const char *text, const imp_decimal *d)
{
    const bool has_zeros = d->before > 1 && text[d->minus] == '0';
    return !d->plus && d->before > 0 && !has_zeros && (!d->has_point || d->behind > 0);
}

static json_t *read_number(quick_reader *r)
{
    imp_decimal d = {.fits = false};
    double x;
    const char *const text = r->at, *const end = imp_decimal_scan(text, r->end, &d);
    if (end == NULL || !is_of_json(text, &d)) return stop(r, JSON_QUICK_LEFT);
    if (!imp_decimal_value(&d, &x) && !imp_decimal_by_strtod(text, (size_t)(end - text), &x))
        return stop(r, JSON_QUICK_LEFT);
    r->at = end;
    return made(r, json_real(x));
}

static json_t *read_word(quick_reader *r, const char *word, json_t *value)
{
    const size_t length = strlen(word);
    if ((size_t)(r->end - r->at) < length || memcmp(r->at, word, length) != 0)
        return stop(r, JSON_QUICK_LEFT);
    r->at += length;
    return value;
}

static bool is_ascii(const char *text, size_t length)
{
    for (size_t k = 0; k < length; ++k)
        if ((unsigned char)text[k] >= 0x80) return false;
    return true;
}

/* Leaves to jansson what is not UTF-8. */
static json_t *read_string(quick_reader *r)
{
    const char *text;
    size_t length;
    if (!take_string(r, &text, &length)) return stop(r, JSON_QUICK_LEFT);
    if (is_ascii(text, length)) return made(r, json_stringn_nocheck(text, length));
    json_t *value = json_stringn(text, length);
    return value != NULL ? value : stop(r, JSON_QUICK_LEFT);
}

/* --- Arrays and objects ----------------------------------------------------------------------- */

static json_t *read_array(quick_reader *r)
{
    json_t *array = made(r, json_array());
    if (array == NULL || take(r, ']')) return array;
    do {
        json_t *value = read_value(r);
        if (value == NULL) break;
        if (json_array_append_new(array, value) != 0) stop(r, JSON_QUICK_NO_MEMORY);
    } while (r->ended == JSON_QUICK_DONE && take(r, ','));
    if (r->ended == JSON_QUICK_DONE && take(r, ']')) return array;
    json_decref(array);
    return stop(r, JSON_QUICK_LEFT);
}

/* Copies a key of ASCII, which ends in a colon. False: it is left to jansson. */
static bool take_key(quick_reader *r, char key[KEY_MAX])
{
    const char *text;
    size_t length;
    if (!take(r, '"') || !take_string(r, &text, &length) || length >= KEY_MAX) return false;
    if (!is_ascii(text, length)) return false;
    memcpy(key, text, length);
    key[length] = '\0';
    return take(r, ':');
}

/* False: the member is left to jansson, such as one whose key is there already, or the reading has
 * ended. */
static bool read_member(quick_reader *r, json_t *object)
{
    char key[KEY_MAX];
    const size_t before = json_object_size(object);
    if (!take_key(r, key)) return false;
    json_t *value = read_value(r);
    if (value == NULL) return false;
    if (json_object_set_new_nocheck(object, key, value) != 0) stop(r, JSON_QUICK_NO_MEMORY);
    return json_object_size(object) > before;
}

static json_t *read_object(quick_reader *r)
{
    json_t *object = made(r, json_object());
    if (object == NULL || take(r, '}')) return object;
    do {
        if (!read_member(r, object)) stop(r, JSON_QUICK_LEFT);
    } while (r->ended == JSON_QUICK_DONE && take(r, ','));
    if (r->ended == JSON_QUICK_DONE && take(r, '}')) return object;
    json_decref(object);
    return stop(r, JSON_QUICK_LEFT);
}

/* --- Values ----------------------------------------------------------------------------------- */

/* Counts the values of the text's next part. False: the budget is over. */
static bool count_part(quick_reader *r)
{
    const size_t rest = (size_t)(r->end - r->counted), n = rest < PART ? rest : PART;
    if (r->budget->limits.bytes > 0)
        reading_budget_take(r->budget, json_size_parsed(r->counted, n));
    r->counted += n;
    return reading_budget_allows(r->budget, 0);
}

static json_t *read_nested(quick_reader *r, json_t *(*read)(quick_reader *))
{
    if (r->depth == DEPTH_MAX) return stop(r, JSON_QUICK_LEFT);
    ++r->at;
    ++r->depth;
    json_t *value = read(r);
    --r->depth;
    return value;
}

static json_t *read_value(quick_reader *r)
{
    skip_blanks(r);
    if (r->at == r->end) return stop(r, JSON_QUICK_LEFT);
    while (r->at >= r->counted)
        if (!count_part(r)) return stop(r, JSON_QUICK_LIMIT);
    switch (*r->at) {
    case '{':
        return read_nested(r, read_object);
    case '[':
        return read_nested(r, read_array);
    case '"':
        ++r->at;
        return read_string(r);
    case 't':
        return read_word(r, "true", json_true());
    case 'f':
        return read_word(r, "false", json_false());
    case 'n':
        return read_word(r, "null", json_null());
    default:
        return read_number(r);
    }
}

json_t *json_quick_parse(const char *text, size_t length, reading_budget *budget,
                         json_quick_end *end)
{
    const uint64_t before = budget->bytes;
    quick_reader r = {.at = text, .end = text + length, .counted = text, .budget = budget};
    skip_blanks(&r);
    const bool is_whole = r.at < r.end && (*r.at == '{' || *r.at == '[');
    json_t *value = is_whole ? read_value(&r) : stop(&r, JSON_QUICK_LEFT);
    skip_blanks(&r);
    if (value != NULL && r.at < r.end) {
        json_decref(value);
        value = stop(&r, JSON_QUICK_LEFT);
    }
    if (r.ended == JSON_QUICK_LEFT) budget->bytes = before;
    *end = r.ended;
    return value;
}

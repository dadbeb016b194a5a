/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_text.h"

#include <impinge/decimal.h>

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/* Whether c is certainly part of a word, which one comparison tells of nearly all that are. */
static bool is_above_blanks(char c) { return (unsigned char)c > ' '; }

static bool is_end(char c) { return c == '\n' || c == '\r'; }

/* --- Lines ------------------------------------------------------------------------------------ */

/* Room for more behind `used` characters. False: no memory. */
static bool grow(mesh_text *text, size_t used)
{
    const size_t wanted = 2 * (used + 64);
    char *grown = realloc(text->words, wanted);
    if (grown == NULL) return false;
    text->words = grown;
    text->capacity = wanted;
    return true;
}

/* Goes on behind the end of a line, at which, or at the file's, text->at is: "\n", "\r\n" or
 * "\r". */
static void pass_end(mesh_text *text)
{
    if (text->end - text->at > 1 && text->at[0] == '\r' && text->at[1] == '\n') text->at += 1;
    if (text->at < text->end) text->at += 1;
    text->line += 1;
}

/* Returns the end of the line, if it is near and the line has neither comment nor NUL nor '\r';
 * else NULL. */
static const char *end_of_plain_line(const char *at, const char *end)
{
    enum { NEAR = 256 }; /* characters: searched once for each line, if it has no end */
    const char *stop = memchr(at, '\n', end - at < NEAR ? (size_t)(end - at) : NEAR);
    const size_t length = stop != NULL ? (size_t)(stop - at) : 0;
    if (stop == NULL || memchr(at, '#', length) != NULL) return NULL;
    return memchr(at, '\r', length) == NULL && memchr(at, '\0', length) == NULL ? stop : NULL;
}

/* Appends a line that end_of_plain_line found. False: no memory. */
static bool append_plain_line(mesh_text *text, const char *stop, size_t *used)
{
    const size_t length = (size_t)(stop - text->at);
    if (*used + length + 2 > text->capacity && !grow(text, *used + length)) return false;
    memcpy(text->words + *used, text->at, length);
    *used += length;
    text->at = stop + 1;
    text->line += 1;
    return true;
}

/* Appends one line of the file, without comment and end, and leaves room for two more; false: no
 * memory. A NUL ends no line: it makes a word that is none. */
static bool append_line(mesh_text *text, size_t *used)
{
    const char *at = text->at, *const end = text->end, *const stop = end_of_plain_line(at, end);
    size_t n = *used;
    if (stop != NULL) return append_plain_line(text, stop, used);
    for (;;) {
        if (n + 3 > text->capacity && !grow(text, n)) return false;
        char *const words = text->words;
        const size_t most = text->capacity - 2;
        while (at < end && n<most && * at> '#') words[n++] = *at++; /* none of them is special */
        if (at == end || is_end(*at)) break;
        if (*at == '#')
            while (at < end && !is_end(*at)) ++at;
        else if (n < most)
            words[n++] = (char)(*at != '\0' ? *at : '\1'), ++at;
    }
    text->at = at;
    *used = n;
    pass_end(text);
    return true;
}

/* Takes off the backslash behind which the line goes on. */
static bool take_backslash(const mesh_text *text, size_t from, size_t *used)
{
    if (*used == from || text->words[*used - 1] != '\\') return false;
    *used -= 1;
    return true;
}

bool mesh_text_line(mesh_text *text, bool continues)
{
    while (text->at < text->end) {
        size_t used = 0;
        bool more = true;
        while (more && text->at < text->end) {
            const size_t from = used;
            text->out_of_memory = !append_line(text, &used);
            if (text->out_of_memory) return false;
            more = continues && take_backslash(text, from, &used);
            text->words[used++] = ' ';
        }
        text->words[used] = '\0';
        text->next = text->words;
        while (is_blank(*text->next)) ++text->next;
        if (*text->next != '\0') return true;
    }
    return false;
}

char *mesh_text_word(mesh_text *text)
{
    char *word = text->next;
    while (is_blank(*word)) ++word;
    if (*word == '\0') return NULL;
    char *stop = word;
    while (is_above_blanks(*stop) || (*stop != '\0' && !is_blank(*stop))) ++stop;
    text->next = stop;
    if (*stop != '\0') {
        *stop = '\0';
        text->next = stop + 1;
    }
    return word;
}

/* --- Numbers ---------------------------------------------------------------------------------- */

bool mesh_text_number(const char *word, double *x)
{
    return imp_decimal_number(word, strlen(word), x);
}

enum { DIGITS_MAX = 15 }; /* of an integer */

bool mesh_text_integer(const char *word, int64_t *k)
{
    const bool minus = *word == '-';
    const char *const first = word + (minus || *word == '+'), *const end = first + strlen(first);
    uint64_t digits = 0;
    if (end == first || end - first > DIGITS_MAX) return false;
    if (imp_decimal_digits(first, end, &digits) != end) return false;
    *k = minus ? -(int64_t)digits : (int64_t)digits;
    return true;
}

imp_status mesh_text_point(mesh_text *text, double x[3], triangles_fault *fault)
{
    for (int i = 0; i < 3; ++i) {
        const char *word = mesh_text_word(text);
        if (word == NULL)
            return triangles_refuse(fault, text->line, "a point of %d numbers, must have 3", i);
        if (!mesh_text_number(word, &x[i]))
            return triangles_refuse(fault, text->line, "'%.40s' is not a finite number", word);
    }
    return IMP_STATUS_OK;
}

void mesh_text_clear(mesh_text *text) { free(text->words); }

imp_status mesh_text_status(const mesh_text *text)
{
    return text->out_of_memory ? IMP_STATUS_INTERNAL : IMP_STATUS_OK;
}

bool mesh_corners_add(mesh_corners *corners, int64_t k)
{
    if (corners->at == NULL || corners->count == corners->capacity) {
        const size_t wanted = corners->at == NULL ? 16 : 2 * corners->capacity;
        int64_t *grown = realloc(corners->at, wanted * sizeof *grown);
        if (grown == NULL) return false;
        corners->at = grown;
        corners->capacity = wanted;
    }
    corners->at[corners->count++] = k;
    return true;
}

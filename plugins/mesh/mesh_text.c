/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_text.h"

#include <locale.h>

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

static bool is_end(char c) { return c == '\n' || c == '\r'; }

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

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

/* Appends one line of the file, without comment and end, and leaves room for two more; false: no
 * memory. A NUL ends no line: it makes a word that is none. */
static bool append_line(mesh_text *text, size_t *used)
{
    const char *at = text->at, *const end = text->end;
    size_t n = *used;
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
    while (*stop != '\0' && !is_blank(*stop)) ++stop;
    text->next = stop;
    if (*stop != '\0') {
        *stop = '\0';
        text->next = stop + 1;
    }
    return word;
}

/* --- Numbers ---------------------------------------------------------------------------------- */

enum { NUMBER_MAX = 100, DIGITS_MAX = 15 };

/* Lemma. 15 digits are below 2^53, and so a double exactly; so is a power of ten up to 10^22: their
 * quotient, rounded once, is the nearest double, as strtod answers it. False: the word is anything
 * else. */
static bool read_short(const char *word, double *x)
{
    static const double power[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    const bool minus = *word == '-';
    int64_t all = 0;
    int digits = 0, behind = 0;
    bool is_behind = false;
    for (word += minus || *word == '+'; *word != '\0'; ++word) {
        if (*word == '.' && !is_behind) {
            is_behind = true;
            continue;
        }
        if (!is_digit(*word) || ++digits > DIGITS_MAX) return false;
        all = 10 * all + (*word - '0');
        behind += is_behind;
    }
    const double size = (double)all / power[behind];
    *x = minus ? -size : size;
    return digits > 0;
}

bool mesh_text_number(const char *word, double *x)
{
    char copy[NUMBER_MAX], *end;
    if (read_short(word, x)) return true;
    if (strlen(word) >= sizeof copy || word[strspn(word, "+-.0123456789eE")] != '\0') return false;
    strcpy(copy, word);
    char *point = strchr(copy, '.');
    if (point != NULL) *point = *localeconv()->decimal_point;
    *x = strtod(copy, &end);
    return end != copy && *end == '\0' && isfinite(*x);
}

bool mesh_text_integer(const char *word, int64_t *k)
{
    const bool minus = *word == '-';
    const char *digit = word + (minus || *word == '+'), *const first = digit;
    *k = 0;
    for (; is_digit(*digit) && digit - first < DIGITS_MAX; ++digit) *k = 10 * *k + (*digit - '0');
    if (minus) *k = -*k;
    return digit != first && *digit == '\0';
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

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/kernel/kernel.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { BODIES_MAX = 1 << 12, PIECES_MAX = 1 << 24, LONGEST = 1 << 24 };

bool bytes_refuse(bytes *in, const char *format, ...)
{
    if (!bytes_are_good(in)) return false;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(in->fault, sizeof in->fault, format, arguments);
    va_end(arguments);
    return false;
}

unsigned bytes_next(bytes *in)
{
    const int c = bytes_are_good(in) ? getc(in->file) : EOF;
    if (c == EOF) return bytes_refuse(in, "it ends too early, or cannot be read");
    ++in->at;
    if (in->copy != NULL) in->copy(in->context, (uint8_t)c);
    return (unsigned)c;
}

uint64_t bytes_count(bytes *in, uint64_t most)
{
    uint64_t n = 0;
    unsigned byte = 128;
    for (int shift = 0; shift < 56 && byte >= 128; shift += 7) {
        byte = bytes_next(in);
        n |= (uint64_t)(byte & 127) << shift;
    }
    return byte < 128 && n <= most ? n : bytes_refuse(in, "a number is too large");
}

char *bytes_line(bytes *in)
{
    size_t length = 0;
    void *list = NULL;
    while (bytes_grow(in, &list, length, 1)) {
        const unsigned c = bytes_next(in);
        char *line = list;
        if (c == '\n') return line; /* room that was made is 0 */
        if (bytes_are_good(in) && (c < ' ' || c > '~' || length == LONGEST))
            bytes_refuse(in, "a line is too long, or holds byte %u", c);
        line[length++] = (char)c;
    }
    free(list);
    return NULL;
}

const char *bytes_word(bytes *in, char **rest)
{
    const char *found = strsep(rest, " ");
    if (found == NULL || *found == '\0') bytes_refuse(in, "a line is too short");
    return found != NULL ? found : "";
}

double bytes_number(bytes *in, char **rest)
{
    const char *text = bytes_word(in, rest);
    char *end;
    const double x = strtod(text, &end);
    if (*end != '\0' || !(fabs(x) < INFINITY))
        bytes_refuse(in, "'%.40s' is no finite number", text);
    return bytes_are_good(in) ? x : 0;
}

uint64_t bytes_whole(bytes *in, char **rest, uint64_t below)
{
    const double x = bytes_number(in, rest);
    if (!(x >= 0 && x < (double)below && floor(x) == x)) bytes_refuse(in, "a count is too large");
    return bytes_are_good(in) ? (uint64_t)x : 0;
}

/* Lists have room for 2^k items, and double it when they are full. */
bool bytes_grow(bytes *in, void **list, size_t count, size_t size)
{
    const size_t wanted = count == 0 ? 1 : 2 * count;
    if (!bytes_are_good(in)) return false;
    if ((count & (count - 1)) != 0) return true;
    char *grown = wanted < SIZE_MAX / 2 / size ? realloc(*list, wanted * size) : NULL;
    if (grown == NULL) return bytes_refuse(in, "memory ran out");
    memset(grown + count * size, 0, (wanted - count) * size);
    *list = grown;
    return true;
}

/* Makes room for one more item of a list, and counts it; NULL: a fault. */
#define ADDED(IN, LIST, COUNT)                                                                     \
    (bytes_grow(IN, (void **)&(LIST), COUNT, sizeof *(LIST)) ? &(LIST)[(COUNT)++] : NULL)

/* Reads the parts of a piece: of a shape, with finite ranges of u and v; of a map, of t alone. */
static void read_piece(bytes *in, bool is_map, piece *p)
{
    char *line = bytes_line(in);
    const char *text = line, *why;
    while (text != NULL && bytes_are_good(in)) {
        range said[EXPRESSION_VARIABLES] = {{0, 0}};
        part *made = ADDED(in, p->parts, p->count);
        if (made == NULL) break;
        made->f = expression_read(&text, is_map ? "xyzt" : "uvt", said, &why);
        if (made->f == NULL) bytes_refuse(in, "%s", *line == '\0' ? "a type has no formula" : why);
        for (int j = 0; j < 2 + is_map; ++j) {
            const bool no_lo = said[j].lo == -INFINITY, no_hi = said[j].hi == INFINITY;
            if (is_map ? !no_lo || !no_hi : no_lo || no_hi)
                bytes_refuse(in, "a formula has no range of u or v, or one of x, y or z");
            if (!is_map) made->uv[j] = said[j];
        }
        made->t = said[2 + is_map];
    }
    free(line);
}

static void read_stage(claim *c, bytes *in, bool is_map, char **rest)
{
    stage *made = ADDED(in, c->stages, c->stage_count);
    const size_t count = bytes_whole(in, rest, is_map ? 2 : PIECES_MAX);
    bytes_word(in, rest);
    if (count == 0) bytes_refuse(in, "a shape or map has no pieces");
    if (made == NULL) return;
    made->is_map = is_map;
    const bool is_clocked = *rest != NULL;
    if (is_clocked && strcmp(bytes_word(in, rest), "clock") != 0) bytes_refuse(in, "no 'clock'");
    if (is_clocked) made->clock = bytes_whole(in, rest, c->clock_count);
    while (made->count < count && bytes_are_good(in)) {
        piece *p = ADDED(in, made->pieces, made->count);
        if (p != NULL) read_piece(in, is_map, p);
    }
}

static void read_shape(claim *c, bytes *in, char **rest) { read_stage(c, in, false, rest); }
static void read_map(claim *c, bytes *in, char **rest) { read_stage(c, in, true, rest); }

static void read_surface(claim *c, bytes *in, char **rest)
{
    surface *made = ADDED(in, c->surfaces, c->surface_count);
    const size_t body = bytes_whole(in, rest, c->body_count);
    if (made == NULL) return;
    made->body = body;
    while (*rest != NULL && made->count < CLAIM_STAGES && bytes_are_good(in)) {
        const size_t number = bytes_whole(in, rest, c->stage_count);
        size_t *next = ADDED(in, made->stages, made->count);
        if (next == NULL || !bytes_are_good(in)) return;
        *next = number;
        if (c->stages[number].is_map != (made->count > 1))
            bytes_refuse(in, "a surface is no shape and maps");
    }
    if (made->count == 0 || (c->surface_count > 1 && body < made[-1].body))
        bytes_refuse(in, "a surface has no shape, or is not in the order of bodies");
}

static void read_body(claim *c, bytes *in, char **rest)
{
    const char *name = *rest != NULL ? *rest : "";
    for (size_t k = 0; k < c->body_count; ++k)
        if (strcmp(c->bodies[k], name) == 0) bytes_refuse(in, "two bodies have one name");
    if (c->body_count == BODIES_MAX) bytes_refuse(in, "there are too many bodies");
    char **made = ADDED(in, c->bodies, c->body_count);
    if (made != NULL && (*made = strdup(name)) == NULL) bytes_refuse(in, "memory ran out");
    *rest = NULL;
}

static void read_parameter(claim *c, bytes *in, char **rest)
{
    if (c->clock_count == CLAIM_CLOCKS || c->stage_count > 0 || c->has_points)
        bytes_refuse(in, "a parameter is not expected here, or one too many");
    if (!bytes_are_good(in)) return;
    clock_range *made = &c->clocks[c->clock_count++];
    made->all.lo = bytes_number(in, rest), made->all.hi = bytes_number(in, rest);
    made->name = strdup(*rest != NULL ? *rest : "");
    if (made->name == NULL || *made->name == '\0') bytes_refuse(in, "a parameter has no name");
    for (size_t k = 1; k + 1 < c->clock_count && made->name != NULL; ++k)
        if (strcmp(c->clocks[k].name, made->name) == 0) bytes_refuse(in, "parameters share a name");
    *rest = NULL;
}

static void read_points(claim *c, bytes *in, char **rest)
{
    c->within = bytes_number(in, rest);
    if (strcmp(bytes_word(in, rest), "at") != 0 || c->has_points) bytes_refuse(in, "no 'at'");
    for (size_t k = 0; k < c->clock_count; ++k) c->clocks[k].at = bytes_number(in, rest);
    for (int k = 0; k < 2 && bytes_are_good(in); ++k) {
        char *line = bytes_line(in), *more = line;
        if (strcmp(bytes_word(in, &more), "point") != 0) bytes_refuse(in, "expected 'point'");
        c->points[k].surface = bytes_whole(in, &more, PIECES_MAX);
        c->points[k].piece = bytes_whole(in, &more, PIECES_MAX);
        for (int j = 0; j < 2; ++j) c->points[k].uv[j] = bytes_number(in, &more);
        if (more != NULL) bytes_refuse(in, "a line 'point' is too long");
        free(line);
    }
    c->has_points = true;
}

static void read_ignored(claim *c, bytes *in, char **rest)
{
    size_t(*made)[2] = ADDED(in, c->ignored, c->ignored_count);
    for (int k = 0; k < 2 && made != NULL; ++k) (*made)[k] = bytes_whole(in, rest, c->body_count);
}

static void read_verdict(claim *c, bytes *in, char **rest)
{
    static const char *const words[] = {"contact",  "violated", "undecided",
                                        "distance", "clear",    "holds"};
    const char *word = bytes_word(in, rest);
    if (c->verdict != NULL) bytes_refuse(in, "a second verdict");
    for (int k = 0; k < 6; ++k)
        if (strcmp(word, words[k]) == 0)
            c->verdict = words[k], c->needs_points = k < 2, c->needs_gap = k >= 4;
}

/* Reads a line. False: it is "trees". */
static bool read_line(claim *c, bytes *in, char *rest)
{
    static const char *const keys[] = {"verdict", "parameter", "within",  "shape", "map",  "body",
                                       "surface", "ignore",    "program", "scene", "type", "file"};
    static void (*const read[sizeof keys / sizeof *keys])(claim *, bytes *, char **) = {
        read_verdict, read_parameter, read_points,  read_shape, read_map,
        read_body,    read_surface,   read_ignored, NULL}; /* what is left is passed over */
    const char *key = bytes_word(in, &rest);
    double *number = strcmp(key, "apart") == 0  ? &c->apart
                     : strcmp(key, "from") == 0 ? &c->clocks[0].all.lo
                     : strcmp(key, "to") == 0   ? &c->clocks[0].all.hi
                                                : NULL;
    size_t k = 0, count = sizeof keys / sizeof *keys;
    if (strcmp(key, "trees") == 0 && rest == NULL) return false;
    if (number != NULL && !isnan(*number)) bytes_refuse(in, "a second line '%s'", key);
    if (number != NULL) *number = bytes_number(in, &rest);
    while (number == NULL && k < count && strcmp(key, keys[k]) != 0) ++k;
    if (number == NULL && k < count && read[k] != NULL) read[k](c, in, &rest);
    return (k < count && (rest == NULL || read[k] == NULL)) ||
           bytes_refuse(in, "a line '%.40s' is wrong", key);
}

bool claim_read(claim *c, bytes *in)
{
    *c = (claim){.apart = NAN, .clock_count = 1, .clocks = {{.all = {NAN, NAN}}}};
    char *line = bytes_line(in);
    const char *head = line != NULL ? line : "";
    const bool is_first = strcmp(head, "impinge certificate 1") == 0;
    if (!is_first && strcmp(head, "impinge certificate 2") != 0)
        bytes_refuse(in, "it begins with no 'impinge certificate 1', or 2");
    do {
        free(line);
        line = bytes_line(in);
    } while (line != NULL && read_line(c, in, line));
    free(line);
    if (is_first && c->clock_count > 1) bytes_refuse(in, "a parameter is in format 1");
    if (c->verdict == NULL || !(c->needs_gap ? c->apart > 0 : c->apart >= 0) ||
        (c->needs_points && !c->has_points))
        bytes_refuse(in, "it has no verdict, points or distance");
    for (size_t k = 0; k < c->clock_count; ++k) {
        const range all = c->clocks[k].all;
        const double at = c->has_points ? c->clocks[k].at : all.lo;
        if (!(all.lo <= all.hi && all.lo <= at && at <= all.hi))
            bytes_refuse(in, "it says no times or values, or its points are of others");
    }
    return bytes_are_good(in);
}

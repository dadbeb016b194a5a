/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/array_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/plugin/open_file.h"
#include "core/plugin/parameters_internal.h"

/* The format is that of numpy.lib.format: a magic text, a version, the length of the head, and the
 * head, the text of a Python dictionary, behind which the numbers stand. */

enum {
    MAGIC_BYTES = 8,
    HEAD_MOST = 1 << 16, /* bytes: that of an array of numbers has 118 */
    PIECE = 1 << 13      /* numbers that are read at once */
};

/* What the head says, and where reading has come to. */
typedef struct npy {
    const imp_parameter *row;
    const char *path;
    const place *at;
    imp_error *error;
    FILE *file;
    uint64_t size; /* of the file; bytes */
    char kind;     /* f, i, u or b */
    size_t width;  /* bytes of a number */
    bool is_big_endian, is_columns_first;
    uint32_t rank;
    size_t extent[IMP_RANK_MAX], count;
} npy;

static imp_code refuse(const npy *f, const char *found)
{
    return place_error(f->at, f->error, IMP_ERROR_SCENE,
                       "%.200s: %s; write it by numpy.save(FILE, numpy.asarray(A, dtype=float))",
                       f->path, found);
}

/* --- The head --------------------------------------------------------------------------------- */

static const char *skip(const char *at) { return at + strspn(at, " \t\r\n"); }

/* Reads a text in quotes, without escapes. NULL: there is none. */
static const char *read_quoted(const char *at, char *to, size_t size)
{
    const char quote = *at;
    if (quote != '\'' && quote != '"') return NULL;
    const char *end = strchr(at + 1, quote);
    if (end == NULL || (size_t)(end - at) > size) return NULL;
    memcpy(to, at + 1, (size_t)(end - at) - 1);
    to[end - at - 1] = '\0';
    return end + 1;
}

/* Reads '<f8' and the like. */
static const char *read_descr(npy *f, const char *at)
{
    char text[16];
    at = read_quoted(at, text, sizeof text);
    if (at == NULL || strlen(text) != 3 || strchr("<>|=", text[0]) == NULL) return NULL;
    const bool is_byte = text[2] == '1';
    f->is_big_endian = text[0] == '>' || (text[0] == '=' && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
    f->kind = text[1];
    f->width = (size_t)(text[2] - '0');
    const bool known = f->kind == 'f' ? f->width == 4 || f->width == 8
                       : f->kind == 'b'
                           ? is_byte
                           : (f->kind == 'i' || f->kind == 'u') && strchr("1248", text[2]) != NULL;
    return known && (is_byte || text[0] != '|') ? at : NULL;
}

static const char *read_truth(npy *f, const char *at)
{
    f->is_columns_first = strncmp(at, "True", 4) == 0;
    if (f->is_columns_first) return at + 4;
    return strncmp(at, "False", 5) == 0 ? at + 5 : NULL;
}

/* Reads (16, 3), (5,) or (). NULL: it is no shape. Of one of more dimensions than any row has, only
 * the rank is kept. */
static const char *read_shape(npy *f, const char *at)
{
    if (*at != '(') return NULL;
    at = skip(at + 1);
    for (f->rank = 0; *at != ')'; ++f->rank) {
        size_t extent = 0, digits = 0;
        for (; *at >= '0' && *at <= '9'; ++at, ++digits)
            if (__builtin_mul_overflow(extent, (size_t)10, &extent) ||
                __builtin_add_overflow(extent, (size_t)(*at - '0'), &extent))
                return NULL;
        if (digits == 0) return NULL;
        if (f->rank < IMP_RANK_MAX) f->extent[f->rank] = extent;
        at = skip(*at == 'L' ? at + 1 : at); /* as Python 2 wrote it */
        if (*at == ',')
            at = skip(at + 1);
        else if (*at != ')')
            return NULL;
    }
    return at + 1;
}

enum { DESCR = 1, ORDER = 2, SHAPE = 4, ALL = 7 };

/* Reads the three entries, in any order. */
static imp_code read_head(npy *f, const char *at)
{
    unsigned seen = 0;
    at = skip(at);
    if (*at != '{') return refuse(f, "its head is no dictionary");
    for (at = skip(at + 1); *at != '}';) {
        char key[32];
        unsigned which = 0;
        at = read_quoted(at, key, sizeof key);
        if (at != NULL) at = skip(at);
        if (at == NULL || *at != ':') return refuse(f, "its head is no dictionary");
        at = skip(at + 1);
        if (strcmp(key, "descr") == 0)
            which = DESCR, at = read_descr(f, at);
        else if (strcmp(key, "fortran_order") == 0)
            which = ORDER, at = read_truth(f, at);
        else if (strcmp(key, "shape") == 0)
            which = SHAPE, at = read_shape(f, at);
        if (which == 0 || (seen & which) != 0)
            return refuse(f, "its head has an entry that is not known, or one twice");
        if (at == NULL)
            return refuse(f, which == DESCR ? "its numbers are none of float32, float64, integers "
                                              "and booleans"
                                            : "its head cannot be read");
        seen |= which;
        at = skip(at);
        if (*at == ',')
            at = skip(at + 1);
        else if (*at != '}')
            return refuse(f, "its head is no dictionary");
    }
    return seen == ALL ? IMP_SUCCESS : refuse(f, "its head lacks descr, fortran_order or shape");
}

/* Reads what stands before the numbers; *numbers: where they begin. */
static imp_code read_front(npy *f, uint64_t *numbers)
{
    unsigned char front[MAGIC_BYTES + 4];
    const bool has_front = fread(front, 1, MAGIC_BYTES + 2, f->file) == MAGIC_BYTES + 2;
    if (!has_front || memcmp(front, "\x93NUMPY", 6) != 0)
        return refuse(f, "it is no file of NumPy's format (.npy)");
    if (front[6] < 1 || front[6] > 3) return refuse(f, "its version is none of 1, 2 and 3");
    const size_t more = front[6] == 1 ? 0 : 2;
    size_t length = front[8] + 256u * front[9];
    if (fread(front + MAGIC_BYTES + 2, 1, more, f->file) != more)
        return refuse(f, "it ends within its head");
    if (more > 0) length += ((size_t)front[10] << 16) + ((size_t)front[11] << 24);
    if (length > HEAD_MOST) return refuse(f, "its head is longer than that of numbers");
    char *head = malloc(length + 1);
    if (head == NULL) return error_set_memory(f->error);
    head[length] = '\0';
    const imp_code code = fread(head, 1, length, f->file) == length
                              ? read_head(f, head)
                              : refuse(f, "it ends within its head");
    free(head);
    *numbers = MAGIC_BYTES + 2 + more + length;
    return code;
}

/* --- Its shape -------------------------------------------------------------------------------- */

/* Writes (16, 3). */
static const char *shape_text(const npy *f, char text[100])
{
    size_t used = (size_t)snprintf(text, 100, "(");
    for (uint32_t k = 0; k < f->rank; ++k)
        used += (size_t)snprintf(text + used, 100 - used, k > 0 ? ", %zu" : "%zu", f->extent[k]);
    snprintf(text + used, 100 - used, f->rank == 1 ? ",)" : ")");
    return text;
}

static imp_code check_shape(npy *f, uint64_t numbers)
{
    const imp_parameter *row = f->row;
    char text[100];
    bool fits = f->rank == row->rank;
    f->count = 1;
    if (f->rank > IMP_RANK_MAX)
        return place_error(f->at, f->error, IMP_ERROR_SCENE,
                           "%.200s: it has %u dimensions, must be %s", f->path, f->rank,
                           parameter_shape_words(row, 0).at);
    for (uint32_t k = 0; fits && k < f->rank; ++k)
        fits = f->extent[k] > 0 && (row->extent[k] == 0 || row->extent[k] == f->extent[k]) &&
               !__builtin_mul_overflow(f->count, f->extent[k], &f->count);
    if (!fits)
        return place_error(f->at, f->error, IMP_ERROR_SCENE,
                           "%.200s: its shape is %s, must be that of %s", f->path,
                           shape_text(f, text), parameter_shape_words(row, 0).at);
    const uint64_t there = f->size > numbers ? f->size - numbers : 0;
    if (f->count > UINT64_MAX / f->width || f->count > SIZE_MAX / sizeof(double) ||
        f->count * f->width != there)
        return place_error(f->at, f->error, IMP_ERROR_SCENE,
                           "%.200s: a shape of %s takes %zu numbers of %zu bytes, but the file has "
                           "%llu bytes of them; write it again",
                           f->path, shape_text(f, text), f->count, f->width,
                           (unsigned long long)there);
    return IMP_SUCCESS;
}

/* --- Its numbers ------------------------------------------------------------------------------ */

/* Converts one number. Whole ones that no double holds become infinite, which no row allows. */
static double number_of(const npy *f, const unsigned char *bytes)
{
    uint64_t bits = 0;
    for (size_t k = 0; k < f->width; ++k)
        bits |= (uint64_t)bytes[f->is_big_endian ? f->width - 1 - k : k] << (8 * k);
    if (f->kind == 'f' && f->width == 8) {
        double x;
        memcpy(&x, &bits, sizeof x);
        return x;
    }
    if (f->kind == 'f') {
        const uint32_t half = (uint32_t)bits;
        float x;
        memcpy(&x, &half, sizeof x);
        return (double)x;
    }
    const uint64_t sign = UINT64_C(1) << (8 * f->width - 1), exact = UINT64_C(1) << 53;
    const bool is_below = f->kind == 'i' && (bits & sign) != 0;
    const uint64_t magnitude = is_below ? (sign - (bits & (sign - 1))) : bits;
    if (magnitude > exact) return INFINITY;
    return is_below ? -(double)magnitude : (double)magnitude;
}

/* Returns the index in the value, which has rows first, of number k of the file. */
static size_t place_of(const npy *f, size_t k)
{
    size_t index[IMP_RANK_MAX], to = 0;
    if (!f->is_columns_first) return k;
    for (uint32_t j = 0; j < f->rank; ++j) {
        index[j] = k % f->extent[j];
        k /= f->extent[j];
    }
    for (uint32_t j = 0; j < f->rank; ++j) to = to * f->extent[j] + index[j];
    return to;
}

/* Names the number by its indices, as in a scene's text. */
static imp_code refuse_number(const npy *f, size_t to, double x)
{
    size_t index[IMP_RANK_MAX];
    place element[IMP_RANK_MAX];
    const place *at = f->at;
    for (uint32_t j = f->rank; j-- > 0; to /= f->extent[j]) index[j] = to % f->extent[j];
    for (uint32_t j = 0; j < f->rank; ++j) {
        element[j] = place_index(at, index[j]);
        at = &element[j];
    }
    if (isinf(x) && f->kind != 'f')
        return place_error(at, f->error, IMP_ERROR_SCENE,
                           "%.200s: got a whole number beyond 2^53, must be %s", f->path,
                           parameter_shape_words(f->row, f->rank).at);
    return place_error(at, f->error, IMP_ERROR_SCENE, "%.200s: got %.17g, must be %s", f->path, x,
                       parameter_shape_words(f->row, f->rank).at);
}

static bool is_allowed(const imp_parameter *row, double x)
{
    return parameter_is_allowed(row, x) && (row->kind != IMP_KIND_BOOLEAN || x == 0 || x == 1);
}

static imp_code read_numbers(const npy *f, double *number)
{
    unsigned char bytes[PIECE * sizeof(double)];
    for (size_t k = 0; k < f->count;) {
        const size_t rest = f->count - k, some = rest < PIECE ? rest : PIECE;
        if (fread(bytes, f->width, some, f->file) != some)
            return refuse(f, "it ends within its numbers");
        for (size_t i = 0; i < some; ++i, ++k) {
            const double x = number_of(f, bytes + i * f->width);
            const size_t to = place_of(f, k);
            if (!is_allowed(f->row, x)) return refuse_number(f, to, x);
            number[to] = x;
        }
    }
    return IMP_SUCCESS;
}

static imp_code take_numbers(const npy *f, const array_file_limit *limit, imp_value *value)
{
    const uint64_t bytes = f->size + f->count * sizeof(double);
    if (limit != NULL && !limit->allows(limit->context, limit->held + bytes))
        return IMP_ERROR_LIMIT;
    double *number = malloc(f->count * sizeof *number);
    if (number == NULL) return error_set_memory(f->error);
    const imp_code code = read_numbers(f, number);
    if (code != IMP_SUCCESS) {
        free(number);
        return code;
    }
    *value = (imp_value){.count = f->count, .number = number};
    for (uint32_t k = 0; k < IMP_RANK_MAX; ++k) value->extent[k] = k < f->rank ? f->extent[k] : 1;
    return IMP_SUCCESS;
}

/* --- The whole -------------------------------------------------------------------------------- */

bool array_file_is_asked(const imp_parameter *row, const json_t *json)
{
    const bool has_numbers = row->kind == IMP_KIND_NUMBER || row->kind == IMP_KIND_INTEGER ||
                             row->kind == IMP_KIND_BOOLEAN;
    return has_numbers && row->rank > 0 && json_object_get(json, "file") != NULL;
}

const char *array_file_name(const json_t *json, const place *at, imp_error *error)
{
    const char *name = json_string_value(json_object_get(json, "file"));
    if (name != NULL && name[0] != '\0' && json_object_size(json) == 1) return name;
    place_error(at, error, IMP_ERROR_SCENE,
                "got an object, must be an array, or {\"file\": NAME} of a .npy file");
    return NULL;
}

static FILE *open_array(const char *path)
{
    const int file = open_file(path);
    FILE *opened = file >= 0 ? fdopen(file, "rb") : NULL;
    if (file >= 0 && opened == NULL) close(file);
    return opened;
}

imp_code array_file_read(const imp_parameter *row, const char *path, const array_file_limit *limit,
                         const place *at, imp_value *value, uint64_t *bytes, imp_error *error)
{
    npy f = {.row = row, .path = path, .at = at, .error = error, .file = open_array(path)};
    struct stat facts;
    uint64_t numbers = 0;
    if (f.file == NULL)
        return place_error(at, error, IMP_ERROR_SCENE, "%.200s: %s", path, strerror(errno));
    imp_code code = IMP_SUCCESS;
    if (fstat(fileno(f.file), &facts) != 0 || !S_ISREG(facts.st_mode))
        code = refuse(&f, "it is no regular file");
    f.size = code == IMP_SUCCESS ? (uint64_t)facts.st_size : 0;
    if (code == IMP_SUCCESS) code = read_front(&f, &numbers);
    if (code == IMP_SUCCESS) code = check_shape(&f, numbers);
    if (code == IMP_SUCCESS) code = take_numbers(&f, limit, value);
    fclose(f.file);
    *bytes = code == IMP_SUCCESS ? f.count * sizeof(double) : 0;
    return code;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/array_file.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/plugin/npy_head.h"
#include "core/plugin/open_file.h"
#include "core/plugin/parameters_internal.h"
#include "core/plugin/zip_member.h"

enum { PIECE = 1 << 13 }; /* numbers that are read at once */

/* What the head says, and where reading has come to. */
typedef struct npy {
    const imp_parameter *row;
    const char *path;
    const char *array; /* in an archive; NULL: the file is no archive */
    const place *at;
    imp_error *error;
    FILE *file;
    zip_member member; /* where `array` is not NULL */
    uint64_t size;     /* of the array's file; bytes */
    npy_head head;
    size_t count;
} npy;

static imp_code fail(const npy *f, const place *at, const char *format, ...) STATUS_PRINTF_(3, 4);

/* Reports an error that begins with the name of the file, and of its array. */
static imp_code fail(const npy *f, const place *at, const char *format, ...)
{
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (f->array == NULL)
        return place_error(at, f->error, IMP_ERROR_SCENE, "%.200s: %s", f->path, text);
    return place_error(at, f->error, IMP_ERROR_SCENE, "%.200s: '%.60s': %s", f->path, f->array,
                       text);
}

static imp_code refuse(const npy *f, const char *found)
{
    return fail(f, f->at, "%s; write it by %s(FILE, %snumpy.asarray(A, dtype=float))", found,
                f->array == NULL ? "numpy.save" : "numpy.savez", f->array == NULL ? "" : "NAME=");
}

static size_t take(npy *f, void *to, size_t bytes)
{
    return f->array != NULL ? zip_member_read(&f->member, to, bytes) : fread(to, 1, bytes, f->file);
}

/* What stands where bytes are missing. */
static imp_code refuse_end(const npy *f, const char *where)
{
    if (f->array == NULL) return refuse(f, where);
    if (f->member.lacks_memory) return error_set_memory(f->error);
    return refuse(f, "it is damaged");
}

/* --- The head --------------------------------------------------------------------------------- */

static imp_code read_text(npy *f, size_t length)
{
    if (length > NPY_HEAD_MOST) return refuse(f, "its head is longer than that of numbers");
    char *text = malloc(length + 1);
    if (text == NULL) return error_set_memory(f->error);
    text[length] = '\0';
    imp_code code = IMP_SUCCESS;
    if (take(f, text, length) != length)
        code = refuse_end(f, "it ends within its head");
    else {
        const char *wrong = npy_head_read(&f->head, text);
        if (wrong != NULL) code = refuse(f, wrong);
    }
    free(text);
    return code;
}

/* Reads what stands before the numbers; *numbers: where they begin. */
static imp_code read_front(npy *f, uint64_t *numbers)
{
    unsigned char front[NPY_FRONT + 2] = {0};
    const bool has_front = take(f, front, NPY_FRONT) == NPY_FRONT;
    if (!has_front && f->array != NULL) return refuse_end(f, NULL);
    const int more = has_front ? npy_length_bytes(front) : -1;
    if (more == -1) return refuse(f, "it is no file of NumPy's format (.npy)");
    if (more < 0) return refuse(f, "its version is none of 1, 2 and 3");
    if (take(f, front + NPY_FRONT, (size_t)more) != (size_t)more)
        return refuse_end(f, "it ends within its head");
    const size_t length =
        front[8] + 256u * front[9] + ((size_t)front[10] << 16) + ((size_t)front[11] << 24);
    *numbers = NPY_FRONT + (uint64_t)more + length;
    return read_text(f, length);
}

/* --- Its shape -------------------------------------------------------------------------------- */

/* Writes (16, 3). */
static const char *shape_text(const npy *f, char text[100])
{
    size_t used = (size_t)snprintf(text, 100, "(");
    for (uint32_t k = 0; k < f->head.rank; ++k)
        used +=
            (size_t)snprintf(text + used, 100 - used, k > 0 ? ", %zu" : "%zu", f->head.extent[k]);
    snprintf(text + used, 100 - used, f->head.rank == 1 ? ",)" : ")");
    return text;
}

/* Writes how to make rows of an array of more dimensions, or nothing where that cannot be. */
static const char *reshape_text(const npy *f, char text[100])
{
    const imp_parameter *row = f->row;
    if (f->head.rank <= row->rank) return "";
    const uint32_t more = f->head.rank - row->rank;
    size_t rows = 1;
    for (uint32_t k = 0; k <= more; ++k) rows *= f->head.extent[k];
    bool is_known = row->extent[0] == 0 || row->extent[0] == rows;
    size_t used = (size_t)snprintf(text, 100, "; write it by numpy.save(FILE, A.reshape(-1");
    for (uint32_t k = 1; k < row->rank; ++k) {
        is_known = is_known && row->extent[k] > 0 && f->head.extent[k + more] == row->extent[k];
        used += (size_t)snprintf(text + used, 100 - used, ", %u", row->extent[k]);
    }
    snprintf(text + used, 100 - used, "))");
    return is_known ? text : "";
}

static imp_code check_shape(npy *f, uint64_t numbers)
{
    const imp_parameter *row = f->row;
    char text[100], cure[100];
    bool fits = f->head.rank == row->rank;
    f->count = 1;
    if (f->head.rank > IMP_RANK_MAX)
        return fail(f, f->at, "it has %u dimensions, must be %s", f->head.rank,
                    parameter_shape_words(row, 0).at);
    for (uint32_t k = 0; fits && k < f->head.rank; ++k)
        fits = f->head.extent[k] > 0 &&
               (row->extent[k] == 0 || row->extent[k] == f->head.extent[k]) &&
               !__builtin_mul_overflow(f->count, f->head.extent[k], &f->count);
    if (!fits)
        return fail(f, f->at, "its shape is %s, must be that of %s%s", shape_text(f, text),
                    parameter_shape_words(row, 0).at, reshape_text(f, cure));
    const uint64_t there = f->size > numbers ? f->size - numbers : 0;
    uint64_t bytes;
    if (__builtin_mul_overflow(f->count, f->head.width, &bytes)) bytes = UINT64_MAX;
    if (f->count > SIZE_MAX / sizeof(double) || bytes != there)
        return fail(f, f->at,
                    "a shape of %s takes %zu numbers of %zu bytes, but the file has %llu bytes of "
                    "them, %llu too %s; write it again",
                    shape_text(f, text), f->count, f->head.width, (unsigned long long)there,
                    (unsigned long long)(there < bytes ? bytes - there : there - bytes),
                    there < bytes ? "few" : "many");
    return IMP_SUCCESS;
}

/* --- Its numbers ------------------------------------------------------------------------------ */

/* Returns the index in the value, which has rows first, of number k of the file. */
static size_t place_of(const npy *f, size_t k)
{
    size_t index[IMP_RANK_MAX], to = 0;
    if (!f->head.is_columns_first) return k;
    for (uint32_t j = 0; j < f->head.rank; ++j) {
        index[j] = k % f->head.extent[j];
        k /= f->head.extent[j];
    }
    for (uint32_t j = 0; j < f->head.rank; ++j) to = to * f->head.extent[j] + index[j];
    return to;
}

/* Names the number by its indices, as in a scene's text. */
static imp_code refuse_number(const npy *f, size_t to, double x)
{
    size_t index[IMP_RANK_MAX];
    place element[IMP_RANK_MAX];
    const place *at = f->at;
    for (uint32_t j = f->head.rank; j-- > 0; to /= f->head.extent[j])
        index[j] = to % f->head.extent[j];
    for (uint32_t j = 0; j < f->head.rank; ++j) {
        element[j] = place_index(at, index[j]);
        at = &element[j];
    }
    if (isinf(x) && f->head.kind != 'f')
        return fail(f, at, "got a whole number beyond 2^53, must be %s",
                    parameter_shape_words(f->row, f->head.rank).at);
    return fail(f, at, "got %.17g, must be %s", x, parameter_shape_words(f->row, f->head.rank).at);
}

static bool is_allowed(const imp_parameter *row, double x)
{
    return parameter_is_allowed(row, x) && (row->kind != IMP_KIND_BOOLEAN || x == 0 || x == 1);
}

static imp_code read_numbers(npy *f, double *number)
{
    unsigned char bytes[PIECE * sizeof(double)];
    for (size_t k = 0; k < f->count;) {
        const size_t rest = f->count - k, some = rest < PIECE ? rest : PIECE;
        if (take(f, bytes, some * f->head.width) != some * f->head.width)
            return refuse_end(f, "it ends within its numbers");
        for (size_t i = 0; i < some; ++i, ++k) {
            const double x = npy_number(&f->head, bytes + i * f->head.width);
            const size_t to = place_of(f, k);
            if (!is_allowed(f->row, x)) return refuse_number(f, to, x);
            number[to] = x;
        }
    }
    return f->array == NULL || zip_member_ends_well(&f->member) ? IMP_SUCCESS : refuse_end(f, NULL);
}

static imp_code take_numbers(npy *f, const array_file_limit *limit, imp_value *value)
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
    for (uint32_t k = 0; k < IMP_RANK_MAX; ++k)
        value->extent[k] = k < f->head.rank ? f->head.extent[k] : 1;
    return IMP_SUCCESS;
}

/* --- The whole -------------------------------------------------------------------------------- */

bool array_file_is_asked(const imp_parameter *row, const json_t *json)
{
    const bool has_numbers = row->kind == IMP_KIND_NUMBER || row->kind == IMP_KIND_INTEGER ||
                             row->kind == IMP_KIND_BOOLEAN;
    return has_numbers && row->rank > 0 && json_object_get(json, "file") != NULL;
}

imp_code array_file_name(const json_t *json, const place *at, array_name *name, imp_error *error)
{
    const json_t *array = json_object_get(json, "array");
    *name =
        (array_name){json_string_value(json_object_get(json, "file")), json_string_value(array)};
    const bool has_names = name->file != NULL && name->file[0] != '\0' &&
                           (array == NULL || (name->array != NULL && name->array[0] != '\0'));
    if (has_names && json_object_size(json) == (array != NULL ? 2 : 1)) return IMP_SUCCESS;
    return place_error(at, error, IMP_ERROR_SCENE,
                       "got an object, must be an array, or {\"file\": NAME} of a .npy file, or "
                       "{\"file\": NAME, \"array\": NAME} of a .npz file");
}

static FILE *open_array(const char *path)
{
    const int file = open_file(path);
    FILE *opened = file >= 0 ? fdopen(file, "rb") : NULL;
    if (file >= 0 && opened == NULL) close(file);
    return opened;
}

/* Reads the array from where the file stands. */
static imp_code read_array(npy *f, const array_file_limit *limit, imp_value *value)
{
    uint64_t numbers = 0;
    imp_code code = read_front(f, &numbers);
    if (code == IMP_SUCCESS) code = check_shape(f, numbers);
    return code == IMP_SUCCESS ? take_numbers(f, limit, value) : code;
}

static imp_code read_member(npy *f, const array_file_limit *limit, imp_value *value)
{
    zip_fault fault = {""};
    imp_code code = zip_member_open(&f->member, f->file, f->size, f->array, &fault);
    if (code == IMP_ERROR_MEMORY) return error_set_memory(f->error);
    if (code != IMP_SUCCESS) return fail(f, f->at, "%s", fault.text);
    f->size = f->member.size;
    code = read_array(f, limit, value);
    zip_member_close(&f->member);
    return code;
}

/* An archive has arrays with names, another file one without. */
static imp_code read_either(npy *f, const array_file_limit *limit, imp_value *value)
{
    unsigned char front[4] = {0};
    const bool is_archive = fread(front, 1, 4, f->file) == 4 && zip_begins_so(front);
    rewind(f->file);
    if (is_archive) return read_member(f, limit, value);
    if (f->array == NULL) return read_array(f, limit, value);
    f->array = NULL;
    return fail(f, f->at, "it is no archive (.npz); leave out \"array\"");
}

imp_code array_file_read(const imp_parameter *row, const char *path, const char *array,
                         const array_file_limit *limit, const place *at, imp_value *value,
                         uint64_t *bytes, imp_error *error)
{
    npy f = {.row = row,
             .path = path,
             .array = array,
             .at = at,
             .error = error,
             .file = open_array(path)};
    struct stat facts;
    if (f.file == NULL)
        return place_error(at, error, IMP_ERROR_SCENE, "%.200s: %s", path, strerror(errno));
    imp_code code = IMP_SUCCESS;
    if (fstat(fileno(f.file), &facts) != 0 || !S_ISREG(facts.st_mode))
        code = refuse(&f, "it is no regular file");
    f.size = code == IMP_SUCCESS ? (uint64_t)facts.st_size : 0;
    if (code == IMP_SUCCESS) code = read_either(&f, limit, value);
    fclose(f.file);
    *bytes = code == IMP_SUCCESS ? f.count * sizeof(double) : 0;
    return code;
}

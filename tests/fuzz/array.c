/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/array_file.h"
#include "core/plugin/parameters.h"
#include "tests/fuzz/fuzz_file.h"

#include <impinge/plugin.h>
#include <math.h>
#include <string.h>

/* Whatever bytes a file of an array holds, it is read or refused with a reason that names it. What
 * was read is allowed, has the parameter's shape, took no more memory than was asked for, and is
 * equal to the last bit when it is written out as text and read again. The input's first byte says
 * which parameter it is for, and whether the array "a" of an archive is asked for. */

const char fuzz_target[] = "array";

enum { MOST = 1 << 20 }; /* bytes that may be asked for */

static const imp_parameter rows[] = {
    {.name = "points", .kind = IMP_KIND_NUMBER, .rank = 2, .extent = {0, 3}, .min = -9, .max = 99},
    {.name = "weights", .kind = IMP_KIND_NUMBER, .rank = 1, .min = 0, .max = 1e100},
    {.name = "flags", .kind = IMP_KIND_BOOLEAN, .rank = 2, .extent = {2, 0}, .min = 0, .max = 1},
    {.name = "counts", .kind = IMP_KIND_INTEGER, .rank = 2, .min = -1e15, .max = 1e15},
};
enum { ROWS = sizeof rows / sizeof *rows, FROM_ARCHIVE = 8 };

static uint64_t asked; /* the most bytes that were */

static bool allows(void *unused, uint64_t bytes)
{
    (void)unused;
    if (bytes > asked) asked = bytes;
    return bytes <= MOST;
}

/* Writes the elements from *next on as JSON, with the extents of the value. */
static json_t *text_of(const imp_value *value, uint32_t depth, uint32_t rank, size_t *next)
{
    if (depth == rank) return json_real(value->number[(*next)++]);
    json_t *list = json_array();
    for (uint64_t k = 0; k < value->extent[depth]; ++k)
        FUZZ_REQUIRE(json_array_append_new(list, text_of(value, depth + 1, rank, next)) == 0);
    return list;
}

static void judge(const imp_parameter *row, const imp_value *value, const place *at)
{
    size_t next = 0;
    uint64_t count = 1;
    imp_value again = {0};
    for (uint32_t k = 0; k < row->rank; ++k) count *= value->extent[k];
    FUZZ_REQUIRE(count == value->count && count > 0);
    FUZZ_REQUIRE(asked >= count * sizeof(double) && asked <= MOST);
    if (row->kind == IMP_KIND_BOOLEAN) return; /* whose text is true or false */
    json_t *text = text_of(value, 0, row->rank, &next);
    imp_error error;
    FUZZ_REQUIRE(parameters_read_value(row, text, at, &again, &error) == IMP_SUCCESS);
    FUZZ_REQUIRE(again.count == value->count &&
                 memcmp(again.number, value->number, count * sizeof(double)) == 0 &&
                 memcmp(again.extent, value->extent, sizeof again.extent) == 0);
    parameters_clear_value(&again);
    json_decref(text);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    if (length == 0) return 0;
    const imp_parameter *row = &rows[bytes[0] % ROWS];
    const char *array = (bytes[0] & FROM_ARCHIVE) != 0 ? "a" : NULL;
    const array_file_limit limit = {.allows = allows};
    const place at = place_document("scene");
    imp_value value = {0};
    imp_error error = {.code = IMP_SUCCESS};
    uint64_t taken = 7;
    fuzz_file_write(bytes + 1, length - 1);
    asked = 0;
    const imp_code code =
        array_file_read(row, fuzz_file, array, &limit, &at, &value, &taken, &error);
    if (code == IMP_SUCCESS) {
        FUZZ_REQUIRE(taken == value.count * sizeof(double));
        judge(row, &value, &at);
        parameters_clear_value(&value);
        return 0;
    }
    FUZZ_REQUIRE(value.number == NULL && taken == 0);
    FUZZ_REQUIRE(code == IMP_ERROR_LIMIT ? asked > MOST
                                         : code == IMP_ERROR_SCENE && error.code == code &&
                                               strstr(error.text, fuzz_file) != NULL);
    return 0;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "plugins/common/csv.h"
#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/fuzz_mutate.h"

#include <math.h>
#include <string.h>

/* Whatever bytes a file of numbers holds, it is read or refused with a reason. What was read is
 * finite, and the same to the last bit when it is written out and read again. The input's first
 * byte says how many columns are asked for, and whether by name; the names are "x", "2" and
 * "angle". */

const char fuzz_target[] = "csv";

FUZZ_MUTATE_TEXT

static void write_numbers(const csv_numbers *n)
{
    FILE *out = fopen(fuzz_file, "wb");
    FUZZ_REQUIRE(out != NULL);
    for (size_t k = 0; k < n->rows * n->columns; ++k)
        fprintf(out, "%.17g%c", n->number[k], (k + 1) % n->columns == 0 ? '\n' : ',');
    FUZZ_REQUIRE(fclose(out) == 0);
}

static bool read_numbers(const char *const *names, csv_numbers *to)
{
    imp_create_error why = {.parameter = -7};
    const imp_status status = csv_read(fuzz_file, 3, names, 4, to, &why);
    if (status == IMP_STATUS_OK) return true;
    FUZZ_REQUIRE(status == IMP_STATUS_PARAMETER && why.text[0] != '\0');
    FUZZ_REQUIRE(why.parameter == 3 || why.parameter == 4);
    free(to->number);
    return false;
}

/* Lines behind a byte order mark that are not empty and no comment: one of them may be a header,
 * the others are rows. */
static size_t count_lines(const unsigned char *bytes, size_t length)
{
    const bool mark = length >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0;
    size_t count = 0;
    for (size_t k = mark ? 3 : 0; k < length;) {
        const bool comment = bytes[k] == '#';
        bool empty = true;
        for (; k < length && bytes[k] != '\n' && bytes[k] != '\r'; ++k)
            empty = empty && (bytes[k] == ' ' || bytes[k] == '\t');
        if (!comment && !empty) ++count;
        if (k + 1 < length && bytes[k] == '\r' && bytes[k + 1] == '\n') ++k;
        ++k;
    }
    return count;
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    static const char *const names[] = {"x", "2", "angle"};
    if (length == 0) return 0;
    csv_numbers first = {.columns = 1 + bytes[0] % CSV_COLUMNS_MAX}, second = first;
    fuzz_file_write(bytes + 1, length - 1);
    if (!read_numbers(bytes[0] & 4 ? names : NULL, &first)) return 0;
    for (size_t k = 0; k < first.rows * first.columns; ++k) FUZZ_REQUIRE(isfinite(first.number[k]));
    FUZZ_REQUIRE(memchr(bytes + 1, 0, length - 1) == NULL); /* what is behind it is not lost */
    const size_t lines = count_lines(bytes + 1, length - 1);
    FUZZ_REQUIRE(lines == first.rows || lines == first.rows + 1);
    write_numbers(&first);
    FUZZ_REQUIRE(read_numbers(NULL, &second) && second.rows == first.rows);
    if (first.rows > 0)
        FUZZ_REQUIRE(memcmp(first.number, second.number,
                            first.rows * first.columns * sizeof *first.number) == 0);
    free(first.number);
    free(second.number);
    return 0;
}

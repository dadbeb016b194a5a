/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/array_scene.h"

/* Arrays of numbers from files of NumPy's format: {"file": "points.npy"}. */

/* --- Writing ---------------------------------------------------------------------------------- */

enum { ROWS = 3, WIDTH = 3, NUMBERS = ROWS * WIDTH };
static const double corners[NUMBERS] = {0, -1, -1, 0, 1, -1, 0, 0, 2};

/* How an array is written; an all-zero one is that of numpy.save(FILE, array of float64). */
typedef struct form {
    const char *descr, *shape; /* NULL: '<f8', (3, 3) */
    int version;               /* 0: 1 */
    bool is_columns_first;
    const char *head; /* NULL: made from these */
    long length;      /* bytes of numbers that are written; 0: all; < 0: so many less */
} form;

static void write_number(FILE *out, const char *descr, double x)
{
    unsigned char bytes[8];
    const size_t width = (size_t)(descr[2] - '0');
    uint64_t bits = (uint64_t)(int64_t)x;
    const float single = (float)x;
    if (descr[1] == 'f' && width == 8) memcpy(&bits, &x, sizeof bits);
    if (descr[1] == 'f' && width == 4) {
        uint32_t half;
        memcpy(&half, &single, sizeof half);
        bits = half;
    }
    for (size_t k = 0; k < width; ++k)
        bytes[descr[0] == '>' ? width - 1 - k : k] = (unsigned char)(bits >> (8 * k));
    fwrite(bytes, 1, width, out);
}

static void write_file(const form *f, const double *numbers)
{
    char head[300];
    const char *descr = f->descr != NULL ? f->descr : "<f8";
    const int version = f->version != 0 ? f->version : 1;
    snprintf(head, sizeof head, "{'descr': '%s', 'fortran_order': %s, 'shape': %s, }\n", descr,
             f->is_columns_first ? "True" : "False", f->shape != NULL ? f->shape : "(3, 3)");
    if (f->head != NULL) snprintf(head, sizeof head, "%s", f->head);
    FILE *out = fopen(path, "wb");
    ck_assert_ptr_nonnull(out);
    fwrite("\x93NUMPY", 1, 6, out);
    fputc(version, out), fputc(0, out);
    const size_t length = strlen(head);
    for (int k = 0; k < (version == 1 ? 2 : 4); ++k) fputc((int)(length >> (8 * k)) & 255, out);
    fputs(head, out);
    for (int k = 0; k < NUMBERS; ++k)
        write_number(out, descr,
                     f->is_columns_first ? numbers[k % ROWS * WIDTH + k / ROWS] : numbers[k]);
    if (f->length != 0) {
        fflush(out);
        ck_assert_int_eq(ftruncate(fileno(out), ftell(out) + f->length), 0);
    }
    fclose(out);
}

/* --- Reading ---------------------------------------------------------------------------------- */

static imp_scene *read_file(void)
{
    char object[100];
    snprintf(object, sizeof object, "{\"file\":\"%s\"}", path);
    return array_scene_read(object);
}

/* --- Tests ------------------------------------------------------------------------------------ */

START_TEST(arrays_of_each_form_are_those_of_the_text)
{
    static const form all[] = {
        {.descr = NULL},       {.descr = ">f8"}, {.descr = "<f4"},        {.descr = ">f4"},
        {.descr = "<i8"},      {.descr = ">i4"}, {.descr = "<i2"},        {.descr = "|i1"},
        {.version = 2},        {.version = 3},   {.is_columns_first = 1}, {.shape = "( 3,3 )"},
        {.shape = "(3L, 3L)"},
    };
    const imp_result expected = array_scene_solve(array_scene_read("[[0,-1,-1],[0,1,-1],[0,0,2]]"));
    ck_assert_int_eq(expected.verdict, IMP_VERDICT_CONTACT);
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        write_file(&all[k], corners);
        const imp_result found = array_scene_solve(read_file());
        ck_assert_msg(found.t == expected.t && found.b.u == expected.b.u &&
                          found.a.v == expected.a.v && found.stats.pairs == expected.stats.pairs,
                      "form %zu", k);
    }
}
END_TEST

START_TEST(other_files_are_refused_with_the_reason)
{
    static const struct {
        form form;
        const char *message;
    } all[] = {
        {{.descr = "|O8"}, "none of float32, float64, integers"},
        {{.descr = "<c8"}, "none of float32, float64, integers"},
        {{.descr = "<f2"}, "none of float32, float64, integers"},
        {{.shape = "(9,)"}, "its shape is (9,), must be that of"},
        {{.shape = "(3, 3, 1)"}, "numbers in [-1e+100, 1e+100]"},
        {{.shape = "(1, 3, 3)"}, "write it by numpy.save(FILE, A.reshape(-1, 3))"},
        {{.shape = "(3, 0)"}, "its shape is (3, 0), must be"},
        {{.shape = "(3, 4)"}, "its shape is (3, 4), must be"},
        {{.shape = "(3, 3, 3, 3)"}, "it has 4 dimensions, must be"},
        {{.shape = "(99999999999999999999, 3)"}, "its shape cannot be read"},
        {{.shape = "(1152921504606846976, 3)"}, "its shape is (1152921504606846976, 3), must"},
        {{.shape = "(-3, 3)"}, "its shape cannot be read"},
        {{.length = -8},
         "takes 9 numbers of 8 bytes, but the file has 64 bytes of them, 8 too few"},
        {{.length = 8},
         "takes 9 numbers of 8 bytes, but the file has 80 bytes of them, 8 too many"},
        {{.version = 4}, "its version is none of 1, 2 and 3"},
        {{.head = "{'descr': '<f8'}"}, "its head lacks"},
        {{.head = "{'descr': [('x', '<f8')], }"}, "none of float32, float64, integers"},
        {{.head = "{'descr': '<f8', 'descr': '<f8'}"}, "or one twice"},
        {{.head = "{'other': 1}"}, "an entry that is not known"},
        {{.head = "{'descr"}, "is no dictionary"},
        {{.head = ""}, "is no dictionary"},
        {{.head = "{'descr': '<f8', 'shape': (3, 3"}, "its shape cannot be read"},
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        write_file(&all[k].form, corners);
        imp_scene *scene = read_file();
        ck_assert_msg(scene == NULL && error.code == IMP_ERROR_SCENE &&
                          strstr(error.text, all[k].message) != NULL,
                      "case %zu: %s", k, scene != NULL ? "read" : error.text);
    }
}
END_TEST

START_TEST(files_that_end_early_are_refused_wherever_they_end)
{
    write_file(&(form){.version = 2}, corners);
    FILE *file = fopen(path, "rb");
    ck_assert_int_eq(fseek(file, 0, SEEK_END), 0);
    const long size = ftell(file);
    fclose(file);
    for (long length = size - 1; length >= 0; --length) {
        ck_assert_int_eq(truncate(path, length), 0);
        ck_assert_ptr_null(read_file());
        ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    }
}
END_TEST

START_TEST(numbers_that_a_text_could_not_state_are_refused_with_their_place)
{
    double numbers[NUMBERS];
    memcpy(numbers, corners, sizeof numbers);
    numbers[5] = NAN;
    write_file(&(form){.is_columns_first = true}, numbers);
    ck_assert_ptr_null(read_file());
    ck_assert_msg(strstr(error.text, "/bodies/0/surfaces/0/points/1/2: ") != NULL, "%s",
                  error.text);
    numbers[5] = 0x1p60; /* as a whole number: none that a double is sure to hold */
    write_file(&(form){.descr = "<i8"}, numbers);
    ck_assert_ptr_null(read_file());
    ck_assert_msg(strstr(error.text, "points/1/2: ") != NULL &&
                      strstr(error.text, "got a whole number beyond 2^53, must be") != NULL,
                  "%s", error.text);
}
END_TEST

START_TEST(an_object_that_names_no_file_is_refused)
{
    ck_assert_ptr_null(array_scene_read("{\"file\":\"x.npy\", \"type\": \"f8\"}"));
    ck_assert_msg(strstr(error.text, "or {\"file\": NAME}") != NULL, "%s", error.text);
    ck_assert_ptr_null(array_scene_read("{\"file\":\"/none/such.npy\"}"));
    ck_assert_msg(strstr(error.text, "/none/such.npy: No such file") != NULL, "%s", error.text);
    unlink(path);
    ck_assert_int_eq(mkfifo(path, 0600), 0); /* nobody writes to it */
    ck_assert_ptr_null(read_file());
    ck_assert_msg(strstr(error.text, "it is no regular file") != NULL, "%s", error.text);
    unlink(path);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {arrays_of_each_form_are_those_of_the_text,
                                  other_files_are_refused_with_the_reason,
                                  files_that_end_early_are_refused_wherever_they_end,
                                  numbers_that_a_text_could_not_state_are_refused_with_their_place,
                                  an_object_that_names_no_file_is_refused};
    return suite_main_with("array_files", tests, sizeof tests / sizeof *tests, array_scene_begin,
                           array_scene_end);
}

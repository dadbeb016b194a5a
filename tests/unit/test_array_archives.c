/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>

#include "tests/support/array_scene.h"

/* Arrays of numbers from archives, as numpy.savez and numpy.savez_compressed write them:
 * {"file": "nets.npz", "array": "points"}. */

/* --- Archives --------------------------------------------------------------------------------- */

/* What numpy.save writes of [[0, -1, -1], [0, 1, -1], [0, 0, 2]] as float64, and that deflated by
 * zlib 1.2.13. */
enum { STORED = 0, DEFLATED = 8, ARRAY_BYTES = 200 };
static const unsigned char packed_array[] = {
    0x9b, 0xec, 0x17, 0xea, 0x1b, 0x10, 0xc9, 0xc8, 0x50, 0xc6, 0x50, 0xad, 0x9e, 0x92,
    0x5a, 0x9c, 0x5c, 0xa4, 0x6e, 0xa5, 0xa0, 0x6e, 0x93, 0x66, 0xa1, 0xae, 0xa3, 0xa0,
    0x9e, 0x96, 0x5f, 0x54, 0x52, 0x94, 0x98, 0x17, 0x9f, 0x5f, 0x94, 0x92, 0x0a, 0x12,
    0x77, 0x4b, 0xcc, 0x29, 0x4e, 0x05, 0x8a, 0x17, 0x67, 0x24, 0x16, 0xa4, 0x02, 0xf9,
    0x1a, 0xc6, 0x3a, 0x0a, 0xc6, 0x9a, 0x3a, 0x0a, 0xb5, 0x0a, 0x64, 0x03, 0x2e, 0x06,
    0x14, 0xf0, 0x61, 0x3f, 0x2a, 0x0d, 0x17, 0xb7, 0xc7, 0x2e, 0x0e, 0x07, 0x0e, 0x00};
static const char array_head[] = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }";
static const double corners[9] = {0, -1, -1, 0, 1, -1, 0, 0, 2};

static size_t write_array(unsigned char to[ARRAY_BYTES])
{
    memcpy(to, "\x93NUMPY\x01\x00\x76\x00", 10);
    memset(to + 10, ' ', 117);
    memcpy(to + 10, array_head, sizeof array_head - 1);
    to[127] = '\n';
    memcpy(to + 128, corners, sizeof corners);
    return ARRAY_BYTES;
}

/* CRC-32, bit by bit. */
static uint32_t sum_of(const unsigned char *at, size_t bytes)
{
    uint32_t sum = UINT32_MAX;
    for (size_t k = 0; k < 8 * bytes; ++k) {
        const uint32_t bit = (sum ^ (uint32_t)(at[k / 8] >> (k % 8))) & 1;
        sum = (sum >> 1) ^ (bit != 0 ? UINT32_C(0xedb88320) : 0);
    }
    return sum ^ UINT32_MAX;
}

/* How a member differs from a sound one that holds the array. */
typedef struct member {
    const char *name; /* NULL: points.npy */
    unsigned method, flags;
    uint32_t more_size, more_packed, more_at; /* added to what the directory says */
} member;

typedef struct archive {
    unsigned char at[2000];
    size_t size;
} archive;

static void put(archive *a, uint32_t number, int bytes)
{
    for (int k = 0; k < bytes; ++k) a->at[a->size++] = (unsigned char)(number >> (8 * k));
}

static void put_bytes(archive *a, const void *from, size_t bytes)
{
    memcpy(a->at + a->size, from, bytes);
    a->size += bytes;
}

/* Writes the fields that a member's head and its entry share. */
static void put_facts(archive *a, const member *m, uint32_t sum, size_t packed, size_t size)
{
    put(a, 20, 2), put(a, m->flags, 2), put(a, m->method, 2), put(a, 0, 4), put(a, sum, 4);
    put(a, (uint32_t)packed, 4), put(a, (uint32_t)size, 4);
    put(a, (uint32_t)strlen(m->name), 2), put(a, 0, 2);
}

/* Writes an archive of these members. */
static archive pack(const member *members, size_t count)
{
    archive a = {.size = 0};
    unsigned char array[ARRAY_BYTES];
    size_t start[4];
    const size_t size = write_array(array);
    const uint32_t sum = sum_of(array, size);
    for (size_t k = 0; k < count; ++k) {
        member m = members[k];
        if (m.name == NULL) m.name = "points.npy";
        const void *bytes = m.method == DEFLATED ? packed_array : array;
        const size_t packed = m.method == DEFLATED ? sizeof packed_array : size;
        start[k] = a.size;
        put_bytes(&a, "PK\x03\x04", 4);
        put_facts(&a, &m, sum, packed, size);
        put_bytes(&a, m.name, strlen(m.name));
        put_bytes(&a, bytes, packed);
    }
    const size_t directory = a.size;
    for (size_t k = 0; k < count; ++k) {
        member m = members[k];
        if (m.name == NULL) m.name = "points.npy";
        put_bytes(&a, "PK\x01\x02", 4);
        put(&a, 20, 2);
        put_facts(&a, &m, sum, (m.method == DEFLATED ? sizeof packed_array : size) + m.more_packed,
                  size + m.more_size);
        put(&a, 0, 2), put(&a, 0, 2), put(&a, 0, 2), put(&a, 0, 4);
        put(&a, (uint32_t)start[k] + m.more_at, 4);
        put_bytes(&a, m.name, strlen(m.name));
    }
    const size_t length = a.size - directory;
    put_bytes(&a, "PK\x05\x06", 4);
    put(&a, 0, 4), put(&a, (uint32_t)count, 2), put(&a, (uint32_t)count, 2);
    put(&a, (uint32_t)length, 4), put(&a, (uint32_t)directory, 4), put(&a, 0, 2);
    return a;
}

static void write_file(const archive *a)
{
    FILE *out = fopen(path, "wb");
    ck_assert_ptr_nonnull(out);
    ck_assert_uint_eq(fwrite(a->at, 1, a->size, out), a->size);
    fclose(out);
}

/* --- Reading ---------------------------------------------------------------------------------- */

/* Reads a scene whose triangle has these points; returns whether it is there, and when it is
 * touched. */
static bool touches(const char *points, double *t)
{
    imp_scene *scene = array_scene_read(points);
    if (scene == NULL) return false;
    *t = array_scene_solve(scene).t;
    return true;
}

static bool reads(const char *array, double *t)
{
    char object[200];
    snprintf(object, sizeof object, "{\"file\":\"%s\",\"array\":%s}", path, array);
    return touches(object, t);
}

static double time_of_text(void)
{
    double t = 0;
    ck_assert(touches("[[0,-1,-1],[0,1,-1],[0,0,2]]", &t));
    return t;
}

#ifdef HAVE_ZLIB
static const bool has_zlib = true;
#else
static const bool has_zlib = false;
#endif

static void expect_refused(const char *array, const char *message)
{
    double t;
    ck_assert_msg(!reads(array, &t), "read, must be refused: %s", message);
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_msg(strstr(error.text, message) != NULL && strstr(error.text, path) != NULL,
                  "\"%s\", must contain \"%s\"", error.text, message);
}

/* --- Tests ------------------------------------------------------------------------------------ */

START_TEST(an_array_of_an_archive_is_that_of_the_text)
{
    static const member others[] = {{.name = "a.npy"}, {.name = "points.npy"}, {.name = "c.npy"}};
    const double expected = time_of_text();
    double t = 0;
    archive a = pack(others, 3);
    write_file(&a);
    ck_assert_msg(reads("\"points\"", &t), "%s", error.text);
    ck_assert(t == expected);
    a = pack(&(member){.method = DEFLATED}, 1);
    write_file(&a);
    if (has_zlib) {
        ck_assert_msg(reads("\"points\"", &t), "%s", error.text);
        ck_assert(t == expected);
    } else
        expect_refused("\"points\"", "write it by numpy.savez, not numpy.savez_compressed");
}
END_TEST

START_TEST(other_archives_are_refused_with_the_reason)
{
    static const struct {
        member members[2];
        size_t count;
        const char *array, *message;
    } all[] = {
        {{{.name = "a.npy"}, {.name = "b\n.npy"}}, 2, "\"points\"", "but 'a', 'b?'"},
        {{{.name = "points"}}, 1, "\"points\"", "it has no such array"},
        {{{.name = "points.npy"}}, 0, "\"points\"", "it has no such array"},
        {{{.name = "points.npy"}, {.name = "points.npy"}}, 2, "\"points\"", "two arrays of that"},
        {{{.flags = 1}}, 1, "\"points\"", "it needs a password"},
        {{{.method = 14}}, 1, "\"points\"", "by another method than deflate"},
        {{{.more_size = 1}}, 1, "\"points\"", "to be larger than what is packed there can be"},
        {{{.method = DEFLATED, .more_size = 1 << 17}}, 1, "\"points\"", "larger than what is"},
        {{{.more_size = 400, .more_packed = 400}}, 1, "\"points\"", "ends beyond the directory"},
        {{{.more_at = 1}}, 1, "\"points\"", "not where the directory says"},
        {{{.more_at = UINT32_MAX / 2}}, 1, "\"points\"", "not where the directory says"},
        {{{.name = "points.npy"}}, 1, "7", "or {\"file\": NAME, \"array\": NAME} of a .npz"},
        {{{.name = "points.npy"}}, 1, "\"\"", "or {\"file\": NAME, \"array\": NAME} of a .npz"},
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        double t;
        const archive a = pack(all[k].members, all[k].count);
        write_file(&a);
        ck_assert_msg(!reads(all[k].array, &t) && error.code == IMP_ERROR_SCENE &&
                          strstr(error.text, all[k].message) != NULL,
                      "case %zu: %s", k, error.text);
    }
}
END_TEST

START_TEST(names_are_asked_for_where_there_are_some_and_else_not)
{
    char object[100];
    double t;
    const archive a = pack(&(member){.name = NULL}, 1);
    write_file(&a);
    snprintf(object, sizeof object, "{\"file\":\"%s\"}", path);
    ck_assert(!touches(object, &t));
    ck_assert_msg(strstr(error.text, "add \"array\": NAME of one of its arrays: 'points'") != NULL,
                  "%s", error.text);
    archive plain = {.size = ARRAY_BYTES};
    write_array(plain.at);
    write_file(&plain);
    ck_assert(touches(object, &t));
    expect_refused("\"points\"", "leave out \"array\"");
}
END_TEST

START_TEST(archives_that_end_early_are_refused_wherever_they_end)
{
    archive a = pack(&(member){.method = has_zlib ? DEFLATED : STORED}, 1);
    while (a.size-- > 0) {
        double t;
        write_file(&a);
        ck_assert(!reads("\"points\"", &t));
        ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    }
}
END_TEST

/* Dates, versions and rights may be anything. Numbers that are not those of the sum never pass. */
START_TEST(a_damaged_archive_is_refused_or_read_as_it_was)
{
    const double expected = time_of_text();
    for (int packed = 0; packed <= has_zlib; ++packed) {
        const archive sound = pack(&(member){.method = packed ? DEFLATED : STORED}, 1);
        size_t refused = 0;
        for (size_t k = 0; k < sound.size; ++k) {
            archive a = sound;
            double t = 0;
            a.at[k] ^= (unsigned char)(1u << (k % 8));
            write_file(&a);
            if (reads("\"points\"", &t))
                ck_assert_msg(t == expected, "byte %zu, packed %d", k, packed);
            else
                ++refused;
        }
        ck_assert_uint_gt(refused, sound.size * 3 / 4);
    }
}
END_TEST

/* A member whose numbers are larger than the limit is not even begun. */
START_TEST(limits_on_reading_count_arrays_of_archives)
{
    double t;
    const archive a = pack(&(member){.name = NULL}, 1);
    write_file(&a);
    ck_assert_int_eq(imp_registry_limit_reading(registry, 0, 900, &error), IMP_SUCCESS);
    ck_assert(!reads("\"points\"", &t));
    ck_assert_int_eq(error.code, IMP_ERROR_LIMIT);
    ck_assert_int_eq(imp_registry_limit_reading(registry, 0, 1 << 20, &error), IMP_SUCCESS);
    ck_assert(reads("\"points\"", &t));
}
END_TEST

/* --- Certificates ----------------------------------------------------------------------------- */

static char *sources_after(bool is_replaced)
{
    char text[300], other[sizeof path + 4];
    const archive a = pack(&(member){.name = NULL}, 1);
    write_file(&a);
    snprintf(text, sizeof text,
             "{\"bodies\":[{\"surfaces\":[{\"type\":\"triangle\",\"points\":{\"file\":\"%s\","
             "\"array\":\"points\"}}]}]}",
             path);
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "scene", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    snprintf(other, sizeof other, "%s.old", path);
    if (is_replaced) {
        ck_assert_int_eq(rename(path, other), 0);
        write_file(&a);
        unlink(other);
    }
    char *sources = imp_scene_sources(scene, &error);
    ck_assert_ptr_nonnull(sources);
    imp_scene_free(scene);
    return sources;
}

START_TEST(a_certificate_has_the_hash_of_the_file_that_was_read)
{
    char expected[200];
    char *sources = sources_after(true);
    snprintf(expected, sizeof expected, "file - %s\n", path);
    ck_assert_msg(strstr(sources, expected) != NULL, "%s", sources);
    free(sources);
    sources = sources_after(false);
    const char *line = strstr(sources, "file ");
    ck_assert_msg(line != NULL && strspn(line + 5, "0123456789abcdef") == 64 &&
                      strstr(line, path) == line + 5 + 65,
                  "%s", sources);
    free(sources);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {an_array_of_an_archive_is_that_of_the_text,
                                  other_archives_are_refused_with_the_reason,
                                  names_are_asked_for_where_there_are_some_and_else_not,
                                  archives_that_end_early_are_refused_wherever_they_end,
                                  a_damaged_archive_is_refused_or_read_as_it_was,
                                  limits_on_reading_count_arrays_of_archives,
                                  a_certificate_has_the_hash_of_the_file_that_was_read};
    return suite_main_with("array_archives", tests, sizeof tests / sizeof *tests, array_scene_begin,
                           array_scene_end);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/mesh_bytes.h"

/* OBJ, OFF, STL and PLY files, and polygons that are cut into triangles. */

/* --- OBJ, OFF and STL ------------------------------------------------------------------------- */

START_TEST(obj_files_are_read_as_people_have_them)
{
    READ(MESH_OBJ,
         "mtllib a.mtl\no part\nv 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 0 1 0\nl 1 2 3\np 1\n"
         "usemtl red\ng all\ns off\nf -3/1/1 -2//2 -1",
         3, 1, 2);
    READ(MESH_OBJ, "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\nf 1 2 3\r\nf 1 1 2\r\n", 3, 3, 0);
    READ(MESH_OBJ, "cstype bezier\nv 0 0 0\nv 1 0 0\nv 0 1 0\ncurv 0 1 1 2\nend\nf 1 2 3", 3, 1, 3);
    REFUSED(MESH_OBJ, "v 0 0 0\nl 1 1\n", 0, "no faces in it");
    REFUSED(MESH_OBJ, "v 0 0\n", 1, "a point of 2 numbers, must have 3");
}
END_TEST

START_TEST(off_files_have_comments_and_colours)
{
    READ(MESH_OFF, "# made by hand\nOFF # here\n\n3 1 0\n0 0 0\n# two more\n1 0 0\n0 1 0\n3 0 1 2",
         3, 1, 0);
    READ(MESH_OFF, "CNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n", 3, 1, 0);
    REFUSED(MESH_OFF, "4OFF\n3 1 0\n", 1, "must begin with OFF");
    REFUSED(MESH_OFF, "OFF\n999999999999999 1 0\n0 0 0\n", 3, "the file ends before point 1");
}
END_TEST

static bytes binary_stl(const char *head, uint32_t count, size_t written)
{
    bytes b = {.length = 0};
    char start[80] = "";
    memcpy(start, head, strlen(head));
    add(&b, start, sizeof start);
    add_word(&b, count, false);
    for (size_t k = 0; k < written; ++k) {
        for (int i = 0; i < 12; ++i) add_float(&b, (float)(i == 3 || i == 7), false);
        add(&b, "\0\0", 2);
    }
    return b;
}

START_TEST(stl_files_are_told_apart_by_their_length)
{
    const bytes plain = binary_stl("", 2, 2), solid = binary_stl("solid of Rhino", 3, 3);
    check_read(MESH_STL, &plain, 6, 2, 0);
    check_read(MESH_STL, &solid, 9, 3, 0);
    const bytes huge = binary_stl("", 0xffffffff, 2);
    check_refused(MESH_STL, &huge, 0, -1, "for 4294967295 triangles");
    bytes broken = binary_stl("", 2, 2);
    const float none = NAN;
    memcpy(broken.at + 84 + 50 + 12, &none, sizeof none);
    check_refused(MESH_STL, &broken, 0, 84 + 50 + 12, "coordinate");
    READ(MESH_STL,
         "\n SOLID x\r\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\n"
         "VERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID x",
         3, 1, 0);
}
END_TEST

/* --- PLY -------------------------------------------------------------------------------------- */

#define PLY_HEAD                                                                                   \
    "comment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"                 \
    "property uchar red\nproperty float z\nelement edge 1\nproperty int vertex1\n"                 \
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

START_TEST(ply_text_is_read)
{
    READ(MESH_PLY,
         "ply\nformat ascii 1.0\n" PLY_HEAD
         "0 0 255 0\n1 0 255 0\n1 1\n255 0 0 1 255 0\n7\n4 0 1 2 3",
         4, 2, 1);
    READ(MESH_PLY,
         "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty double x\r\n"
         "property double y\r\nproperty double z\r\nelement face 1\r\n"
         "property list uint8 uint32 vertex_index\r\nend_header\r\n"
         "0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n",
         3, 1, 0);
}
END_TEST

static bytes binary_ply(bool is_big_endian, uint32_t last_corner)
{
    bytes b = {.length = 0};
    add_text(&b, "ply\nformat ");
    add_text(&b, is_big_endian ? "binary_big_endian" : "binary_little_endian");
    add_text(&b, " 1.0\n" PLY_HEAD);
    for (int k = 0; k < 4; ++k) {
        add_float(&b, (float)(k == 1 || k == 2), is_big_endian);
        add_float(&b, (float)(k >= 2), is_big_endian);
        add(&b, "\n", 1);
        add_float(&b, 0.5f, is_big_endian);
    }
    add_word(&b, 7, is_big_endian);
    add(&b, "\4", 1);
    for (uint32_t k = 0; k < 4; ++k) add_word(&b, k < 3 ? k : last_corner, is_big_endian);
    return b;
}

START_TEST(ply_binaries_of_both_orders_are_read)
{
    for (int big = 0; big < 2; ++big) {
        const bytes b = binary_ply(big == 1, 3);
        triangles t;
        triangles_fault why;
        check_read(MESH_PLY, &b, 4, 2, 1);
        ck_assert(read_all(MESH_PLY, &b, &t, &why) == IMP_STATUS_OK);
        const double third[3] = {1, 1, 0.5};
        ck_assert_mem_eq(t.point + 6, third, sizeof third);
        triangles_clear(&t);
        const bytes beyond = binary_ply(big == 1, 4);
        check_refused(MESH_PLY, &beyond, 0, (long)beyond.length - 1, "is point 4 of 4");
        const bytes negative = binary_ply(big == 1, 0xffffffff);
        check_refused(MESH_PLY, &negative, 0, (long)negative.length - 1, "got -1");
    }
}
END_TEST

/* A binary file is refused at every shorter length, and text wherever an element is missing. */
START_TEST(ply_files_that_end_early_are_refused)
{
    bytes b = binary_ply(false, 3);
    for (; b.length > 0; --b.length) {
        bytes cut = b;
        cut.length -= 1;
        triangles t;
        triangles_fault why;
        ck_assert_int_eq(read_all(MESH_PLY, &cut, &t, &why), IMP_STATUS_PARAMETER);
        ck_assert(why.text[0] != '\0');
        triangles_clear(&t);
    }
}
END_TEST

START_TEST(broken_ply_heads_are_named)
{
    REFUSED(MESH_PLY, "plx\n", 1, "must begin with the line 'ply'");
    REFUSED(MESH_PLY, "ply\nformat binary 1.0\n", 2, "must be ascii");
    REFUSED(MESH_PLY, "ply\nelement vertex 3\nend_header\n", 3, "no line 'format");
    REFUSED(MESH_PLY, "ply\nformat ascii 1.0\nelement vertex -1\n", 3, "no number of elements");
    REFUSED(MESH_PLY, "ply\nformat ascii 1.0\nproperty float x\n", 3, "before the first element");
    REFUSED(MESH_PLY, "ply\nformat ascii 1.0\nelement face 1\nproperty list float3 int x\n", 4,
            "'float3' is no type");
    REFUSED(MESH_PLY,
            "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int corners\n"
            "end_header\n",
            5, "has no list 'vertex_indices'");
    REFUSED(MESH_PLY, "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n", 5,
            "no property 'y'");
    REFUSED(MESH_PLY, "ply\nformat ascii 1.0\nelement tristrips 1\n", 3, "strips of triangles");
    REFUSED(MESH_PLY, "ply\nformat ascii 1.0\nelement empty 999999999999999\nend_header\n", 0,
            "no faces in it");
    REFUSED(MESH_PLY,
            "ply\nformat ascii 1.0\nelement face 999999999999999\n"
            "property list uchar int vertex_indices\nend_header\n999999999 0 0\n",
            6, "the file ends before");
}
END_TEST

/* --- Polygons --------------------------------------------------------------------------------- */

/* Twice the area of a triangle of plane points. */
static double area(const double *p, const double *q, const double *r)
{
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/* The cuts of a star-shaped polygon of `count` corners have its area, and go round as it does. */
static void check_cut(const double *point, size_t count)
{
    int64_t corner[64];
    uint32_t cut[3 * 62];
    bool is_simple;
    double whole = 0, sum = 0;
    for (size_t k = 0; k < count; ++k) corner[k] = (int64_t)k;
    ck_assert(polygon_cut(point, corner, count, cut, &is_simple) == IMP_STATUS_OK);
    ck_assert(is_simple);
    const double *const origin = (const double[]){0, 0, 0};
    for (size_t k = 0; k < count; ++k)
        whole += area(origin, point + 3 * k, point + 3 * ((k + 1) % count));
    for (size_t k = 0; k < count - 2; ++k) {
        const double twice =
            area(point + 3 * cut[3 * k], point + 3 * cut[3 * k + 1], point + 3 * cut[3 * k + 2]);
        ck_assert(twice * whole > -1e-12);
        sum += fabs(twice);
    }
    ck_assert_msg(fabs(sum - fabs(whole)) < 1e-9, "%g, must be %g", sum, fabs(whole));
}

START_TEST(ears_cover_a_polygon_once)
{
    uint64_t state = suite_seed();
    for (int n = 0; n < suite_times(400); ++n) {
        double point[3 * 64];
        const size_t count = 4 + (size_t)(random_bits(&state) % 61);
        const double way = random_bits(&state) % 2 ? 1 : -1;
        for (size_t k = 0; k < count; ++k) {
            const double angle = way * 6.283185307179586 * (double)k / (double)count;
            const double radius = random_between(&state, 0.1, 1);
            point[3 * k] = radius * cos(angle);
            point[3 * k + 1] = radius * sin(angle);
            point[3 * k + 2] = random_between(&state, -0.01, 0.01);
        }
        check_cut(point, count);
    }
}
END_TEST

START_TEST(polygons_that_cross_themselves_are_refused)
{
    REFUSED(MESH_OBJ, "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 2 0\nf 1 2 3 4", 5, "crosses itself");
    REFUSED(MESH_OBJ, "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4", 5, "crosses itself");
    READ(MESH_OBJ, "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4", 4, 2, 0);
    READ(MESH_OBJ, "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3 4", 4, 2, 0);
    /* a square with a square hole, as one polygon that passes two points twice */
    READ(MESH_OBJ,
         "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 1 2 0\nv 2 2 0\nv 2 1 0\n"
         "f 1 2 3 4 1 5 6 7 8 5",
         8, 8, 0);
}
END_TEST

/* The note of a mesh lists everything that was left out or changed. */
START_TEST(notes_count_what_was_done)
{
    const bytes b = text_of("v 0 0 0\nv 2 0 0\nv .1 .1 0\nv 0 2 0\nl 1 2\nf 1 2 3 4\nf 1 1 2\n");
    triangles t;
    triangles_fault why;
    char text[200];
    ck_assert(read_all(MESH_OBJ, &b, &t, &why) == IMP_STATUS_OK);
    ck_assert_uint_eq(triangles_tell(&t, text, sizeof text), 3);
    ck_assert_str_eq(text, "statements that are no faces, left out: 1, the first in line 5; "
                           "faces not plane and convex, cut into triangles: 1, the first in line "
                           "6; triangles without area, taken as segments: 1");
    triangles_clear(&t);
}
END_TEST

SUITE_MAIN("mesh_files", obj_files_are_read_as_people_have_them,
           off_files_have_comments_and_colours, stl_files_are_told_apart_by_their_length,
           ply_text_is_read, ply_binaries_of_both_orders_are_read,
           ply_files_that_end_early_are_refused, broken_ply_heads_are_named,
           ears_cover_a_polygon_once, polygons_that_cross_themselves_are_refused,
           notes_count_what_was_done)

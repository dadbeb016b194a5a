/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plugins/mesh/mesh_file.h"
#include "plugins/mesh/polygon.h"
#include "tests/support/sandbox.h"
#include "tests/support/suite.h"

/* What the readers of mesh files make of whole files, and what they say of broken ones. */

/* A file that is being written. */
typedef struct bytes {
    char at[4096];
    size_t length;
} bytes;

static void add(bytes *b, const void *data, size_t size)
{
    ck_assert(b->length + size <= sizeof b->at);
    memcpy(b->at + b->length, data, size);
    b->length += size;
}

static void add_text(bytes *b, const char *text) { add(b, text, strlen(text)); }

/* `size` bytes of a number, the last first if the file wants it so. */
static void add_number(bytes *b, const void *data, size_t size, bool is_big_endian)
{
    const char *from = data;
    for (size_t k = 0; k < size; ++k) add(b, from + (is_big_endian ? size - 1 - k : k), 1);
}

static void add_float(bytes *b, float x, bool is_big_endian)
{
    add_number(b, &x, sizeof x, is_big_endian);
}

static void add_word(bytes *b, uint32_t x, bool is_big_endian)
{
    add_number(b, &x, sizeof x, is_big_endian);
}

static imp_status read_all(mesh_format format, const bytes *b, triangles *to, triangles_fault *why)
{
    *to = (triangles){.count = 0};
    *why = (triangles_fault){0, "", 0};
    char *exact = malloc(b->length + (b->length == 0)); /* reading beyond it shows */
    ck_assert(exact != NULL);
    memcpy(exact, b->at, b->length);
    const imp_status status = mesh_read_bytes(format, exact, b->length, NULL, to, why);
    free(exact);
    return status;
}

/* The file has that many points and triangles, and left out that much. */
static void check_read(mesh_format format, const bytes *b, size_t points, size_t count,
                       size_t left_out)
{
    triangles t;
    triangles_fault why;
    ck_assert_msg(read_all(format, b, &t, &why) == IMP_STATUS_OK, "%s", why.text);
    ck_assert_uint_eq(t.point_count, points);
    ck_assert_uint_eq(t.count, count);
    ck_assert_uint_eq(t.left_out.count, left_out);
    triangles_clear(&t);
}

/* The file is refused with a text that has these words in it, at that line or byte (from 0). */
static void check_refused(mesh_format format, const bytes *b, size_t line, long byte,
                          const char *words)
{
    triangles t;
    triangles_fault why;
    ck_assert_int_eq(read_all(format, b, &t, &why), IMP_STATUS_PARAMETER);
    ck_assert_msg(strstr(why.text, words) != NULL, "got: %s", why.text);
    ck_assert_uint_eq(why.line, line);
    ck_assert_int_eq((long)why.byte - 1, byte);
    triangles_clear(&t);
}

static bytes text_of(const char *text)
{
    bytes b = {.length = 0};
    add_text(&b, text);
    return b;
}

#define READ(FORMAT, TEXT, POINTS, COUNT, LEFT_OUT)                                                \
    check_read(FORMAT, &(const bytes[]){text_of(TEXT)}[0], POINTS, COUNT, LEFT_OUT)
#define REFUSED(FORMAT, TEXT, LINE, WORDS)                                                         \
    check_refused(FORMAT, &(const bytes[]){text_of(TEXT)}[0], LINE, -1, WORDS)

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

/* --- glTF ------------------------------------------------------------------------------------- */

/* A square of two triangles: four points, then six indices of 16 bits. */
#define GLTF_MESHES                                                                                \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"                                           \
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12}],"                                         \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"      \
    "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}],"                  \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]"
#define GLTF_HEAD "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":60}],"

static bytes glb_of(const char *json)
{
    bytes b = {.length = 0};
    const float points[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    add_text(&b, "glTF");
    add_word(&b, 2, false);
    add_word(&b, (uint32_t)(12 + 8 + strlen(json) + 8 + 60), false);
    add_word(&b, (uint32_t)strlen(json), false);
    add_text(&b, "JSON");
    add_text(&b, json);
    add_word(&b, 60, false);
    add(&b, "BIN", 4);
    for (int k = 0; k < 12; ++k) add_float(&b, points[k], false);
    for (int k = 0; k < 6; ++k) add_number(&b, &indices[k], sizeof indices[k], false);
    return b;
}

START_TEST(glb_nodes_are_placed_by_their_transforms)
{
    const bytes b = glb_of(GLTF_HEAD GLTF_MESHES
                           ",\"nodes\":[{\"children\":[1,2],\"translation\":[10,0,0]},"
                           "{\"mesh\":0,\"scale\":[2,2,2],\"rotation\":[0,0,1,0]},"
                           "{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,-1,0,0,0,5,1]}]}");
    triangles t;
    triangles_fault why;
    check_read(MESH_GLTF, &b, 8, 4, 0);
    ck_assert(read_all(MESH_GLTF, &b, &t, &why) == IMP_STATUS_OK);
    ck_assert(t.point[6] == 10 - 2 && t.point[7] == -2 && t.point[8] == 0);
    ck_assert(t.point[18] == 11 && t.point[19] == 1 && t.point[20] == 5);
    /* a reflection turns its triangles round, so that what is outside stays so */
    ck_assert_uint_eq(t.corner[6], 6);
    ck_assert_uint_eq(t.corner[7], 5);
    ck_assert_uint_eq(t.corner[8], 4);
    triangles_clear(&t);
}
END_TEST

START_TEST(gltf_buffers_may_be_text)
{
    READ(MESH_GLTF,
         "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36,\"uri\":"
         "\"data:application/octet-stream;base64,"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"
         "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
         "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
         "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}},"
         "{\"attributes\":{\"POSITION\":0},\"mode\":1}]}],"
         "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0},{\"mesh\":0}]}",
         3, 1, 1);
}
END_TEST

/* Its bytes are not told by the document's name, so such a mesh is not kept for later scenes. */
START_TEST(gltf_buffers_in_other_files_are_noticed)
{
    static const char other[] =
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36,\"uri\":\"a.bin\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]}";
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const bytes whole = glb_of(GLTF_HEAD GLTF_MESHES ",\"nodes\":[{\"mesh\":0}]}");
    const sandbox box = sandbox_new();
    triangles to = {.count = 0};
    imp_create_error why = {.struct_size = sizeof why};
    sandbox_write(&box, "a.bin", (const char *)corners, sizeof corners);
    sandbox_write(&box, "a.gltf", other, sizeof other - 1);
    sandbox_write(&box, "a.glb", whole.at, whole.length);
    ck_assert(mesh_read_file(sandbox_file(&box, "a.gltf").at, 0, &to, &why) == IMP_STATUS_OK);
    ck_assert(to.count == 1 && why.is_repeatable == 0);
    triangles_clear(&to);
    ck_assert(mesh_read_file(sandbox_file(&box, "a.glb").at, 0, &to, &why) == IMP_STATUS_OK);
    ck_assert(to.count == 2 && why.is_repeatable == 1);
    triangles_clear(&to);
    sandbox_remove(&box);
}
END_TEST

static void check_glb_refused(const char *json, const char *words)
{
    const bytes b = glb_of(json);
    check_refused(MESH_GLTF, &b, 0, -1, words);
}

START_TEST(broken_gltf_documents_are_named)
{
    const char *const nodes = ",\"nodes\":[{\"mesh\":0}]}";
    char text[2048];
    check_glb_refused("{\"asset\":{\"version\":\"1.0\"}}", "must be 2.0");
    check_glb_refused("{\"asset\":{\"version\":\"2.0\"},"
                      "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}",
                      "needs the extension 'KHR_draco_mesh_compression'");
    check_glb_refused("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"children\":[1]},"
                      "{\"children\":[1]}]}",
                      "one parent only");
    check_glb_refused("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":3}]}",
                      "/meshes/3 does not exist");
    static const char *const changes[][3] = {
        {"\"count\":4", "\"count\":5", "/accessors/0: ends behind its bufferView"},
        {"\"count\":4", "\"count\":9223372036854775807", "ends behind its bufferView"},
        {"\"byteOffset\":48", "\"byteOffset\":9223372036854775807", "ends behind its buffer"},
        {"\"byteOffset\":48", "\"byteOffset\":-1", "whole numbers from 0"},
        {"\"byteLength\":60", "\"byteLength\":61", "61 of 60 bytes that are there"},
        {"5126", "5124", "componentType must be"},
        {"VEC3", "VEC2", "type must be VEC3"},
        {"\"byteOffset\":48", "\"byteOffset\":8", "of 4 points"},
        {"\"mesh\":0", "\"mesh\":0,\"scale\":[1,2]", "must be lists of"},
        {"\"mesh\":0", "\"mesh\":0,\"rotation\":[0,0,0,0]", "must be lists of"},
        {"5123", "5120", "unsigned whole numbers"}};
    for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
        char whole[2048];
        snprintf(whole, sizeof whole, "%s%s%s", GLTF_HEAD, GLTF_MESHES, nodes);
        const char *at = strstr(whole, changes[k][0]);
        ck_assert(at != NULL);
        snprintf(text, sizeof text, "%.*s%s%s", (int)(at - whole), whole, changes[k][1],
                 at + strlen(changes[k][0]));
        check_glb_refused(text, changes[k][2]);
    }
    REFUSED(MESH_GLTF, "{\"asset\":\n{\"version\" 2}}", 2, "JSON: ");
    REFUSED(MESH_GLTF,
            "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":1,\"uri\":\"/etc/x\"}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":1}],\"accessors\":[{\"bufferView\":0,"
            "\"componentType\":5126,\"count\":0,\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":["
            "{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]}",
            0, "must be a file beside this one");
}
END_TEST

START_TEST(glb_files_that_end_early_are_refused)
{
    char json[1024];
    snprintf(json, sizeof json, "%s%s,\"nodes\":[{\"mesh\":0}]}", GLTF_HEAD, GLTF_MESHES);
    const bytes whole = glb_of(json);
    check_read(MESH_GLTF, &whole, 4, 2, 0);
    for (bytes b = whole; b.length > 0;) {
        triangles t;
        triangles_fault why;
        b.length -= 1;
        ck_assert_int_eq(read_all(MESH_GLTF, &b, &t, &why), IMP_STATUS_PARAMETER);
        triangles_clear(&t);
    }
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
           glb_nodes_are_placed_by_their_transforms, gltf_buffers_may_be_text,
           gltf_buffers_in_other_files_are_noticed, broken_gltf_documents_are_named,
           glb_files_that_end_early_are_refused, ears_cover_a_polygon_once,
           polygons_that_cross_themselves_are_refused, notes_count_what_was_done)

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/mesh_bytes.h"

/* glTF and GLB files. */

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

SUITE_MAIN("gltf_files", glb_nodes_are_placed_by_their_transforms, gltf_buffers_may_be_text,
           gltf_buffers_in_other_files_are_noticed, broken_gltf_documents_are_named,
           glb_files_that_end_early_are_refused)

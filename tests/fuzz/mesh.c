/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "plugins/mesh/mesh_file.h"
#include "plugins/subdivision/control_mesh.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_mutate.h"

#include <string.h>

/* Whatever bytes a file of triangles holds, it is read or refused with a reason. What was read has
 * triangles, corners that are there and coordinates within limits, and is the same to the last bit
 * when it is written out as OFF and read again. With faces kept whole, a control mesh is made of
 * them or refused; its half-edges are each other's twins, also after a step. The input's first byte
 * says which format it is in. */

const char fuzz_target[] = "mesh";

FUZZ_MUTATE_TEXT

static bool read_bytes(mesh_format format, const char *bytes, size_t length, triangles *to)
{
    triangles_fault fault = {0, "", 0};
    const imp_status status = mesh_read_bytes(format, bytes, length, NULL, to, &fault);
    if (status == IMP_STATUS_OK) return true;
    FUZZ_REQUIRE(status == IMP_STATUS_INTERNAL ||
                 (status == IMP_STATUS_PARAMETER && fault.text[0] != '\0'));
    FUZZ_REQUIRE(fault.line <= length + 1 && fault.byte <= length + 1);
    return false;
}

static void judge(const triangles *t)
{
    FUZZ_REQUIRE(t->count > 0 && t->point_count > 0);
    for (size_t k = 0; k < 3 * t->count; ++k) FUZZ_REQUIRE(t->corner[k] < t->point_count);
    for (size_t k = 0; k < 3 * t->point_count; ++k)
        FUZZ_REQUIRE(fabs(t->point[k]) <= TRIANGLES_FAR);
}

static char *write_off(const triangles *t, size_t *length)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, length);
    FUZZ_REQUIRE(out != NULL);
    fprintf(out, "OFF\n%zu %zu 0\n", t->point_count, t->count);
    for (size_t k = 0; k < t->point_count; ++k)
        fprintf(out, "%.17g %.17g %.17g\n", t->point[3 * k], t->point[3 * k + 1],
                t->point[3 * k + 2]);
    for (size_t k = 0; k < t->count; ++k)
        fprintf(out, "3 %u %u %u\n", t->corner[3 * k], t->corner[3 * k + 1], t->corner[3 * k + 2]);
    FUZZ_REQUIRE(fclose(out) == 0);
    return text;
}

static void judge_twins(const control_mesh *m)
{
    for (uint32_t h = 0; h < m->corner_count; ++h) {
        const uint32_t twin = m->twin[h];
        if (twin == CONTROL_NONE) continue;
        FUZZ_REQUIRE(twin < m->corner_count && m->twin[twin] == h);
        FUZZ_REQUIRE(m->corner[twin] == control_end(m, h) && control_end(m, twin) == m->corner[h]);
    }
}

/* With `loop`: of Loop's scheme. */
static void judge_control_mesh(mesh_format format, const char *bytes, size_t length,
                               const box_tables *loop)
{
    triangles faces = {.keeps_faces = true};
    triangles_fault fault = {0, "", 0};
    control_mesh coarse = {0}, fine = {0};
    bool *wanted_fine = NULL;
    if (read_bytes(format, bytes, length, &faces)) {
        const imp_status status = control_begin(&coarse, &faces, NULL, loop, &fault);
        FUZZ_REQUIRE(status == IMP_STATUS_OK ||
                     (status == IMP_STATUS_PARAMETER && fault.text[0] != '\0'));
        if (status == IMP_STATUS_OK) {
            bool *wanted = calloc(coarse.face_count, sizeof *wanted);
            FUZZ_REQUIRE(wanted != NULL);
            judge_twins(&coarse);
            wanted[coarse.face_count / 2] = true;
            FUZZ_REQUIRE(control_refine(&coarse, wanted, &fine, &wanted_fine) == IMP_STATUS_OK);
            judge_twins(&fine);
            free(wanted);
        }
    }
    free(wanted_fine);
    control_clear(&fine);
    control_clear(&coarse);
    triangles_clear(&faces);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    static const mesh_format formats[] = {MESH_OBJ, MESH_OFF, MESH_STL, MESH_PLY, MESH_GLTF};
    enum { FORMATS = sizeof formats / sizeof *formats };
    triangles first = {0}, second = {0};
    if (length == 0) return 0;
    const mesh_format format = formats[(unsigned char)(bytes[0] - '0') % FORMATS];
    judge_control_mesh(format, (const char *)bytes + 1, length - 1, NULL);
    static const box_tables tables; /* steps only pass them on */
    judge_control_mesh(format, (const char *)bytes + 1, length - 1, &tables);
    if (read_bytes(format, (const char *)bytes + 1, length - 1, &first)) {
        judge(&first);
        size_t written = 0;
        char *text = write_off(&first, &written);
        FUZZ_REQUIRE(read_bytes(MESH_OFF, text, written, &second));
        FUZZ_REQUIRE(second.point_count == first.point_count && second.count == first.count);
        FUZZ_REQUIRE(memcmp(second.point, first.point, 3 * first.point_count * sizeof(double)) ==
                     0);
        FUZZ_REQUIRE(memcmp(second.corner, first.corner, 3 * first.count * sizeof(uint32_t)) == 0);
        free(text);
    }
    triangles_clear(&first);
    triangles_clear(&second);
    return 0;
}

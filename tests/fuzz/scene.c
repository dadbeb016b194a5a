/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "tests/fuzz/fuzz_mutate.h"
#include "tests/fuzz/fuzz_registry.h"
#include "tests/fuzz/scene_judge.h"

#include <math.h>
#include <string.h>

/* Whatever bytes a scene or a pipeline is made of, it is read or refused. What is read is solved
 * with --audit under small limits, and the answer is judged (scene_judge.h). */

const char fuzz_target[] = "scene";

enum { PAIRS = 500, SURFACES = 8 };

FUZZ_MUTATE_TEXT

static bool is_small(const imp_scene *scene)
{
    size_t count = 0;
    for (size_t b = 0; b < imp_scene_body_count(scene); ++b)
        count += imp_scene_surface_count(scene, b);
    return imp_scene_body_count(scene) == 2 && count <= SURFACES;
}

/* Whether a number of the input is beyond 1e100, up to which our types promise finite answers. */
static bool has_huge_number(const char *text)
{
    while (*text != '\0') {
        char *end;
        const double x = strtod(text, &end);
        if (end != text && !(fabs(x) <= 1e100)) return true;
        text = end != text ? end : text + 1;
    }
    return false;
}

/* Our own types keep their promises; but a formula may be undefined where its domain says
 * otherwise. */
static void judge_error(imp_code code, const imp_error *error, const char *input)
{
    FUZZ_REQUIRE(text_is_line(error->text) && error->text[0] != '\0');
    if (code != IMP_ERROR_PLUGIN || strstr(error->text, "is undefined there") != NULL) return;
    if (has_huge_number(input)) return;
    fprintf(stderr, "accused: %s\n", error->text);
    FUZZ_REQUIRE(code != IMP_ERROR_PLUGIN);
}

static void solve_and_judge(imp_scene *scene, const char *input)
{
    if (scene == NULL || !is_small(scene)) return;
    imp_options options = imp_options_default(scene);
    imp_result r = {.struct_size = (uint32_t)sizeof r};
    imp_error error = {IMP_SUCCESS, ""};
    options.max_pairs = PAIRS;
    options.max_bytes = 1 << 26;
    options.audit = true;
    const imp_code code = imp_scene_solve(scene, &options, &r, &error);
    if (code != IMP_SUCCESS) {
        judge_error(code, &error, input);
        return;
    }
    const uint64_t seed = strlen(input);
    scene_judge(scene, &options, &r, seed);
    options.audit = false;
    if (seed % 4 == 0) scene_judge_by_clearance(scene, &options, &r);
}

/* Two lines: the pipelines of two bodies; one: the same of both. */
static void try_pipelines(imp_registry *ours, imp_registry *with_tests, char *line,
                          const char *input)
{
    imp_error error;
    char *second = strchr(line, '\n');
    if (second != NULL) *second++ = '\0';
    imp_scene_free(imp_scene_from_pair(with_tests, line, line, &error));
    imp_scene *scene = imp_scene_from_pair(ours, line, second != NULL ? second : line, &error);
    solve_and_judge(scene, input);
    imp_scene_free(scene);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    static imp_registry *ours, *with_tests;
    if (ours == NULL) ours = fuzz_registry(false);
    if (with_tests == NULL) with_tests = fuzz_registry(true);
    char *input = strndup((const char *)bytes, length),
         *line = strndup((const char *)bytes, length);
    if (input != NULL && line != NULL) {
        imp_error error;
        const char *text = (const char *)bytes;
        imp_scene_free(imp_scene_from_json(with_tests, text, length, "input", &error));
        imp_scene *scene = imp_scene_from_json(ours, text, length, "input", &error);
        solve_and_judge(scene, input);
        imp_scene_free(scene);
        try_pipelines(ours, with_tests, line, input);
    }
    free(line);
    free(input);
    return 0;
}

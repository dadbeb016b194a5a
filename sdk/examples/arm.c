/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#include <impinge/impinge.h>
#include <stdio.h>

/* Does a six-joint arm stay 2 mm away from a fixture? Its joint angles come from a CSV file.
 *
 *     cc arm.c $(pkg-config --cflags --libs impinge) -o arm && ./arm tools/data/arm.json */

static const char *const verdicts[] = {"not asked", "holds", "violated", "undecided"};

static int fail(const imp_error *error)
{
    fprintf(stderr, "%s\n", error->text);
    return 1;
}

/* The answer to one question about the scene. */
static imp_code ask(imp_scene *scene, double required, imp_clearance *answer, imp_error *error)
{
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.required = required; /* asked.decide = true would end it with the verdict */
    imp_query *query = imp_clearance_new(scene, &options, &asked, error);
    if (query == NULL) return error->code;
    answer->struct_size = sizeof *answer;
    imp_code code = imp_query_step(query, 0, error);
    if (code == IMP_SUCCESS) code = imp_clearance_get(query, 0, answer, error);
    imp_query_free(query);
    return code;
}

int main(int argc, char **argv)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_clearance answer;
    imp_registry *registry = imp_registry_new(NULL);
    if (argc != 2 || registry == NULL) {
        fprintf(stderr, argc != 2 ? "usage: arm SCENE\n" : "arm: out of memory\n");
        return 2;
    }
    imp_scene *scene = imp_scene_from_file(registry, argv[1], &error);
    if (scene == NULL) return fail(&error);
    if (ask(scene, 2, &answer, &error) != IMP_SUCCESS) return fail(&error);
    printf("%s, tightest %.4g mm at t = %.3g between %s and %s\n", verdicts[answer.verdict],
           answer.upper, answer.t, imp_scene_body_name(scene, answer.a.body),
           imp_scene_body_name(scene, answer.b.body));
    imp_scene_free(scene);
    imp_registry_free(registry);
    return 0;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/recorded.h"

#include <string.h>

#include "tools/cli/result.h"

void recorded_free(recorded *r)
{
    json_decref(r->json);
    *r = (recorded){0};
}

exit_status recorded_read(const char *text, size_t length, const char *name, const char *verb,
                          recorded *r)
{
    *r = (recorded){0};
    json_t *json = json_loadb(text, length, 0, NULL);
    if (json_object_get(json, "verdict") == NULL || json_object_get(json, "bodies") != NULL) {
        json_decref(json);
        return EXIT_ANSWERED;
    }
    const json_t *scene = json_object_get(json, "scene");
    *r = (recorded){
        true,
        json,
        json_string_value(scene),
        {json_string_value(json_array_get(scene, 0)), json_string_value(json_array_get(scene, 1))}};
    if (r->scene != NULL || (r->pair[0] != NULL && r->pair[1] != NULL)) return EXIT_ANSWERED;
    recorded_free(r);
    return complain(EXIT_DATA, verb,
                    "%s: /scene: this result does not name its scene (it was read from standard "
                    "input, or belongs to a batch); view the scene itself",
                    name);
}

static bool vector_of(const json_t *array, vec *v)
{
    if (json_array_size(array) != 3) return false;
    for (size_t k = 0; k < 3; ++k) {
        if (!json_is_number(json_array_get(array, k))) return false;
        v->x[k] = json_number_value(json_array_get(array, k));
    }
    return true;
}

static bool side_of(const json_t *side, const imp_scene *scene, vec *point, size_t *body)
{
    const char *name = json_string_value(json_object_get(side, "body"));
    for (*body = 0; name != NULL && *body < imp_scene_body_count(scene); ++*body)
        if (strcmp(imp_scene_body_name(scene, *body), name) == 0)
            return vector_of(json_object_get(side, "point"), point);
    return false;
}

void recorded_times(const recorded *r, imp_options *options)
{
    const json_t *time = json_object_get(r->json, "time");
    const json_t *from = json_array_get(time, 0), *to = json_array_get(time, 1);
    if (!json_is_number(from) || !json_is_number(to)) return;
    options->t_start = json_number_value(from);
    options->t_end = json_number_value(to);
}

exit_status recorded_contact(const recorded *r, const imp_scene *scene, const char *name,
                             const char *verb, stage_contact *contact)
{
    const char *verdict = json_string_value(json_object_get(r->json, "verdict"));
    const json_t *normal = json_object_get(r->json, "normal");
    *contact = (stage_contact){.t = json_number_value(json_object_get(r->json, "t_lower")),
                               .gap = json_number_value(json_object_get(r->json, "gap")),
                               .gamma = json_number_value(json_object_get(r->json, "gamma"))};
    bool good = verdict != NULL && contact->gamma > 0;
    for (int k = IMP_CLEAR; good && k <= IMP_UNDECIDED; ++k)
        if (strcmp(verdict, result_verdict_name((imp_verdict)k)) == 0)
            contact->verdict = (imp_verdict)k;
    if (good && contact->verdict == IMP_CONTACT) {
        const char *const sides[2] = {"a", "b"};
        for (int k = 0; k < 2; ++k)
            good &= side_of(json_object_get(r->json, sides[k]), scene, &contact->point[k],
                            &contact->body[k]);
        contact->has_normal = vector_of(normal, &contact->normal);
    }
    if (good) return EXIT_ANSWERED;
    return complain(EXIT_DATA, verb, "%s: not a result of the scene that it names", name);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/recorded.h"

#include <string.h>

#include "tools/cli/result.h"

/* A scene has bodies; an answer about two of several bodies names them. */
static recorded_kind kind_of(const json_t *json)
{
    if (json_object_get(json, "bodies") != NULL) return RECORDED_NOTHING;
    if (json_object_get(json, "lower") != NULL && json_object_get(json, "upper") != NULL)
        return RECORDED_CLEARANCE;
    return json_object_get(json, "verdict") != NULL ? RECORDED_RESULT : RECORDED_NOTHING;
}

exit_status recorded_read(const json_t *json, const char *name, const char *verb, recorded *r)
{
    const json_t *scene = json_object_get(json, "scene");
    *r = (recorded){.kind = kind_of(json), .json = json};
    if (r->kind == RECORDED_NOTHING) return EXIT_ANSWERED;
    r->scene = json_string_value(scene);
    for (size_t k = 0; k < 2; ++k) r->pair[k] = json_string_value(json_array_get(scene, k));
    if (r->scene != NULL || (r->pair[0] != NULL && r->pair[1] != NULL)) return EXIT_ANSWERED;
    return complain(EXIT_DATA, verb,
                    "%s: /scene: this result does not name its scene (it was read from standard "
                    "input, or belongs to a batch); view the scene itself",
                    name);
}

bool recorded_vector(const json_t *array, vec *v)
{
    if (json_array_size(array) != 3) return false;
    for (size_t k = 0; k < 3; ++k) {
        if (!json_is_number(json_array_get(array, k))) return false;
        v->x[k] = json_number_value(json_array_get(array, k));
    }
    return true;
}

static bool read_side(const json_t *side, const imp_scene *scene, vec *point, size_t *body)
{
    const char *name = json_string_value(json_object_get(side, "body"));
    for (*body = 0; name != NULL && *body < imp_scene_body_count(scene); ++*body)
        if (strcmp(imp_scene_body_name(scene, *body), name) == 0)
            return recorded_vector(json_object_get(side, "point"), point);
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

/* Reads the spot. False: it names bodies or surfaces that are not in the scene. */
static bool read_spot(const json_t *json, const imp_scene *scene, stage_spot *spot)
{
    const char *const sides[2] = {"a", "b"};
    bool good = true;
    for (int k = 0; k < 2; ++k)
        good &= read_side(json_object_get(json, sides[k]), scene, &spot->point[k], &spot->body[k]);
    spot->t = json_number_value(json_object_get(json, "t"));
    spot->has_normal = recorded_vector(json_object_get(json, "normal"), &spot->normal);
    spot->is_known = good;
    return good;
}

static bool read_result(const json_t *json, const imp_scene *scene, stage_contact *contact,
                        stage_spot *spot)
{
    const char *verdict = json_string_value(json_object_get(json, "verdict"));
    bool known = false;
    contact->is_known = true;
    contact->t = json_number_value(json_object_get(json, "t_lower"));
    contact->gap = json_number_value(json_object_get(json, "gap"));
    contact->gamma = json_number_value(json_object_get(json, "gamma"));
    for (int k = IMP_VERDICT_CLEAR; k <= IMP_VERDICT_UNDECIDED && verdict != NULL; ++k)
        if (strcmp(verdict, result_verdict_name((imp_verdict)k)) == 0)
            contact->verdict = (imp_verdict)k, known = true;
    if (!known || !(contact->gamma > 0)) return false;
    if (contact->verdict != IMP_VERDICT_CONTACT) return true;
    spot->is_contact = true;
    spot->upper = contact->gap;
    return read_spot(json, scene, spot);
}

static bool read_clearance(const json_t *json, const imp_scene *scene, double gamma,
                           stage_spot *spot)
{
    const json_t *upper = json_object_get(json, "upper");
    spot->lower = json_number_value(json_object_get(json, "lower"));
    spot->upper = json_number_value(upper);
    spot->is_contact = json_is_number(upper) && spot->upper <= gamma;
    return !json_is_number(upper) || read_spot(json, scene, spot);
}

exit_status recorded_answer(const recorded *r, const imp_scene *scene, const imp_options *options,
                            const char *name, const char *verb, stage_contact *contact,
                            stage_spot *spot)
{
    *contact = (stage_contact){
        .verdict = IMP_VERDICT_UNDECIDED, .t = options->t_start, .gamma = options->gamma};
    *spot = (stage_spot){.is_known = false};
    const bool good = r->kind == RECORDED_RESULT
                          ? read_result(r->json, scene, contact, spot)
                          : read_clearance(r->json, scene, options->gamma, spot);
    if (good) return EXIT_ANSWERED;
    return complain(EXIT_DATA, verb, "%s: not a result of the scene that it names", name);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/survey_answer.h"

#include <stdio.h>

#include "tools/cli/clearance.h"
#include "tools/cli/output.h"
#include "tools/cli/result.h"
#include "tools/cli/survey_boxes.h"

size_t survey_answer_room(const imp_scene *scene)
{
    return 3 * imp_scene_parameter_count(scene) + 1;
}

static const double *worst_lo(const imp_scene *scene, const survey_answer *answer)
{
    return answer->numbers + imp_scene_parameter_count(scene);
}

static const double *worst_hi(const imp_scene *scene, const survey_answer *answer)
{
    return answer->numbers + 2 * imp_scene_parameter_count(scene);
}

void survey_answer_read(const imp_scene *scene, const imp_survey *survey, survey_answer *answer)
{
    const size_t count = imp_scene_parameter_count(scene);
    answer->state = (imp_survey_state){.struct_size = (uint32_t)sizeof answer->state};
    imp_survey_get_state(survey, &answer->state, NULL);
    answer->has_values = imp_survey_values(survey, answer->numbers);
    imp_survey_worst(survey, answer->numbers + count, answer->numbers + 2 * count);
}

survey_told survey_told_of_contact(const imp_result *result)
{
    return (survey_told){.known = result->verdict == IMP_VERDICT_CONTACT,
                         .undecided = result->verdict == IMP_VERDICT_UNDECIDED,
                         .goal = EXPLAIN_CONTACT};
}

survey_told survey_told_of_clearance(const imp_clearance *clearance)
{
    const bool is_required = clearance->verdict != IMP_REQUIREMENT_NONE;
    return (survey_told){.known = clearance->has_witness,
                         .undecided = clearance_is_undecided(clearance),
                         .goal = is_required ? EXPLAIN_REQUIREMENT : EXPLAIN_DISTANCE};
}

/* --- For programs ----------------------------------------------------------------------------- */

json_t *survey_values_json(const imp_scene *scene, const double *values)
{
    imp_scene_parameter_info info;
    json_t *object = json_object();
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        if (json_object_set_new(object, info.name, output_json_number(values[k])) != 0)
            return json_decref(object), NULL;
    return object;
}

static json_t *worst_json(const imp_scene *scene, const survey_answer *a)
{
    return json_pack("{s:o, s:o, s:o}", "parameters",
                     survey_ranges_json(scene, worst_lo(scene, a), worst_hi(scene, a)), "time",
                     result_times_json(a->state.worst_time[0], a->state.worst_time[1]), "bodies",
                     survey_bodies_json(scene, a->state.worst_body));
}

int survey_answer_set_json(json_t *object, const imp_scene *scene, const survey_answer *a,
                           survey_told told)
{
    int failed = json_object_set_new(object, "boxes", json_integer((json_int_t)a->state.boxes));
    failed |= json_object_set_new(object, "parameters",
                                  told.known ? survey_values_json(scene, a->numbers) : json_null());
    if (!told.undecided) return failed;
    failed |= json_object_set_new(object, "proved", output_json_number(a->state.proved));
    if (a->state.has_worst) failed |= json_object_set_new(object, "worst", worst_json(scene, a));
    if (a->has_values && !told.known)
        failed |=
            json_object_set_new(object, "known",
                                json_pack("{s:o, s:o}", "t", output_json_number(a->state.t_upper),
                                          "parameters", survey_values_json(scene, a->numbers)));
    return failed;
}

/* --- For people ------------------------------------------------------------------------------- */

void survey_answer_print_values(const imp_scene *scene, const double *values)
{
    imp_scene_parameter_info info;
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        printf("%s%s = %.10g", k > 0 ? ", " : "", message_shown(info.name).text, values[k]);
}

static void print_values(const imp_scene *scene, const survey_answer *a)
{
    result_print_label("values");
    survey_answer_print_values(scene, a->numbers);
    putchar('\n');
}

static void print_worst(const imp_scene *scene, const survey_answer *a)
{
    imp_scene_parameter_info info;
    result_print_label("left");
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        printf("%s%s from %.10g to %.10g", k > 0 ? ", " : "", message_shown(info.name).text,
               worst_lo(scene, a)[k], worst_hi(scene, a)[k]);
    printf(", t from %.10g to %.10g\n", a->state.worst_time[0], a->state.worst_time[1]);
}

/* What is proved of the share that is done with. */
static const char *const proved_of[] = {
    [EXPLAIN_CONTACT] = "is proved",
    [EXPLAIN_DISTANCE] = "is done: nothing there is nearer, to within --tolerance",
    [EXPLAIN_REQUIREMENT] = "is proved to keep the distance required",
};

void survey_answer_print(const imp_scene *scene, const survey_answer *a, survey_told told)
{
    if (told.known) print_values(scene, a);
    if (told.undecided) {
        result_print_label("share");
        printf("%s of all values and times %s\n", output_number_lower(a->state.proved).text,
               proved_of[told.goal]);
        if (a->state.has_worst) print_worst(scene, a);
        if (a->has_values && !told.known) {
            result_print_label("known");
            printf("a contact at t = %.10g, but an earlier one is not excluded\n",
                   a->state.t_upper);
            print_values(scene, a);
        }
    }
    result_print_label("boxes");
    printf("%ju\n", (uintmax_t)a->state.boxes);
}

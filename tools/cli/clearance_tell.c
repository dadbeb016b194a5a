/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/clearance_tell.h"

#include <math.h>
#include <stdio.h>

#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"

exit_status clearance_tell_slice(const measuring *m)
{
    const size_t k = m->table.count - 1;
    const imp_clearance slice = clearance_table_get(&m->table, k);
    if (m->json)
        return output_json(clearance_slice_json(&m->table, k, &slice), m->args->verb->name);
    clearance_print_csv(&m->table, k, &slice);
    return EXIT_ANSWERED;
}

imp_clearance clearance_of_nothing(const measuring *m)
{
    const double required = m->asked.required;
    return (imp_clearance){.reason = IMP_REASON_NO_PAIRS,
                           .verdict = required > 0 ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_NONE,
                           .t_start = m->options.t_start,
                           .t_end = m->options.t_end,
                           .required = required,
                           .body = {SIZE_MAX, SIZE_MAX},
                           .lower = INFINITY,
                           .upper = INFINITY,
                           .t = NAN,
                           .t_violated = NAN};
}

static json_t *whole_json(const measuring *m, const imp_clearance *all)
{
    json_t *object = clearance_json(m->scene, all);
    int failed = json_object_set_new(object, "scene", query_scene_json(m->args));
    if (arguments_option(m->args, "within") != NULL)
        failed |= json_object_set_new(object, "beyond", json_integer((json_int_t)m->beyond));
    if (m->not_examined > 0)
        failed |=
            json_object_set_new(object, "not_examined", json_integer((json_int_t)m->not_examined));
    if (object != NULL) failed |= !result_set_warnings(object, m->scene);
    if (object != NULL) failed |= !explain_set_json(object, m->scene, &m->why);
    if (!failed) return object;
    json_decref(object);
    return NULL;
}

static exit_status print(const measuring *m, const imp_clearance *all)
{
    const char *speaker = m->args->verb->name;
    if (m->json && (m->profile || m->each))
        return clearance_print_json(whole_json(m, all), &m->table, m->profile, speaker);
    if (m->json) return output_json(whole_json(m, all), speaker);
    if (m->profile) return EXIT_ANSWERED;
    clearance_print(m->scene, all, m->options.gamma);
    explain_print(m->scene, &m->why);
    if (m->each && m->table.count > 0) clearance_print_pairs(&m->table);
    if (m->beyond > 0)
        printf("never within %.10g: %zu pairs of bodies\n", m->asked.within, m->beyond);
    if (m->not_examined > 0)
        printf("not examined: %zu pairs of bodies%s\n", m->not_examined,
               m->asked.within > 0 ? "" : "; --within D only counts those that stay farther apart");
    return output_flush(speaker);
}

exit_status clearance_conclude(const measuring *m, const clearance_table *shown)
{
    imp_clearance all = shown->count > 0 ? clearance_summary(shown) : clearance_of_nothing(m);
    all.stats = m->stats;
    const exit_status status = print(m, &all);
    return status != EXIT_ANSWERED ? status : clearance_status(&all);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/arguments.h"

#include <string.h>

#include "tools/check/argument_list.h"
#include "tools/check/values.h"

#include <impinge/examine.h>

/* --- The check -------------------------------------------------------------------------------- */

enum { POINTS = 32 };

static imp_status create_from(const arguments_list *list, const imp_instance *like,
                              imp_instance *made)
{
    imp_create_error why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    const imp_value *values = arguments_list_values(list);
    *made = *like;
    return like->surface != NULL ? like->surface->create(values, &made->self, &why)
                                 : like->map->create(values, &made->self, &why);
}

/* The instance from guarded arguments gives the same results as the host's; where they consist of
 * pieces, their first. */
static bool answers_alike(const subject *host, const imp_instance *made, const char *hint)
{
    subject s;
    uint64_t random = 1;
    double p[BOX_DIMS], x[2][3], error[2][3];
    host->answer->call.hint = hint;
    const bool is_made = subject_make(&s, made, made, 0, host->answer);
    host->answer->call.hint = NULL;
    if (!is_made) return false;
    for (int k = 0; k < POINTS; ++k) {
        draw_point(&random, &host->domain, host->n, p);
        const imp_status one = subject_eval(host, 1, p, x[0], error[0]);
        host->answer->call.hint = hint;
        const imp_status other = subject_eval(&s, 1, p, x[1], error[1]);
        host->answer->call.hint = NULL;
        ++host->answer->tests;
        if (one != other || memcmp(x[0], x[1], sizeof x[0]) != 0)
            return answer_fail(host->answer,
                               "two instances of the same parameters differ at %s: create reads "
                               "past an argument, or leaves a member unset",
                               subject_point_text(s.n, p).text);
    }
    return true;
}

static void check_guarded(arguments_list *list, const subject *host, const char *stage)
{
    check_answer *answer = host->answer;
    imp_instance made;
    subject_note_stage(answer, "create", stage);
    answer->call.hint = "whose arguments end where readable memory ends: it reads past one";
    const imp_status status = create_from(list, host->instance, &made);
    subject_note_stage(answer, NULL, NULL);
    if (status != IMP_STATUS_OK) {
        answer_fail(answer, "create returned '%s' for arguments that it accepted before",
                    subject_status_name(status));
        return;
    }
    arguments_list_hide(list);
    if (answers_alike(host, &made, "though create's arguments are gone: it keeps a pointer to one"))
        answer_pass(answer,
                    "create reads no more than its %zu argument%s, and keeps no pointer to them",
                    list->count, list->count == 1 ? "" : "s");
    subject_destroy(&made, stage, answer);
}

void arguments_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                     check_answer *answer)
{
    arguments_list list;
    imp_instance host;
    imp_error error;
    subject s;
    if (subject_create(registry, type->kind, stage, &host, &error, answer) != IMP_SUCCESS) {
        answer_fail(answer, "'%.300s' does not work: %s", stage, error.text);
        return;
    }
    json_t *given = stage_values(registry, type->kind, stage);
    if (!arguments_list_make(&list, type, given))
        answer_skip(answer, "the arguments could not be created");
    else if (subject_make(&s, &host, &host, 0, answer))
        check_guarded(&list, &s, stage);
    json_decref(given);
    arguments_list_free(&list);
    subject_destroy(&host, stage, answer);
}

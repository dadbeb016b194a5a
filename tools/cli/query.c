/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/query.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/build_tree.h"
#include "tools/cli/explain.h"
#include "tools/cli/input.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/output_operands.h"
#include "tools/cli/progress.h"
#include "tools/cli/proof_output.h"
#include "tools/cli/reading_limit.h"
#include "tools/cli/result.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

/* Adds the plugins of the build tree, if the command runs from one, after those of the environment
 * and before the installed ones, so that a program just built uses the plugins built with it. */
static bool add_build_tree(void)
{
    const char *built = build_tree_plugins(), *named = getenv("IMPINGE_PLUGIN_PATH");
    char *path;
    if (built == NULL) return true;
    if (named == NULL || named[0] == '\0') return setenv("IMPINGE_PLUGIN_PATH", built, 1) == 0;
    if (asprintf(&path, "%s:%s", named, built) < 0) return false;
    const bool done = setenv("IMPINGE_PLUGIN_PATH", path, 1) == 0;
    free(path);
    return done;
}

imp_registry *query_registry_first(const char *path, unsigned flags, const char *speaker)
{
    imp_registry *registry = NULL;
    if (add_build_tree()) registry = imp_registry_open(path, flags);
    if (registry == NULL) complain_of_memory(speaker);
    return registry;
}

static void warn(const imp_registry *registry, const char *speaker)
{
    imp_plugin_refusal warning;
    for (size_t i = 0; imp_registry_warning(registry, i, &warning); ++i)
        remark(speaker, "warning: %s: %s", warning.file, warning.reason);
}

imp_registry *query_registry(const arguments *args)
{
    const option_value *path = arguments_option(args, "plugin-path");
    const unsigned flags = arguments_option(args, "secure") != NULL ? IMP_REGISTRY_SECURE : 0;
    imp_registry *registry =
        query_registry_first(path != NULL ? path->text : NULL, flags, args->verb->name);
    const option_value *isolate = arguments_option(args, "isolate");
    if (registry != NULL) warn(registry, args->verb->name);
    if (registry == NULL) return NULL;
    imp_error error = {0};
    imp_code code = reading_limit_share(args, registry, &error);
    if (code == IMP_SUCCESS && isolate != NULL)
        code = imp_registry_isolate(
            registry, strcmp(isolate->text, "all") == 0 ? NULL : isolate->text, &error);
    if (code == IMP_SUCCESS) return registry;
    complain_of(&error, args->verb->name);
    imp_registry_free(registry);
    return NULL;
}

void query_registry_free(imp_registry *registry)
{
    imp_plugin_refusal fault;
    for (size_t i = 0; imp_registry_fault(registry, i, &fault); ++i)
        remark(NULL, "warning: %s: %s", fault.file, fault.reason);
    imp_registry_free(registry);
}

imp_code query_run(imp_query *query, imp_result *result, imp_error *error)
{
    const imp_code code = imp_query_step(query, 0, error);
    progress_wipe();
    *result = imp_query_result(query);
    return code;
}

imp_code query_solve(imp_scene *scene, const arguments *args, imp_result *result, char **advice,
                     imp_error *error)
{
    const imp_options options = query_options(scene, args);
    imp_query *query = imp_query_new(scene, &options, error);
    if (query == NULL) return error->code;
    const imp_code code = query_run(query, result, error);
    if (code == IMP_SUCCESS && advice != NULL) *advice = query_advice(scene, query);
    imp_query_free(query);
    return code;
}

char *query_advice(const imp_scene *scene, const imp_query *query)
{
    const imp_result result = imp_query_result(query);
    if (result.verdict != IMP_VERDICT_UNDECIDED) return NULL;
    const explain_asked asked = explain_asked_of_contact(scene, &result);
    return explain_advice(query, &asked);
}

exit_status query_status(const imp_result *result, const arguments *args)
{
    if (result->verdict == IMP_VERDICT_UNDECIDED) return EXIT_UNDECIDED;
    if (result->verdict == IMP_VERDICT_CONTACT && arguments_option(args, "exit-code") != NULL)
        return EXIT_CONTACT;
    return EXIT_ANSWERED;
}

json_t *query_scene_json(const arguments *args)
{
    if (args->operand_count == 2)
        return json_pack("[o,o]", output_json_text(args->operands[0]),
                         output_json_text(args->operands[1]));
    if (args->operand_count == 1 && strcmp(args->operands[0], "-") != 0)
        return output_json_text(args->operands[0]);
    return json_null();
}

/* Returns the result as JSON, with an explanation unless `why` is NULL. */
static json_t *answer_json(const imp_scene *scene, const imp_result *result, const explanation *why,
                           const arguments *args)
{
    json_t *object = result_json(scene, result);
    if (object == NULL || (json_object_set_new(object, "scene", query_scene_json(args)) == 0 &&
                           result_set_warnings(object, scene) &&
                           (why == NULL || explain_set_json(object, scene, why))))
        return object;
    json_decref(object);
    return NULL;
}

static exit_status print(const imp_scene *scene, const imp_result *result, const explanation *why,
                         const arguments *args)
{
    if (arguments_option(args, "json") != NULL)
        return output_json(answer_json(scene, result, why, args), args->verb->name);
    result_print(scene, result);
    if (why != NULL) explain_print(scene, why);
    return output_flush(args->verb->name);
}

exit_status query_print(const imp_scene *scene, const imp_query *query, const imp_result *result,
                        const arguments *args)
{
    const bool is_asked = arguments_option(args, "explain") != NULL;
    explanation why;
    if (!is_asked && result->verdict != IMP_VERDICT_UNDECIDED)
        return print(scene, result, NULL, args);
    const explain_asked asked = explain_asked_of_contact(scene, result);
    if (!explain_query(query, &asked, &why)) return complain_of_memory(args->verb->name);
    const exit_status status = print(scene, result, &why, args);
    explain_free(&why);
    return status;
}

static exit_status answer(imp_scene *scene, const arguments *args)
{
    imp_result result;
    imp_error error = {0};
    imp_options options = query_options(scene, args);
    crew threads = {query_threads_asked(args)};
    exit_status status = output_spares_operands(args, "proof");
    if (status != EXIT_ANSWERED) return status;
    query_lend_threads(&options, &threads);
    imp_query *query = imp_query_new(scene, &options, &error);
    imp_code code = query != NULL ? IMP_SUCCESS : error.code;
    if (code == IMP_SUCCESS && arguments_option(args, "explain") != NULL)
        code = imp_query_explain(query, &error);
    if (code == IMP_SUCCESS && arguments_option(args, "proof") != NULL)
        code = imp_query_keep_proof(query, &error);
    if (code == IMP_SUCCESS) code = query_run(query, &result, &error);
    if (code != IMP_SUCCESS) {
        status = complain_of(&error, args->verb->name);
    } else {
        status = proof_output_write(query, scene, args);
        if (status == EXIT_ANSWERED) status = query_print(scene, query, &result, args);
        if (status == EXIT_ANSWERED) status = query_status(&result, args);
    }
    imp_query_free(query);
    return status;
}

exit_status query_answer(imp_scene *scene, const imp_error *error, const arguments *args)
{
    if (scene == NULL) return complain_of(error, args->verb->name);
    interrupt_prepare();
    const exit_status status =
        survey_is_needed(scene, args) ? survey_contact(scene, args) : answer(scene, args);
    imp_scene_free(scene);
    return status;
}

/* Makes a scene of a text, which it frees, with the parameters of the command line. */
static imp_scene *scene_of_text(imp_registry *registry, char *text, size_t length, const char *name,
                                const arguments *args, bool *complained, imp_error *error)
{
    size_t declared = 0;
    if (arguments_option(args, "parameter") != NULL)
        text = survey_add_parameters(text, &length, &declared, args);
    *complained = text == NULL;
    imp_scene *scene =
        text != NULL ? imp_scene_from_json(registry, text, length, name, error) : NULL;
    free(text);
    if (scene == NULL || survey_check_parameters(scene, declared, args, error) == IMP_SUCCESS)
        return scene;
    imp_scene_free(scene);
    return NULL;
}

/* Files are read by the library, unless parameters are put into them; standard input is read here,
 * whole. */
static imp_scene *scene_of_file(imp_registry *registry, const char *path, const arguments *args,
                                bool *complained, imp_error *error)
{
    input_text t = {.most = reading_limit_most(args)};
    const char *name = input_name(path);
    FILE *file = input_open(path, args->verb->name);
    *complained = file == NULL;
    if (file == NULL) return NULL;
    *complained = !input_read(file, name, args->verb->name, &t);
    input_close(file);
    if (!*complained)
        return scene_of_text(registry, t.text, t.length, name, args, complained, error);
    free(t.text);
    return NULL;
}

static imp_scene *scene_of_pair(imp_registry *registry, const arguments *args, bool *complained,
                                imp_error *error)
{
    const char *a = args->operands[0], *b = args->operands[1];
    if (arguments_option(args, "parameter") == NULL)
        return imp_scene_from_pair(registry, a, b, error);
    char *text = imp_pair_to_json(registry, a, b, error);
    if (text == NULL) return NULL;
    return scene_of_text(registry, text, strlen(text), "the command line", args, complained, error);
}

void query_warn(const imp_scene *scene, const arguments *args)
{
    imp_remark found = {.struct_size = (uint32_t)sizeof found};
    for (size_t k = 0; imp_scene_remark(scene, k, &found); ++k)
        remark(args->verb->name, "warning: body '%s', %s, %s",
               imp_scene_body_name(scene, found.body), found.type, found.text);
}

static imp_scene *read_scene(imp_registry *registry, const arguments *args, bool *complained,
                             imp_error *error)
{
    *complained = false;
    if (args->operand_count == 2) return scene_of_pair(registry, args, complained, error);
    if (strcmp(args->operands[0], "-") == 0 || arguments_option(args, "parameter") != NULL)
        return scene_of_file(registry, args->operands[0], args, complained, error);
    return imp_scene_from_file(registry, args->operands[0], error);
}

imp_scene *query_scene(imp_registry *registry, const arguments *args, bool *complained,
                       imp_error *error)
{
    reading_limit_begin(args, NULL);
    imp_scene *scene = read_scene(registry, args, complained, error);
    reading_limit_end();
    query_warn(scene, args);
    return scene;
}

exit_status query_answer_file(imp_registry *registry, const char *path, const arguments *args)
{
    imp_error error = {0};
    reading_limit_begin(args, NULL);
    imp_scene *scene = imp_scene_from_file(registry, path, &error);
    reading_limit_end();
    return query_answer(scene, &error, args);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/proof_output.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/sha256.h"
#include "tools/cli/output_file.h"
#include "tools/cli/output_operands.h"
#include "tools/cli/verbs.h"

const option options_proof[] = {{.name = "proof",
                                 .kind = OPTION_TEXT,
                                 .argument = "FILE",
                                 .help = "write a certificate, which impinge-verify proves again"},
                                {.name = NULL}};

exit_status proof_output_check(const arguments *args)
{
    static const char one_answer[] = "a certificate is of one answer";
    static const char *const others[][3] = {
        {"each", one_answer, "leave --each out: it is about all bodies"},
        {"refine", one_answer, "leave --refine out, and give the last --gamma"},
        {"resume", "how boxes of the run before were proved is not in its file",
         "ask for all of it with --proof, without --resume"},
        {"profile", one_answer, "leave --profile out, and give the --time of one slice"}};
    for (size_t k = 0; k < sizeof others / sizeof *others; ++k)
        if (arguments_option(args, "proof") != NULL && arguments_option(args, others[k][0]) != NULL)
            return complain(EXIT_USAGE, args->verb->name,
                            "--proof and --%s exclude each other, since %s; %s", others[k][0],
                            others[k][1], others[k][2]);
    return EXIT_ANSWERED;
}

/* Whether a proof is wanted and can be written; *status tells where not. */
static bool is_wanted(const arguments *args, exit_status *status)
{
    *status = EXIT_ANSWERED;
    if (arguments_option(args, "proof") == NULL) return false;
    *status = output_spares_operands(args, "proof");
    return *status == EXIT_ANSWERED;
}

exit_status proof_output_begin(imp_query *query, const arguments *args)
{
    imp_error error = {0};
    exit_status status;
    if (!is_wanted(args, &status) || imp_query_keep_proof(query, &error) == IMP_SUCCESS)
        return status;
    return complain_of(&error, args->verb->name);
}

exit_status proof_output_begin_survey(imp_survey *survey, const arguments *args)
{
    imp_error error = {0};
    exit_status status;
    if (!is_wanted(args, &status) || imp_survey_keep_proof(survey, &error) == IMP_SUCCESS)
        return status;
    return complain_of(&error, args->verb->name);
}

/* Returns the lines that name the scene's file, if it is one, and the plugins' files; the caller
 * frees them. NULL: complained of. */
static char *stated_of(const imp_scene *scene, const arguments *args)
{
    imp_error error = {0};
    char hash[SHA256_TEXT], *all;
    const char *path = args->operand_count == 1 ? args->operands[0] : "-";
    const bool named = strcmp(path, "-") != 0 && sha256_file(path, hash);
    char *types = imp_scene_sources(scene, &error);
    if (types == NULL) return complain_of(&error, args->verb->name), NULL;
    const int size = asprintf(&all, "%s%s%s%s", named ? "scene " : "", named ? hash : "",
                              named ? "\n" : "", types);
    free(types);
    if (size < 0) return complain_of_memory(args->verb->name), NULL;
    return all;
}

static void put(void *context, const void *bytes, size_t size)
{
    fwrite(bytes, 1, size, context); /* output_file_end looks for failures */
}

/* Writes the proof of `query`, or else of `survey`. */
static exit_status write_proof(const imp_query *query, const imp_survey *survey,
                               const imp_scene *scene, const arguments *args)
{
    const option_value *path = arguments_option(args, "proof");
    output_file out;
    imp_error error = {0};
    if (path == NULL) return EXIT_ANSWERED;
    char *stated = stated_of(scene, args);
    if (stated == NULL) return EXIT_DATA;
    exit_status status = output_file_begin(&out, path->text, args->verb->name);
    if (status != EXIT_ANSWERED) return free(stated), status;
    const imp_code code = query != NULL
                              ? imp_query_write_proof(query, stated, put, out.file, &error)
                              : imp_survey_write_proof(survey, stated, put, out.file, &error);
    free(stated);
    status = output_file_end(&out, code == IMP_SUCCESS);
    if (code == IMP_SUCCESS) return status;
    if (code != IMP_ERROR_USAGE) return complain_of(&error, args->verb->name);
    remark(args->verb->name, "%s; no certificate is written", message_of(&error));
    return EXIT_ANSWERED;
}

exit_status proof_output_write(const imp_query *query, const imp_scene *scene,
                               const arguments *args)
{
    return write_proof(query, NULL, scene, args);
}

exit_status proof_output_write_survey(const imp_survey *survey, const imp_scene *scene,
                                      const arguments *args)
{
    return write_proof(NULL, survey, scene, args);
}

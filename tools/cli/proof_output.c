/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/proof_output.h"

#include <stdio.h>
#include <string.h>

#include "core/common/sha256.h"
#include "tools/cli/output_file.h"
#include "tools/cli/verbs.h"

const option options_proof[] = {{.name = "proof",
                                 .kind = OPTION_TEXT,
                                 .argument = "FILE",
                                 .help = "write a certificate, which impinge-verify proves again"},
                                {.name = NULL}};

exit_status proof_output_begin(imp_query *query, const arguments *args)
{
    imp_error error = {0};
    if (arguments_option(args, "proof") == NULL) return EXIT_ANSWERED;
    if (imp_query_keep_proof(query, &error) == IMP_SUCCESS) return EXIT_ANSWERED;
    return complain_of(&error, args->verb->name);
}

/* Appends "WORD HASH" for a file that can be read. */
static void state_file(const char *word, const char *path, char *stated, size_t size)
{
    char text[SHA256_TEXT];
    const size_t used = strlen(stated);
    if (sha256_file(path, text)) snprintf(stated + used, size - used, "%s %s\n", word, text);
}

static void put(void *context, const void *bytes, size_t size)
{
    fwrite(bytes, 1, size, context); /* output_file_end looks for failures */
}

exit_status proof_output_write(const imp_query *query, const imp_scene *scene,
                               const arguments *args)
{
    const option_value *path = arguments_option(args, "proof");
    output_file out;
    imp_error error = {0};
    char stated[200] = "";
    (void)scene;
    if (path == NULL) return EXIT_ANSWERED;
    if (args->operand_count == 1 && strcmp(args->operands[0], "-") != 0)
        state_file("scene", args->operands[0], stated, sizeof stated);
    exit_status status = output_file_begin(&out, path->text, args->verb->name);
    if (status != EXIT_ANSWERED) return status;
    const imp_code code = imp_query_write_proof(query, stated, put, out.file, &error);
    status = output_file_end(&out, code == IMP_SUCCESS);
    return code == IMP_SUCCESS ? status : complain_of(&error, args->verb->name);
}

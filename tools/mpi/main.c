/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <locale.h>
#include <stdio.h>
#include <string.h>

#include "tools/cli/crash.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/query.h"
#include "tools/cli/series.h"
#include "tools/cli/verbs.h"
#include "tools/mpi/ranks.h"

static exit_status help(void)
{
    puts("Usage: mpirun [-np N] impinge-mpi batch FILE.jsonl --resume OUT [OPTION]...\n"
         "       mpirun [-np N] impinge-mpi solve SCENE --each [OPTION]...\n"
         "\n"
         "The same as `impinge batch` and `impinge solve --each`, by all processes of an MPI run; "
         "see\n"
         "impinge(1) for the options. Run again, batch goes on where OUT ends.");
    return EXIT_ANSWERED;
}

static exit_status version(void)
{
    printf("impinge-mpi %s (%s)\n", PACKAGE_VERSION, imp_version());
    return EXIT_ANSWERED;
}

/* Complains of what only `impinge` does. */
static exit_status check(const arguments *args)
{
    const char *speaker = args->verb != NULL ? args->verb->name : NULL;
    const bool batch = speaker != NULL && strcmp(speaker, "batch") == 0;
    if (!batch && (speaker == NULL || strcmp(speaker, "solve") != 0))
        return complain(EXIT_USAGE, speaker, "impinge-mpi has the verbs batch and solve only");
    if (!batch && arguments_option(args, "each") == NULL)
        return complain(EXIT_USAGE, speaker, "impinge-mpi solves a scene with --each only");
    if (batch && arguments_option(args, "resume") == NULL)
        return complain(EXIT_USAGE, speaker, "impinge-mpi needs --resume OUT, the file of answers");
    if (arguments_option(args, "threads") != NULL)
        return complain(EXIT_USAGE, speaker, "--threads: got one, but processes take their place");
    if (strcmp(args->operands[0], "-") == 0)
        return complain(EXIT_USAGE, speaker, "got '-', must be a file that all processes can read");
    if (batch) return EXIT_ANSWERED;
    const exit_status status = query_check(args);
    return status != EXIT_ANSWERED ? status : series_check(args);
}

static exit_status run(const arguments *args)
{
    const bool first = ranks_own() == FIRST_RANK;
    if (arguments_option(args, "help") != NULL) return first ? help() : EXIT_ANSWERED;
    if (arguments_option(args, "version") != NULL) return first ? version() : EXIT_ANSWERED;
    const exit_status checked = check(args);
    if (checked != EXIT_ANSWERED) return checked;
    return strcmp(args->verb->name, "batch") == 0 ? ranks_batch(args) : ranks_each(args);
}

static void choose_progress(const arguments *args)
{
    const option_value *progress = arguments_option(args, "progress");
    if (progress != NULL) progress_choose((progress_mode)progress->choice);
    if (ranks_own() != FIRST_RANK) progress_choose(PROGRESS_NONE);
}

int main(int argc, char **argv)
{
    uselocale(newlocale(LC_ALL_MASK, "C", (locale_t)0));
    progress_begin();
    output_prepare();
    MPI_Init(&argc, &argv);
    const bool json = arguments_ask_for_json(argc, (const char *const *)argv);
    crash_prepare(json);
    complain_aloud(ranks_own() == FIRST_RANK);
    arguments args;
    exit_status status = arguments_read(&args, argc, (const char *const *)argv);
    choose_progress(&args);
    if (status == EXIT_ANSWERED) status = run(&args);
    arguments_free(&args);
    progress_end();
    if (json) output_error_object();
    const exit_status finished = output_finish(NULL);
    if (finished > status) status = finished;
    const bool first = ranks_own() == FIRST_RANK;
    MPI_Finalize();
    return first ? (int)status : 0;
}

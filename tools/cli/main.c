/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/c_locale.h"
#include "tools/cli/crash.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/verbs.h"
#include "tools/cli/version.h"

static exit_status print_help(const verb *v)
{
    if (v != NULL)
        help_verb(v);
    else
        help_overview();
    return EXIT_ANSWERED;
}

static exit_status run(const arguments *args)
{
    if (arguments_option(args, "help") != NULL) return print_help(args->verb);
    if (arguments_option(args, "version") != NULL) return version_print(args);
    if (args->verb != NULL) return args->verb->run(args);
    return complain(EXIT_USAGE, NULL,
                    "which verb? `impinge help` shows all, `impinge demo` a first "
                    "contact");
}

int main(int argc, char **argv)
{
    /* Numbers have a point, whatever a plugin makes of the process's locale. */
    c_locale_enter();
    progress_begin();
    if (!output_prepare()) return EXIT_DATA;
    const bool json = arguments_ask_for_json(argc, (const char *const *)argv);
    crash_prepare(json);
    arguments args;
    exit_status status = arguments_read(&args, argc, (const char *const *)argv);
    const char *speaker = args.verb != NULL ? args.verb->name : NULL;
    output_choose_colour(arguments_option(&args, "no-color") == NULL);
    const option_value *progress = arguments_option(&args, "progress");
    if (progress != NULL) progress_choose((progress_mode)progress->choice);
    if (status == EXIT_ANSWERED) status = run(&args);
    arguments_free(&args);
    progress_end();
    if (json) output_error_object();
    const exit_status finished = output_finish(speaker);
    return (int)(status > finished ? status : finished);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdarg.h>
#include <stdio.h>

#include "tools/cli/message.h"
#include "tools/cli/output.h"
#include "tools/cli/standard_output.h"

/* How impinge-verify complains of files: tools/cli/output_file.c, which it shares with the command,
 * calls these. Standard output is never such a file here. */

exit_status complain(exit_status status, const char *verb, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", verb);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return status;
}

exit_status complain_of_memory(const char *verb)
{
    return complain(EXIT_DATA, verb, "memory ran out");
}

exit_status output_flush(const char *verb)
{
    return fflush(stdout) == 0 ? EXIT_ANSWERED : complain(EXIT_DATA, verb, "output failed");
}

void standard_output_discard(void) {}

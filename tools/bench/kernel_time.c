/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/kernel_time.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tools/cli/program.h"

double kernel_time_of_programs(void)
{
    struct rusage used;
    getrusage(RUSAGE_CHILDREN, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

bool kernel_time_begin(kernel_time *k, size_t most)
{
    const char *folder = getenv("TMPDIR");
    *k = (kernel_time){.program = program_beside("impinge-verify-kernel")};
    if (k->program == NULL) return true;
    if (folder == NULL || strlen(folder) > 32) folder = "/tmp";
    snprintf(k->folder, sizeof k->folder, "%s/impinge-bench-XXXXXX", folder);
    if (mkdtemp(k->folder) == NULL) {
        free(k->program);
        *k = (kernel_time){.program = NULL};
        return true;
    }
    snprintf(k->file, sizeof k->file, "%s/long", k->folder);
    k->takes = calloc(most + 1, sizeof *k->takes);
    return k->takes != NULL;
}

/* Runs the program; *takes becomes its processor seconds. Returns whether its status is 0. */
static bool run(const char *const *words, double *takes)
{
    const double before = kernel_time_of_programs();
    const program_end end = program_run(words, PROGRAM_OUTPUT, false);
    *takes = kernel_time_of_programs() - before;
    free(end.said);
    return end.error == 0 && end.status == 0;
}

void kernel_time_add(kernel_time *k, const char *verifier, const char *path)
{
    char limited[60];
    double unused;
    if (k->program == NULL) return;
    snprintf(limited, sizeof limited, "ulimit -t %d && exec \"$0\" \"$@\" 2>&1", KERNEL_TIME_LIMIT);
    const char *const elaborate[] = {"sh",          "-c",    limited,   verifier, path,
                                     "--elaborate", k->file, "--quiet", NULL};
    const char *const prove[] = {k->program, k->file, NULL};
    if (!run(elaborate, &unused)) return;
    k->proved += run(prove, &k->takes[k->elaborated]);
    k->elaborated += 1;
    unlink(k->file);
}

void kernel_time_end(kernel_time *k)
{
    if (k->folder[0] != '\0') rmdir(k->folder);
    free(k->takes);
    free(k->program);
}

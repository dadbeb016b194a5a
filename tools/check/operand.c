/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/operand.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/common/search_path.h"
#include "core/common/spelling.h"
#include "tools/check/fate.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

bool operand_is_path(const char *operand)
{
    return strpbrk(operand, OPERAND_BLANKS "=") == NULL &&
           (strchr(operand, '/') != NULL || is_named_so(operand));
}

static void lookup_work(void *result, const void *data)
{
    operand_file *l = result;
    const operand_type *w = data;
    imp_type_info info;
    spelling_search near = {.wanted = w->name};
    imp_registry *registry = query_registry(w->args);
    for (size_t i = 0; registry != NULL && imp_registry_type(registry, i, &info); ++i) {
        spelling_offer(&near, info.name);
        if (l->found || strcmp(info.name, w->name) != 0) continue;
        snprintf(l->file, sizeof l->file, "%s", info.file);
        l->found = true;
    }
    if (near.best != NULL) snprintf(l->near, sizeof l->near, "%s", near.best);
}

exit_status operand_find_type(const arguments *args, const operand_type *w, double seconds,
                              operand_file *l)
{
    const char *speaker = args->verb->name;
    const child_fate fate = child_run(lookup_work, l, w, seconds);
    if (fate.end != CHILD_DONE)
        return complain(EXIT_DATA, speaker, "looking for '%s' among the plugins %s", w->name,
                        fate_text_of(fate, seconds).text);
    if (l->found) return EXIT_ANSWERED;
    if (l->near[0] != '\0')
        return complain(EXIT_DATA, speaker,
                        "unknown type '%s', did you mean '%s'? `impinge list` shows all", w->name,
                        l->near);
    return complain(EXIT_DATA, speaker,
                    "unknown type '%s'; `impinge list` shows all; a file has a '/' in its name "
                    "or ends in .so",
                    w->name);
}

exit_status operand_find_file(const arguments *args, const char *path, operand_file *l)
{
    char *absolute = realpath(path, NULL);
    if (absolute == NULL || access(absolute, R_OK) != 0 || strlen(absolute) >= sizeof l->file) {
        const int error = errno;
        free(absolute);
        return complain(EXIT_DATA, args->verb->name, "%s: %s", path, strerror(error));
    }
    strcpy(l->file, absolute);
    free(absolute);
    return EXIT_ANSWERED;
}

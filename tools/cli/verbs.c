/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/spelling.h"
#include "tools/cli/verbs.h"

#include <string.h>

/* Add a verb: write verb_NAME.c, which defines `const verb verb_NAME`, and add a row here. */
#define VERBS(ROW)                                                                                 \
    ROW(demo)                                                                                      \
    ROW(list)                                                                                      \
    ROW(info)                                                                                      \
    ROW(pair)                                                                                      \
    ROW(solve)                                                                                     \
    ROW(clearance)                                                                                 \
    ROW(simulate)                                                                                  \
    ROW(batch)                                                                                     \
    ROW(view)                                                                                      \
    ROW(plot)                                                                                      \
    ROW(matrix)                                                                                    \
    ROW(why)                                                                                       \
    ROW(bench)                                                                                     \
    ROW(new)                                                                                       \
    ROW(build)                                                                                     \
    ROW(check)                                                                                     \
    ROW(complete)                                                                                  \
    ROW(watch)                                                                                     \
    ROW(help)

#define DECLARE(NAME) extern const verb verb_##NAME;
VERBS(DECLARE)
#undef DECLARE

#define ADDRESS(NAME) &verb_##NAME,
static const verb *const all[] = {VERBS(ADDRESS) NULL};
#undef ADDRESS

const verb *const *verbs_all(void) { return all; }

const verb *verb_find(const char *name)
{
    for (const verb *const *v = all; *v != NULL; ++v)
        if (strcmp((*v)->name, name) == 0) return *v;
    return NULL;
}

exit_status verb_unknown(const char *speaker, const char *name)
{
    spelling_search near = {.wanted = name};
    for (const verb *const *v = all; *v != NULL; ++v)
        if (!(*v)->is_hidden) spelling_offer(&near, (*v)->name);
    if (near.best != NULL)
        return complain(EXIT_USAGE, speaker,
                        "unknown verb '%s', did you mean '%s'? `impinge help` shows all", name,
                        near.best);
    return complain(EXIT_USAGE, speaker, "unknown verb '%s'; `impinge help` shows all", name);
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/file_trust.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/common/system_error.h"

enum { LINKS_MAX = 40 }; /* as the kernel follows */

typedef struct walk {
    char at[PATH_MAX];   /* what has been walked: real, without links */
    char rest[PATH_MAX]; /* components to come */
    int links;
    trust_fault *why;
} walk;

static bool fault(const walk *w, const char *what, const char *cure)
{
    snprintf(w->why->text, sizeof w->why->text, "'%.400s' %s; %s", w->at, what, cure);
    return false;
}

static bool fails(const walk *w)
{
    return fault(w, "cannot be examined", system_error_text(errno));
}

static bool is_owned(const walk *w, const struct stat *facts)
{
    char what[100];
    if (facts->st_uid == 0 || facts->st_uid == geteuid()) return true;
    snprintf(what, sizeof what, "belongs to user %ju, who is neither root nor the one running this",
             (uintmax_t)facts->st_uid);
    return fault(w, what, "chown it, or copy the plugin to a directory of your own");
}

static bool is_guarded(const walk *w, const struct stat *facts)
{
    const bool above = w->rest[strspn(w->rest, "/")] != '\0';
    if ((facts->st_mode & S_IWOTH) == 0) return true;
    if (S_ISDIR(facts->st_mode) && above && (facts->st_mode & S_ISVTX) != 0) return true;
    return fault(w,
                 S_ISDIR(facts->st_mode) ? "is a directory that anyone may write to"
                                         : "is a file that anyone may write to",
                 "chmod o-w it");
}

/* Puts what the link says in front of the rest. */
static bool follow(walk *w, size_t parent)
{
    char rest[PATH_MAX], target[PATH_MAX];
    const ssize_t length = readlink(w->at, target, sizeof target - 1);
    if (length < 0) return fails(w);
    target[length] = '\0';
    if (++w->links > LINKS_MAX)
        return fault(w, "is one of too many links", "link to the file itself");
    if (snprintf(rest, sizeof rest, "%s/%s", target, w->rest) >= (int)sizeof rest)
        return fault(w, "links to a path that is too long", "link to the file itself");
    memcpy(w->rest, rest, sizeof rest);
    w->at[target[0] == '/' ? 0 : parent] = '\0';
    return true;
}

/* True if the component that was added last is none: "." or "..". */
static bool is_no_name(walk *w, size_t parent)
{
    const char *name = w->at + parent + 1;
    const bool up = strcmp(name, "..") == 0;
    if (!up && strcmp(name, ".") != 0) return false;
    w->at[parent] = '\0';
    char *last = strrchr(w->at, '/');
    if (up && last != NULL) *last = '\0';
    return true;
}

/* Takes the first component off the rest, if there is one, and goes there. */
static bool step(walk *w, bool *arrived)
{
    struct stat facts;
    const size_t parent = strlen(w->at), from = strspn(w->rest, "/");
    const size_t length = strcspn(w->rest + from, "/");
    *arrived = length == 0;
    if (*arrived) return true;
    if (parent + length + 2 > sizeof w->at) return fault(w, "is too deep", "use a shorter path");
    snprintf(w->at + parent, sizeof w->at - parent, "/%.*s", (int)length, w->rest + from);
    memmove(w->rest, w->rest + from + length, strlen(w->rest + from + length) + 1);
    if (is_no_name(w, parent)) return true;
    if (lstat(w->at, &facts) != 0) return fails(w);
    if (!is_owned(w, &facts)) return false;
    return S_ISLNK(facts.st_mode) ? follow(w, parent) : is_guarded(w, &facts);
}

static bool begin(walk *w, const char *path)
{
    char folder[PATH_MAX] = "";
    if (path[0] != '/' && getcwd(folder, sizeof folder) == NULL) return fails(w);
    if (snprintf(w->rest, sizeof w->rest, "%s/%s", folder, path) < (int)sizeof w->rest) return true;
    return fault(w, "and what follows is too long", "use a shorter path");
}

bool file_is_trusted(const char *path, trust_fault *why)
{
    walk w = {.why = why};
    bool arrived = false, good = begin(&w, path);
    while (good && !arrived) good = step(&w, &arrived);
    return good;
}

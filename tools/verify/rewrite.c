/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/rewrite.h"

#include <errno.h>
#include <string.h>

static const char speaker[] = "impinge-verify";

static bool complained(const char *path, const char *why)
{
    fprintf(stderr, "%s: %s: %s\n", speaker, path, why);
    return false;
}

static bool is_same_file(const char *a, const char *b)
{
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

bool rewrite_begin(rewrite *r, const char *path, const char *certificate)
{
    if (output_is_standard(path))
        return complained(path, "standard output has the answer; name a file");
    if (is_same_file(path, certificate))
        return complained(path, "is the certificate that is read; name another file");
    r->draft = tmpfile();
    if (r->draft == NULL) return complained("a temporary file", strerror(errno));
    if (output_file_begin(&r->out, path, speaker) != EXIT_ANSWERED) {
        fclose(r->draft);
        return false;
    }
    r->path = path;
    return true;
}

bool rewrite_watch(rewrite *r, walk *w)
{
    if (r->is_coq)
        r->coq = coq_begin(w, r->goals, r->seed);
    else
        r->tighten = tighten_begin(w, r->draft);
    return r->tighten != NULL || r->coq != NULL || input_refuse(w->in, "memory ran out");
}

bool rewrite_end(rewrite *r)
{
    bool good = true;
    if (r->is_coq)
        r->leaves = coq_write(r->coq, r->draft, &r->known);
    else
        good = tighten_end(r->tighten, &r->leaves);
    good = good && fflush(r->draft) == 0 && !ferror(r->draft);
    r->size = ftell(r->draft);
    rewind(r->draft);
    r->is_ended = good && r->size >= 0;
    return r->is_ended || complained("a temporary file", strerror(errno));
}

bool rewrite_finish(rewrite *r, bool keep)
{
    char some[4096];
    size_t n;
    if (r->path == NULL) return true;
    tighten_free(r->tighten);
    coq_free(r->coq);
    rewind(r->draft);
    while (keep && (n = fread(some, 1, sizeof some, r->draft)) > 0)
        fwrite(some, 1, n, r->out.file); /* output_file_end looks for failures */
    if (keep && ferror(r->draft)) keep = complained("a temporary file", "cannot be read");
    fclose(r->draft);
    r->path = NULL;
    return output_file_end(&r->out, keep) == EXIT_ANSWERED;
}

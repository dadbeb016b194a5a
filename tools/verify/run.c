/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/run.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/verify/receipt.h"

/* --- Verifying -------------------------------------------------------------------------------- */

static void name_assumed(const statement *s, const bool *assumed, char *text, size_t size)
{
    for (size_t k = 0; k < s->stage_count; ++k) {
        bool is_new = assumed[k];
        for (size_t i = 0; i < k && is_new; ++i)
            if (assumed[i] && strcmp(s->stages[i].type, s->stages[k].type) == 0) is_new = false;
        const size_t used = strlen(text);
        if (is_new)
            snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "", s->stages[k].type);
    }
    if (strlen(text) + 1 == size) memcpy(text + size - 4, "...", 4); /* not all fit in */
}

static void show_progress(uint64_t bytes)
{
    static uint64_t next;
    if (bytes < next) return;
    next = bytes + 4096;
    fprintf(stderr, "\r%llu bytes ", (unsigned long long)bytes);
}

run_progress *run_progress_of(const request *asked)
{
    return !asked->quiet && isatty(2) ? show_progress : NULL;
}

void run_progress_end(run_progress *progress)
{
    if (progress != NULL) fprintf(stderr, "\r                        \r");
}

void run_verify(const request *asked, input *in, statement *s, unsigned share, outcome *found)
{
    walk w = {.in = in,
              .says = s,
              .effort = asked->effort,
              .share = share,
              .shares = asked->threads,
              .text = asked->text ? stdout : NULL,
              .progress = share == 0 ? run_progress_of(asked) : NULL};
    bool good = asked->rewrite == NULL || rewrite_watch(asked->rewrite, &w);
    good = good && statement_read(s, in);
    w.assumed = good ? calloc(s->stage_count + 1, sizeof *w.assumed) : NULL;
    if (good && w.assumed == NULL) good = input_refuse(in, "memory ran out");
    good = good && (share > 0 || walk_points(&w)) && walk_trees(&w);
    if (good && asked->rewrite != NULL) rewrite_end(asked->rewrite);
    run_progress_end(w.progress);
    *found = (outcome){!good, in->fault_at, in->at, w.leaves, w.pairs, w.tests, "", ""};
    memcpy(found->text, in->fault, sizeof found->text);
    if (good) name_assumed(s, w.assumed, found->assumed, sizeof found->assumed);
    free(w.assumed);
}

/* Each process reads the whole file and proves its share of the leaves. */
static bool verify_file(const request *asked, unsigned share, statement *s, outcome *found)
{
    FILE *file = strcmp(asked->path, "-") == 0 ? stdin : fopen(asked->path, "rb");
    input in;
    if (file == NULL) return false;
    input_begin(&in, file);
    run_verify(asked, &in, s, share, found);
    if (file != stdin) fclose(file);
    return true;
}

typedef struct helper {
    pid_t pid;
    int from;
} helper;

static bool start(const request *asked, unsigned share, helper *h)
{
    int ends[2];
    if (pipe(ends) != 0) return false;
    fflush(NULL);
    h->pid = fork();
    h->from = ends[0];
    if (h->pid != 0) {
        close(ends[1]);
        if (h->pid < 0) close(ends[0]);
        return h->pid > 0;
    }
    statement s;
    outcome found;
    memset(&found, 0, sizeof found);
    close(ends[0]);
    if (!verify_file(asked, share, &s, &found)) _exit(USAGE);
    const bool told = write(ends[1], &found, sizeof found) == (ssize_t)sizeof found;
    _exit(told ? HOLDS : REFUSED);
}

/* Waits for a process and adds what it found. The earliest refusal counts; a process that told
 * nothing has proved nothing. */
static void join(helper *h, outcome *all)
{
    outcome told;
    size_t have = 0;
    ssize_t some;
    while (have < sizeof told &&
           (some = read(h->from, (char *)&told + have, sizeof told - have)) > 0)
        have += (size_t)some;
    close(h->from);
    waitpid(h->pid, NULL, 0);
    if (have < sizeof told) {
        told = (outcome){.refused = true, .text = "a process ended early"};
    }
    all->tests += told.tests;
    if (told.refused && (!all->refused || told.at < all->at)) {
        all->refused = true;
        all->at = told.at;
        memcpy(all->text, told.text, sizeof all->text);
    }
}

bool run_all(const request *asked, statement *s, outcome *all)
{
    helper helpers[THREADS_MAX];
    unsigned count = 0;
    bool started = true;
    for (unsigned k = 1; k < asked->threads && started; ++k) {
        started = start(asked, k, &helpers[count]);
        count += started;
    }
    const bool opened = verify_file(asked, 0, s, all);
    for (unsigned k = 0; k < count; ++k) join(&helpers[k], all);
    if (!started && !all->refused) {
        all->refused = true;
        snprintf(all->text, sizeof all->text, "a process could not be made");
    }
    return opened;
}

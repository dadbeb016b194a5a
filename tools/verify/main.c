/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/verify/walk.h"

/* impinge-verify: proves a certificate again (core/CERTIFICATE.md). It loads no shared object and
 * trusts nothing in the file. */

enum { HOLDS, REFUSED, USAGE, STALE }; /* exit statuses */
enum { THREADS_MAX = 256 };

typedef struct request {
    const char *path, *scene;
    unsigned threads;
    unsigned long effort;
    bool text, quiet;
} request;

/* What one process has found; sent through a pipe. */
typedef struct outcome {
    bool refused;
    uint64_t at, leaves, pairs, tests;
    char text[1400];    /* why it is refused */
    char assumed[1000]; /* names of types */
} outcome;

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

static void verify(const request *asked, input *in, statement *s, unsigned share, outcome *found)
{
    walk w = {.in = in,
              .says = s,
              .effort = asked->effort,
              .share = share,
              .shares = asked->threads,
              .text = asked->text ? stdout : NULL,
              .progress = share == 0 && !asked->quiet && isatty(2) ? show_progress : NULL};
    bool good = statement_read(s, in);
    w.assumed = good ? calloc(s->stage_count + 1, sizeof *w.assumed) : NULL;
    if (good && w.assumed == NULL) good = input_refuse(in, "memory ran out");
    good = good && (share > 0 || walk_points(&w)) && walk_trees(&w);
    if (w.progress != NULL) fprintf(stderr, "\r                        \r");
    *found = (outcome){!good, in->fault_at, w.leaves, w.pairs, w.tests, "", ""};
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
    verify(asked, &in, s, share, found);
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

static bool verify_by_all(const request *asked, statement *s, outcome *all)
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

/* --- Receipts --------------------------------------------------------------------------------- */

/* Returns HOLDS if the certificate was written of this scene by this version; else prints what has
 * changed. */
static int check_receipt(const request *asked, const statement *s)
{
    char own[SHA256_TEXT];
    const char *changed = NULL;
    if (asked->scene == NULL) return HOLDS;
    if (!sha256_file(asked->scene, own)) {
        fprintf(stderr, "impinge-verify: %s: %s\n", asked->scene, strerror(errno));
        return USAGE;
    }
    bool named = false;
    for (size_t k = 0; k < s->source_count; ++k) {
        if (strcmp(s->sources[k].kind, "scene") != 0) continue;
        named = true;
        if (strcmp(s->sources[k].hash, own) != 0) changed = "the scene";
    }
    if (!named) changed = "the scene: the certificate names none";
    if (changed == NULL && strcmp(s->program, "impinge " PACKAGE_VERSION) != 0)
        changed = "the version of impinge";
    if (changed == NULL) return HOLDS;
    printf("stale: %s has changed\n", changed);
    return STALE;
}

/* --- The answer ------------------------------------------------------------------------------- */

typedef struct number_text {
    char text[32];
} number_text;

/* The fewest digits that read back exactly: a claim that is rounded would be another one. */
static number_text exact(double x)
{
    number_text to;
    for (int digits = 1; digits <= 17; ++digits) {
        snprintf(to.text, sizeof to.text, "%.*g", digits, x);
        if (strtod(to.text, NULL) == x) break;
    }
    return to;
}

static void say_count(const char *one, const char *many, uint64_t n, const char *rest)
{
    printf("%llu %s%s", (unsigned long long)n, n == 1 ? one : many, rest);
}

static int report(const request *asked, const statement *s, const outcome *all)
{
    if (all->refused) {
        printf("refused at byte %llu: %s\n", (unsigned long long)all->at, all->text);
        return REFUSED;
    }
    const int status = check_receipt(asked, s);
    if (status != HOLDS) return status;
    printf("holds%s%s\n", all->assumed[0] != '\0' ? " assuming " : "", all->assumed);
    if (asked->quiet) return HOLDS;
    printf("%s: no two points nearer than %s", s->verdict, exact(s->apart).text);
    printf(" from t = %s", exact(s->from).text);
    printf(" to %s\n", exact(s->to).text);
    if (s->has_points)
        printf("two points within %s at t = %s\n", exact(s->within).text, exact(s->t).text);
    if (s->ignored_count > 0)
        say_count("ignored pair", "ignored pairs", s->ignored_count, " of bodies\n");
    say_count("pair", "pairs", all->pairs, " of surfaces, ");
    say_count("leaf", "leaves", all->leaves, ", ");
    say_count("test", "tests", all->tests, "\n");
    return HOLDS;
}

static int usage(FILE *to)
{
    fputs("Usage: impinge-verify [OPTIONS] FILE [SCENE]\n"
          "Proves the certificate FILE again, which impinge --proof wrote; trusts nothing of it.\n"
          "With SCENE, tells whether it is of this scene file and version.\n\n"
          "  --text        print what is claimed and the tree, a line for each entry\n"
          "  --threads N   processes that prove at once (1)\n"
          "  --effort N    tests that one leaf may take (20000)\n"
          "  --quiet       one line\n"
          "  --help, --version\n\n"
          "Exit status: 0 holds, 1 refused, 2 usage, 3 stale\n",
          to);
    return to == stdout ? HOLDS : USAGE;
}

static bool read_count(const char *text, unsigned long most, unsigned long *n)
{
    char *end;
    *n = strtoul(text, &end, 10);
    return *end == '\0' && text[0] >= '0' && text[0] <= '9' && *n >= 1 && *n <= most;
}

int main(int argc, char **argv)
{
    static const struct option options[] = {{"text", no_argument, NULL, 't'},
                                            {"threads", required_argument, NULL, 'j'},
                                            {"effort", required_argument, NULL, 'e'},
                                            {"quiet", no_argument, NULL, 'q'},
                                            {"help", no_argument, NULL, 'h'},
                                            {"version", no_argument, NULL, 'v'},
                                            {NULL, 0, NULL, 0}};
    request asked = {.threads = 1, .effort = 20000};
    unsigned long n;
    for (int c; (c = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        if (c == 'h') return usage(stdout);
        if (c == 'v') return printf("impinge-verify %s\n", PACKAGE_VERSION) < 0;
        if (c == 't')
            asked.text = true;
        else if (c == 'q')
            asked.quiet = true;
        else if (c == 'j' && read_count(optarg, THREADS_MAX, &n))
            asked.threads = (unsigned)n;
        else if (c == 'e' && read_count(optarg, 1000000000, &n))
            asked.effort = n;
        else
            return usage(stderr);
    }
    if (argc - optind < 1 || argc - optind > 2) return usage(stderr);
    asked.path = argv[optind];
    asked.scene = argc - optind == 2 ? argv[optind + 1] : NULL;
    if (strcmp(asked.path, "-") == 0) asked.threads = 1;
    statement s = {.apart = 0};
    outcome all;
    memset(&all, 0, sizeof all);
    if (!verify_by_all(&asked, &s, &all)) {
        fprintf(stderr, "impinge-verify: %s: %s\n", asked.path, strerror(errno));
        return USAGE;
    }
    const int status = report(&asked, &s, &all);
    statement_free(&s);
    return status;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <getopt.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "tools/verify/elaborate.h"
#include "tools/verify/receipt.h"
#include "tools/verify/run.h"

/* impinge-verify: proves a certificate again (core/CERTIFICATE.md). It loads no shared object and
 * trusts nothing in the file. */

enum { GOALS_MAX = 100000, EFFORT = 200000, EFFORT_ELABORATE = 1000000 };

/* --- The answer ------------------------------------------------------------------------------- */

typedef struct number_text {
    char text[32];
} number_text;

/* Returns the fewest digits that read back exactly: a claim that is rounded would be another one.
 * */
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

/* Prints the name of a parameter, which cannot end its quotes. */
static void say_name(const char *name)
{
    printf(", '");
    for (; *name != '\0'; ++name) printf(strchr("'\\", *name) ? "\\%c" : "%c", *name);
    printf("'");
}

static int report(const request *asked, const statement *s, const outcome *all)
{
    if (all->refused) {
        printf("refused at byte %llu: %s\n", (unsigned long long)all->at, all->text);
        return REFUSED;
    }
    const int status =
        asked->scene == NULL ? HOLDS : receipt_check(s, asked->scene, asked->plugin_path);
    if (status != HOLDS) return status;
    printf("holds%s%s\n", all->assumed[0] != '\0' ? " assuming " : "", all->assumed);
    if (asked->quiet) return HOLDS;
    printf("%s: no two points nearer than %s", s->verdict, exact(s->apart).text);
    for (size_t k = 0; k < s->clock_count; ++k) {
        if (k == 0) printf(" from t = %s", exact(s->clocks[0].lo).text);
        if (k > 0) {
            say_name(s->clocks[k].name);
            printf(" from %s", exact(s->clocks[k].lo).text);
        }
        printf(" to %s", exact(s->clocks[k].hi).text);
    }
    if (s->has_points) printf("\ntwo points within %s at t", exact(s->within).text);
    for (size_t k = 0; k < s->clock_count && s->has_points; ++k) {
        if (k > 0) say_name(s->clocks[k].name);
        printf(" = %s", exact(s->clocks[k].at).text);
    }
    printf("\n");
    if (s->ignored_count > 0)
        say_count("ignored pair", "ignored pairs", s->ignored_count, " of bodies\n");
    say_count("body", "bodies", s->body_count, ", ");
    say_count("pair", "pairs", all->pairs, " of surfaces, ");
    say_count("leaf", "leaves", all->leaves, ", ");
    say_count("test", "tests", all->tests, "\n");
    return HOLDS;
}

static int usage(FILE *to)
{
    fputs("Usage: impinge-verify [OPTIONS] FILE [SCENE]\n"
          "Proves the certificate FILE again, which impinge --proof wrote; trusts nothing of it.\n"
          "With SCENE, tells whether it is of this scene file, this version and these plugins.\n\n"
          "  --text        print what is claimed and the tree, a line for each entry\n"
          "  --threads N   processes that prove at once (1)\n"
          "  --effort N    tests that one leaf may take (200000; 1000000 with --elaborate)\n"
          "  --tighten OUT write a shorter certificate of the same claim\n"
          "  --elaborate OUT\n"
          "                write a longer one, which impinge-verify-kernel proves\n"
          "  --coq OUT     write leaves as goals for Coq's tactic interval\n"
          "  --goals N     so many (20), drawn at random\n"
          "  --seed N      with this seed (1)\n"
          "  --plugin-path DIR[:DIR...]\n"
          "                look for the plugins that SCENE was solved with there first\n"
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

/* Returns an exit status, or -1: go on. */
static int read_arguments(int argc, char **argv, request *asked)
{
    static const struct option options[] = {{"text", no_argument, NULL, 't'},
                                            {"threads", required_argument, NULL, 'j'},
                                            {"effort", required_argument, NULL, 'e'},
                                            {"tighten", required_argument, NULL, 'w'},
                                            {"elaborate", required_argument, NULL, 'k'},
                                            {"coq", required_argument, NULL, 'c'},
                                            {"goals", required_argument, NULL, 'g'},
                                            {"seed", required_argument, NULL, 's'},
                                            {"plugin-path", required_argument, NULL, 'p'},
                                            {"quiet", no_argument, NULL, 'q'},
                                            {"help", no_argument, NULL, 'h'},
                                            {"version", no_argument, NULL, 'v'},
                                            {NULL, 0, NULL, 0}};
    unsigned long n;
    for (int c; (c = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        if (c == 'h') return usage(stdout);
        if (c == 'v') return printf("impinge-verify %s\n", PACKAGE_VERSION) < 0;
        if (c == 't')
            asked->text = true;
        else if (c == 'q')
            asked->quiet = true;
        else if ((c == 'w' || c == 'c' || c == 'k') && asked->output == NULL) {
            asked->output = optarg;
            asked->is_coq = c == 'c';
            asked->is_elaborate = c == 'k';
        } else if (c == 'g' && read_count(optarg, GOALS_MAX, &n))
            asked->goals = n;
        else if (c == 's' && read_count(optarg, ULONG_MAX, &n))
            asked->seed = n;
        else if (c == 'p')
            asked->plugin_path = optarg;
        else if (c == 'j' && read_count(optarg, THREADS_MAX, &n))
            asked->threads = (unsigned)n;
        else if (c == 'e' && read_count(optarg, 1000000000, &n))
            asked->effort = n;
        else
            return usage(stderr);
    }
    if (argc - optind < 1 || argc - optind > 2) return usage(stderr);
    asked->path = argv[optind];
    asked->scene = argc - optind == 2 ? argv[optind + 1] : NULL;
    if (strcmp(asked->path, "-") == 0 || asked->output != NULL) asked->threads = 1;
    return -1;
}

/* Proves a certificate that has been written like any. */
static bool prove_draft(const request *asked, outcome *found)
{
    request again = *asked;
    statement s;
    input in;
    again.rewrite = NULL;
    again.text = false;
    input_begin(&in, asked->rewrite->draft);
    run_verify(&again, &in, &s, 0, found);
    statement_free(&s);
    if (found->refused)
        fprintf(stderr, "impinge-verify: %s: not written: %s\n", asked->rewrite->path, found->text);
    return !found->refused;
}

/* Puts what has been written in its place. */
static int finish(const request *asked, const outcome *before)
{
    rewrite *r = asked->rewrite;
    outcome after;
    memset(&after, 0, sizeof after);
    const bool good = r->is_ended && (r->is_coq || prove_draft(asked, &after));
    if (!rewrite_finish(r, good) || !good) return USAGE;
    if (!asked->quiet && r->is_coq)
        printf("goals: %llu of the %llu leaves that Coq can be told, of %llu%s\n",
               (unsigned long long)r->leaves, (unsigned long long)r->known,
               (unsigned long long)before->leaves,
               r->known == before->leaves
                   ? ""
                   : "; of others no axis is known, or formulas are long, or have functions that "
                     "the tactic interval lacks, such as powers that are not whole");
    if (!asked->quiet && !r->is_coq)
        printf("tightened: %llu leaves to %llu, %llu tests to %llu, %llu bytes to %ld\n",
               (unsigned long long)before->leaves, (unsigned long long)after.leaves,
               (unsigned long long)before->tests, (unsigned long long)after.tests,
               (unsigned long long)before->bytes, r->size);
    return HOLDS;
}

static int answer(const request *asked)
{
    statement s = {.apart = 0};
    outcome all;
    memset(&all, 0, sizeof all);
    if (!run_all(asked, &s, &all)) {
        fprintf(stderr, "impinge-verify: %s: %s\n", asked->path, strerror(errno));
        return USAGE;
    }
    const int status = report(asked, &s, &all);
    statement_free(&s);
    return status == HOLDS && asked->rewrite != NULL ? finish(asked, &all) : status;
}

/* Writes what the kernel proves, by its own tests; the certificate is not proved otherwise. */
static int write_for_kernel(const request *asked, rewrite *to)
{
    elaborated found;
    FILE *from = strcmp(asked->path, "-") == 0 ? stdin : fopen(asked->path, "rb");
    if (from == NULL) {
        fprintf(stderr, "impinge-verify: %s: %s\n", asked->path, strerror(errno));
        return USAGE;
    }
    run_progress *progress = run_progress_of(asked);
    const bool good = elaborate(from, to->draft, asked->effort, progress, &found);
    run_progress_end(progress);
    if (from != stdin) fclose(from);
    if (!good)
        printf("not elaborated: at byte %llu: %s\n", (unsigned long long)found.at, found.why);
    if (!rewrite_finish(to, good)) return USAGE;
    if (good && !asked->quiet)
        printf("elaborated: %llu leaves to %llu\n", (unsigned long long)found.leaves_before,
               (unsigned long long)found.leaves);
    return good ? HOLDS : REFUSED;
}

int main(int argc, char **argv)
{
    request asked = {.threads = 1, .goals = 20, .seed = 1};
    const int read = read_arguments(argc, argv, &asked);
    if (read >= 0) return read;
    if (asked.effort == 0) asked.effort = asked.is_elaborate ? EFFORT_ELABORATE : EFFORT;
    rewrite written = {.is_coq = asked.is_coq, .goals = asked.goals, .seed = asked.seed};
    if (asked.output != NULL) {
        if (!rewrite_begin(&written, asked.output, asked.path)) return USAGE;
        asked.rewrite = &written;
    }
    const int status = asked.is_elaborate ? write_for_kernel(&asked, &written) : answer(&asked);
    rewrite_finish(&written, false);
    return status;
}

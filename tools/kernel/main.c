/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "tools/kernel/kernel.h"

/* impinge-verify-kernel: proves a certificate whose leaves need no more than their axis. */
enum { HOLDS, REFUSED, USAGE };

/* Prints the name of a parameter or body, which cannot end its quotes. */
static void say_name(const char *before, const char *name)
{
    printf("%s'", before);
    for (; *name != '\0'; ++name) printf(strchr("'\\", *name) ? "\\%c" : "%c", *name);
    printf("'");
}

static void say(const claim *c, const trees *w)
{
    const clock_range *t = &c->clocks[0];
    printf("holds\n%s: no two points nearer than %.17g, t from %.17g to %.17g", c->verdict,
           c->apart, t->all.lo, t->all.hi);
    for (size_t k = 1; k < c->clock_count; ++k) {
        say_name(", ", c->clocks[k].name);
        printf(" from %.17g to %.17g", c->clocks[k].all.lo, c->clocks[k].all.hi);
    }
    if (c->has_points) printf("\ntwo points within %.17g at t = %.17g", c->within, t->at);
    for (size_t k = 1; k < c->clock_count && c->has_points; ++k) {
        say_name(", ", c->clocks[k].name);
        printf(" = %.17g", c->clocks[k].at);
    }
    for (size_t k = 0; k < c->ignored_count; ++k) {
        say_name("\nignored: ", c->bodies[c->ignored[k][0]]);
        say_name(" and ", c->bodies[c->ignored[k][1]]);
    }
    printf("\n%zu bodies, %llu pair%s of surfaces, %llu lea%s\n", c->body_count,
           (unsigned long long)w->pairs, w->pairs == 1 ? "" : "s", (unsigned long long)w->leaves,
           w->leaves == 1 ? "f" : "ves");
}

int main(int argc, char **argv)
{
    if (argc != 2 || (argv[1][0] == '-' && argv[1][1] != '\0')) {
        fputs("Usage: impinge-verify-kernel FILE (" PACKAGE_VERSION ")\n"
              "Proves what impinge-verify --elaborate wrote: 0 holds, 1 refused, 2 no file\n",
              stderr);
        return USAGE;
    }
    bytes in = {.file = strcmp(argv[1], "-") == 0 ? stdin : fopen(argv[1], "rb")};
    static claim c;
    trees w = {.in = &in, .of = &c};
    if (in.file == NULL) return perror(argv[1]), USAGE;
    const bool good = claim_read(&c, &in) && trees_hold(&w);
    if (good) say(&c, &w);
    if (!good) printf("refused at byte %llu: %s\n", (unsigned long long)in.at, in.fault);
    return fflush(stdout) != 0 ? USAGE : good ? HOLDS : REFUSED;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "tools/kernel/trees.h"

/* impinge-verify-kernel: proves a certificate whose leaves need no more than their axis. */

enum { HOLDS, REFUSED, USAGE };

static void say(const claim *c, const trees *w)
{
    printf("holds\n%s: no two points nearer than %.17g", c->verdict, c->apart);
    for (size_t k = 0; k < c->clock_count; ++k)
        printf(", %s from %.17g to %.17g", k == 0 ? "t" : c->clocks[k].name, c->clocks[k].all.lo,
               c->clocks[k].all.hi);
    if (c->has_points) printf("\ntwo points within %.17g at t", c->within);
    for (size_t k = 0; k < c->clock_count && c->has_points; ++k)
        printf("%s%s = %.17g", k == 0 ? "" : ", ", k == 0 ? "" : c->clocks[k].name,
               c->clocks[k].at);
    for (size_t k = 0; k < c->ignored_count; ++k)
        printf("\nignored: '%s' and '%s'", c->bodies[c->ignored[k][0]],
               c->bodies[c->ignored[k][1]]);
    printf("\n%llu pairs of surfaces, %llu leaves\n", (unsigned long long)w->pairs,
           (unsigned long long)w->leaves);
}

static int answer(FILE *file)
{
    bytes in = {.file = file};
    claim c;
    trees w = {.in = &in, .of = &c};
    const bool good = claim_read(&c, &in) && trees_hold(&w);
    if (good) say(&c, &w);
    if (!good) printf("refused at byte %llu: %s\n", (unsigned long long)in.at, in.fault);
    claim_free(&c);
    return good ? HOLDS : REFUSED;
}

int main(int argc, char **argv)
{
    if (argc != 2 || (argv[1][0] == '-' && argv[1][1] != '\0')) {
        fprintf(stderr,
                "impinge-verify-kernel " PACKAGE_VERSION "\nUsage: impinge-verify-kernel FILE\n"
                "Proves a certificate that impinge-verify --elaborate wrote.\n"
                "Exit status: 0 holds, 1 refused, 2 usage or no file\n");
        return USAGE;
    }
    FILE *file = strcmp(argv[1], "-") == 0 ? stdin : fopen(argv[1], "rb");
    if (file == NULL) perror(argv[1]);
    const int status = file != NULL ? answer(file) : USAGE;
    return fflush(stdout) == 0 ? status : USAGE;
}

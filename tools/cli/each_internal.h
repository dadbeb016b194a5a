/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_EACH_INTERNAL_H
#define TOOLS_CLI_EACH_INTERNAL_H

#include "tools/cli/each.h"

/* solve --each: its parts (each_parts.c), its lines (each_line.c) and their order (each.c) */

/* An answer that is not clear, and the time that it is printed in the order of. */
typedef struct timed {
    double t;
    size_t part;
} timed;

/* State while lines are printed. Pairs that are clear without a search have the same line except
 * for the bodies' names: it is made once, in two halves. */
struct printing {
    each *e;
    bool json, list_all;
    imp_result rest;    /* of the divided query */
    imp_result unknown; /* of a part that was not examined */
    char **names;       /* of bodies, as JSON */
    char *head, *tail;
    const char *advised; /* the last advice printed as text */
    size_t *waiting;     /* parts whose answers have not come */
    timed *order;        /* answers that are not clear, by time; the first `shown` are printed */
    size_t waiting_count, count, shown, lines;
    size_t clear, unexamined; /* pairs of bodies without a line */
    exit_status worst, status;
};

/* Tells the bodies of part k; false past the last. */
bool each_part_bodies(const each *e, size_t k, size_t body[2]);

/* Whether the time is over, or a signal came. */
bool each_is_over(const each *e);

/* Returns the answer for pairs of bodies that have no part: with surveys there are none. */
imp_result each_answer_of_rest(const each *e);

/* Makes the two halves of the line of clear pairs, and the names that go between. False: no
 * memory. */
bool each_prepare_lines(printing *p);

/* Prints the line of bodies a and b with this answer, whose exit status counts for `worst`. Returns
 * EXIT_ANSWERED, or complains that the line could not be written. */
exit_status each_print_line(printing *p, const imp_result *r, size_t a, size_t b);

#endif

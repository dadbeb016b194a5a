/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_WORDS_H
#define TOOLS_VERIFY_WORDS_H

#include <stddef.h>

#include "tools/verify/input.h"

/* Words of a line, and lists that grow with the lines
 * ===================================================
 * `*rest` is the part of a line that is not taken yet, NULL after its last word. A word that is
 * missing or not as expected is a fault of the input (input_refuse); numbers are 0 after a
 * fault. */

/* Takes the next word, and ends it with a null byte in the line; "": there is none. */
const char *words_take(input *in, char **rest);

/* Takes the next word, which must be a finite number, or a whole number less than `below`. */
double words_number(input *in, char **rest);
uint64_t words_whole(input *in, char **rest, uint64_t below);

/* Copies a text that must be shorter than `room` bytes. */
void words_copy(input *in, char *to, size_t room, const char *text);

/* Makes room for one more item of a list, all bytes 0. False: a fault. */
#define WORDS_GROW(IN, LIST, COUNT, ROOM)                                                          \
    ((LIST) = words_grown(IN, (LIST), (COUNT), &(ROOM), sizeof *(LIST)), !input_is_refused(IN))

void *words_grown(input *in, void *list, size_t count, size_t *room, size_t size);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_INPUT_H
#define TOOLS_VERIFY_INPUT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "core/common/sha256.h"

/* The bytes of a certificate, in order, and why it is refused */

enum { INPUT_BYTES = 4096 };

typedef struct input {
    FILE *file;
    uint64_t at; /* bytes read */
    sha256 hash;
    uint8_t read[INPUT_BYTES]; /* what is not in the hash so far */
    size_t count;
    char fault[1400]; /* empty: none. What is read afterwards is 0. */
    uint64_t fault_at;
    void (*copy)(void *context, uint8_t byte); /* takes each byte but the checksum; NULL: none */
    void *copy_context;
} input; /* input_begin, then read */

void input_begin(input *in, FILE *file);

/* Refuses the file at the byte read last; the first fault counts. Answers false. */
bool input_refuse(input *in, const char *format, ...) __attribute__((format(printf, 2, 3)));
static inline bool input_is_refused(const input *in) { return in->fault[0] != '\0'; }

/* Return 0 where the file has ended, which is a fault. */
unsigned input_byte(input *in);
unsigned input_16(input *in);                   /* the high byte first */
uint64_t input_count(input *in, uint64_t most); /* seven bits a byte, the lowest first */

/* Reads a line of at most `most` bytes, without its end, in memory that the caller frees; NULL: a
 * fault. */
char *input_line(input *in, size_t most);

/* Reads the checksum and the end of the file. */
bool input_end(input *in);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_KERNEL_CLAIM_H
#define TOOLS_KERNEL_CLAIM_H

#include <stdint.h>
#include <stdio.h>

#include "tools/kernel/expression.h"

/* The bytes of a certificate, in order, and why it is refused; all but `file` begins as 0. */
typedef struct bytes {
    FILE *file;
    uint64_t at;                               /* bytes read */
    char fault[1000];                          /* empty: none. What is read afterwards is 0. */
    void (*copy)(void *context, uint8_t byte); /* takes each byte but the checksum; NULL: none */
    void *context;
} bytes;

/* Refuses the file at the byte read last; the first fault counts. Answers false. */
bool bytes_refuse(bytes *in, const char *format, ...) __attribute__((format(printf, 2, 3)));
static inline bool bytes_are_good(const bytes *in) { return in->fault[0] == '\0'; }

unsigned bytes_next(bytes *in);                 /* 0 where it has ended, which is a fault */
uint64_t bytes_count(bytes *in, uint64_t most); /* seven bits a byte, the lowest first */

/* Reads a line without its end, in memory that the caller frees; NULL: a fault. */
char *bytes_line(bytes *in);

/* Take the next word of a line: any, a finite number, a whole number less than `below`. `*rest` is
 * NULL after the last word; one that is missing or wrong is a fault. */
const char *bytes_word(bytes *in, char **rest);
double bytes_number(bytes *in, char **rest);
uint64_t bytes_whole(bytes *in, char **rest, uint64_t below);

/* Makes room for one more item of a list, all bytes 0. False: a fault. */
bool bytes_grow(bytes *in, void **list, size_t count, size_t size);

/* What a certificate claims: its lines of text (core/CERTIFICATE.md)
 * ==================================================================
 * For all values of the clocks, of which number 0 is time, no point of a surface of one body is
 * nearer than `apart` to one of another body that is not ignored. */

enum { CLAIM_CLOCKS = SLOPE_VARIABLES - 2, CLAIM_STAGES = 33 };

/* A surface or map is, at each value of its clock, the union of its parts that exist then. */
typedef struct part {
    expression *f; /* of u, v and t, or x, y, z and t */
    range uv[2], t;
} part;

typedef struct piece {
    part *parts;
    size_t count;
} piece;

/* A type's instance. */
typedef struct stage {
    bool is_map;
    size_t clock;
    piece *pieces;
    size_t count;
} stage;

/* A shape's stage, then those of maps, in the order in which they apply. */
typedef struct surface {
    size_t body, *stages, count;
} surface;

typedef struct clock_range {
    char *name; /* NULL: time */
    range all;
    double at; /* for the two points */
} clock_range;

typedef struct point {
    size_t surface, piece;
    double uv[2];
} point;

typedef struct claim {
    const char *verdict;
    bool needs_points, needs_gap; /* by its verdict: APART is above 0 */
    double apart, within;
    clock_range clocks[CLAIM_CLOCKS];
    bool has_points;
    point points[2];
    char **bodies;
    stage *stages;
    surface *surfaces;
    size_t (*ignored)[2]; /* bodies */
    size_t clock_count, body_count, stage_count, surface_count, ignored_count;
    range offset[SLOPE_VARIABLES]; /* of what is computed; slopes point to it */
} claim;

/* Reads the lines up to "trees". To be freed whatever it answers. */
bool claim_read(claim *c, bytes *in);
void claim_free(claim *c);

bool claim_ignores(const claim *c, size_t body, size_t other);

#endif

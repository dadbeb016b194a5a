/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_KERNEL_KERNEL_H
#define TOOLS_KERNEL_KERNEL_H
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* Sets of real numbers between two doubles. Each result contains what the operands' numbers give.
 * lo <= hi, neither is NaN, and either may be infinite. */

typedef struct range {
    double lo, hi;
} range;

#define RANGE_ALL ((range){-INFINITY, INFINITY})
static inline range range_of(double x) { return (range){x, x}; }
static inline bool range_is(range x, double value) { return x.lo == value && x.hi == value; }
static inline bool range_has_0(range x) { return !(x.lo > 0 || x.hi < 0); }
static inline range range_neg(range x) { return (range){-x.hi, -x.lo}; }

range range_both(range x, range y); /* the numbers that are in both; lo > hi: there are none */
range range_hull(range x, range y);
range range_greatest(range x, range y);
double range_middle(range x); /* of a finite range, a double near its middle */
range range_add(range x, range y);
range range_sub(range x, range y);
range range_mul(range x, range y);
range range_div(range x, range y); /* RANGE_ALL if 0 is in y */
range range_pi(void);
range range_power(range x, range y);  /* of x >= 0 */
range range_square(const range x[3]); /* the sum of the three squares, or 0 */

/* A function over a box, by its slopes from the middle: at each point of the box the function is in
 * v, and it is in c, its value at the middle, plus the sum of s[j] o_j, where o_j is how far
 * variable j is from its middle. Slopes exist where a function has a kink, too. */

enum { SLOPE_VARIABLES = 8 };
typedef struct slope {
    unsigned on;         /* bit j: it may depend on variable j; the other s[j] are exactly 0 */
    bool is_undefined;   /* it may have no value somewhere in the box */
    const range *offset; /* of each variable, from its middle; NULL: it depends on none */
    range v, c, s[SLOPE_VARIABLES];
} slope;

static inline bool slope_has(const slope *x, int j) { return (x->on >> j & 1) != 0; }
slope slope_fixed(range value);
/* Variable j, which is in `where`; its middle is range_middle(where), its offset is offset[j]. */
slope slope_variable(int j, range where, const range *offset);

typedef slope slope_unary(const slope *x);
typedef slope slope_binary(const slope *x, const slope *y);
slope_unary slope_cos, slope_sin;
slope_binary slope_sum, slope_less, slope_product, slope_quotient, slope_greatest;
slope_binary slope_raised; /* to a power that is a constant; else it has no value */

/* A formula: three expressions in up to four variables
 *   part     = { item ";" } sum ";" sum ";" sum
 *   item     = name "=" sum | variable "in" "[" end "," end "]"     end = sum | "inf" | "-inf"
 *   sum      = product { ("+" | "-") product }
 *   product  = signed { ("*" | "/") signed }
 *   signed   = { "+" | "-" } operand [ "^" signed ]
 *   operand  = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
 *
 * Numbers stand for the nearest double; names are variables, those defined before, or pi. */

enum { EXPRESSION_VARIABLES = 4 };
typedef struct expression expression;

/* Reads one part; *text becomes what follows its '|', or NULL. Writes the ranges of the variables,
 * whose letters are `variables`, outward; RANGE_ALL: none is said. NULL: *why tells. */
expression *expression_read(const char **text, const char *variables,
                            range said[EXPRESSION_VARIABLES], const char **why);

/* The steps of the expression computed last, for variables with these values; begins as 0. */
typedef struct memo {
    const expression *of;
    slope *value; /* to be freed */
    range at[EXPRESSION_VARIABLES];
} memo;

/* Computes the three from slopes of the variables, which `out` may be; keeps what depends on none
 * but variables from `first` on (0, or 3: t of a map) with the same values. False: no memory. */
bool expression_compute(const expression *e, memo *m, int first, const slope *in, slope out[3]);

/* The bytes of a certificate, and why it is refused; all but `file` begins as 0. */
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
char *bytes_line(bytes *in);                    /* without its end; to be freed; NULL: a fault */
/* Take the next word of a line: any, a finite number, a whole number less than `below`. `*rest` is
 * NULL after the last word; one that is missing or wrong is a fault. */
const char *bytes_word(bytes *in, char **rest);
double bytes_number(bytes *in, char **rest);
uint64_t bytes_whole(bytes *in, char **rest, uint64_t below);
/* Makes room for one more item of a list, all bytes 0. False: a fault. */
bool bytes_grow(bytes *in, void **list, size_t count, size_t size);
/* What a certificate claims by its lines of text (core/CERTIFICATE.md): for all values of the
 * clocks, of which number 0 is time, no point of a surface of one body is nearer than `apart` to
 * one of another body that is not ignored. */

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

typedef struct stage { /* a type's instance */
    bool is_map;
    piece *pieces;
    size_t clock, count;
    memo last;
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

bool claim_read(claim *c, bytes *in);                   /* the lines up to "trees" */
bool claim_ignores(const claim *c, size_t a, size_t b); /* of two surfaces: is nothing claimed? */

/* Where two surfaces are proved to be apart: pieces of either, by their places in the order of the
 * pair; of a single piece a box of u and v; and values of the clocks. */
typedef struct cell {
    size_t first[2], count[2];
    range uv[2][2]; /* only where count is 1 */
    range clocks[CLAIM_CLOCKS];
} cell;

typedef struct pair {
    claim *of;
    const surface *side[2];
    uint32_t *order[2]; /* NULL: the pieces' own */
    size_t choices;     /* of parts of stages, in the last cell */
    const char *why;    /* the last cell failed */
} pair;

/* Visits the points of a side in a cell: of each piece and choice of parts, as slopes, at values of
 * the clocks between ends of parts, or at one, whose middles plus `shift` are the cell's. False:
 * p->why tells. */
typedef void leaf_visitor(void *context, const slope x[3], const range shift[CLAIM_CLOCKS]);
bool leaf_visit(pair *p, const cell *c, int side, leaf_visitor *visit, void *context);

/* A side's points in a cell: n.x is in `all`; and it is in a mean of the ranges `at` the corners of
 * the clocks' values, with weights that depend on these alone. Bit k of a corner: clock k is at its
 * upper end. */
typedef struct bound {
    const pair *p;
    const cell *c;
    double n[3];
    bool some; /* points; else nothing else is known */
    range all, at[1 << CLAIM_CLOCKS];
} bound;
leaf_visitor leaf_add; /* adds the points to a bound */
/* Returns whether n.(B - A) >= |n| apart for all points at one time, by either side's. */
bool leaf_holds(const bound *a, const bound *b);

/* Writes the least box of u and v of a piece of a side, by its place in the order. */
void leaf_box(const pair *p, int side, size_t place, range uv[2]);
bool leaf_point(pair *p, int side, range x[3]); /* encloses the point that the claim states */

/* The trees of a certificate, read and proved leaf by leaf (core/CERTIFICATE.md) */
enum { TREES_TIME = 4, TREES_AXIS, TREES_SAME, TREES_ALONE, TREES_CLOCK, TREES_SIDES };
enum { TREES_WHOLE = 2, TREES_DEPTH_MAX = 1000 }; /* an entry of a side that is not divided */

typedef struct tree { /* of a pair, which is being read */
    struct trees *w;
    pair p;
    size_t main;    /* the clock that entries call time */
    size_t without; /* maps left out, which are put back */
    double axis[3]; /* of the last leaf that named one; or 0 */
} tree;

typedef struct trees {
    bytes *in;
    claim *of;
    uint64_t pairs, leaves;
    /* What is done with a leaf; false: p.why tells. NULL: it is proved. */
    bool (*leaf)(void *context, tree *r, const cell *c, unsigned op);
    void *context;
} trees;

/* Proves that the stated points are as near as stated, then all trees, to the end of the file. */
bool trees_hold(trees *w);
/* Divides a cell: side 0 or 1, along u (0) or v (1), or its pieces; side 2: the values of clock
 * `along`, at `at`. The halves cover it. */
void trees_split(const pair *p, const cell *c, int side, size_t along, double at, cell half[2]);

#endif

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_STATEMENT_H
#define TOOLS_VERIFY_STATEMENT_H

#include "tools/proof/formula.h"
#include "tools/verify/input.h"

/* What a certificate states
 * =========================
 * The lines before the trees (core/CERTIFICATE.md): the claim, each instance of a type by its
 * formulas, and the surfaces as chains of instances. */

/* A part of a formula, and its domain: u, v and t, or for a map t alone (the others are infinite).
 * The exact ends are between lo and inner_lo, and between inner_hi and hi. */
typedef struct part {
    double lo[3], hi[3], inner_lo[3], inner_hi[3];
    formula *f;
    struct net *net;           /* of a shape that is a polynomial; NULL: it is none */
    struct circle *circle;     /* of a shape that is one about each v; NULL: it is none */
    struct turning *turn;      /* of a map that turns by an angle; NULL: it does not */
    bool is_moving, is_affine; /* a shape that depends on t; a map that is affine in x, y and z */
} part;

/* A piece of an instance. No parts: the certificate has no formula for it. */
typedef struct piece {
    part *parts;
    size_t count;
} piece;

typedef struct stage {
    bool is_map;
    size_t clock; /* that its t is */
    char type[64];
    piece *pieces;
    size_t count;
} stage;

/* A surface of a body: its type's instance, then its maps'. */
typedef struct chain {
    size_t body;
    size_t *stages; /* indices */
    size_t count;
} chain;

typedef struct point {
    uint64_t chain, piece;
    double u, v;
} point;

typedef struct source {
    char kind[8], type[64], hash[SHA256_TEXT]; /* "scene", "type" with its name, or "file" */
    char *file; /* of a type: the plugin's, without its folder; a file's name; else NULL */
} source;

/* What the t of formulas is: time, which is number 0, or a parameter of the scene. */
typedef struct scene_clock {
    char *name; /* NULL: time */
    double lo, hi;
    double at; /* for the two points */
} scene_clock;

enum { CLOCKS_MAX = 33 };

typedef struct statement {
    char program[64], verdict[16];
    bool has_parameters; /* it is of the format that may have some */
    double apart;
    scene_clock clocks[CLOCKS_MAX];
    size_t clock_count;
    bool has_points;
    point point[2];
    double within;
    source *sources;
    stage *stages;
    chain *chains;
    char **bodies;
    size_t (*ignored)[2]; /* bodies a < b, sorted */
    size_t source_count, stage_count, chain_count, body_count, ignored_count;
    size_t source_room, stage_room, chain_room, body_room, ignored_room;
    int steps; /* most of any formula */
} statement;

/* Reads the lines up to "trees". */
bool statement_read(statement *s, input *in);
void statement_free(statement *s);

/* Returns whether the two bodies are not tested against each other. */
bool statement_ignores(const statement *s, size_t a, size_t b);

/* Returns whether the certificate has formulas for each stage of a surface. */
bool statement_is_said(const statement *s, const chain *c);

#endif

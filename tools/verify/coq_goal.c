/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/coq_goal.h"

#include <stdlib.h>

#include "tools/verify/coq_term.h"
#include "tools/verify/coq_text.h"

static const char head[] =
    "(* Leaves of a certificate, which impinge-verify --coq has drawn. Of each leaf the verifier "
    "has\n"
    "   enclosed boxes of both surfaces; a theorem says that no two points of two of these, at "
    "one\n"
    "   time, are nearer than stated, before the maps that both surfaces share. Numbers that are\n"
    "   known as intervals, such as pi and values of parameters, are k0, k1, ...; it holds for "
    "all\n"
    "   their values. *)\n"
    "From Coq Require Import Reals Lra Psatz.\n"
    "From Interval Require Import Tactic.\n"
    "Open Scope R_scope.\n\n"
    "(* By Cauchy and Schwarz. *)\n"
    "Lemma parted : forall n1 n2 n3 a b s c x1 y1 z1 x2 y2 z2 : R,\n"
    "  0 < n1 ^ 2 + n2 ^ 2 + n3 ^ 2 -> 0 <= b - a ->\n"
    "  c ^ 2 * (n1 ^ 2 + n2 ^ 2 + n3 ^ 2) <= (b - a) ^ 2 ->\n"
    "  n1 * x1 + n2 * y1 + n3 * z1 - s <= a -> b <= n1 * x2 + n2 * y2 + n3 * z2 - s ->\n"
    "  c ^ 2 <= (x2 - x1) ^ 2 + (y2 - y1) ^ 2 + (z2 - z1) ^ 2.\n"
    "Proof.\n"
    "intros n1 n2 n3 a b s c x1 y1 z1 x2 y2 z2 N L C A B.\n"
    "set (x := x2 - x1); set (y := y2 - y1); set (z := z2 - z1).\n"
    "assert (D : b - a <= n1 * x + n2 * y + n3 * z) by (unfold x, y, z; lra).\n"
    "assert (Q : (b - a) ^ 2 <= (n1 * x + n2 * y + n3 * z) ^ 2) by (apply pow_incr; lra).\n"
    "assert (S : (n1 * x + n2 * y + n3 * z) ^ 2 <=\n"
    "            (n1 ^ 2 + n2 ^ 2 + n3 ^ 2) * (x ^ 2 + y ^ 2 + z ^ 2)).\n"
    "{ assert (0 <= (n1 * y - n2 * x) ^ 2) by apply pow2_ge_0.\n"
    "  assert (0 <= (n2 * z - n3 * y) ^ 2) by apply pow2_ge_0.\n"
    "  assert (0 <= (n3 * x - n1 * z) ^ 2) by apply pow2_ge_0. nra. }\n"
    "apply Rmult_le_reg_r with (1 := N). lra.\n"
    "Qed.\n";

void coq_put_head(FILE *to) { fputs(head, to); }

enum { NAME_SIZE = 40 };

typedef struct side_text {
    const goal *g;
    int side;
    const part **parts;
    size_t constants;
    char name[NAME_SIZE];
} side_text;

static void put_range(FILE *to, const box3 *where, int j, const char *name)
{
    coq_put_number(to, where->lo[j]);
    fprintf(to, " <= %s <= ", name);
    coq_put_number(to, where->hi[j]);
    fputs(" -> ", to);
}

/* n.x - s (t - mid) of a side. */
static void put_along(FILE *to, const side_text *s)
{
    const goal *g = s->g;
    for (int i = 0; i < 3; ++i) {
        coq_put_number(to, g->n[i]);
        fprintf(to, " * %s_%c u v t", s->name, "xyz"[i]);
        coq_put_constants(to, 'k', s->constants);
        fputs(i < 2 ? " + " : " - ", to);
    }
    coq_put_number(to, g->slope);
    fputs(" * (t - ", to);
    coq_put_number(to, g->mid);
    fputs(")", to);
}

/* The lemma that bounds one side. */
static void put_side(FILE *to, const side_text *s)
{
    const goal *g = s->g;
    fprintf(to, "Lemma %s : forall u v t", s->name);
    coq_put_constants(to, 'k', s->constants);
    fputs(" : R,\n  ", to);
    put_range(to, &g->where[s->side], U, "u");
    put_range(to, &g->where[s->side], V, "v");
    put_range(to, &(box3){{0, 0, g->t[0]}, {0, 0, g->t[1]}}, T, "t");
    coq_put_ranges(to, 'k', &g->of[s->side], s->parts);
    fputs("\n  ", to);
    if (s->side == 1) {
        coq_put_number(to, g->lower);
        fputs(" <= ", to);
    }
    put_along(to, s);
    if (s->side == 0) {
        fputs(" <= ", to);
        coq_put_number(to, g->upper);
    }
    fputs(".\nProof. intros; cbv beta zeta delta [", to);
    coq_put_names(to, s->name, &g->of[s->side]);
    fputs(" ];\n  interval with (i_bisect u, i_bisect v, i_bisect t", to);
    coq_put_bisections(to, &g->of[s->side], s->parts);
    fputs(", i_depth 100). Qed.\n", to);
}

static void put_theorem(FILE *to, const goal *g, const side_text s[2])
{
    static const char names[2][2][3] = {{"u1", "v1"}, {"u2", "v2"}};
    fprintf(to, "Theorem leaf%llu : forall u1 v1 u2 v2 t", (unsigned long long)g->leaf);
    for (int side = 0; side < 2; ++side) coq_put_constants(to, "kl"[side], s[side].constants);
    fputs(" : R,\n  ", to);
    for (int side = 0; side < 2; ++side)
        for (int j = 0; j < 2; ++j) put_range(to, &g->where[side], j, names[side][j]);
    const box3 times = {{0, 0, g->t[0]}, {0, 0, g->t[1]}};
    put_range(to, &times, T, "t");
    for (int side = 0; side < 2; ++side)
        coq_put_ranges(to, "kl"[side], &g -> of[side], s[side].parts);
    fputs("\n  ", to);
    coq_put_number(to, g->apart);
    fputs(" ^ 2 <=", to);
    for (int i = 0; i < 3; ++i) {
        fprintf(to, "%s\n  (%s_%c u2 v2 t", i > 0 ? " +" : "", s[1].name, "xyz"[i]);
        coq_put_constants(to, 'l', s[1].constants);
        fprintf(to, " - %s_%c u1 v1 t", s[0].name, "xyz"[i]);
        coq_put_constants(to, 'k', s[0].constants);
        fputs(") ^ 2", to);
    }
    fputs(".\nProof. intros; apply (parted", to);
    const double numbers[] = {g->n[0], g->n[1], g->n[2], g->upper, g->lower};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        fputc(' ', to);
        coq_put_number(to, numbers[k]);
    }
    fputs(" (", to);
    coq_put_number(to, g->slope);
    fputs(" * (t - ", to);
    coq_put_number(to, g->mid);
    fprintf(to, ")));\n  [ interval | interval | interval | apply %s; assumption | apply %s; ",
            s[0].name, s[1].name);
    fputs("assumption ]. Qed.\n", to);
}

void coq_put_goal(FILE *to, goal *g)
{
    const statement *says = g->of[0].of;
    side_text s[2];
    g->of[0].when = g->of[1].when = &g->when;
    bool good = true;
    fprintf(to, "\n(* Leaf %llu: surfaces %zu and %zu, pieces %zu and %zu *)\n",
            (unsigned long long)g->leaf, (size_t)(g->of[0].chain - says->chains),
            (size_t)(g->of[1].chain - says->chains), g->of[0].piece, g->of[1].piece);
    for (int side = 0; side < 2; ++side) {
        s[side] = (side_text){.g = g, .side = side};
        s[side].parts = malloc((g->of[side].maps + 1) * sizeof *s[side].parts);
        snprintf(s[side].name, NAME_SIZE, "leaf%llu_%c", (unsigned long long)g->leaf, "ab"[side]);
        good = good && s[side].parts != NULL &&
               coq_find_parts(&g->of[side], &g->where[side], s[side].parts);
        if (!good) continue;
        s[side].constants = coq_put_definitions(to, s[side].name, &g->of[side], s[side].parts);
        put_side(to, &s[side]);
    }
    if (good) put_theorem(to, g, s);
    for (int side = 0; side < 2; ++side) free(s[side].parts);
}

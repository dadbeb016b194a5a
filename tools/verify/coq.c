/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/coq.h"

#include <math.h>
#include <stdlib.h>

#include "core/common/random.h"
#include "tools/verify/apart_internal.h"
#include "tools/verify/coq_term.h"
#include "tools/verify/coq_text.h"

/* Boxes of a leaf that was drawn, one of either side of those that the prover enclosed: over them
 * n.A - s (t - mid) <= upper, and n.B - s (t - mid) >= lower, where lower - upper >= |n| apart. */
typedef struct goal {
    uint64_t leaf;
    place of[2];
    values when; /* that both places are of, once they are written */
    box3 where[2];
    double t[2]; /* that both have */
    double n[3], slope, mid, upper, lower, apart;
} goal;

struct coq {
    watch watch;
    goal *goals;
    size_t count, most;
    uint64_t seed, leaves, known; /* leaves seen, and those that could be drawn */
};

/* --- Drawing ---------------------------------------------------------------------------------- */

static size_t draw(coq *q, size_t below)
{
    return (size_t)(random_fraction(&q->seed) * (double)below);
}

static bool is_told(const place *of, const box3 *where)
{
    const part **parts = malloc((of->maps + 1) * sizeof *parts);
    const bool told = parts != NULL && coq_find_parts(of, where, parts);
    free(parts);
    return told;
}

/* Takes the line in time midway between both sides, and how far either reaches from it, at most, by
 * its coefficients, of which those of a line are its values at equal distances. */
static void take_line(const double *const upper[2], const double t[2], goal *g, double far[2])
{
    const int last = NET_TIMES - 1;
    const double rise = 0.5 * (upper[0][last] - upper[0][0] - (upper[1][last] - upper[1][0]));
    g->slope = t[1] > t[0] ? rise / (t[1] - t[0]) : 0;
    g->mid = 0.5 * t[0] + 0.5 * t[1];
    far[0] = far[1] = -INFINITY;
    for (int k = 0; k <= last; ++k) {
        const double line = g->slope * (t[0] + (t[1] - t[0]) * k / last - g->mid);
        far[0] = proof_larger(far[0], upper[0][k] - line);
        far[1] = proof_larger(far[1], upper[1][k] + line);
    }
}

/* Takes boxes of either side that the prover has enclosed. What is left over between them is
 * divided among both, so that Coq's bounds may be a little wider. False: no axis parted the cell,
 * or the formulas cannot be told. */
static bool take_goal(coq *q, const prover *p, goal *g)
{
    const aim *a = &p->aim;
    double far[2];
    const double *upper[2];
    ld_interval square = ld_interval_of(0);
    if (a->about != NULL || p->is_round || p->areas[0].count == 0 || p->areas[1].count == 0)
        return false;
    *g = (goal){.leaf = q->leaves, .when = p->when, .apart = p->apart};
    for (int side = 0; side < 2; ++side) {
        const area *drawn = &p->areas[side].at[draw(q, p->areas[side].count)];
        g->of[side] = drawn->of;
        g->where[side] = drawn->where;
        upper[side] = drawn->upper;
        if (!is_told(&drawn->of, &drawn->where)) return false;
    }
    for (int i = 0; i < 3; ++i) {
        g->n[i] = a->n[i];
        square = ld_interval_add(square, ld_interval_sqr(ld_interval_of(a->n[i])));
    }
    take_line(upper, p->tried.t, g, far);
    const double left = -(far[0] + far[1]) - ld_interval_sqrt(square).hi * p->apart;
    g->upper = far[0] + 0.49 * left;
    g->lower = -(far[1] + 0.49 * left);
    for (int k = 0; k < 2; ++k) {
        g->t[k] = k == 0 ? fmax(g->where[0].lo[T], g->where[1].lo[T])
                         : fmin(g->where[0].hi[T], g->where[1].hi[T]);
    }
    return left >= 0 && g->t[0] <= g->t[1];
}

/* Keeps each leaf of those that can be told with the same probability. */
static void leaf_read(void *context, prover *p, const cell *c, bool named)
{
    coq *q = context;
    goal g;
    (void)c, (void)named;
    const bool told = take_goal(q, p, &g);
    q->leaves += 1;
    if (!told) return;
    q->known += 1;
    const size_t at = q->count < q->most ? q->count++ : draw(q, (size_t)q->known);
    if (at < q->most) q->goals[at] = g;
}

static void nothing(void *context) { (void)context; }

static void split_read(void *context, const uint8_t *bytes, size_t size)
{
    (void)context, (void)bytes, (void)size;
}

static void joined(void *context, prover *p, const cell *c) { (void)context, (void)p, (void)c; }

coq *coq_begin(walk *w, size_t count, uint64_t seed)
{
    coq *q = calloc(1, sizeof *q);
    if (q == NULL) return NULL;
    q->goals = calloc(count, sizeof *q->goals);
    q->most = count;
    q->seed = seed;
    q->watch = (watch){q, nothing, split_read, leaf_read, joined, nothing};
    w->watch = &q->watch;
    if (q->goals != NULL) return q;
    coq_free(q);
    return NULL;
}

void coq_free(coq *q)
{
    if (q != NULL) free(q->goals);
    free(q);
}

/* --- Writing ---------------------------------------------------------------------------------- */

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

static void put_goal(FILE *to, goal *g)
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

size_t coq_write(const coq *q, FILE *to, uint64_t *known)
{
    fputs(head, to);
    for (size_t k = 0; k < q->count; ++k) put_goal(to, &q->goals[k]);
    *known = q->known;
    return q->count;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SCENE_VARIANTS_H
#define TESTS_SUPPORT_SCENE_VARIANTS_H

#include "tests/support/query_helpers.h"

/* One scene told in several ways: what metamorphic tests share
 * =============================================================
 * Whatever is done to a scene that does not change when its bodies touch, the answers must fit
 * together. What that means is exact, for two questions X and Y about the same motion:
 *
 *   Lemma. If Y answers contact at t_Y with a gamma_Y below X's gamma_clear, then t_lower of X is
 *   at most t_Y, and X is not clear unless t_Y is its very end.
 *   Proof. At t_Y the gap is at most gamma_Y < gamma_clear of X (G2), and before t_lower of X, or
 *   in the whole interval if X is clear, it is nowhere below X's gamma_clear (G1, G3).
 *
 * So each scene is asked on a ladder of tolerances, gamma_k = gamma 4^-k with gamma_clear gamma_k /
 * 2 > gamma_(k+1), and a variant Y asked on rung 1 must answer within [t_lower of rung 0, t of rung
 * 2]. Both bounds are sharp to a few gamma over the closing speed. Rounding in a variant moves
 * points by 1e-15 or so, against differences of gamma / 4 between rungs. */

/* --- Scenes, told in other units -------------------------------------------------------------- */

/* Lengths are multiplied by `size`; the scene's own time is rate t + clock. */
typedef struct frame {
    double size, rate, clock;
} frame;

static const frame plain = {1, 1, 0};

typedef struct setting {
    const char *name;
    void (*write)(const frame *f, FILE *a, FILE *b);
    double gamma; /* of rung 0, for size 1 */
    bool meets;   /* within its own times [0, 1] */
} setting;

const setting *setting_of(const char *name);

typedef struct telling {
    char *a, *b; /* pipelines */
} telling;

telling tell(const setting *s, const frame *f);
void untell(telling *told);

/* Puts the same maps on top of both. */
telling carry(const telling *told, const char *maps);

/* The scene in the plain frame. */
imp_scene *scene_told(imp_registry *registry, const setting *s);

/* --- The patches of the setting of that name -------------------------------------------------- */

typedef struct control {
    double point[3], velocity[3];
} control;

enum { POINTS = 16 }; /* point (i, j) is at 4 i + j */

void draw_patch(int side, control patch[POINTS]);

/* The patch as a pipeline, and as a surface in a scene file. */
char *patch_pipeline(const control patch[POINTS]);
void write_patch_json(FILE *out, const control patch[POINTS]);

/* --- Questions, and the ladder ---------------------------------------------------------------- */

double rung_gamma(const setting *s, const frame *f, int rung);
question question_of(const setting *s, const frame *f, const telling *told, int rung);

typedef struct ladder {
    const setting *about;
    imp_result rung[3];
} ladder;

ladder ladder_of(imp_registry *registry, const setting *s);

/* The lemma, for an answer on rung 1 in another frame. */
void check_answer(const ladder *l, const frame *f, const imp_result *r, const char *how);

/* Asks and checks rung 1 of a variant in the frame. */
imp_result check_told(imp_registry *registry, const ladder *l, const frame *f, const telling *told,
                      const char *how);

void for_each_setting(void (*judge)(imp_registry *registry, const ladder *l));

#endif

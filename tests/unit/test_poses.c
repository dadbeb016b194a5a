/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/formula.h>
#include <string.h>

#include "core/common/random.h"
#include "core/tree/bound_audit.h"
#include "core/tree/node.h"
#include "core/tree/pose.h"
#include "tests/support/compose.h"
#include "tests/support/judge.h"
#include "tests/support/suite.h"

/* Nodes of rigidly moved surfaces: the product of shape and pose against exact numbers, and trees
 * under chains of rigid maps against points of the surface. */

/* --- The product ------------------------------------------------------------------------------ */

static double draw(uint64_t *state, double most) { return most * random_between(state, -1, 1); }

/* A model of a function of s_j for each bit j of `depends`. */
static imp_model draw_model(uint64_t *state, uint32_t depends, double size, double e)
{
    imp_model m = imp_num(draw(state, size));
    for (int j = 0, k = 0; j < 3; ++j) {
        const double less = random_power(state, -6, 0) * size;
        if (depends >> j & 1) m.b[j] = draw(state, less);
        for (int l = j; l < 3; ++l, ++k)
            if ((depends >> j & 1) && (depends >> l & 1)) m.q[k] = draw(state, less * less / size);
        if (depends >> j & 1) m.rate[j] = size;
    }
    m.depends = depends;
    m.e = e;
    m.lo = -INFINITY, m.hi = INFINITY;
    const imp_interval range = imp_model_poly_range(&m);
    m.lo = range.lo, m.hi = range.hi;
    return m;
}

/* The truth of a model at s: at the share `off` of its remainder. */
static number truth_of(const imp_model *m, const number s[3], double off)
{
    number x = num_add(num(m->a), num_mul(num(off), num(m->e)));
    for (int j = 0, k = 0; j < 3; ++j) {
        x = num_add(x, num_mul(num(m->b[j]), s[j]));
        for (int l = j; l < 3; ++l, ++k) x = num_add(x, num_mul(num(m->q[k]), num_mul(s[j], s[l])));
    }
    return x;
}

typedef struct product {
    imp_model shape[3];
    imp_pose pose;
    double norm;
    node n;
} product;

static void draw_product(uint64_t *state, product *made)
{
    const double blur = random_bits(state) % 2 ? 0 : random_power(state, -20, 0);
    const double place = random_power(state, -3, 20);
    made->norm = 0;
    for (int i = 0; i < 3; ++i) {
        made->shape[i] =
            draw_model(state, 3, random_power(state, -3, 3), blur * random_power(state, -3, 0));
        made->pose.shift[i] = draw_model(state, 4, place, blur * random_power(state, -3, 0));
        made->pose.pivot[i] = random_bits(state) % 2 ? 0 : draw(state, random_power(state, -3, 20));
        for (int j = 0; j < 3; ++j) {
            imp_model *r = &made->pose.turn[i][j];
            *r = draw_model(state, 4, 1, blur * random_power(state, -3, 0));
            made->norm += imp_interval_mag(imp_model_range(r));
        }
    }
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 2, 3};
    made->n = (node){.region = region_make(lo, hi)};
    shape_model shape;
    pose_lanes p;
    ck_assert(shape_model_take(&shape, made->shape));
    pose_take(&p, &made->pose, made->norm);
    ck_assert(node_take_posed(&made->n, &shape, &p));
}

/* The node's bounds as models, the remainder times `share`. */
static void models_of(const node *n, double share, imp_model model[3])
{
    const quadratic3 *f = &n->f;
    for (int i = 0; i < 3; ++i) {
        model[i] =
            (imp_model){.a = f->a[i],
                        .b = {f->bu[i], f->bv[i], f->bt[i]},
                        .q = {f->quu[i], f->quv[i], f->qut[i], f->qvv[i], f->qvt[i], f->qtt[i]},
                        .e = share * n->e[i],
                        .lo = n->lo[i],
                        .hi = n->hi[i],
                        .depends = 7};
    }
}

/* Whether the image of one point of the shape lies in the node. */
static bool holds_a_point(uint64_t *state, const product *made, double share, fault *why)
{
    imp_model model[3];
    number s[3], z[3], x[3];
    num_forget();
    for (int j = 0; j < 3; ++j) s[j] = num(suite_end_or_inside(state));
    for (int j = 0; j < 3; ++j)
        z[j] = num_sub(truth_of(&made->shape[j], s, suite_end_or_inside(state)),
                       num(made->pose.pivot[j]));
    for (int i = 0; i < 3; ++i) {
        x[i] = truth_of(&made->pose.shift[i], s, suite_end_or_inside(state));
        for (int j = 0; j < 3; ++j)
            x[i] = num_add(
                x[i],
                num_mul(truth_of(&made->pose.turn[i][j], s, suite_end_or_inside(state)), z[j]));
    }
    models_of(&made->n, share, model);
    return judge_models(model, s, x, why);
}

START_TEST(the_image_of_a_shape_lies_in_its_node)
{
    uint64_t state = suite_seed();
    product made;
    fault why;
    int refuted = 0;
    for (int k = 0; k < suite_times(3000); ++k) {
        draw_product(&state, &made);
        for (int point = 0; point < 10; ++point) {
            ck_assert_msg(holds_a_point(&state, &made, 1, &why), "%s", why.text);
            refuted += !holds_a_point(&state, &made, 0.25, &why);
        }
    }
    ck_assert_int_gt(refuted, suite_times(100));
}
END_TEST

START_TEST(what_depends_on_time_is_no_shape)
{
    shape_model shape;
    imp_model model[3] = {imp_num(1), imp_num(2), imp_num(3)};
    ck_assert(shape_model_take(&shape, model));
    model[1].depends = 4;
    ck_assert(!shape_model_take(&shape, model));
}
END_TEST

START_TEST(what_is_not_finite_has_to_be_filled_otherwise)
{
    uint64_t state = suite_seed();
    product made;
    shape_model shape;
    pose_lanes p;
    draw_product(&state, &made);
    shape_model_take(&shape, made.shape);
    made.pose.turn[1][1].a = 1e300;
    pose_take(&p, &made.pose, made.norm);
    shape.a[1] = 1e300;
    ck_assert(!node_take_posed(&made.n, &shape, &p));
    shape.a[1] = NAN;
    ck_assert(!node_take_posed(&made.n, &shape, &p));
}
END_TEST

/* --- Trees ------------------------------------------------------------------------------------ */

static void keep(void *self) { (void)self; }

static const double drifts[2] = {0, 0.25};

/* An egg at rest, or moving by itself. */
static void egg(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    imp_model su, cu, sv, cv;
    imp_sincos(u, &su, &cu);
    imp_sincos(v, &sv, &cv);
    out[0] = imp_add(imp_mul(cv, cu), imp_scale(t, *(const double *)self));
    out[1] = imp_mul(cv, su);
    out[2] = imp_scale(imp_add(sv, imp_scale(imp_sqr(sv), 0.125)), 1.5);
}
IMP_SURFACE_FORMULA(egg)

static void egg_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    memcpy(lo, (double[3]){0, -1.5, -INFINITY}, 3 * sizeof *lo);
    memcpy(hi, (double[3]){6, 1.5, INFINITY}, 3 * sizeof *hi);
}

/* Turns about z through a center, and rises. */
typedef struct motion {
    double rate, rise, center[3];
} motion;

static void lift(const void *self, imp_model t, imp_pose *pose)
{
    const motion *m = self;
    imp_model sine, cosine;
    imp_pose_at_rest(pose);
    imp_sincos(imp_scale(t, m->rate), &sine, &cosine);
    if (m->rate != 0) {
        pose->turn[0][0] = pose->turn[1][1] = cosine;
        pose->turn[1][0] = sine;
        pose->turn[0][1] = imp_neg(sine);
    }
    memcpy(pose->pivot, m->center, sizeof pose->pivot);
    for (int i = 0; i < 3; ++i) pose->shift[i] = imp_num(m->center[i]);
    pose->shift[2] = imp_add(imp_scale(imp_sqr(t), m->rise), pose->shift[2]);
}
IMP_RIGID_FORMULA(lift)

static void shear(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                  imp_model out[3])
{
    (void)self;
    out[0] = imp_add(x, imp_mul(z, t)), out[1] = y, out[2] = z;
}
IMP_MAP_FORMULA(shear)

static void at_all_times(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static const imp_surface_type egg_type = {.struct_size = sizeof egg_type,
                                          .name = "egg",
                                          .destroy = keep,
                                          .domain = egg_domain,
                                          .eval = egg_eval,
                                          .rate = egg_rate,
                                          .include = egg_include};
static const imp_map_type lift_type = {.struct_size = sizeof lift_type,
                                       .name = "lift",
                                       .destroy = keep,
                                       .time_domain = at_all_times,
                                       .eval = lift_eval,
                                       .rate = lift_rate,
                                       .apply = lift_apply,
                                       .rigid = lift_rigid};
static const imp_map_type shear_type = {.struct_size = sizeof shear_type,
                                        .name = "shear",
                                        .destroy = keep,
                                        .time_domain = at_all_times,
                                        .eval = shear_eval,
                                        .rate = shear_rate,
                                        .apply = shear_apply};

/* An egg under up to three motions, of which the first may be a shear. */
typedef struct moved_egg {
    motion motion[3];
    surface *s;
    tree *t;
} moved_egg;

static moved_egg *egg_make(uint64_t *state, int drift, bool sheared, double far)
{
    moved_egg *e = calloc(1, sizeof *e);
    e->s = surface_new(&egg_type, (void *)(uintptr_t)&drifts[drift]);
    if (sheared) ck_assert_int_eq(surface_add_map(e->s, &shear_type, e), IMP_SUCCESS);
    const int maps = 1 + (int)(random_bits(state) % 3);
    for (int k = 0; k < maps; ++k) {
        motion *m = &e->motion[k];
        *m = (motion){k == 0 && maps > 1 ? 0 : draw(state, 3), draw(state, 2), {0, 0, 0}};
        for (int i = 0; i < 3; ++i) m->center[i] = draw(state, far);
        ck_assert_int_eq(surface_add_map(e->s, &lift_type, m), IMP_SUCCESS);
    }
    const tree_plan plan = {
        .kind = TREE_MODELS, .t_start = 0, .t_end = 1, .audit = bound_audit_run};
    tree_growth growth = {0};
    imp_error error;
    ck_assert_int_eq(tree_new(e->s, &plan, &e->t, &growth, &error), IMP_SUCCESS);
    return e;
}

static void egg_free(moved_egg *e)
{
    tree_free(e->t);
    surface_free(e->s);
    free(e);
}

/* A random way down; each node is held against points where it is made. Answers the last. */
static node *descend(uint64_t *state, moved_egg *e, int steps)
{
    node *n = tree_root(e->t);
    tree_growth growth = {0};
    for (int k = 0; k < steps; ++k) {
        imp_error error = {IMP_SUCCESS, ""};
        const parameter j = (parameter)(random_bits(state) % 3);
        const int side = (int)(random_bits(state) % 2);
        const imp_code code = node_child(e->t, n, j, side, &n, &growth, &error);
        ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    }
    return n;
}

START_TEST(nodes_under_chains_of_rigid_maps_hold_their_points)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(60); ++k) {
        moved_egg *e = egg_make(&state, 0, false, random_power(&state, -1, 20));
        for (int way = 0; way < 20; ++way) {
            const node *n = descend(&state, e, 12);
            ck_assert(n->bounded && n->shape != NULL && n->span != NULL);
        }
        egg_free(e);
    }
}
END_TEST

/* Points leave a turning remainder that is less than it has to be, though they lie in the node's
 * box. */
START_TEST(points_are_held_against_remainders_that_turn)
{
    uint64_t state = suite_seed();
    imp_error error;
    int refuted = 0;
    for (int k = 0; k < suite_times(60); ++k) {
        moved_egg *e = egg_make(&state, 0, false, 1);
        node less = *descend(&state, e, 8);
        ck_assert_ptr_nonnull(less.pose);
        shape_model narrower = *less.still;
        for (int i = 0; i < 3; ++i) narrower.e[i] *= 0.25;
        less.still = &narrower;
        refuted += bound_audit_run(e->s, &less, &error) == IMP_ERROR_PLUGIN;
        egg_free(e);
    }
    ck_assert_int_gt(refuted, suite_times(60) / 4);
}
END_TEST

START_TEST(what_deforms_or_moves_by_itself_is_bounded_as_before)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < 2; ++k) {
        moved_egg *e = egg_make(&state, k, k == 0, 1);
        const node *n = descend(&state, e, 4);
        ck_assert(n->bounded && n->shape == NULL && n->span == NULL);
        egg_free(e);
    }
}
END_TEST

static node *child_of(moved_egg *e, node *n, parameter j, int side)
{
    tree_growth growth = {0};
    ck_assert_int_eq(node_child(e->t, n, j, side, &n, &growth, NULL), IMP_SUCCESS);
    return n;
}

START_TEST(shapes_are_shared_by_all_times_and_spans_by_all_places)
{
    uint64_t state = suite_seed();
    moved_egg *e = egg_make(&state, 0, false, 1);
    node *early = child_of(e, tree_root(e->t), PARAMETER_T, 0);
    node *late = child_of(e, tree_root(e->t), PARAMETER_T, 1);
    node *here = child_of(e, early, PARAMETER_U, 1), *there = child_of(e, early, PARAMETER_V, 0);
    node *later = child_of(e, late, PARAMETER_U, 1);
    ck_assert_ptr_eq(here->shape, later->shape);
    ck_assert_ptr_eq(here->span, there->span);
    ck_assert_ptr_ne(here->shape, there->shape);
    ck_assert_ptr_ne(here->span, later->span);
    egg_free(e);
}
END_TEST

START_TEST(a_tree_from_the_root_of_another_has_shapes_and_spans_of_its_own)
{
    uint64_t state = suite_seed();
    tree_growth growth = {0};
    moved_egg *e = egg_make(&state, 0, false, 1);
    node *of_first = child_of(e, tree_root(e->t), PARAMETER_T, 0);
    tree *first = e->t;
    ck_assert_int_eq(tree_new_from_root(first, &e->t, &growth, NULL), IMP_SUCCESS);
    const node *of_second = child_of(e, tree_root(e->t), PARAMETER_T, 0);
    ck_assert(of_second->shape != NULL && of_second->span != NULL);
    ck_assert_ptr_ne(of_first->shape, of_second->shape);
    ck_assert_mem_eq(&of_first->f, &of_second->f, sizeof of_first->f);
    ck_assert_mem_eq(of_first->e, of_second->e, sizeof of_first->e);
    tree_free(first);
    egg_free(e);
}
END_TEST

/* Together the remainders are no larger than those of the inclusion through the maps. */
START_TEST(remainders_are_no_larger_than_through_the_maps)
{
    uint64_t state = suite_seed();
    double posed = 0, through = 0;
    for (int k = 0; k < suite_times(200); ++k) {
        moved_egg *e = egg_make(&state, 0, false, 2);
        const node *n = descend(&state, e, 8);
        imp_model model[3];
        ck_assert_int_eq(surface_include(e->s, &n->region, model), IMP_STATUS_OK);
        for (int i = 0; i < 3; ++i) {
            posed += n->e[i] / (n->e[i] + model[i].e);
            through += model[i].e / (n->e[i] + model[i].e);
        }
        egg_free(e);
    }
    ck_assert_msg(posed < through, "%g of the sum, and %g", posed, through);
}
END_TEST

SUITE_MAIN("poses", the_image_of_a_shape_lies_in_its_node, what_depends_on_time_is_no_shape,
           what_is_not_finite_has_to_be_filled_otherwise,
           nodes_under_chains_of_rigid_maps_hold_their_points,
           points_are_held_against_remainders_that_turn,
           what_deforms_or_moves_by_itself_is_bounded_as_before,
           shapes_are_shared_by_all_times_and_spans_by_all_places,
           a_tree_from_the_root_of_another_has_shapes_and_spans_of_its_own,
           remainders_are_no_larger_than_through_the_maps)

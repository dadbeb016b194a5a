/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/isolated_bowl.h"

/* Types in processes of their own answer as they do in the host. */

static void turn_pose(const void *self, imp_model t, imp_pose *pose)
{
    imp_pose_at_rest(pose);
    imp_sincos(imp_shift(t, *(const double *)self), &pose->turn[1][0], &pose->turn[0][0]);
    pose->turn[1][1] = pose->turn[0][0];
    pose->turn[0][1] = imp_neg(pose->turn[1][0]);
    pose->pivot[2] = 3;
}
IMP_RIGID_FORMULA(turn_pose)

static void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static const imp_map_type turn = {.struct_size = sizeof turn,
                                  .name = "turn",
                                  .parameter_count = 1,
                                  .create = make,
                                  .destroy = free,
                                  .time_domain = always,
                                  .eval = turn_pose_eval,
                                  .rate = turn_pose_rate,
                                  .apply = turn_pose_apply,
                                  .rigid = turn_pose_rigid};

START_TEST(answers_from_another_process_are_the_same_bit_for_bit)
{
    isolated *i = isolated_bowl(0, IMP_STATUS_OK);
    const imp_surface_type *type = isolate_surface_type(i);
    const double zero = 0;
    uint64_t state = suite_seed();
    double p[3 * 200], x[2][3 * 200], e[2][3 * 200];
    for (int k = 0; k < 600; ++k) p[k] = random_between(&state, -1, 1);
    ck_assert_int_eq(type->eval(i, 200, p, x[0], e[0]), IMP_STATUS_OK);
    ck_assert_int_eq(eval(&zero, 200, p, x[1], e[1]), IMP_STATUS_OK);
    ck_assert(memcmp(x[0], x[1], sizeof x[0]) == 0 && memcmp(e[0], e[1], sizeof e[0]) == 0);
    ck_assert_int_eq(type->eval(i, 200, p, x[0], NULL), IMP_STATUS_OK);
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    imp_model m[2][3];
    imp_rate_matrix rates[2];
    memset(m, 0, sizeof m);
    ck_assert_int_eq(type->include(i, &r, m[0]), include(&zero, &r, m[1]));
    ck_assert_int_eq(type->rate(i, &r, &rates[0]), rate(&zero, &r, &rates[1]));
    ck_assert(memcmp(m[0], m[1], sizeof m[0]) == 0);
    ck_assert(memcmp(&rates[0], &rates[1], sizeof rates[0]) == 0);
    imp_net nets[2];
    memset(nets, 0, sizeof nets);
    ck_assert_int_eq(type->net(i, &r, &nets[0]), net(&zero, &r, &nets[1]));
    ck_assert(memcmp(&nets[0], &nets[1], sizeof nets[0]) == 0 && nets[0].error[1] == 1);
    imp_model at[4], far[2];
    memset(far, 0, sizeof far);
    for (int k = 0; k < 4; ++k) at[k] = imp_param(&r, k % 3);
    ck_assert_int_eq(type->distance(i, at, &far[0]), IMP_STATUS_OK);
    ck_assert_int_eq(distance(&zero, at, &far[1]), IMP_STATUS_OK);
    ck_assert(memcmp(&far[0], &far[1], sizeof far[0]) == 0);
    at[3] = imp_num(1);
    ck_assert_int_eq(type->distance(i, at, &far[0]), IMP_STATUS_UNBOUNDED);
    double lo[3], hi[3];
    type->domain(i, lo, hi);
    ck_assert(lo[1] == -2 && hi[0] == 1 && hi[2] == INFINITY);
    isolate_destroy(i);
}
END_TEST

START_TEST(poses_from_another_process_are_the_same_bit_for_bit)
{
    const double start = 0.5;
    const imp_value value = {.count = 1, .extent = {1, 1, 1}, .number = &start};
    imp_create_error why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    isolated *i = isolate_map(pool, &turn);
    ck_assert_ptr_nonnull(i);
    ck_assert_int_eq(isolate_create(i, &value, &why), IMP_STATUS_OK);
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    const imp_model t = imp_param(&r, 2);
    imp_pose pose[2];
    memset(pose, 0, sizeof pose);
    ck_assert_int_eq(isolate_map_type(i)->rigid(i, &t, &pose[0]), IMP_STATUS_OK);
    ck_assert_int_eq(turn_pose_rigid(&start, &t, &pose[1]), IMP_STATUS_OK);
    ck_assert(memcmp(&pose[0], &pose[1], sizeof pose[0]) == 0 && pose[0].pivot[2] == 3);
    isolate_destroy(i);
}
END_TEST

START_TEST(complaints_of_create_come_through)
{
    isolated *i = isolate_surface(pool, &fussy);
    imp_create_error why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    ck_assert_int_eq(isolate_create(i, NULL, &why), IMP_STATUS_PARAMETER);
    ck_assert_int_eq(why.parameter, 0);
    ck_assert_str_eq(why.text, "too red");
    isolate_destroy(i);
}
END_TEST

START_TEST(what_destroy_did_is_kept_once_for_each_type)
{
    worker_type type;
    const char *text;
    ck_assert(!worker_pool_fault(pool, 0, &type, &text));
    isolate_destroy(isolated_bowl(0, IMP_STATUS_OK));
    isolate_destroy(isolated_bowl(KILLED_IN_DESTROY, IMP_STATUS_OK));
    ck_assert(!worker_pool_fault(pool, 0, &type, &text));
    isolate_destroy(isolated_bowl(HANG_IN_DESTROY, IMP_STATUS_OK));
    isolate_destroy(isolated_bowl(EXIT_IN_DESTROY, IMP_STATUS_OK));
    ck_assert(worker_pool_fault(pool, 0, &type, &text));
    ck_assert(type.surface == &bowl && type.map == NULL);
    ck_assert_str_eq(text, "destroy of 'bowl' does not answer within 5 s; it ran isolated, and its "
                           "process was ended");
    ck_assert(!worker_pool_fault(pool, 1, &type, &text));
}
END_TEST

START_TEST(instances_of_a_type_share_a_process)
{
    double x[2][3];
    isolated *one = isolated_bowl(PID_IN_EVAL, IMP_STATUS_OK),
             *other = isolated_bowl(PID_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(one, x[0]), IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(other, x[1]), IMP_STATUS_OK);
    ck_assert(x[0][0] == x[1][0] && x[0][0] != getpid());
    isolate_destroy(one);
    isolate_destroy(other);
}
END_TEST

enum { PIECES = 20000 };

static double columns[PIECES]; /* where each piece is: at no sin */

static size_t count_pieces(const void *self) { return self != NULL ? PIECES : 0; }

static const void *take_piece(const void *self, size_t k)
{
    (void)self;
    columns[k] = (double)k + 100;
    return &columns[k];
}

static void tile_domain(const void *self, double lo[3], double hi[3])
{
    const double at = *(const double *)self;
    memcpy(lo, (double[3]){at, 0, 0}, 3 * sizeof *lo);
    memcpy(hi, (double[3]){at + 0.5, 1, 9}, 3 * sizeof *hi);
}

static const imp_surface_type tiles = {.struct_size = sizeof tiles,
                                       .name = "tiles",
                                       .parameter_count = 1,
                                       .create = make,
                                       .destroy = destroy,
                                       .domain = tile_domain,
                                       .eval = eval,
                                       .rate = rate,
                                       .include = include,
                                       .piece_count = count_pieces,
                                       .piece = take_piece};

/* Each piece over its domain at the given times, and over a half of it: as without isolation. */
static void check_piece(const isolated *i, size_t k, const double times[2])
{
    const imp_surface_type *type = isolate_surface_type(i);
    const void *piece = type->piece(i, k);
    take_piece(NULL, k);
    double lo[3], hi[3];
    imp_model from[3], here[3];
    type->domain(piece, lo, hi);
    ck_assert(lo[0] == columns[k] && hi[0] == columns[k] + 0.5 && hi[2] == 9);
    lo[2] = times[0], hi[2] = times[1];
    for (int half = 0; half < (k % 997 == 0 ? 2 : 1); ++half) {
        if (half == 1) hi[1] = 0.5;
        const imp_region region = region_make(lo, hi);
        ck_assert_int_eq(type->include(piece, &region, from), IMP_STATUS_OK);
        ck_assert_int_eq(bowl_formula_include(&columns[k], &region, here), IMP_STATUS_OK);
        ck_assert_int_eq(memcmp(from, here, sizeof here), 0);
    }
}

/* Each reply that the host waits for costs it a switch to another process. */
START_TEST(pieces_and_their_models_come_many_at_once)
{
    const double sin = 0;
    const imp_value value = {.count = 1, .extent = {1, 1, 1}, .number = &sin};
    imp_create_error why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    struct rusage before, after;
    isolated *i = isolate_surface(pool, &tiles);
    getrusage(RUSAGE_SELF, &before);
    ck_assert_int_eq(isolate_create(i, &value, &why), IMP_STATUS_OK);
    for (size_t k = 0; k < PIECES; ++k) check_piece(i, k, (double[]){0, 9});
    getrusage(RUSAGE_SELF, &after);
    const long waits = after.ru_nvcsw - before.ru_nvcsw;
    ck_assert_msg(waits < PIECES / 10, "%ld waits", waits);
    for (size_t k = PIECES; k-- > PIECES - 300;) check_piece(i, k, (double[]){1, 2});
    for (size_t k = 0; k < 300; ++k) check_piece(i, k, (double[]){1, 2});
    check_piece(i, 300, (double[]){1, 3});
    isolate_destroy(i);
}
END_TEST

START_TEST(values_of_every_kind_arrive)
{
    static double numbers[MANY];
    for (size_t k = 0; k < MANY; ++k) numbers[k] = (double)k / 3;
    const char *text = "of 9 bytes", *names[] = {"a name", ""};
    const double table[] = {3, -7};
    const imp_value values[] = {
        {.count = MANY, .extent = {MANY / 2, 2, 1}, .number = numbers},
        {.count = 0},
        {.count = 1, .extent = {1, 1, 1}, .string = &text},
        {.count = 2, .extent = {2, 1, 1}, .number = table, .string = names},
    };
    imp_create_error why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    for (int k = 0; k < 2; ++k) {
        isolated *i = isolate_surface(pool, &comparing);
        ck_assert_int_eq(isolate_create(i, values, &why), IMP_STATUS_OK);
        isolate_destroy(i);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        answers_from_another_process_are_the_same_bit_for_bit,
        poses_from_another_process_are_the_same_bit_for_bit,
        complaints_of_create_come_through,
        what_destroy_did_is_kept_once_for_each_type,
        instances_of_a_type_share_a_process,
        pieces_and_their_models_come_many_at_once,
        values_of_every_kind_arrive,
    };
    return suite_main_with("isolate", tests, sizeof tests / sizeof *tests, open_pool, close_pool);
}

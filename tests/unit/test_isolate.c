/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/isolate.h"
#include "core/surface/region.h"

#include <impinge/formula.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/suite.h"

/* Instances in processes of their own: the same answers, and an answer when they have none. */

enum {
    CRASH_IN_CREATE = 1,
    CRASH_IN_EVAL,
    EXIT_IN_RATE,
    HANG_IN_EVAL,
    TRAP_IN_INCLUDE,
    FORK_IN_EVAL,
    PID_IN_EVAL, /* x is the number of the process */
    ALLOCATE_IN_EVAL,
    THREAD_EXIT_IN_EVAL,
    KILLED_IN_EVAL,
    STOPPED_IN_EVAL,
    EXIT_IN_DESTROY,
    HANG_IN_DESTROY,
    KILLED_IN_DESTROY
};

static imp_status make(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    if (values->number[0] == CRASH_IN_CREATE) raise(SIGSEGV);
    *self = malloc(sizeof(double));
    memcpy(*self, values->number, sizeof(double));
    return IMP_STATUS_OK;
}

static imp_status complain(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values;
    (void)self;
    why->parameter = 0;
    strcpy(why->text, "too red");
    return IMP_STATUS_PARAMETER;
}

static void bowl_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    (void)self;
    out[0] = u;
    out[1] = v;
    out[2] = imp_add(imp_add(imp_sqr(u), imp_sin(v)), t);
}
IMP_SURFACE_FORMULA(bowl_formula)

/* Address space, not memory: nothing is touched. More than 64 GiB is more than any limit. */
static imp_status allocate(void)
{
    for (int k = 0; k < 256; ++k)
        if (mmap(NULL, 1 << 28, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
                 -1, 0) == MAP_FAILED)
            return IMP_STATUS_INTERNAL;
    return IMP_STATUS_OK;
}

static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const double sin = *(const double *)self;
    if (sin == CRASH_IN_EVAL) raise(SIGSEGV);
    while (sin == HANG_IN_EVAL) pause();
    const bool is_copy = sin == FORK_IN_EVAL && fork() == 0;
    volatile double *late = x; /* what a copy writes while the next requests are answered */
    for (int k = 0; is_copy && k < 1 << 20; ++k) late[0] = -1 - k;
    if (sin == ALLOCATE_IN_EVAL) return allocate();
    if (sin == THREAD_EXIT_IN_EVAL) pthread_exit(NULL);
    if (sin == KILLED_IN_EVAL) raise(SIGKILL);
    if (sin == STOPPED_IN_EVAL) raise(SIGSTOP);
    const imp_status status = bowl_formula_eval(self, n, p, x, error);
    if (sin == PID_IN_EVAL) x[0] = getpid();
    return status;
}

static void destroy(void *self)
{
    const double sin = *(const double *)self;
    if (sin == EXIT_IN_DESTROY) exit(0);
    while (sin == HANG_IN_DESTROY) pause();
    if (sin == KILLED_IN_DESTROY) raise(SIGKILL);
    free(self);
}

static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    if (*(const double *)self == EXIT_IN_RATE) _exit(0);
    return bowl_formula_rate(self, region, rates);
}

/* Subnormals off, as -ffast-math does it. */
static void change_mode(void)
{
#if defined(__x86_64__)
    __builtin_ia32_ldmxcsr(0x1f80 | 0x8000);
#endif
}

static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    if (*(const double *)self == TRAP_IN_INCLUDE) change_mode();
    return bowl_formula_include(self, region, model);
}

static void domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    memcpy(lo, (double[3]){-1, -2, -INFINITY}, 3 * sizeof *lo);
    memcpy(hi, (double[3]){1, 2, INFINITY}, 3 * sizeof *hi);
}

static imp_status net(const void *self, const imp_region *region, imp_net *out)
{
    (void)self;
    for (int k = 0; k < IMP_NET_POINTS; ++k) out->point[2][k] = region->lo[0] / (k + 1);
    out->error[1] = region->hi[2];
    return region->lo[0] < 0.5 ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

static imp_status distance(const void *self, const imp_model point[4], imp_model *out)
{
    (void)self;
    *out = imp_sub(imp_add(point[0], point[3]), imp_mul(point[1], point[2]));
    return point[3].a < 0.75 ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

static const imp_surface_type bowl = {.struct_size = sizeof bowl,
                                      .name = "bowl",
                                      .parameter_count = 1,
                                      .create = make,
                                      .destroy = destroy,
                                      .domain = domain,
                                      .eval = eval,
                                      .rate = rate,
                                      .include = include,
                                      .net = net,
                                      .distance = distance};
static const imp_surface_type fussy = {.name = "fussy",
                                       .create = complain,
                                       .destroy = free,
                                       .domain = domain,
                                       .eval = eval,
                                       .rate = rate};

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

static worker_pool *pool;

static void open_pool(void)
{
    pool = worker_pool_new();
    ck_assert_ptr_nonnull(pool);
}

static void close_pool(void) { worker_pool_free(pool); }

static isolated *isolated_bowl(double sin, imp_status expected)
{
    const imp_value value = {.count = 1, .extent = {1, 1, 1}, .number = &sin};
    imp_create_error why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    isolated *i = isolate_surface(pool, &bowl);
    ck_assert_ptr_nonnull(i);
    ck_assert_int_eq(isolate_create(i, &value, &why), expected);
    return i;
}

static imp_status eval_at_zero(isolated *i, double x[3])
{
    const double p[3] = {0, 0, 0};
    return isolate_surface_type(i)->eval(i, 1, p, x, NULL);
}

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

START_TEST(a_crash_costs_an_answer_and_every_later_one)
{
    isolated *i = isolated_bowl(CRASH_IN_EVAL, IMP_STATUS_OK);
    const imp_surface_type *type = isolate_surface_type(i);
    double p[3] = {0, 0, 0}, x[3];
    imp_rate_matrix rates;
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    ck_assert_int_eq(type->rate(i, &r, &rates), IMP_STATUS_OK);
    ck_assert_int_eq(type->eval(i, 1, p, x, NULL), SURFACE_CRASHED);
    ck_assert_int_eq(type->rate(i, &r, &rates), SURFACE_CRASHED);
    isolate_destroy(i);
    i = isolated_bowl(EXIT_IN_RATE, IMP_STATUS_OK);
    ck_assert_int_eq(isolate_surface_type(i)->rate(i, &r, &rates), SURFACE_CRASHED);
    isolate_destroy(i);
    isolate_destroy(isolated_bowl(CRASH_IN_CREATE, SURFACE_CRASHED));
}
END_TEST

START_TEST(a_call_that_never_comes_back_is_ended_in_time)
{
    isolated *i = isolated_bowl(HANG_IN_EVAL, IMP_STATUS_OK);
    double p[3] = {0, 0, 0}, x[3];
    ck_assert_int_eq(isolate_surface_type(i)->eval(i, 1, p, x, NULL), SURFACE_HUNG);
    isolate_destroy(i);
}
END_TEST

START_TEST(a_changed_floating_point_mode_is_seen_there_too)
{
#if defined(__x86_64__)
    isolated *i = isolated_bowl(TRAP_IN_INCLUDE, IMP_STATUS_OK);
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    imp_model m[3];
    ck_assert_int_eq(isolate_surface_type(i)->include(i, &r, m), SURFACE_CHANGED_MODE);
    isolate_destroy(i);
#endif
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

START_TEST(no_child_is_left_behind)
{
    for (int k = 0; k < 20; ++k)
        isolate_destroy(isolated_bowl(k % 2 ? CRASH_IN_EVAL : 0, IMP_STATUS_OK));
    isolate_destroy(isolated_bowl(EXIT_IN_DESTROY, IMP_STATUS_OK));
    worker_pool_free(pool);
    pool = NULL;
    ck_assert_int_eq(waitpid(-1, NULL, WNOHANG), -1);
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

START_TEST(an_innocent_instance_is_lost_and_a_new_one_is_served)
{
    double x[3];
    isolated *innocent = isolated_bowl(0, IMP_STATUS_OK),
             *guilty = isolated_bowl(CRASH_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(guilty, x), SURFACE_CRASHED);
    ck_assert_int_eq(eval_at_zero(innocent, x), SURFACE_LOST);
    ck_assert_int_eq(eval_at_zero(guilty, x), SURFACE_CRASHED);
    isolated *fresh = isolated_bowl(0, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(fresh, x), IMP_STATUS_OK);
    isolate_destroy(guilty);
    isolate_destroy(innocent);
    ck_assert_int_eq(eval_at_zero(fresh, x), IMP_STATUS_OK);
    isolate_destroy(fresh);
}
END_TEST

START_TEST(a_copy_of_the_host_is_refused_and_ends_nothing)
{
    double x[3];
    isolated *i = isolated_bowl(0, IMP_STATUS_OK);
    const pid_t copy = fork();
    if (copy == 0) {
        const imp_status status = eval_at_zero(i, x);
        isolated *fresh = isolate_surface(pool, &bowl);
        imp_create_error why = {.struct_size = sizeof why};
        const imp_value value = {.count = 1, .number = x};
        const imp_status created = isolate_create(fresh, &value, &why);
        isolate_destroy(i);
        worker_pool_free(pool);
        _exit(status == SURFACE_FORKED && created == SURFACE_NO_PROCESS ? 0 : 1);
    }
    int end;
    ck_assert_int_eq(waitpid(copy, &end, 0), copy);
    ck_assert_int_eq(end, 0);
    ck_assert_int_eq(eval_at_zero(i, x), IMP_STATUS_OK);
    isolate_destroy(i);
}
END_TEST

START_TEST(a_callback_that_forks_and_returns_gives_one_answer)
{
    isolated *i = isolated_bowl(FORK_IN_EVAL, IMP_STATUS_OK);
    for (int k = 0; k < 200; ++k) {
        const double p[3] = {0.001 * k, 0, k};
        double x[3], expected[3];
        ck_assert_int_eq(isolate_surface_type(i)->eval(i, 1, p, x, NULL), IMP_STATUS_OK);
        bowl_formula_eval(NULL, 1, p, expected, NULL);
        ck_assert_mem_eq(x, expected, sizeof x);
    }
    isolate_destroy(i);
}
END_TEST

static void *make_in_thread(void *unused)
{
    (void)unused;
    return isolated_bowl(0, IMP_STATUS_OK);
}

START_TEST(an_instance_outlives_the_thread_that_made_it)
{
    pthread_t thread;
    void *made;
    double x[3];
    ck_assert_int_eq(pthread_create(&thread, NULL, make_in_thread, NULL), 0);
    ck_assert_int_eq(pthread_join(thread, &made), 0);
    usleep(20000); /* a signal at the thread's end would have come */
    ck_assert_int_eq(eval_at_zero(made, x), IMP_STATUS_OK);
    isolate_destroy(made);
}
END_TEST

START_TEST(the_process_ends_with_its_host)
{
    ck_assert_int_eq(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
    const pid_t host = fork();
    if (host == 0) {
        worker_pool_free(pool);
        open_pool();
        double x[3];
        _exit(eval_at_zero(isolated_bowl(FORK_IN_EVAL, IMP_STATUS_OK), x) == IMP_STATUS_OK ? 0 : 1);
    }
    int end;
    ck_assert_int_eq(waitpid(host, &end, 0), host);
    ck_assert_int_eq(end, 0);
    for (pid_t ended; (ended = wait(&end)) > 0;) /* until there is no descendant any more */
        ck_assert_int_ne(ended, host);
}
END_TEST

START_TEST(memory_is_limited)
{
    double x[3];
    isolated *i = isolated_bowl(ALLOCATE_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(i, x), IMP_STATUS_INTERNAL);
    isolate_destroy(i);
}
END_TEST

START_TEST(a_thread_that_ends_itself_is_a_crash)
{
    double x[3];
    isolated *i = isolated_bowl(THREAD_EXIT_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(i, x), SURFACE_CRASHED);
    isolate_destroy(i);
}
END_TEST

START_TEST(what_is_killed_or_stopped_from_outside_is_not_blamed)
{
    double x[3];
    isolated *i = isolated_bowl(KILLED_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(i, x), SURFACE_KILLED);
    isolate_destroy(i);
    i = isolated_bowl(STOPPED_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(i, x), SURFACE_KILLED);
    isolate_destroy(i);
}
END_TEST

/* --- Values ----------------------------------------------------------------------------------- */

enum { MANY = 50000 };

/* IMP_STATUS_OK if the values are those of values_of_every_kind_arrive. */
static imp_status compare(const imp_value *values, void **self, imp_create_error *why)
{
    static char instance;
    (void)why;
    *self = &instance;
    bool good = values[0].count == MANY && values[0].extent[0] == MANY / 2;
    for (size_t k = 0; good && k < MANY; ++k) good = values[0].number[k] == (double)k / 3;
    good = good && values[1].count == 0 && values[1].number == NULL && values[1].string == NULL;
    good = good && values[2].count == 1 && strcmp(values[2].string[0], "of 9 bytes") == 0;
    good = good && values[3].count == 2 && strcmp(values[3].string[1], "") == 0;
    return good && values[3].number[1] == -7 ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static void keep(void *self) { (void)self; }

static const imp_surface_type comparing = {.name = "comparing",
                                           .parameter_count = 4,
                                           .create = compare,
                                           .destroy = keep,
                                           .domain = domain,
                                           .eval = eval,
                                           .rate = rate};

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
        a_crash_costs_an_answer_and_every_later_one,
        a_call_that_never_comes_back_is_ended_in_time,
        a_changed_floating_point_mode_is_seen_there_too,
        complaints_of_create_come_through,
        no_child_is_left_behind,
        what_destroy_did_is_kept_once_for_each_type,
        instances_of_a_type_share_a_process,
        pieces_and_their_models_come_many_at_once,
        an_innocent_instance_is_lost_and_a_new_one_is_served,
        a_copy_of_the_host_is_refused_and_ends_nothing,
        a_callback_that_forks_and_returns_gives_one_answer,
        an_instance_outlives_the_thread_that_made_it,
        the_process_ends_with_its_host,
        memory_is_limited,
        a_thread_that_ends_itself_is_a_crash,
        what_is_killed_or_stopped_from_outside_is_not_blamed,
        values_of_every_kind_arrive,
    };
    return suite_main_with("isolate", tests, sizeof tests / sizeof tests[0], open_pool, close_pool);
}

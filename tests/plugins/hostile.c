/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <fcntl.h>
#include <fenv.h>
#include <locale.h>
#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <impinge/formula.h>

#include "slab.h"

/* Commits the sin that the environment asks for, in the phase that it asks for:
 * HOSTILE="eval exit". Without it a slab like any other, and hostile-map a map that lets a surface
 * rise. */

/* Returns only where the stack ends at 0. */
static size_t use_stack(size_t depth)
{
    volatile char room[4096];
    room[0] = room[depth % sizeof room] = 1;
    return room[0] != 2 && depth > 0 ? use_stack(depth - 1) + (size_t)room[0] : depth;
}

static void leave_child(void)
{
    if (fork() != 0) return;
    sleep(1000);
    _exit(0);
}

/* The number of the process goes to the file `hangs`. */
static void hang(void)
{
    const int file = open("hangs", O_CREAT | O_WRONLY, 0666);
    dprintf(file, "%d\n", (int)getpid());
    close(file);
    for (;;) pause();
}

static void *sleep_on(void *unused)
{
    for (;;) pause();
    return unused;
}

static void leave_thread(void *run(void *))
{
    pthread_t thread;
    if (pthread_create(&thread, NULL, run, NULL) == 0) pthread_detach(thread);
}

/* Crashes when the callback that started it has returned, and waits in the next one. */
static atomic_bool returned;

static void *crash_later(void *unused)
{
    while (!atomic_load(&returned)) sched_yield();
    raise(SIGSEGV);
    return unused;
}

/* Crashes when the plugin's code is no longer there. */
static void *run_on(void *unused)
{
    for (;;) sched_yield();
    return unused;
}

static void wait_for_crash(void)
{
    atomic_store(&returned, true);
    for (;;) pause();
}

/* At the end of the thread that the callback runs in, when that has returned. */
static void crash_at_end(void *unused)
{
    (void)unused;
    raise(SIGSEGV);
}

static void leave_thread_data(void)
{
    static pthread_key_t key;
    if (pthread_key_create(&key, crash_at_end) == 0) pthread_setspecific(key, &key);
}

static void block_signals(bool all)
{
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGUSR1);
    if (all) sigfillset(&blocked);
    pthread_sigmask(SIG_BLOCK, &blocked, NULL);
}

/* Signals by which users end the command. */
static void ignore_signals(void)
{
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
}

static void limit(__rlimit_resource_t what, rlim_t to)
{
    struct rlimit now;
    getrlimit(what, &now);
    now.rlim_cur = to;
    setrlimit(what, &now);
}

/* All but the standard ones; with `reuse` files of its own take their numbers. */
static void close_descriptors(bool reuse)
{
    for (int k = 3; k < 256; ++k) close(k);
    for (int k = 3; reuse && k < 256; ++k)
        (void)!open("stolen", O_CREAT | O_WRONLY | O_APPEND, 0666);
}

/* To a frame that has returned. */
static jmp_buf left;

static void jump(void) { longjmp(left, 1); }

static void let_exceptions_trap(void)
{
#if defined(__GLIBC__)
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT);
#endif
}

/* x87 with 24 bits, where there is one. */
static void lose_precision(void)
{
#if defined(__x86_64__)
    const unsigned short word = 0x007F;
    __asm__ volatile("fldcw %0" : : "m"(word));
#endif
}

/* To what belongs to the thread or the process. */
static void change_environment(const char *sin)
{
    const int error = errno;
    if (strcmp(sin, "round") == 0) fesetround(FE_UPWARD);
    if (strcmp(sin, "trap") == 0) let_exceptions_trap();
    if (strcmp(sin, "x87") == 0) lose_precision();
    if (strcmp(sin, "chdir") == 0) (void)!chdir("/");
    if (strcmp(sin, "umask") == 0) umask(0777);
    if (strcmp(sin, "block") == 0) block_signals(false);
    if (strcmp(sin, "block_all") == 0) block_signals(true);
    if (strcmp(sin, "ignore") == 0) ignore_signals();
    if (strcmp(sin, "no_file") == 0) limit(RLIMIT_FSIZE, 0);
    if (strcmp(sin, "no_descriptor") == 0) limit(RLIMIT_NOFILE, 3);
    if (strcmp(sin, "no_memory") == 0) limit(RLIMIT_AS, 1 << 20);
    if (strcmp(sin, "no_stack") == 0) limit(RLIMIT_STACK, 1 << 13);
    if (strcmp(sin, "locale") == 0) setlocale(LC_ALL, "");
    if (strcmp(sin, "uselocale") == 0) uselocale(newlocale(LC_ALL_MASK, "C.UTF-8", (locale_t)0));
    if (strcmp(sin, "thread") == 0) leave_thread(sleep_on);
    errno = strcmp(sin, "errno") == 0 ? EDOM : error;
}

/* Throws an exception of C++, where a test has linked it in. */
__attribute__((weak)) void hostile_throw(void);

static void commit(const char *sin)
{
    change_environment(sin);
    if (strcmp(sin, "crash") == 0) raise(SIGSEGV);
    if (strcmp(sin, "abort") == 0) abort();
    if (strcmp(sin, "overflow") == 0) use_stack(SIZE_MAX);
    if (strcmp(sin, "exit") == 0) exit(0);
    if (strcmp(sin, "_exit") == 0) _exit(0);
    if (strcmp(sin, "_Exit") == 0) _Exit(0);
    if (strcmp(sin, "quick_exit") == 0) quick_exit(0);
    if (strcmp(sin, "pthread_exit") == 0) pthread_exit(NULL);
    if (strcmp(sin, "hang") == 0) hang();
    if (strcmp(sin, "spin") == 0)
        for (;;) continue; /* no compiler may leave out a loop whose condition is constant */
    if (strcmp(sin, "fork") == 0) fork();
    if (strcmp(sin, "later") == 0) leave_thread(crash_later);
    if (strcmp(sin, "unloaded") == 0) leave_thread(run_on);
    if (strcmp(sin, "thread_data") == 0) leave_thread_data();
    if (strcmp(sin, "longjmp") == 0) jump();
    if (strcmp(sin, "throw") == 0 && hostile_throw != NULL) hostile_throw();
    if (strcmp(sin, "fclose") == 0) fclose(stdout);
    if (strcmp(sin, "freopen") == 0) (void)!freopen("stolen", "w", stdout);
    if (strcmp(sin, "setvbuf") == 0) setvbuf(stdout, NULL, _IOFBF, 4096);
    if (strcmp(sin, "close") == 0) close_descriptors(false);
    if (strcmp(sin, "reuse") == 0) close_descriptors(true);
    if (strcmp(sin, "child") == 0) leave_child();
    if (strcmp(sin, "print") == 0) puts("{\"verdict\": \"printed\"}"), fflush(stdout);
    if (strcmp(sin, "write") == 0) (void)!write(1, "{\"verdict\": \"written\"}\n", 23);
}

/* A line for each sin that was committed: the proof that a scene calls the callback. */
static void confess(const char *wanted)
{
    const char *file = getenv("HOSTILE_CONFESSIONS");
    const int error = errno,
              to = file != NULL ? open(file, O_CREAT | O_WRONLY | O_APPEND, 0666) : -1;
    if (to >= 0) dprintf(to, "%s\n", wanted);
    if (to >= 0) close(to);
    errno = error;
}

/* The sin that this call commits; "": none. */
static const char *committing = "";

/* What a callback fills, `size` bytes: writes before it or past its end, if that is the sin. */
static void fill_beside(void *out, size_t size)
{
    volatile char *volatile bytes = out; /* which no compiler knows the bounds of */
    if (strcmp(committing, "before") == 0) bytes[-1] = 1;
    if (strcmp(committing, "after") == 0) bytes[size] = 1;
}

/* Once in each phase: a second time would hide what the first one did. */
static void enter(const char *phase)
{
    committing = "";
    static char done[20];
    const char *wanted = getenv("HOSTILE");
    const size_t length = strlen(phase);
    if (wanted == NULL) return;
    if (done[0] != '\0' && strstr(wanted, " later") != NULL) wait_for_crash();
    if (strncmp(wanted, phase, length) != 0 || wanted[length] != ' ') return;
    if (strcmp(done, phase) == 0) return;
    snprintf(done, sizeof done, "%s", phase);
    confess(wanted);
    committing = wanted + length + 1;
    commit(committing);
}

__attribute__((constructor)) static void construct(void) { enter("constructor"); }
__attribute__((destructor)) static void destruct(void) { enter("destructor"); }

static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    if (setjmp(left) != 0) return IMP_STATUS_INTERNAL;
    enter("create");
    return slab_create(values, self, why);
}

static void destroy(void *self)
{
    enter("destroy");
    slab_destroy(self);
}

static void domain(const void *self, double lo[3], double hi[3])
{
    enter("domain");
    slab_domain(self, lo, hi);
    fill_beside(hi, 3 * sizeof *hi);
}

static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    enter("eval");
    fill_beside(error != NULL ? error : x, 3 * n * sizeof *x);
    return slab_eval(self, n, p, x, error);
}

static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    enter("rate");
    fill_beside(rates, sizeof *rates);
    return slab_rate(self, region, rates);
}

static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    enter("include");
    fill_beside(model, 3 * sizeof *model);
    return slab_include(self, region, model);
}

static imp_status net(const void *self, const imp_region *region, imp_net *out)
{
    (void)self, (void)region;
    enter("net");
    fill_beside(out, sizeof *out);
    return IMP_STATUS_UNBOUNDED;
}

static imp_status distance(const void *self, const imp_model point[4], imp_model *out)
{
    (void)self, (void)point;
    enter("distance");
    fill_beside(out, sizeof *out);
    return IMP_STATUS_UNBOUNDED;
}

/* Claims no symmetry. */
static imp_status symmetry(const void *self, imp_symmetry *out)
{
    (void)self;
    enter("symmetry");
    fill_beside(out, sizeof *out);
    return IMP_STATUS_UNBOUNDED;
}

static size_t piece_count(const void *self)
{
    (void)self;
    enter("piece_count");
    return 1;
}

static const void *piece(const void *self, size_t k)
{
    (void)k;
    enter("piece");
    return self;
}

/* The last rows of the type: its optional callbacks. */
#define HOSTILE_SURFACE(NAME, ...)                                                                 \
    {                                                                                              \
        .struct_size = sizeof(imp_surface_type), .parameter_count = 1,                             \
        .parameter_size = sizeof(imp_parameter), .name = (NAME), .summary = "slab",                \
        .equation = "(u, v, height + t)", .example = (NAME), .parameters = slab_table,             \
        .create = create, .destroy = destroy, .domain = domain, .eval = eval, .rate = rate,        \
        .include = include, __VA_ARGS__                                                            \
    }

static const imp_surface_type surface_type = HOSTILE_SURFACE("hostile", .source = NULL);
static const imp_surface_type net_type = HOSTILE_SURFACE("hostile-net", .net = net);
static const imp_surface_type distance_type =
    HOSTILE_SURFACE("hostile-distance", .distance = distance);
static const imp_surface_type symmetry_type =
    HOSTILE_SURFACE("hostile-symmetry", .distance = distance, .symmetry = symmetry);
static const imp_surface_type pieces_type =
    HOSTILE_SURFACE("hostile-pieces", .piece_count = piece_count, .piece = piece);

/* --- The map (x, y, z) -> (x, y, z + t) ------------------------------------------------------- */

static void time_domain(const void *self, double *lo, double *hi)
{
    (void)self;
    enter("time_domain");
    fill_beside(hi, sizeof *hi);
    *lo = -INFINITY, *hi = INFINITY;
}

static imp_status map_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    (void)self;
    enter("eval");
    fill_beside(error != NULL ? error : x, 3 * n * sizeof *x);
    for (size_t k = 0; k < n; ++k) {
        const double at[3] = {p[4 * k], p[4 * k + 1], p[4 * k + 2] + p[4 * k + 3]};
        memcpy(x + 3 * k, at, sizeof at);
    }
    for (size_t k = 0; error != NULL && k < 3 * n; ++k) error[k] = 0x1p-52 * fabs(x[k]);
    return IMP_STATUS_OK;
}

static imp_status map_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    (void)self, (void)box;
    enter("rate");
    fill_beside(rates, sizeof *rates);
    memset(rates, 0, sizeof *rates);
    for (int i = 0; i < 3; ++i) rates->m[i][i] = 1;
    rates->m[2][3] = 1;
    return IMP_STATUS_OK;
}

static imp_status apply(const void *self, const imp_model in[4], imp_model out[3])
{
    (void)self;
    enter("apply");
    fill_beside(out, 3 * sizeof *out);
    const imp_model sum = imp_add(in[2], in[3]);
    out[0] = in[0];
    out[1] = in[1];
    out[2] = sum;
    return IMP_STATUS_OK;
}

static imp_status rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    (void)self;
    enter("rigid");
    fill_beside(pose, sizeof *pose);
    for (int k = 0; k < 9; ++k) pose->turn[k / 3][k % 3] = imp_num(k / 3 == k % 3);
    pose->shift[0] = pose->shift[1] = imp_num(0);
    pose->shift[2] = *t;
    for (int i = 0; i < 3; ++i) pose->pivot[i] = 0;
    return IMP_STATUS_OK;
}

#define HOSTILE_MAP(NAME, ...)                                                                     \
    {                                                                                              \
        .struct_size = sizeof(imp_map_type), .parameter_count = 1,                                 \
        .parameter_size = sizeof(imp_parameter), .name = (NAME), .summary = "lift",                \
        .equation = "(x, y, z + t)", .example = (NAME), .parameters = slab_table,                  \
        .create = create, .destroy = destroy, .time_domain = time_domain, .eval = map_eval,        \
        .rate = map_rate, .apply = apply, __VA_ARGS__                                              \
    }

static const imp_map_type map_type = HOSTILE_MAP("hostile-map", .source = NULL);
static const imp_map_type rigid_type = HOSTILE_MAP("hostile-rigid", .rigid = rigid);

/* --- The file --------------------------------------------------------------------------------- */

static const imp_surface_type *const surface_types[] = {&surface_type, &net_type, &distance_type,
                                                        &symmetry_type, &pieces_type};
static const imp_map_type *const map_types[] = {&map_type, &rigid_type};
static const imp_surface_factory surface_factory = {sizeof surface_factory, 5, surface_types};
static const imp_map_factory map_factory = {sizeof map_factory, 2, map_types};

static const void *get_factory(const char *id)
{
    enter("get_factory");
    if (strcmp(id, IMP_SURFACE_FACTORY) == 0) return &surface_factory;
    return strcmp(id, IMP_MAP_FACTORY) == 0 ? &map_factory : NULL;
}

IMPINGE_PLUGIN("hostile", "1.0", "Apache-2.0", "tests", get_factory);

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L /* strdup */
#include "mistakes.h"

/* --- Create and destroy ----------------------------------------------------------------------- */

/* One coefficient more than there are. */
static imp_status overread(const imp_value *values, void **self, imp_create_error *why)
{
    const imp_status status = tube_create(values, self, why);
    if (status == IMP_STATUS_OK)
        ((tube *)*self)->wave += 0 * values[PATH].number[values[PATH].count];
    return status;
}
MISTAKE_CREATE(list_read_too_far, overread, tube_destroy);

/* The host's array is gone when eval looks at it. */
typedef struct borrower {
    tube own;
    const double *path;
} borrower;

static imp_status borrow(const imp_value *values, void **self, imp_create_error *why)
{
    const imp_status status = tube_create(values, self, why);
    if (status != IMP_STATUS_OK) return status;
    borrower *made = realloc(*self, sizeof *made);
    if (made == NULL) return free(*self), IMP_STATUS_INTERNAL;
    made->path = values[PATH].number;
    *self = made;
    return IMP_STATUS_OK;
}
static imp_status borrowed_eval(const void *self, size_t n, const double *p, double *x,
                                double *error)
{
    const borrower *b = self;
    tube now = b->own;
    memcpy(now.path, b->path, now.count * sizeof *now.path);
    return tube_formula_eval(&now, n, p, x, error);
}
MISTAKE(list_kept, borrow, tube_destroy, tube_domain, borrowed_eval, tube_formula_rate,
        tube_formula_include);

static imp_status leak(const imp_value *values, void **self, imp_create_error *why)
{
    void *volatile scratch = malloc(200);
    if (values[WAVE].number[0] < 0) return IMP_STATUS_PARAMETER;
    free(scratch);
    return tube_create(values, self, why);
}
MISTAKE_CREATE(refusal_leaks, leak, tube_destroy);

/* Allocates as many samples as the wave is high; nobody thought of a negative one. */
static imp_status sample(const imp_value *values, void **self, imp_create_error *why)
{
    volatile size_t count = (size_t)(ptrdiff_t)(16 + 16 * values[WAVE].number[0]);
    volatile double *samples = malloc(count * sizeof *samples);
    samples[0] = 0;
    free((void *)(uintptr_t)samples);
    return tube_create(values, self, why);
}
MISTAKE_CREATE(create_crashes_on_odd_value, sample, tube_destroy);

/* Radii near 0 are taken, and divided by. */
static imp_status steep_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const tube *a = self;
    const double one = 1 / a->radius * a->radius;
    const imp_status status = tube_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < n && one != 1; ++k) x[3 * k] *= one;
    for (size_t k = 0; k < n && one != 1 && error != NULL; ++k) error[3 * k] = fabs(x[3 * k]);
    return status;
}
MISTAKE_EVAL(odd_value_is_taken, steep_eval);

static void free_twice(void *self)
{
    void *volatile again = self;
    free(self);
    free(again);
}
MISTAKE_CREATE(destroy_frees_twice, tube_create, free_twice);

static void keep(void *self) { (void)self; }
MISTAKE_CREATE(destroy_does_nothing, tube_create, keep);

/* --- Eval's arrays ---------------------------------------------------------------------------- */

static imp_status first_only(const void *self, size_t n, const double *p, double *x, double *error)
{
    return tube_formula_eval(self, n < 1 ? n : 1, p, x, error);
}
MISTAKE_EVAL(first_point_only, first_only);

static imp_status flat(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = tube_formula_eval(self, n, p, x, NULL);
    for (size_t k = 0; k < n && error != NULL; ++k) error[3 * k] = error[3 * k + 1] = 1e-14;
    return status;
}
MISTAKE_EVAL(error_of_z_not_written, flat);

static imp_status wide(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = tube_formula_eval(self, n, p, x, error);
    x[3 * n] = 1;
    return status;
}
MISTAKE_EVAL(point_written_too_far, wide);

static imp_status ahead(const void *self, size_t n, const double *p, double *x, double *error)
{
    const volatile double *next = p + 3 * n;
    const imp_status status = tube_formula_eval(self, n, p, x, error);
    return *next == 1e300 ? IMP_STATUS_INTERNAL : status;
}
MISTAKE_EVAL(point_read_too_far, ahead);

static imp_status always(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = tube_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < n; ++k) error[3 * k] += 1e-16;
    return status;
}
MISTAKE_EVAL(error_written_when_null, always);

/* --- Where the domain ends, and inside of it -------------------------------------------------- */

static imp_status half_open(const void *self, size_t n, const double *p, double *x, double *error)
{
    for (size_t k = 0; k < n; ++k)
        if (p[3 * k + 1] >= 2) return IMP_STATUS_DOMAIN;
    return tube_formula_eval(self, n, p, x, error);
}
MISTAKE_EVAL(end_of_domain_refused, half_open);

/* sin(w)/w with w = u - 1.3, as a textbook gives it. */
static imp_status hole(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = tube_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < n; ++k) x[3 * k] += 0 * (sin(p[3 * k] - 1.3) / (p[3 * k] - 1.3));
    return status;
}
MISTAKE_EVAL(nan_inside, hole);

/* Has a hole in the operations of models, at a place that nobody would think of. */
static void hole_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const imp_model w = imp_shift(u, -1.2345678), one = imp_div(w, w);
    tube_formula(self, u, v, t, out);
    out[0] = imp_mul(out[0], one);
}
IMP_SURFACE_FORMULA(hole_formula)
MISTAKE_FORMULA(nan_at_odd_place, hole_formula);

static imp_status step(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = tube_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < n; ++k) x[3 * k + 2] += p[3 * k] > 2.1 ? 0x1p-10 : 0;
    return status;
}
MISTAKE_EVAL(jump_inside, step);

static void swapped(const void *self, double lo[3], double hi[3])
{
    tube_domain(self, lo, hi);
    lo[1] = 2, hi[1] = -1;
}
MISTAKE_DOMAIN(domain_swapped, swapped);

/* --- State ------------------------------------------------------------------------------------ */

/* The sine of the last angle, as points often share one. */
static double last_u = 1e300, last_radius;
static imp_status cached(const void *self, size_t n, const double *p, double *x, double *error)
{
    for (size_t k = 0; k < n; ++k)
        if (p[3 * k] != last_u) last_u = p[3 * k], last_radius = ((const tube *)self)->radius;
    return last_radius < 0 ? IMP_STATUS_INTERNAL : tube_formula_eval(self, n, p, x, error);
}
MISTAKE_EVAL(static_cache, cached);

/* Room for something in between. */
static imp_model scratch[3];
static imp_status scratched(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const imp_status status = tube_formula_include(self, region, scratch);
    for (int k = 0; k < 9; ++k) rates->m[k / 3][k % 3] = scratch[k / 3].rate[k % 3];
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_UNBOUNDED : IMP_STATUS_OK;
}
MISTAKE_RATE(static_scratch, scratched);

/* A cache in the instance, which is const only by name. */
typedef struct cacher {
    tube own;
    double last_time, last_path;
} cacher;

static imp_status make_cacher(const imp_value *values, void **self, imp_create_error *why)
{
    const imp_status status = tube_create(values, self, why);
    if (status != IMP_STATUS_OK) return status;
    cacher *made = realloc(*self, sizeof *made);
    if (made == NULL) return free(*self), IMP_STATUS_INTERNAL;
    made->last_time = INFINITY;
    *self = made;
    return IMP_STATUS_OK;
}
static imp_status cacher_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    cacher *c = (cacher *)(uintptr_t)self;
    for (size_t k = 0; k < n; ++k)
        if (p[3 * k + 2] != c->last_time)
            c->last_time = p[3 * k + 2], c->last_path = path_at(&c->own, p[3 * k + 2]);
    return tube_formula_eval(self, n, p, x, error);
}
MISTAKE(instance_cache, make_cacher, tube_destroy, tube_domain, cacher_eval, tube_formula_rate,
        tube_formula_include);

static unsigned calls;
static imp_status drifting(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = tube_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < n; ++k) x[3 * k] += ++calls % 64 == 0 ? 0x1p-52 : 0;
    return status;
}
MISTAKE_EVAL(answer_drifts, drifting);

/* --- Memory ----------------------------------------------------------------------------------- */

static imp_status on_the_heap(const void *self, size_t n, const double *p, double *x, double *error)
{
    double *room = malloc((3 * n + 1) * sizeof *room);
    if (room == NULL) return IMP_STATUS_INTERNAL;
    const imp_status status = tube_formula_eval(self, n, p, room, error);
    memcpy(x, room, 3 * n * sizeof *room);
    free(room);
    return status;
}
MISTAKE_EVAL(eval_allocates, on_the_heap);

/* strdup allocates, too. */
static imp_status copied(const void *self, const imp_region *region, imp_model model[3])
{
    char *copy = strdup("u, v, t");
    if (copy == NULL) return IMP_STATUS_INTERNAL;
    const imp_status status = tube_formula_include(self, region, model);
    free(copy);
    return status;
}
MISTAKE_INCLUDE(include_copies_text, copied);

MISTAKES("mistakes_manners", &list_read_too_far_type, &list_kept_type, &refusal_leaks_type,
         &create_crashes_on_odd_value_type, &odd_value_is_taken_type, &destroy_frees_twice_type,
         &destroy_does_nothing_type, &first_point_only_type, &error_of_z_not_written_type,
         &point_written_too_far_type, &point_read_too_far_type, &error_written_when_null_type,
         &end_of_domain_refused_type, &nan_inside_type, &nan_at_odd_place_type, &jump_inside_type,
         &domain_swapped_type, &static_cache_type, &static_scratch_type, &instance_cache_type,
         &answer_drifts_type, &eval_allocates_type, &include_copies_text_type);

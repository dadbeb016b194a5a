/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/examined_times.h"

#include "core/common/clock.h"

typedef struct span {
    double lo, hi;
} span;

typedef struct examination {
    const imp_scene *scene;
    span asked;
    examined_times *found;
    imp_error *error;
    bool all_exist;   /* all surfaces exist and are defined at all of the query's times */
    bool all_defined; /* no surface is undefined at any of the query's times */
    const limit_watch *watch;
    size_t looked; /* pairs of surfaces, and of bodies */
    bool ended;    /* by the watch */
} examination;

static span existence(const surface *s, span within)
{
    double lo, hi;
    surface_existence(s, &lo, &hi);
    return (span){lo > within.lo ? lo : within.lo, hi < within.hi ? hi : within.hi};
}

static imp_code refuse(const surface *s, const surface_instance *which, span needed,
                       imp_error *error)
{
    surface_fault(
        s, error,
        ": '%s' is defined from t = %.10g to %.10g only, got a query from %.10g to %.10g; "
        "ask about its times, or extend them (see `impinge info %s`)",
        which->name, which->lo, which->hi, needed.lo, needed.hi, which->name);
    if (error != NULL) error->code = IMP_ERROR_SCENE;
    return IMP_ERROR_SCENE;
}

static imp_code check_defined(const surface *s, span needed, imp_error *error)
{
    surface_instance which;
    if (!surface_undefined_instance(s, needed.lo, needed.hi, &which)) return IMP_SUCCESS;
    return refuse(s, &which, needed, error);
}

static imp_code examine_surfaces(examination *x, const surface *a, const surface *b)
{
    const span both = existence(b, existence(a, x->asked));
    x->found->any_pair = true;
    if (both.lo > both.hi) return IMP_SUCCESS;
    if (both.lo < x->found->lo) x->found->lo = both.lo;
    if (both.hi > x->found->hi) x->found->hi = both.hi;
    if (x->all_defined) return IMP_SUCCESS;
    const imp_code code = check_defined(a, both, x->error);
    return code == IMP_SUCCESS ? check_defined(b, both, x->error) : code;
}

/* Whether no further pair can change what was found. */
static bool is_complete(const examination *x)
{
    return x->all_defined && x->found->lo == x->asked.lo && x->found->hi == x->asked.hi;
}

/* Counts one more pair, and asks the watch now and then. */
static bool ends(examination *x)
{
    enum { PAIRS_A_LOOK = 1024 };
    if (++x->looked % PAIRS_A_LOOK == 0) x->ended = !limit_watch_goes_on(x->watch);
    return x->ended;
}

static imp_code examine_bodies(examination *x, size_t a, size_t b)
{
    const size_t of_a = scene_surface_count(x->scene, a);
    const size_t of_b = scene_surface_count(x->scene, b);
    imp_code code = IMP_SUCCESS;
    if (x->all_exist && of_a > 0 && of_b > 0)
        *x->found = (examined_times){true, x->asked.lo, x->asked.hi};
    for (size_t k = 0; k < of_a; ++k)
        for (size_t l = 0; l < of_b; ++l) {
            if (code != IMP_SUCCESS || is_complete(x) || ends(x)) return code;
            code =
                examine_surfaces(x, scene_surface(x->scene, a, k), scene_surface(x->scene, b, l));
        }
    return code;
}

static bool are_all_defined(const imp_scene *scene, span asked)
{
    surface_instance which;
    const size_t bodies = scene_body_count(scene);
    for (size_t b = 0; b < bodies; ++b) {
        const size_t count = scene_surface_count(scene, b);
        for (size_t k = 0; k < count; ++k)
            if (surface_undefined_instance(scene_surface(scene, b, k), asked.lo, asked.hi, &which))
                return false;
    }
    return true;
}

/* Where no pair is tested, and where all surfaces always exist, the number of pairs is the
 * answer. */
static bool is_known_by_count(const imp_scene *scene, examination *x)
{
    if (!scene_counts_pairs(scene)) return false;
    if (imp_scene_pair_count(scene) == 0) return true;
    if (x->all_exist) *x->found = (examined_times){true, x->asked.lo, x->asked.hi};
    return x->all_exist;
}

static bool is_before(void *context) { return clock_seconds() < *(const double *)context; }

limit_watch examined_times_until(double *seconds) { return (limit_watch){is_before, seconds}; }

imp_code examined_times_find(const imp_scene *scene, double t_start, double t_end,
                             const limit_watch *watch, examined_times *found, imp_error *error)
{
    const span asked = {t_start, t_end};
    const bool all_exist = scene_is_defined(scene, t_start, t_end);
    const bool all_defined = all_exist || are_all_defined(scene, asked);
    examination x = {.scene = scene,
                     .asked = asked,
                     .found = found,
                     .error = error,
                     .all_exist = all_exist,
                     .all_defined = all_defined,
                     .watch = watch};
    const size_t bodies = scene_body_count(scene);
    imp_code code = IMP_SUCCESS;
    *found = (examined_times){false, INFINITY, -INFINITY};
    if (is_known_by_count(scene, &x)) return IMP_SUCCESS;
    for (size_t a = 0; a < bodies; ++a)
        for (size_t b = a + 1; b < bodies; ++b) {
            if (code != IMP_SUCCESS || is_complete(&x)) return code;
            if (!ends(&x) && !scene_ignores(scene, a, b)) code = examine_bodies(&x, a, b);
            if (!x.ended) continue;
            *found = (examined_times){true, t_start, t_end};
            return code;
        }
    return code;
}

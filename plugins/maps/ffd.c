/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/ffd_model.h"
#include "plugins/patch/patch_text.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { LATTICE, LO, HI, POINTS, VELOCITIES };

#define FAR 1e100
/* Least extent of the box. */
#define EXTENT_MIN 1e-100

#define ROW_CORNER(NAME, DEFAULT, DOC) IMP_ROW(NAME, "length", DEFAULT, 0, 1, 3, 0, -FAR, FAR, DOC)
#define ROW_LATTICE(NAME, UNIT, FLAGS, DOC)                                                        \
    IMP_ROW(NAME, UNIT, NULL, FLAGS, 2, 0, 3, -FAR, FAR, DOC)

static const imp_parameter parameters[] = {
    [LATTICE] = IMP_ROW_OF(IMP_KIND_INTEGER, "lattice", "1", "[2,2,2]", 0, 1, 3, 0, 2,
                           LATTICE_SIDE_MAX, "numbers l, m, n of control points along x, y and z"),
    [LO] = ROW_CORNER("lo", "[-1,-1,-1]", "least corner of the box"),
    [HI] = ROW_CORNER("hi", "[1,1,1]", "greatest corner of the box"),
    [POINTS] = ROW_LATTICE("points", "length", 0,
                           "control points; number i, j, k is at index (i m + j) n + k"),
    [VELOCITIES] = ROW_LATTICE("velocities", "length/time", IMP_PARAMETER_OPTIONAL,
                               "of the control points, which are at `points` at time 0"),
};

/* --- Making one ------------------------------------------------------------------------------- */

static imp_status check_box(const imp_value *values, imp_create_error *why)
{
    for (int j = 0; j < 3; ++j) {
        double lo = values[LO].number[j], hi = values[HI].number[j];
        if (!(hi - lo >= EXTENT_MIN))
            return imp_reject(why, HI, j, "%g where lo is %g; must be greater, by %g at least", hi,
                              lo, EXTENT_MIN);
    }
    return IMP_STATUS_OK;
}

static imp_status check_points(const imp_value *values, int row, imp_create_error *why)
{
    const double *side = values[LATTICE].number;
    const size_t count = (size_t)(side[0] * side[1] * side[2]);
    if (!imp_is_given(&values[row]) || values[row].extent[0] == count) return IMP_STATUS_OK;
    return imp_reject(why, row, -1, "%zu %s for a lattice of %g x %g x %g; must be %zu",
                      values[row].extent[0], parameters[row].name, side[0], side[1], side[2],
                      count);
}

/* The displacement of each control point from its place, in one coordinate. */
static void set_shape(ffd_instance *s, const double *points, int axis, double *work)
{
    lattice_lane *lane = &s->shape[axis];
    const int n = s->lattice.degree[axis];
    const size_t inner = lattice_inner(&s->lattice, axis);
    const imp_interval lo = {s->lo[axis], s->lo[axis]}, hi = {s->hi[axis], s->hi[axis]};
    const imp_interval length = imp_interval_sub(hi, lo);
    for (size_t i = 0; i < lattice_points(&s->lattice); ++i) {
        const double index = (double)(i / inner % (size_t)(n + 1)),
                     x = points[3 * i + (size_t)axis];
        imp_interval part =
            imp_interval_div(imp_interval_scale(length, index), (imp_interval){n, n});
        imp_interval place = index == n ? hi : index > 0 ? imp_interval_add(lo, part) : lo;
        imp_interval off = imp_interval_sub((imp_interval){x, x}, place);
        lane->net[i] = imp_interval_mid(off);
        lane->slip = imp_larger(lane->slip, imp_interval_radius_upper(off, lane->net[i]));
    }
    lattice_set(&s->lattice, lane, work);
}

static void set_drift(ffd_instance *s, const double *velocities, int axis, double *work)
{
    for (size_t i = 0; i < lattice_points(&s->lattice); ++i)
        s->drift[axis].net[i] = velocities[3 * i + (size_t)axis];
    lattice_set(&s->lattice, &s->drift[axis], work);
}

static void set_box(ffd_instance *s, const double *lo, const double *hi)
{
    for (int j = 0; j < 3; ++j) {
        s->lo[j] = lo[j];
        s->hi[j] = hi[j];
        s->per_length[j] = near_of(imp_div(imp_num(1), imp_sub(imp_num(hi[j]), imp_num(lo[j]))));
    }
}

/* Net and series of each lane, and workspace. */
static ffd_instance *allocate(const double *side, bool moves)
{
    const size_t points = (size_t)(side[0] * side[1] * side[2]), lanes = moves ? 6 : 3;
    const size_t numbers = points * (2 * lanes + 1);
    ffd_instance *s = malloc(sizeof *s + (numbers + points * lanes) * sizeof(double));
    if (s == NULL) return NULL;
    memset(s, 0, sizeof *s);
    s->moves = moves;
    s->given = s->memory + numbers;
    for (int j = 0; j < 3; ++j) s->lattice.degree[j] = (int)side[j] - 1;
    for (size_t k = 0; k < lanes; ++k) {
        lattice_lane *lane = k < 3 ? &s->shape[k] : &s->drift[k - 3];
        lane->net = s->memory + points * (2 * k + 1);
        lane->series = lane->net + points;
    }
    return s;
}

static imp_status ffd_create(const imp_value *values, void **self, imp_create_error *why)
{
    const bool moves = imp_is_given(&values[VELOCITIES]);
    imp_status status = check_box(values, why);
    if (status == IMP_STATUS_OK) status = check_points(values, POINTS, why);
    if (status == IMP_STATUS_OK) status = check_points(values, VELOCITIES, why);
    if (status != IMP_STATUS_OK) return status;
    ffd_instance *s = allocate(values[LATTICE].number, moves);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    set_box(s, values[LO].number, values[HI].number);
    for (int axis = 0; axis < 3; ++axis) {
        set_shape(s, values[POINTS].number, axis, s->memory);
        if (moves) set_drift(s, values[VELOCITIES].number, axis, s->memory);
    }
    memcpy(s->given, values[POINTS].number, values[POINTS].count * sizeof *s->given);
    if (moves)
        memcpy(s->given + values[POINTS].count, values[VELOCITIES].number,
               values[VELOCITIES].count * sizeof *s->given);
    *self = s;
    return IMP_STATUS_OK;
}

/* --- Points ----------------------------------------------------------------------------------- */

/* a, b, c. Lemma: three roundings, so within 4 units of 2^-53 of exact. */
static void place_in_box(const ffd_instance *s, const double p[3], double at[3])
{
    for (int j = 0; j < 3; ++j) {
        double part = (p[j] - s->lo[j]) / (s->hi[j] - s->lo[j]);
        at[j] = p[j] <= s->lo[j] ? 0 : p[j] >= s->hi[j] ? 1 : imp_smaller(part, 1);
    }
}

/* A lane's value, and its error: of the lane itself, and of the place by its slopes. */
static double value_at(const ffd_instance *s, const lattice_lane *lane,
                       const lattice_weights *weights, double *error)
{
    double value = lattice_at(&s->lattice, lane, weights, error), slopes = 0;
    for (int j = 0; j < 3; ++j) slopes += imp_interval_mag(lane->slope[j]);
    *error = (*error + 4 * IMP_U * slopes) * IMP_SLACK;
    return value;
}

/* Roundings: of t Y, of X + t Y and of the sum with x, each by 2^-53 of itself. */
static double moved(const ffd_instance *s, int axis, const lattice_weights *weights,
                    const double p[4], double *error)
{
    double off = value_at(s, &s->shape[axis], weights, error), rounding = 0;
    if (s->moves) {
        double drift_error, way;
        way = p[3] * value_at(s, &s->drift[axis], weights, &drift_error);
        off += way;
        *error += fabs(p[3]) * drift_error;
        rounding = fabs(way) + fabs(off);
    }
    double x = p[axis] + off;
    rounding += fabs(x);
    *error = (*error + IMP_U * rounding + IMP_TINY) * IMP_SLACK;
    return x;
}

static imp_status ffd_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const ffd_instance *s = self;
    for (size_t k = 0; k < n; ++k) {
        double at[3], off;
        lattice_weights weights;
        place_in_box(s, p + 4 * k, at);
        lattice_weigh(&s->lattice, at, &weights);
        for (int axis = 0; axis < 3; ++axis) {
            x[3 * k + (size_t)axis] = moved(s, axis, &weights, p + 4 * k, &off);
            if (!(off < INFINITY)) return IMP_STATUS_DOMAIN;
            if (error != NULL) error[3 * k + (size_t)axis] = off;
        }
    }
    return IMP_STATUS_OK;
}

/* --- The map ---------------------------------------------------------------------------------- */

static void ffd_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                        imp_model out[3])
{
    const ffd_instance *s = self;
    const imp_model in[4] = {x, y, z, t};
    const uint32_t depends = x.depends | y.depends | z.depends | (s->moves ? t.depends : 0);
    ffd_place place;
    ffd_set_place(s, in, t, &place);
    for (int axis = 0; axis < 3; ++axis) {
        ffd_terms terms;
        ffd_set_terms(s, &place, axis, &terms);
        out[axis] = ffd_image(s, &place, axis, &terms, in[axis]);
        out[axis].depends = depends;
        ffd_set_rates(s, &place, axis, &terms, in, &out[axis]);
        out[axis] = imp_model_finish(out[axis]);
    }
}
IMP_MAP_FORMULA(ffd_formula)
IMP_MAP_AT_ALL_TIMES(ffd)

static imp_status ffd_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    return ffd_formula_apply(self, in, out);
}

/* --- As text ---------------------------------------------------------------------------------- */

/* sum_k C_k(c) (points + t velocities), from control point `at` on. */
static void write_line(const ffd_instance *s, size_t at, size_t axis, const imp_text_sink *to)
{
    const double *velocities = s->given + 3 * lattice_points(&s->lattice);
    for (size_t k = 0; k <= (size_t)s->lattice.degree[2]; ++k) {
        if (k > 0) imp_add_text(to, " + ");
        patch_add_name(to, 'C', k, "*(");
        imp_add_number(to, s->given[3 * (at + k) + axis]);
        if (s->moves) imp_add_text(to, " + t*");
        if (s->moves) imp_add_number(to, velocities[3 * (at + k) + axis]);
        imp_add_text(to, ")");
    }
}

static void write_sum(const ffd_instance *s, size_t axis, const imp_text_sink *to)
{
    const size_t rows = (size_t)s->lattice.degree[1] + 1, side = (size_t)s->lattice.degree[2] + 1;
    for (size_t i = 0; i <= (size_t)s->lattice.degree[0]; ++i) {
        imp_add_text(to, " + ");
        patch_add_name(to, 'A', i, "*(");
        for (size_t j = 0; j < rows; ++j) {
            if (j > 0) imp_add_text(to, " + ");
            patch_add_name(to, 'B', j, "*(");
            write_line(s, (i * rows + j) * side, axis, to);
            imp_add_text(to, ")");
        }
        imp_add_text(to, ")");
    }
}

/* The Bernstein polynomials reproduce the undeformed lattice: without it, x less its own place in
 * the box is left. */
static imp_status ffd_write_formula(const void *self, const imp_text_sink *to)
{
    static const char *const off[3] = {"x - (lo0 + a*(hi0 - lo0))", "; y - (lo1 + b*(hi1 - lo1))",
                                       "; z - (lo2 + c*(hi2 - lo2))"};
    const ffd_instance *s = self;
    imp_add_text(to, "a = clamp((x - lo0)/(hi0 - lo0), 0, 1); "
                     "b = clamp((y - lo1)/(hi1 - lo1), 0, 1); "
                     "c = clamp((z - lo2)/(hi2 - lo2), 0, 1); ");
    for (int j = 0; j < 3; ++j) bernstein_define(to, "ABC"[j], s -> lattice.degree[j], "abc"[j]);
    for (size_t axis = 0; axis < 3; ++axis) {
        imp_add_text(to, off[axis]);
        write_sum(s, axis, to);
    }
    return IMP_STATUS_OK;
}

static const imp_map_type ffd = {
    IMP_MAP_FIELDS_OF("ffd", ffd, ffd, free, ffd_formula_rate),
    .write_formula = ffd_write_formula,
    .summary = "free-form deformation: space follows a lattice of control points, which may move",
    .equation =
        "(x,y,z) + sum_ijk B_i(a) B_j(b) B_k(c) (points_ijk + t velocities_ijk - place_ijk); "
        "a = (x - lo_x)/(hi_x - lo_x) limited to [0,1], b and c likewise; B: Bernstein "
        "polynomials of degrees l-1, m-1, n-1; place_ijk: even spacing from lo to hi",
    .source = "Sederberg and Parry, Free-Form Deformation of Solid Geometric Models, SIGGRAPH 1986",
    .example = "ffd lattice=2,2,2 points=[[-1,-1,-1],[-1,-1,1],[-1,1,-1],[-1,1,1],"
               "[1,-1,-1],[1,-1,1],[1,1,-1],[2,2,2]]",
};

PUBLISH_MAP(ffd);

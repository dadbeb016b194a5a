/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/oracle.h"

#include "tests/support/suite.h"

/* --- Random numbers --------------------------------------------------------------------------- */

double oracle_magnitude(uint64_t *state, double least, double most)
{
    double size = random_power(state, least, most);
    return random_bits(state) & 1 ? size : -size;
}

unsigned oracle_below(uint64_t *state, unsigned n) { return (unsigned)(random_bits(state) % n); }

uint64_t oracle_seed(int trial)
{
    uint64_t state = suite_seed() + (uint64_t)trial;
    return random_bits(&state);
}

/* --- Operations: what the models do ----------------------------------------------------------- */

#define UNARY_MODEL(NAME)                                                                          \
    static imp_model model_##NAME(imp_model x, imp_model y, double k)                              \
    {                                                                                              \
        (void)y, (void)k;                                                                          \
        return imp_##NAME(x);                                                                      \
    }                                                                                              \
    static imp_interval interval_##NAME(imp_interval x, imp_interval y, double k)                  \
    {                                                                                              \
        (void)y, (void)k;                                                                          \
        return imp_interval_##NAME(x);                                                             \
    }

#define BINARY_MODEL(NAME)                                                                         \
    static imp_model model_##NAME(imp_model x, imp_model y, double k)                              \
    {                                                                                              \
        (void)k;                                                                                   \
        return imp_##NAME(x, y);                                                                   \
    }                                                                                              \
    static imp_interval interval_##NAME(imp_interval x, imp_interval y, double k)                  \
    {                                                                                              \
        (void)k;                                                                                   \
        return imp_interval_##NAME(x, y);                                                          \
    }

#define EXACT_UNARY(NAME)                                                                          \
    static bool exact_##NAME(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)                   \
    {                                                                                              \
        (void)y, (void)k;                                                                          \
        mpfi_##NAME(r, x);                                                                         \
        return !mpfi_nan_p(r);                                                                     \
    }

#define EXACT_BINARY(NAME)                                                                         \
    static bool exact_##NAME(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)                   \
    {                                                                                              \
        (void)k;                                                                                   \
        mpfi_##NAME(r, x, y);                                                                      \
        return !mpfi_nan_p(r);                                                                     \
    }

UNARY_MODEL(neg)
UNARY_MODEL(abs)
UNARY_MODEL(sqr)
UNARY_MODEL(sqrt)
UNARY_MODEL(exp)
UNARY_MODEL(log)
UNARY_MODEL(sin)
UNARY_MODEL(cos)
UNARY_MODEL(tan)
UNARY_MODEL(asin)
UNARY_MODEL(acos)
UNARY_MODEL(atan)
UNARY_MODEL(sinh)
UNARY_MODEL(cosh)
UNARY_MODEL(tanh)
BINARY_MODEL(add)
BINARY_MODEL(sub)
BINARY_MODEL(mul)
BINARY_MODEL(div)
BINARY_MODEL(min)
BINARY_MODEL(max)

EXACT_UNARY(neg)
EXACT_UNARY(abs)
EXACT_UNARY(sqr)
EXACT_UNARY(sqrt)
EXACT_UNARY(exp)
EXACT_UNARY(sin)
EXACT_UNARY(cos)
EXACT_UNARY(tan)
EXACT_UNARY(asin)
EXACT_UNARY(acos)
EXACT_UNARY(atan)
EXACT_UNARY(sinh)
EXACT_UNARY(cosh)
EXACT_UNARY(tanh)
EXACT_BINARY(add)
EXACT_BINARY(sub)
EXACT_BINARY(mul)

static imp_model model_shift(imp_model x, imp_model y, double k)
{
    (void)y;
    return imp_shift(x, k);
}

static imp_model model_scale(imp_model x, imp_model y, double k)
{
    (void)y;
    return imp_scale(x, k);
}

static imp_model model_pow(imp_model x, imp_model y, double k)
{
    (void)y;
    return imp_pow(x, k);
}

static imp_model model_powi(imp_model x, imp_model y, double k)
{
    (void)y;
    return imp_powi(x, (int)k);
}

static imp_model model_pow_model(imp_model x, imp_model y, double k)
{
    (void)k;
    return imp_pow_model(x, y);
}

static imp_model model_atan2(imp_model x, imp_model y, double k)
{
    (void)k;
    return imp_atan2(x, y);
}

static imp_model model_lerp(imp_model x, imp_model y, double k)
{
    return imp_lerp(x, y, imp_num(k));
}

/* x y + y^2 + k x, or x^2 in the place of 0 x. */
static imp_model model_dot3(imp_model x, imp_model y, double k)
{
    const imp_model a[3] = {x, y, k == 0 ? x : imp_num(k)}, b[3] = {y, y, x};
    return imp_dot3(a, b);
}

static imp_model model_sincos(imp_model x, imp_model y, double k)
{
    imp_model sine, cosine;
    (void)y;
    imp_sincos(x, &sine, &cosine);
    return k > 0 ? sine : cosine;
}

/* The polynomials whose coefficients are 1, -2, 3, -4, ...: k of them. */
enum { COEFFICIENTS_MAX = 40 };

static imp_model model_poly(imp_model x, imp_model y, double k)
{
    double coef[COEFFICIENTS_MAX];
    (void)y;
    for (int i = 0; i < COEFFICIENTS_MAX; i++) coef[i] = i % 2 ? -(i + 1) : i + 1;
    return imp_poly(coef, (size_t)k, x);
}

static imp_interval interval_scale(imp_interval x, imp_interval y, double k)
{
    (void)y;
    return imp_interval_scale(x, k);
}

static imp_interval interval_pow(imp_interval x, imp_interval y, double k)
{
    (void)y;
    return imp_interval_pow(x, k);
}

static imp_interval interval_powi(imp_interval x, imp_interval y, double k)
{
    (void)y;
    return imp_interval_powi(x, (int)k);
}

/* --- Operations: what they mean --------------------------------------------------------------- */

static bool exact_log(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)y, (void)k;
    mpfi_log(r, x);
    return mpfi_is_strictly_pos(x);
}

static bool exact_div(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)k;
    mpfi_div(r, x, y);
    return !mpfi_has_zero(y);
}

/* The first operand is y: the order of the call. On the cut MPFI leaves the sign open; ours is +.
 */
static bool exact_atan2(mpfi_ptr r, mpfi_srcptr y, mpfi_srcptr x, double k)
{
    (void)k;
    if (mpfi_has_zero(x) && mpfi_has_zero(y)) return false;
    mpfi_atan2(r, y, x);
    return !mpfi_nan_p(r);
}

static bool exact_max(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)k;
    mpfr_max(&r->left, &x->left, &y->left, MPFR_RNDD);
    mpfr_max(&r->right, &x->right, &y->right, MPFR_RNDU);
    return true;
}

static bool exact_min(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)k;
    mpfr_min(&r->left, &x->left, &y->left, MPFR_RNDD);
    mpfr_min(&r->right, &x->right, &y->right, MPFR_RNDU);
    return true;
}

static bool exact_shift(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)y;
    mpfi_add_d(r, x, k);
    return true;
}

static bool exact_scale(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)y;
    mpfi_mul_d(r, x, k);
    return true;
}

static bool exact_lerp(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    mpfi_sub(r, y, x);
    mpfi_mul_d(r, r, k);
    mpfi_add(r, r, x);
    return true;
}

static bool exact_dot3(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    mpfi_t term;
    mpfi_init2(term, ORACLE_BITS);
    mpfi_mul(r, x, y);
    mpfi_sqr(term, y);
    mpfi_add(r, r, term);
    if (k == 0)
        mpfi_sqr(term, x);
    else
        mpfi_mul_d(term, x, k);
    mpfi_add(r, r, term);
    mpfi_clear(term);
    return true;
}

static bool exact_sincos(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    return k > 0 ? exact_sin(r, x, y, k) : exact_cos(r, x, y, k);
}

static bool exact_pow(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)y;
    if (mpfi_is_zero(x) && k > 0) {
        mpfi_set_si(r, 0);
        return true;
    }
    mpfi_log(r, x);
    mpfi_mul_d(r, r, k);
    mpfi_exp(r, r);
    return mpfi_is_strictly_pos(x);
}

static bool exact_pow_model(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)k;
    mpfi_log(r, x);
    mpfi_mul(r, r, y);
    mpfi_exp(r, r);
    return mpfi_is_strictly_pos(x);
}

static bool exact_powi(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)y;
    if (k < 0 && mpfi_has_zero(x)) return false;
    mpfi_set_si(r, 1);
    for (int n = abs((int)k); n > 0; n--) mpfi_mul(r, r, x);
    if (k < 0) mpfi_inv(r, r);
    return true;
}

static bool exact_poly(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k)
{
    (void)y;
    mpfi_set_si(r, 0);
    for (int i = (int)k - 1; i >= 0; i--) {
        mpfi_mul(r, r, x);
        mpfi_add_si(r, r, i % 2 ? -(i + 1) : i + 1);
    }
    return true;
}

/* --- Operations: the table -------------------------------------------------------------------- */

static const double shifts[] = {0, 1, -0.1, 1e8, -1e300, 5e-324, 0x1p-1022, NAN};
static const double factors[] = {0, 1, -1, 0.1, 1e8, -1e300, 1e-300, 5e-324, NAN};
static const double exponents[] = {0.5,    -0.5, 1,    2,    3, -1, 2.5,
                                   1 / 3., -2.7, 10.5, 1e-3, 0, 40, NAN};
static const double whole[] = {0, 1, 2, 3, 4, 5, 6, 7, 12, 33, -1, -2, -3, -7, NAN};
static const double lengths[] = {0, 1, 2, 3, 4, 5, 6, 11, 33, 40, NAN};
static const double parts[] = {0, 1, 0.3, 2, NAN};
static const double either[] = {-1, 1, NAN};

#define UNARY(NAME)                                                                                \
    {                                                                                              \
#NAME, 1, model_##NAME, exact_##NAME, interval_##NAME, NULL                                \
    }
#define BINARY(NAME)                                                                               \
    {                                                                                              \
#NAME, 2, model_##NAME, exact_##NAME, interval_##NAME, NULL                                \
    }

const operation operations[] = {
    UNARY(neg),
    UNARY(abs),
    UNARY(sqr),
    UNARY(sqrt),
    UNARY(exp),
    UNARY(log),
    UNARY(sin),
    UNARY(cos),
    UNARY(tan),
    UNARY(asin),
    UNARY(acos),
    UNARY(atan),
    UNARY(sinh),
    UNARY(cosh),
    UNARY(tanh),
    BINARY(add),
    BINARY(sub),
    BINARY(mul),
    BINARY(div),
    BINARY(min),
    BINARY(max),
    {"shift", 1, model_shift, exact_shift, NULL, shifts},
    {"scale", 1, model_scale, exact_scale, interval_scale, factors},
    {"pow", 1, model_pow, exact_pow, interval_pow, exponents},
    {"powi", 1, model_powi, exact_powi, interval_powi, whole},
    {"poly", 1, model_poly, exact_poly, NULL, lengths},
    {"sincos", 1, model_sincos, exact_sincos, NULL, either},
    {"lerp", 2, model_lerp, exact_lerp, NULL, parts},
    {"dot3", 2, model_dot3, exact_dot3, NULL, parts},
    {"pow_model", 2, model_pow_model, exact_pow_model, NULL, NULL},
    {"atan2", 2, model_atan2, exact_atan2, NULL, NULL},
};
const int operation_count = sizeof operations / sizeof operations[0];

double operation_constant(const operation *op, uint64_t *state)
{
    unsigned n = 0;
    while (op->constants != NULL && !isnan(op->constants[n])) n++;
    return n > 0 ? op->constants[oracle_below(state, n)] : 0;
}

/* --- Points and quadratics -------------------------------------------------------------------- */

void oracle_place(uint64_t *state, double s[3])
{
    for (int j = 0; j < 3; j++) {
        unsigned kind = oracle_below(state, 6);
        s[j] = kind < 2 ? 1 : kind < 4 ? -1 : kind < 5 ? 0 : random_between(state, -1, 1);
    }
}

void oracle_quadratic(mpfi_ptr value, const imp_model *m, const mpfi_t s[3])
{
    static const int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
    mpfi_t term;
    mpfi_init2(term, ORACLE_BITS);
    mpfi_set_d(value, m->a);
    for (int j = 0; j < 3; j++) {
        mpfi_mul_d(term, s[j], m->b[j]);
        mpfi_add(value, value, term);
    }
    for (int k = 0; k < 6; k++) {
        if (row[k] == column[k])
            mpfi_sqr(term, s[row[k]]);
        else
            mpfi_mul(term, s[row[k]], s[column[k]]);
        mpfi_mul_d(term, term, m->q[k]);
        mpfi_add(value, value, term);
    }
    mpfi_clear(term);
}

/* --- Claims ----------------------------------------------------------------------------------- */

static bool depends_is_kept(const imp_model *m)
{
    static const int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
    bool kept = m->depends < 8 && m->reserved == 0;
    for (int j = 0; j < 3; j++)
        kept = kept && (m->depends >> j & 1 || (m->b[j] == 0 && m->rate[j] == 0));
    for (int k = 0; k < 6; k++)
        kept = kept && ((m->depends >> row[k] & m->depends >> column[k] & 1) || m->q[k] == 0);
    return kept;
}

bool model_is_well_formed(const imp_model *m)
{
    bool good = isfinite(m->a) && m->e >= 0 && m->lo <= m->hi;
    for (int j = 0; j < 3; j++) good = good && isfinite(m->b[j]) && m->rate[j] >= 0;
    for (int k = 0; k < 6; k++) good = good && isfinite(m->q[k]);
    return good && m->lo < INFINITY && m->hi > -INFINITY && depends_is_kept(m);
}

bool quadratic_is_refuted(const imp_model *m, const mpfi_t s[3], mpfi_srcptr value)
{
    mpfi_t off;
    if (m->e == INFINITY) return false;
    mpfi_init2(off, ORACLE_BITS);
    oracle_quadratic(off, m, s);
    mpfi_sub(off, off, value);
    mpfi_abs(off, off);
    bool refuted = mpfr_cmp_d(&off->left, m->e) > 0;
    mpfi_clear(off);
    return refuted;
}

bool range_is_refuted(double lo, double hi, mpfi_srcptr value)
{
    return mpfr_cmp_d(&value->left, hi) > 0 || mpfr_cmp_d(&value->right, lo) < 0;
}

const char *model_text(const imp_model *m)
{
    static char text[8][800];
    static int next;
    char *out = text[next++ % 8];
    snprintf(out, sizeof text[0],
             "a %a b %a %a %a q %a %a %a %a %a %a e %a range %a %a rate %a %a %a depends %u", m->a,
             m->b[0], m->b[1], m->b[2], m->q[0], m->q[1], m->q[2], m->q[3], m->q[4], m->q[5], m->e,
             m->lo, m->hi, m->rate[0], m->rate[1], m->rate[2], m->depends);
    return out;
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/operation.h"
#include "plugins/expression/functions.h"

int opcode_operands(opcode code)
{
    switch (code) {
    case OP_CONSTANT:
    case OP_VARIABLE:
        return 0;
    case OP_ADD:
    case OP_MULTIPLY:
    case OP_DIVIDE:
    case OP_POWER:
    case OP_MIN:
    case OP_MAX:
    case OP_ATAN2:
    case OP_HYPOT:
    case OP_COPYSIGN:
        return 2;
    case OP_HYPOT3:
        return 3;
    default:
        return 1;
    }
}

imp_model near_model(near_constant k)
{
    return k.error == 0 ? imp_num(k.value) : imp_known(k.value, k.error);
}

/* --- Models ----------------------------------------------------------------------------------- */

static imp_model function_model(opcode code, const imp_model *x)
{
    switch (code) {
    case OP_ABS:
        return imp_abs(*x);
    case OP_SQRT:
        return imp_sqrt(*x);
    case OP_CBRT:
        return cube_root(*x);
    case OP_EXP:
        return imp_exp(*x);
    case OP_LOG:
        return imp_log(*x);
    case OP_SIN:
        return imp_sin(*x);
    case OP_COS:
        return imp_cos(*x);
    case OP_TAN:
        return imp_tan(*x);
    case OP_ASIN:
        return imp_asin(*x);
    case OP_ACOS:
        return imp_acos(*x);
    case OP_ATAN:
        return imp_atan(*x);
    case OP_SINH:
        return imp_sinh(*x);
    case OP_COSH:
        return imp_cosh(*x);
    case OP_TANH:
        return imp_tanh(*x);
    default:
        return imp_unbounded(x->depends);
    }
}

imp_model operation_model(const operation *o, const imp_model *values)
{
    const imp_model *x = &values[o->operand[0]], *y = &values[o->operand[1]];
    switch (o->code) {
    case OP_CONSTANT:
        return near_model(o->k);
    case OP_NEGATE:
        return imp_neg(*x);
    case OP_ADD:
        return imp_add(*x, *y);
    case OP_MULTIPLY:
        return imp_mul(*x, *y);
    case OP_DIVIDE:
        return imp_div(*x, *y);
    case OP_SHIFT:
        return near_shift(*x, o->k);
    case OP_SCALE:
        return near_scale(*x, o->k);
    case OP_SQUARE:
        return imp_sqr(*x);
    case OP_POWER_N:
        return imp_powi(*x, o->n);
    case OP_POWER_K:
        return near_power(*x, o->k);
    case OP_POWER:
        return imp_pow_model(*x, *y);
    case OP_MIN:
        return imp_min(*x, *y);
    case OP_MAX:
        return imp_max(*x, *y);
    case OP_ATAN2:
        return imp_atan2(*x, *y);
    case OP_HYPOT:
        return distance(x, y, NULL);
    case OP_HYPOT3:
        return distance(x, y, &values[o->operand[2]]);
    case OP_COPYSIGN:
        return copy_sign(*x, *y);
    default:
        return function_model(o->code, x);
    }
}

/* --- Points ----------------------------------------------------------------------------------- */

static near_constant nothing_known(void) { return (near_constant){0, INFINITY}; }

/* An infinite or NaN value is unknown. */
static near_constant known(double value, double error)
{
    return error < INFINITY ? (near_constant){value, error} : nothing_known();
}

/* The next three are imp_add_point_, imp_mul_point_ and imp_div_point_ of the model header, without
 * making models: roundings are bounded there. */
static near_constant add_points(near_constant x, near_constant y)
{
    double a = x.value + y.value;
    return known(a, (x.error + y.error + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK);
}

static near_constant multiply_points(near_constant x, near_constant y)
{
    double a = x.value * y.value;
    double inherited = x.error * fabs(y.value) + y.error * (fabs(x.value) + x.error);
    return known(a, (inherited + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK);
}

static near_constant divide_points(near_constant x, near_constant y)
{
    double a = x.value / y.value, least = imp_sum_down(fabs(y.value) - y.error);
    double inherited = (x.error + (imp_round_up(fabs(a)) * y.error + IMP_TINY)) / least;
    if (!(least > 0)) return nothing_known();
    return known(a, (inherited + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK);
}

/* g(x) = y as libm gives it, slope >= |g'| within the error of x: imp_point_, likewise. If the
 * slope is infinite or NaN, the result is unknown. */
static near_constant function_at(near_constant x, double y, double slope)
{
    double inherited = x.error == 0 ? 0 : (slope + IMP_TINY) * x.error;
    return known(y, (fabs(y) * IMP_LIBM + inherited + IMP_TINY) * IMP_SLACK);
}

/* e^(x + 2^-11) < 1.0005 e^x. */
static near_constant exp_at(near_constant x)
{
    double y = imp_libm_exp(x.value);
    return function_at(x, y, x.error <= 0x1p-11 ? 1.001 * y : INFINITY);
}

static near_constant sqrt_at(near_constant x)
{
    double least = imp_sum_down(x.value - x.error);
    if (!(least > 0)) return nothing_known();
    return function_at(x, sqrt(x.value), imp_round_up(0.5 / imp_round_down(sqrt(least))));
}

static near_constant log_at(near_constant x)
{
    double least = imp_sum_down(x.value - x.error);
    if (!(least > 0)) return nothing_known();
    return function_at(x, log(x.value), imp_round_up(1 / least));
}

/* |d z^n / dz| = |n| |z|^(n-1), largest where |z| is, as n > 0. */
static near_constant power_at(near_constant x, int32_t n)
{
    double top = imp_sum_up(fabs(x.value) + x.error);
    double slope = x.error == 0 ? 0 : imp_libm_up(imp_libm_pow(top, n - 1)) * n;
    return n > 0 ? function_at(x, imp_libm_pow(x.value, n), imp_round_up(slope)) : nothing_known();
}

/* The larger of two numbers changes by no more than the one that changes more. */
static near_constant larger_at(near_constant x, near_constant y)
{
    return known(imp_larger(x.value, y.value), imp_larger(x.error, y.error));
}

static near_constant negate_at(near_constant x) { return (near_constant){-x.value, x.error}; }

/* With models. */
static near_constant other_point(const operation *o, const near_constant *values)
{
    imp_model operands[3];
    operation there = *o;
    for (int i = 0; i < opcode_operands(o->code); ++i) {
        operands[i] = near_model(values[o->operand[i]]);
        there.operand[i] = (uint16_t)i;
    }
    if (operation_is_undefined(&there, operands)) return nothing_known();
    return near_of(operation_model(&there, operands));
}

/* Direct evaluation, faster than with models; the result may be unknown. */
static near_constant short_way(const operation *o, near_constant x, near_constant y)
{
    switch (o->code) {
    case OP_CONSTANT:
        return o->k;
    case OP_NEGATE:
        return negate_at(x);
    case OP_ADD:
        return add_points(x, y);
    case OP_MULTIPLY:
        return multiply_points(x, y);
    case OP_DIVIDE:
        return divide_points(x, y);
    case OP_SHIFT:
        return add_points(x, o->k);
    case OP_SCALE:
        return multiply_points(x, o->k);
    case OP_SQUARE:
        return multiply_points(x, x);
    case OP_POWER_N:
        return power_at(x, o->n);
    case OP_ABS:
        return known(fabs(x.value), x.error);
    case OP_SQRT:
        return sqrt_at(x);
    case OP_EXP:
        return exp_at(x);
    case OP_LOG:
        return log_at(x);
    case OP_SIN:
        return function_at(x, sin(x.value), 1);
    case OP_COS:
        return function_at(x, cos(x.value), 1);
    case OP_MIN:
        return negate_at(larger_at(negate_at(x), negate_at(y)));
    case OP_MAX:
        return larger_at(x, y);
    default:
        return nothing_known();
    }
}

near_constant operation_point(const operation *o, const near_constant *values)
{
    near_constant result = short_way(o, values[o->operand[0]], values[o->operand[1]]);
    return result.error < INFINITY ? result : other_point(o, values);
}

/* --- Where they are undefined ----------------------------------------------------------------- */

static bool is_zero(const imp_model *x) { return x->lo == 0 && x->hi == 0; }

bool operation_is_undefined(const operation *o, const imp_model *values)
{
    const imp_model *x = &values[o->operand[0]], *y = &values[o->operand[1]];
    switch (o->code) {
    case OP_DIVIDE:
        return is_zero(y);
    case OP_POWER_N:
        return o->n < 0 && is_zero(x);
    case OP_POWER_K:
        return x->hi < 0 || (x->hi <= 0 && o->k.value + o->k.error < 0);
    case OP_POWER:
        return x->hi < 0 || (x->hi <= 0 && y->hi < 0);
    case OP_SQRT:
        return x->hi < 0;
    case OP_LOG:
        return x->hi <= 0;
    case OP_ASIN:
    case OP_ACOS:
        return x->lo > 1 || x->hi < -1;
    case OP_ATAN2:
        return is_zero(x) && is_zero(y);
    default:
        return false;
    }
}

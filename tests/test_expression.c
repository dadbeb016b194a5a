/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <fenv.h>
#include <locale.h>
#include <string.h>

#include "../plugins/expression.h"
#include "alloc_failure.h"
#include "suite.h"

/* The language of formulas: what texts mean, and what is said of wrong ones. Bounds are judged in
 * test_expression_bounds.c. */

/* --- Compiling for tests ------------------------------------------------------------------- */

/* u in [-1, 1], v in [0, 2], t at all times. */
static imp_status compile_with(const char *const text[3], size_t count, const char *const *name,
                               const double *value, expression_program **program,
                               expression_error *error)
{
    static const char *const variable[] = {"u", "v", "t"};
    imp_model whole[] = {imp_between(-1, 1), imp_between(0, 2), imp_unbounded(4)};
    const expression_scope scope = {variable, whole, 3, name, value, count};
    return expression_compile(&scope, text, program, error);
}

static expression_program *compiled_three(const char *x, const char *y, const char *z)
{
    static const char *const name[] = {"a", "radius"};
    static const double value[] = {3, 0.1};
    const char *const text[] = {x, y, z};
    expression_program *program;
    expression_error error;
    imp_status status = compile_with(text, 2, name, value, &program, &error);
    ck_assert_msg(status == IMP_OK, "%.200s: %s", x,
                  status == IMP_PARAMETER ? error.message : "no memory");
    return program;
}

static expression_program *compiled(const char *text) { return compiled_three(text, "0", "0"); }

static imp_status value_at(const char *text, double u, double v, double t, double *x, double *error)
{
    const double p[] = {u, v, t};
    double xs[3], errors[3];
    expression_program *program = compiled(text);
    imp_status status = expression_point(program, p, xs, errors);
    expression_free(program);
    *x = xs[0];
    *error = errors[0];
    return status;
}

static size_t length_of(const char *text)
{
    expression_program *program = compiled_three(text, text, text);
    size_t length = expression_length(program);
    expression_free(program);
    return length;
}

/* What is said of a wrong text; "" if it was taken. */
static const char *complaint(const char *text)
{
    static expression_error error;
    const char *const texts[] = {"u", text, "v"};
    expression_program *program;
    error = (expression_error){.message = ""};
    imp_status status = compile_with(texts, 0, NULL, NULL, &program, &error);
    if (status == IMP_OK) {
        expression_free(program);
        return "";
    }
    ck_assert_int_eq(status, IMP_PARAMETER);
    ck_assert_int_eq(error.at, 1);
    return error.message;
}

/* --- Meaning -----------------------------------------------------------------------------------
 */

#define U 0.375
#define V 1.25
#define T -2.5
#define E 2.718281828459045
#define PI 3.141592653589793

static const struct meaning {
    const char *text;
    double value; /* as C computes it */
} meanings[] = {
    {"1", 1},
    {".5", 0.5},
    {"5.", 5},
    {"1e-3", 1e-3},
    {"2.5E+2", 250},
    {"pi", PI},
    {"e", E},
    {"a", 3},
    {"radius", 0.1},
    {"u", U},
    {" u\t+\n v ", U + V},
    {"1-2-3", -4},
    {"8/4/2", 1},
    {"2+3*4", 14},
    {"(2+3)*4", 20},
    {"2*3^2", 18},
    {"-2^2", -4},
    {"(-2)^2", 4},
    {"2^3^2", 512},
    {"(2^3)^2", 64},
    {"2^-1", 0.5},
    {"2^-2^2", 0.0625},
    {"-u^2", -U *U},
    {"2*-3", -6},
    {"--u", U},
    {"+-+u", -U},
    {"1 - -1", 2},
    {"-(1+2)^2", -9},
    {"u/v/t", U / V / T},
    {"u/(v/t)", U / (V / T)},
    {"u-v+t", U - V + T},
    {"u-(v+t)", U - (V + T)},
    {"u^2", U *U},
    {"u*u*u", U *U *U},
    {"t^3", T *T *T},
    {"t^-3", 1 / (T * T * T)},
    {"v^0.5", 1.118033988749895},
    {"v^(1/3)", 1.0772173450159418},
    {"v^pi", 2.015820163273421},
    {"v^u", 1.087279638020491},
    {"e^u", 1.4549914146182013},
    {"2^u", 1.2968395546510096},
    {"u^0", 1},
    {"u^1", U},
    {"pow(v,2)", V *V},
    {"abs(t)", 2.5},
    {"fabs(t)", 2.5},
    {"sq(t)", 6.25},
    {"sqr(t)", 6.25},
    {"sqrt(v)", 1.118033988749895},
    {"sqrt(t^2)", 2.5},
    {"cbrt(t)", -1.3572088082974532},
    {"exp(u)", 1.4549914146182013},
    {"exp2(u)", 1.2968395546510096},
    {"log(v)", 0.22314355131420976},
    {"ln(v)", 0.22314355131420976},
    {"log2(8)", 3},
    {"log10(1000)", 3},
    {"sin(u)", 0.36627252908604757},
    {"cos(u)", 0.9305076219123143},
    {"tan(u)", 0.3936265759256327},
    {"asin(u)", 0.38439677449563906},
    {"acos(u)", 1.1863995522992576},
    {"atan(t)", -1.1902899496825317},
    {"atan2(u,t)", 2.992702705980296},
    {"atan2(u,v)", 0.2914567944778671},
    {"sinh(u)", 0.38385106791361456},
    {"cosh(u)", 1.0711403467045868},
    {"tanh(u)", 0.35835739835078595},
    {"min(u,v)", U},
    {"max(u,v,t,1.5)", 1.5},
    {"fmin(u,v,t)", T},
    {"fmax(u,v)", V},
    {"hypot(3,4)", 5},
    {"hypot(u,v)", 1.3050383136138187},
    {"hypot(u,v,t)", 2.8201285431696195},
    {"sqrt(u^2+v^2)", 1.3050383136138187},
    {"hypot(u,v)^2", U *U + V *V},
    {"clamp(t,-1,1)", -1},
    {"clamp(v,-1,1)", 1},
    {"clamp(u,-1,1)", U},
    {"lerp(u,v,1/4)", U + (V - U) / 4},
    {"copysign(2,v)", 2},
    {"copysign(v,-v)", -V},
    {"copysign(t,t)", T},
    {"copysign(abs(t)^1.5,t)", -3.9528470752104745},
    {"u-u", 0},
    {"0*t", 0},
    {"a*u+radius", 3 * U + 0.1},
};

START_TEST(every_operator_and_function_means_what_it_does_elsewhere)
{
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; ++i) {
        const struct meaning *m = &meanings[i];
        double x, error;
        ck_assert_int_eq(value_at(m->text, U, V, T, &x, &error), IMP_OK);
        ck_assert_msg(fabs(x - m->value) <= error + 4e-16 * fabs(m->value),
                      "%s: %.17g +- %g, not %.17g", m->text, x, error, m->value);
        ck_assert_msg(error <= 1e-14 * (1 + fabs(x)), "%s: error %g", m->text, error);
    }
}
END_TEST

START_TEST(exact_arithmetic_with_constants_stays_exact)
{
    static const char *const texts[] = {"2*3/4+1",    "1/8",   "(1+2)^5-3", "sqrt(9)",
                                        "-(2-6)*0.5", "10^15", "min(1,2)",  "abs(-3)"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        double x, error;
        ck_assert_int_eq(value_at(texts[i], U, V, T, &x, &error), IMP_OK);
        ck_assert_msg(error == 0, "%s: error %g", texts[i], error);
    }
}
END_TEST

/* Whatever point the locale has, formulas have '.'. */
START_TEST(numbers_are_read_alike_in_every_locale)
{
    static const char *const locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "C"};
    for (size_t i = 0; i < sizeof locales / sizeof locales[0]; ++i) {
        double x, error;
        if (!setlocale(LC_NUMERIC, locales[i])) continue;
        ck_assert_int_eq(value_at("1.5+.25", U, V, T, &x, &error), IMP_OK);
        ck_assert_double_eq(x, 1.75);
    }
    setlocale(LC_NUMERIC, "C");
}
END_TEST

/* --- Compiled form
 * -------------------------------------------------------------------------------- */

static const struct compiled_length {
    const char *text;
    size_t length; /* for x, y and z alike */
} lengths[] = {
    {"u", 0},       {"7", 1},   {"2*pi*u", 1},    {"u*2*pi", 1},        {"u/3", 1},
    {"1+u+2", 1},   {"u*u", 1}, {"u*u*u*u", 1},   {"--u", 0},           {"u+0", 0},
    {"1*u", 0},     {"u^1", 0}, {"sqrt(u^2)", 1}, {"sin(u)*sin(u)", 2}, {"cos(u)+v*cos(u)", 3},
    {"u*v-v*u", 1},
};

START_TEST(what_formulas_have_in_common_is_computed_once)
{
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; ++i)
        ck_assert_msg(length_of(lengths[i].text) == lengths[i].length, "%s: %zu operations",
                      lengths[i].text, length_of(lengths[i].text));
}
END_TEST

/* --- Faults
 * ---------------------------------------------------------------------------------------- */

#define OPERAND "expected a number, a name or '(', found "
#define OPERATOR "expected an operator or the end, found "
#define CLOSING(LINE, COLUMN)                                                                      \
    "expected an operator or ')' for the '(' at line " LINE ", column " COLUMN ", found "
#define JUMP " is discontinuous: a surface with a jump has no rate bound"
#define CHOICE                                                                                     \
    " can jump where the choice changes, and a surface with a jump has no rate bound; min, max, "  \
    "abs and clamp choose without jumps"
#define KNOWN "; known: u, v, t, pi, e"
#define TIMES "; products are written with '*'"

static const struct fault {
    const char *text, *complaint;
} faults[] = {
    {"", "line 1, column 1: " OPERAND "the end"},
    {"   ", "line 1, column 4: " OPERAND "the end"},
    {"u+", "line 1, column 3: " OPERAND "the end"},
    {"u+\n\n  *v", "line 3, column 3: " OPERAND "'*'; powers are written x^y"},
    {"u**2", "line 1, column 3: " OPERAND "'*'; powers are written x^y"},
    {"*u", "line 1, column 1: " OPERAND "'*'; powers are written x^y"},
    {"/u", "line 1, column 1: " OPERAND "'/'"},
    {"u^", "line 1, column 3: " OPERAND "the end"},
    {"()", "line 1, column 2: " OPERAND "')'"},
    {"(u", "line 1, column 3: " CLOSING("1", "1") "the end"},
    {"(u+\n(v*2)", "line 2, column 6: " CLOSING("1", "1") "the end"},
    {"sin(u", "line 1, column 6: " CLOSING("1", "4") "the end"},
    {"(u v)", "line 1, column 4: " CLOSING("1", "1") "'v'" TIMES},
    {"(u,v)", "line 1, column 3: " CLOSING("1", "1") "','"},
    {"u)", "line 1, column 2: ')' without its '('"},
    {"u,v", "line 1, column 2: " OPERATOR "','"},
    {"2u", "line 1, column 2: " OPERATOR "'u'" TIMES},
    {"2 3", "line 1, column 3: " OPERATOR "'3'" TIMES},
    {"1.2.3", "line 1, column 4: " OPERATOR "'.3'" TIMES},
    {"0x10", "line 1, column 2: " OPERATOR "'x10'" TIMES},
    {"2(u)", "line 1, column 2: " OPERATOR "'('" TIMES},
    {"u(1)", "line 1, column 2: " OPERATOR "'('" TIMES},
    {"1e", "line 1, column 2: " OPERATOR "'e'" TIMES},
    {".", "line 1, column 1: " OPERAND "'.'"},
    {"[u]", "line 1, column 1: " OPERAND "'['; parentheses are '(' and ')'"},
    {"u $ v", "line 1, column 3: " OPERATOR "'$'"},
    {"2\xc3\x97u", "line 1, column 2: " OPERATOR "'\xc3\x97'"},
    {"\xcf\x80*w", "line 1, column 1: " OPERAND "'\xcf\x80'"},
    {"u \xe2\x88\x92 w", "line 1, column 3: " OPERATOR "'\xe2\x88\x92'"},
    {"u+\x01", "line 1, column 3: " OPERAND "the character 1"},
    {"u\x7f", "line 1, column 2: " OPERATOR "the character 127"},
    {"sin(w)", "line 1, column 5: unknown name 'w'" KNOWN},
    {"u +\n  w", "line 2, column 3: unknown name 'w'" KNOWN},
    {"PI", "line 1, column 1: unknown name 'PI', did you mean 'pi'?" KNOWN},
    {"V", "line 1, column 1: unknown name 'V', did you mean 'v'?" KNOWN},
    {"sinn(u)", "line 1, column 1: unknown function 'sinn', did you mean 'sin'?"},
    {"sgrt(u)", "line 1, column 1: unknown function 'sgrt', did you mean 'sqrt'?"},
    {"Cos(u)", "line 1, column 1: unknown function 'Cos', did you mean 'cos'?"},
    {"bessel(u)", "line 1, column 1: unknown function 'bessel'"},
    {"sin", "line 1, column 1: 'sin' is a function: its arguments follow in parentheses"},
    {"sin u", "line 1, column 1: 'sin' is a function: its arguments follow in parentheses"},
    {"sin()", "line 1, column 1: sin takes 1 argument, found 0"},
    {"sin(u,v)", "line 1, column 1: sin takes 1 argument, found 2 or more"},
    {"atan2(u)", "line 1, column 1: atan2 takes 2 arguments, found 1"},
    {"1+max(u)", "line 1, column 3: max takes 2 to 16 arguments, found 1"},
    {"hypot(u,v,t,1)", "line 1, column 1: hypot takes 2 to 3 arguments, found 4 or more"},
    {"floor(u)", "line 1, column 1: 'floor'" JUMP},
    {"u+ceil(u)", "line 1, column 3: 'ceil'" JUMP},
    {"round(u)", "line 1, column 1: 'round'" JUMP},
    {"sign(u)", "line 1, column 1: 'sign'" JUMP},
    {"mod(u,1)", "line 1, column 1: 'mod'" JUMP},
    {"fmod(u,1)", "line 1, column 1: 'fmod'" JUMP},
    {"step(0,u)", "line 1, column 1: 'step'" JUMP},
    {"u % 2", "line 1, column 3: '%'" JUMP},
    {"u < v", "line 1, column 3: '<'" CHOICE},
    {"u >= v", "line 1, column 3: '>'" CHOICE},
    {"u == v", "line 1, column 3: '='" CHOICE},
    {"if(u,v,1)", "line 1, column 1: 'if'" CHOICE},
    {"(u ? v : 1)", "line 1, column 4: '?'" CHOICE},
    {"!u", "line 1, column 1: '!'" CHOICE},
    {"copysign(1,u)", "line 1, column 1: copysign(x, y) jumps where y changes sign, unless x is "
                      "seen to be 0 there, as in copysign(abs(y)^p, y)"},
    {"copysign(u*v+1,u)", "line 1, column 1: copysign(x, y) jumps where y changes sign, unless x "
                          "is seen to be 0 there, as in copysign(abs(y)^p, y)"},
    {"1/0", "line 1, column 2: division by 0"},
    {"u/(2-1-1)", "line 1, column 2: division by 0"},
    {"u/(v-v)", "line 1, column 2: division by 0"},
    {"1+sqrt(-1)", "line 1, column 3: sqrt is undefined everywhere: its argument is in [-1, -1]"},
    {"sqrt(u-2)", "line 1, column 1: sqrt is undefined everywhere: its argument is in [-3, -1]"},
    {"log(0)", "line 1, column 1: log is undefined everywhere: its argument is in [0, 0]"},
    {"asin(2)", "line 1, column 1: asin is undefined everywhere: its argument is in [2, 2]"},
    {"acos(v-4)", "line 1, column 1: acos is undefined everywhere: its argument is in [-4, -2]"},
    {"atan2(0,0)", "line 1, column 1: atan2(0, 0) is undefined"},
    {"0^-2", "line 1, column 2: 0 to the power of -2 is undefined"},
    {"(-8)^(1/3)", "line 1, column 5: this power is undefined everywhere: its base is in [-8, -8], "
                   "and only whole constant exponents take such a base"},
    {"(u-3)^v", "line 1, column 6: this power is undefined everywhere: its base is in [-4, -2], "
                "and only whole constant exponents take such a base"},
    {"(-2)^u", "line 1, column 5: the base of a varying exponent is -2, allowed > 0"},
    {"1e999", "line 1, column 1: this number is beyond the largest, 1.8e308"},
    {"exp(1000)", "line 1, column 1: this constant is beyond all numbers"},
    {"1e300*1e300", "line 1, column 6: this constant is beyond all numbers"},
};

START_TEST(every_fault_is_told_with_its_line_and_column)
{
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; ++i) {
        const char *told = complaint(faults[i].text);
        ck_assert_msg(strcmp(told, faults[i].complaint) == 0, "'%s':\n%s\nnot\n%s", faults[i].text,
                      told, faults[i].complaint);
    }
}
END_TEST

static const struct naming {
    const char *first, *second, *complaint; /* NULL: taken */
} namings[] = {
    {"a", "b_2", NULL},
    {"x", "step", NULL},
    {"_", "U", NULL},
    {"a", "a", "'a' is another constant already; take another name"},
    {"a", "u", "'u' is a variable already; take another name"},
    {"t", "a", "'t' is a variable already; take another name"},
    {"a", "pi", "'pi' is 3.14159... already; take another name"},
    {"e", "a", "'e' is 2.71828... already; take another name"},
    {"a", "hypot", "'hypot' is a function already; take another name"},
    {"a", "", "'' is no name: allowed are letters, digits and '_', a letter first"},
    {"2r", "a", "'2r' is no name: allowed are letters, digits and '_', a letter first"},
    {"a", "r-1", "'r-1' is no name: allowed are letters, digits and '_', a letter first"},
};

START_TEST(constants_need_names_that_mean_nothing_else)
{
    static const double value[] = {1, 2};
    static const char *const text[] = {"u", "v", "t"};
    for (size_t i = 0; i < sizeof namings / sizeof namings[0]; ++i) {
        const struct naming *n = &namings[i];
        const char *const name[] = {n->first, n->second};
        expression_program *program = NULL;
        expression_error error = {.message = ""};
        imp_status status = compile_with(text, 2, name, value, &program, &error);
        ck_assert_int_eq(status, n->complaint ? IMP_PARAMETER : IMP_OK);
        ck_assert_str_eq(error.message, n->complaint ? n->complaint : "");
        if (n->complaint) ck_assert_int_eq(error.at, EXPRESSION_AT_CONSTANTS);
        expression_free(n->complaint ? NULL : program);
    }
}
END_TEST

START_TEST(an_unknown_name_is_compared_with_the_constants)
{
    static const double value[60] = {0};
    static const char *const text[] = {"u", "v", "radios"};
    const char *name[60] = {"height", "radius"};
    char many[58][16];
    for (int k = 0; k < 58; ++k) {
        snprintf(many[k], sizeof many[k], "constant_%d", k);
        name[2 + k] = many[k];
    }
    expression_program *program;
    expression_error error;
    ck_assert_int_eq(compile_with(text, 2, name, value, &program, &error), IMP_PARAMETER);
    ck_assert_str_eq(error.message, "line 1, column 1: unknown name 'radios', did you mean "
                                    "'radius'?; known: u, v, t, pi, e, height, radius");
    ck_assert_int_eq(error.at, 2);
    ck_assert_int_eq(compile_with(text, 60, name, value, &program, &error), IMP_PARAMETER);
    ck_assert_ptr_nonnull(
        strstr(error.message, "known: u, v, t, pi, e, height, radius, constant_0"));
    ck_assert_str_eq(error.message + strlen(error.message) - 5, ", ...");
}
END_TEST

/* --- Limits
 * ------------------------------------------------------------------------------------------ */

/* `count` times `piece`, between `before` and `after`; the caller owns it. */
static char *repeated(const char *before, const char *piece, size_t count, const char *after)
{
    size_t length = strlen(piece);
    char *text = malloc(strlen(before) + count * length + strlen(after) + 1);
    ck_assert_ptr_nonnull(text);
    char *end = stpcpy(text, before);
    for (size_t k = 0; k < count; ++k) end = stpcpy(end, piece);
    stpcpy(end, after);
    return text;
}

static void expect_repeated(const char *before, const char *piece, size_t count, const char *after,
                            const char *said)
{
    char *text = repeated(before, piece, count, after);
    const char *told = complaint(text);
    ck_assert_msg(strcmp(told, said) == 0, "%zu times %s: %s", count, piece, told);
    free(text);
}

#define TOO_DEEP "more than 200 parentheses, functions or exponents inside each other"

START_TEST(depth_is_limited_and_length_of_signs_and_sums_is_not)
{
    char *deep = repeated("", "(", 199, "u");
    char *closed = repeated(deep, ")", 199, "");
    ck_assert_str_eq(complaint(closed), "");
    free(deep);
    free(closed);
    expect_repeated("", "(", 100000, "", "line 1, column 201: " TOO_DEEP);
    expect_repeated("", "sin(", 100000, "", "line 1, column 801: " TOO_DEEP);
    expect_repeated("u", "^u", 100000, "", "line 1, column 401: " TOO_DEEP);
    expect_repeated("", "-", 100001, "u", "");
    expect_repeated("u", "+0", 100000, "", "");
    expect_repeated("u", "\n*2/2", 100000, "", "");
}
END_TEST

START_TEST(a_number_of_a_thousand_digits_is_refused)
{
    expect_repeated("u+0.", "1", 298, "", "");
    expect_repeated("u+0.", "1", 299, "",
                    "line 1, column 3: this number has more than 300 characters");
    expect_repeated("", "7", 1000000, "",
                    "line 1, column 1: this number has more than 300 characters");
}
END_TEST

START_TEST(a_long_name_is_cut_in_the_message)
{
    expect_repeated(
        "", "w", 1000000, "",
        "line 1, column 1: unknown name 'wwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwwww'" KNOWN);
}
END_TEST

static char *sum_of_sines(const char *first, const char *next, int terms)
{
    char *text = malloc((size_t)terms * 32);
    size_t used = 0;
    ck_assert_ptr_nonnull(text);
    for (int k = 1; k <= terms; ++k)
        used += (size_t)sprintf(text + used, "%ssin(%d*u)", k > 1 ? next : first, k);
    return text;
}

START_TEST(too_many_operations_are_refused_where_they_exceed)
{
    char *text = sum_of_sines("", "+", 6000);
    ck_assert_ptr_nonnull(strstr(complaint(text), ": more than 16384 operations"));
    free(text);
    text = sum_of_sines("", "+", 4000);
    ck_assert_str_eq(complaint(text), "");
    free(text);
}
END_TEST

START_TEST(too_many_values_at_once_are_refused)
{
    char *sum = sum_of_sines("", "+", 600), *product = sum_of_sines("", "*", 600);
    const char *const text[] = {sum, product, "0"};
    expression_program *program;
    expression_error error;
    ck_assert_int_eq(compile_with(text, 0, NULL, NULL, &program, &error), IMP_PARAMETER);
    ck_assert_int_eq(error.at, EXPRESSION_AT_ALL);
    ck_assert_str_eq(error.message,
                     "x, y and z have more than 512 common parts to be kept at once");
    free(sum);
    free(product);
}
END_TEST

/* As many values at once as there may be: slots are used to the last, and again. */
START_TEST(all_slots_can_be_used)
{
    char *sum = sum_of_sines("", "+", 500), *product = sum_of_sines("2*", "*", 500);
    expression_program *program = compiled_three(sum, product, sum);
    const double p[] = {0.5, 0, 0};
    double x[3], error[3], by_hand = 0;
    ck_assert_int_eq(expression_point(program, p, x, error), IMP_OK);
    for (int k = 1; k <= 500; ++k) by_hand += sin(k * 0.5);
    ck_assert_double_le(fabs(x[0] - by_hand), error[0] + 1e-11);
    ck_assert_double_eq(x[2], x[0]);
    expression_free(program);
    free(sum);
    free(product);
}
END_TEST

/* --- Where formulas are undefined
 * -------------------------------------------------------------------- */

static const struct point {
    const char *text;
    double u, v, t;
} outside[] =
    {
        {"sqrt(u)", -0.25, 0, 0},
        {"log(u)", -0.5, 0, 0},
        {"log(u)", 0, 0, 0},
        {"1/u", 0, 0, 0},
        {"u^-2", 0, 0, 0},
        {"u^0.3", -1, 0, 0},
        {"u^-0.3", 0, 0, 0},
        {"asin(2*u)", 1, 0, 0},
        {"acos(t)", 0, 0, -3},
        {"atan2(u,v)", 0, 0, 0},
        {"u^v", -0.5, 1, 0},
        {"u^t", 0, 0, -1},
        {"atan(log(u))", 0, 0, 0},
        {"sin(1/u)", 0, 0, 0},
        {"min(1,sqrt(u))", -1, 0, 0},
        {"tanh(sqrt(u))", -1, 0, 0},
        {"exp(1000*v)", 0, 1, 0},
        {"u", NAN, 0, 0},
        {"u+t", 0, 0, INFINITY},
},
  inside[] = {
      {"sqrt(u)", 0, 0, 0},    {"u^0.3", 0, 0, 0},        {"u^(1/3)", 0, 0, 0},
      {"u^v", 0, 1, 0},        {"asin(u)", 1, 0, 0},      {"acos(u)", -1, 0, 0},
      {"hypot(u,v)", 0, 0, 0}, {"cbrt(u)", 0, 0, 0},      {"atan2(u,v)", 0, 1, 0},
      {"1e300*t", 0, 0, 1e8},  {"exp(-1000*v)", 0, 2, 0}, {"acos(cos(u))", 0, 0, 0},
};

START_TEST(a_point_where_the_formula_is_undefined_is_outside_its_domain)
{
    double x, error;
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; ++i) {
        const struct point *p = &outside[i];
        ck_assert_msg(value_at(p->text, p->u, p->v, p->t, &x, &error) == IMP_DOMAIN,
                      "%s at %g %g %g: %g +- %g", p->text, p->u, p->v, p->t, x, error);
    }
    for (size_t i = 0; i < sizeof inside / sizeof inside[0]; ++i) {
        const struct point *p = &inside[i];
        ck_assert_msg(value_at(p->text, p->u, p->v, p->t, &x, &error) == IMP_OK, "%s at %g %g %g",
                      p->text, p->u, p->v, p->t);
        ck_assert_msg(error < 1e-7 * (1 + fabs(x)), "%s: %g +- %g", p->text, x, error);
    }
}
END_TEST

START_TEST(what_is_infinite_on_the_way_may_be_finite_in_the_end)
{
    double x, error;
    ck_assert_int_eq(value_at("1/(1+exp(1000*v))", 0, 1, 0, &x, &error), IMP_OK);
    ck_assert_msg(x - error <= 0 && 0 <= x + error && error <= 0.51, "%g +- %g", x, error);
    ck_assert_int_eq(value_at("tanh(cosh(1000*v))", 0, 1, 0, &x, &error), IMP_OK);
    ck_assert_msg(x - error <= 1 && 1 <= x + error && error <= 1.01, "%g +- %g", x, error);
}
END_TEST

START_TEST(a_region_where_the_formula_is_undefined_is_unbounded)
{
    static const char *const texts[] = {"sqrt(u)",       "log(u)",       "1/u",       "sin(1/u)",
                                        "tanh(sqrt(u))", "atan(log(u))", "u^0.5+1/u", "u^t"};
    const imp_model u = {.a = -0.5, .b = {0.25}, .lo = -0.75, .hi = 0, .rate = {1}, .depends = 1};
    const imp_model variables[] = {u, imp_num(1), imp_num(-0.5)};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        imp_model out[3];
        expression_program *program = compiled(texts[i]);
        expression_models(program, variables, out);
        ck_assert_msg(out[0].rate[0] == INFINITY || out[0].e == INFINITY, "%s", texts[i]);
        expression_free(program);
    }
}
END_TEST

/* At the apex of a cone the square root has no rate, but the distance has. */
START_TEST(a_distance_has_rates_at_zero)
{
    static const char *const texts[] = {"hypot(u,v)", "sqrt(u^2+v^2)", "hypot(u,v,0)",
                                        "sqrt(u*u+v*v)", "(u^2+v*v)^0.5"};
    const imp_model u = {.b = {0.5}, .lo = -0.5, .hi = 0.5, .rate = {1}, .depends = 1};
    const imp_model v = {.b = {0, 0.5}, .lo = -0.5, .hi = 0.5, .rate = {0, 1}, .depends = 2};
    const imp_model variables[] = {u, v, imp_num(0)};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        imp_model out[3];
        expression_program *program = compiled(texts[i]);
        expression_models(program, variables, out);
        for (int j = 0; j < 2; ++j)
            ck_assert_msg(out[0].rate[j] >= 1 && out[0].rate[j] < 1.0001, "%s: %g", texts[i],
                          out[0].rate[j]);
        ck_assert_double_lt(out[0].hi, 0.7072);
        expression_free(program);
    }
}
END_TEST

START_TEST(a_copied_sign_is_lipschitz_where_it_is_taken)
{
    static const char *const texts[] = {"copysign(u,u)", "copysign(u*v,-2*u)",
                                        "copysign(abs(u)^1.5,u)", "copysign(sin(u)*exp(v),u)",
                                        "copysign(min(u^2,abs(u)),u)"};
    const imp_model u = {.b = {0.5}, .lo = -0.5, .hi = 0.5, .rate = {1}, .depends = 1};
    const imp_model variables[] = {u, imp_num(1), imp_num(0)};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        imp_model out[3];
        expression_program *program = compiled(texts[i]);
        expression_models(program, variables, out);
        ck_assert_msg(out[0].rate[0] < 3, "%s: %g", texts[i], out[0].rate[0]);
        ck_assert_double_eq(out[0].lo, -out[0].hi);
        expression_free(program);
    }
}
END_TEST

/* --- Running
 * ------------------------------------------------------------------------------------------ */

START_TEST(running_changes_nothing_and_always_answers_alike)
{
    static const char *const texts[] = {"exp(1000*v)+log(u)", "sqrt(u)/v+cbrt(t)", "u^v",
                                        "sinh(1000*v)*(1e200*t)^3", "atan2(u,t)-acos(u)"};
    const double p[] = {-0.5, 0, 1e200};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        double x[2][3], error[2][3];
        imp_model out[2][3],
            variables[] = {imp_between(-1, 1), imp_between(0, 2), imp_between(-INFINITY, 1)};
        expression_program *program = compiled(texts[i]);
        memset(x, 0, sizeof x);
        memset(error, 0, sizeof error);
        errno = 0;
        fesetround(FE_TONEAREST);
        imp_status first = expression_point(program, p, x[0], error[0]);
        ck_assert_int_eq(expression_point(program, p, x[1], error[1]), first);
        expression_models(program, variables, out[0]);
        expression_models(program, variables, out[1]);
        ck_assert_mem_eq(x[0], x[1], sizeof x[0]);
        ck_assert_mem_eq(error[0], error[1], sizeof error[0]);
        ck_assert_mem_eq(out[0], out[1], sizeof out[0]);
        ck_assert_int_eq(errno, 0);
        ck_assert_int_eq(fegetround(), FE_TONEAREST);
        expression_free(program);
    }
}
END_TEST

START_TEST(without_memory_nothing_is_compiled_and_nothing_left)
{
    static const char *const text[] = {"sin(u)", "u*v", "1/3"};
    size_t before = alloc_failure_live(), n = 0;
    for (bool failed = true; failed;) {
        expression_program *program = NULL;
        expression_error error;
        alloc_failure_begin(++n);
        imp_status status = compile_with(text, 0, NULL, NULL, &program, &error);
        failed = alloc_failure_end();
        ck_assert_int_eq(status, failed ? IMP_INTERNAL : IMP_OK);
        expression_free(program);
        ck_assert_uint_eq(alloc_failure_live(), before);
    }
    ck_assert_uint_ge(n, 3);
}
END_TEST

/* --- Damage
 * --------------------------------------------------------------------------------------------- */

static void try_any(const char *text)
{
    const char *told = complaint(text);
    if (told[0] == '\0') {
        double x, error;
        value_at(text, U, V, T, &x, &error);
        return;
    }
    ck_assert_msg(strncmp(told, "line ", 5) == 0, "%s", told);
    ck_assert_uint_lt(strlen(told), sizeof((expression_error *)0)->message);
}

START_TEST(random_bytes_are_refused_or_taken_and_nothing_else)
{
    static const char pieces[] = "uvte0123456789.()+-*/^, \n<%sincosqrtabcxyz_";
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        char text[64];
        size_t length = suite_bits(&state) % (sizeof text - 1);
        bool any = suite_bits(&state) % 4 == 0;
        for (size_t i = 0; i < length; ++i) {
            uint64_t bits = suite_bits(&state);
            text[i] = any ? (char)(1 + bits % 255) : pieces[bits % (sizeof pieces - 1)];
        }
        text[length] = '\0';
        try_any(text);
    }
}
END_TEST

START_TEST(damaged_formulas_are_refused_or_taken_and_nothing_else)
{
    uint64_t state = suite_seed();
    const size_t count = sizeof meanings / sizeof meanings[0];
    for (int k = 0; k < suite_times(20000); ++k) {
        char text[128];
        snprintf(text, sizeof text, "%s%c%s", meanings[suite_bits(&state) % count].text,
                 "+-*/^,( )"[suite_bits(&state) % 9], meanings[suite_bits(&state) % count].text);
        size_t at = suite_bits(&state) % strlen(text);
        if (suite_bits(&state) % 2)
            memmove(text + at, text + at + 1, strlen(text + at));
        else
            text[at] = (char)(1 + suite_bits(&state) % 126);
        try_any(text);
    }
}
END_TEST

SUITE_MAIN("expression", every_operator_and_function_means_what_it_does_elsewhere,
           exact_arithmetic_with_constants_stays_exact, numbers_are_read_alike_in_every_locale,
           what_formulas_have_in_common_is_computed_once,
           every_fault_is_told_with_its_line_and_column,
           constants_need_names_that_mean_nothing_else,
           an_unknown_name_is_compared_with_the_constants,
           depth_is_limited_and_length_of_signs_and_sums_is_not,
           a_number_of_a_thousand_digits_is_refused, a_long_name_is_cut_in_the_message,
           too_many_operations_are_refused_where_they_exceed, too_many_values_at_once_are_refused,
           all_slots_can_be_used, a_point_where_the_formula_is_undefined_is_outside_its_domain,
           what_is_infinite_on_the_way_may_be_finite_in_the_end,
           a_region_where_the_formula_is_undefined_is_unbounded, a_distance_has_rates_at_zero,
           a_copied_sign_is_lipschitz_where_it_is_taken,
           running_changes_nothing_and_always_answers_alike,
           without_memory_nothing_is_compiled_and_nothing_left,
           random_bytes_are_refused_or_taken_and_nothing_else,
           damaged_formulas_are_refused_or_taken_and_nothing_else)

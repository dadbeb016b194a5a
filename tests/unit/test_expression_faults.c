/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/expression_kit.h"

/* What is said of formulas that are wrong or too large, and that nothing else happens. */

/* --- Faults ----------------------------------------------------------------------------------- */

#define OPERAND "expected a number, a name or '(', got "
#define OPERATOR "expected an operator or the end, got "
#define CLOSING(LINE, COLUMN)                                                                      \
    "expected an operator or ')' for the '(' at line " LINE ", column " COLUMN ", got "
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
    {"sin()", "line 1, column 1: sin takes 1 argument, got 0"},
    {"sin(u,v)", "line 1, column 1: sin takes 1 argument, got 2 or more"},
    {"atan2(u)", "line 1, column 1: atan2 takes 2 arguments, got 1"},
    {"1+max(u)", "line 1, column 3: max takes 2 to 16 arguments, got 1"},
    {"hypot(u,v,t,1)", "line 1, column 1: hypot takes 2 to 3 arguments, got 4 or more"},
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
    {"copysign(1,-v)", "line 1, column 1: copysign(x, y) jumps where y changes sign, unless x is "
                       "seen to be 0 there, as in copysign(abs(y)^p, y)"},
    {"copysign(1,u-1)", "line 1, column 1: copysign(x, y) jumps where y changes sign, unless x is "
                        "seen to be 0 there, as in copysign(abs(y)^p, y)"},
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
    {"(-2)^u", "line 1, column 5: the base of a varying exponent is -2, must be > 0"},
    {"1e999", "line 1, column 1: this number is beyond the largest, 1.8e308"},
    {"exp(1000)", "line 1, column 1: this constant overflows"},
    {"1e300*1e300", "line 1, column 6: this constant overflows"},
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
    {"a", "", "'' is not a name: must be letters, digits and '_', a letter first"},
    {"2r", "a", "'2r' is not a name: must be letters, digits and '_', a letter first"},
    {"a", "r-1", "'r-1' is not a name: must be letters, digits and '_', a letter first"},
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
        ck_assert_int_eq(status, n->complaint != NULL ? IMP_STATUS_PARAMETER : IMP_STATUS_OK);
        ck_assert_str_eq(error.message, n->complaint != NULL ? n->complaint : "");
        if (n->complaint != NULL) ck_assert_int_eq(error.at, EXPRESSION_AT_CONSTANTS);
        expression_free(n->complaint != NULL ? NULL : program);
    }
}
END_TEST

START_TEST(constants_are_limited_in_number)
{
    enum { MANY = EXPRESSION_CONSTANTS_MAX + 1 };
    static char text_of[MANY][8];
    static const char *name[MANY];
    static double value[MANY];
    static const char *const text[] = {"u", "v", "k4095"};
    for (int k = 0; k < MANY; ++k) {
        snprintf(text_of[k], sizeof text_of[k], "k%d", k);
        name[k] = text_of[k];
    }
    expression_program *program = NULL;
    expression_error error = {.message = ""};
    ck_assert_int_eq(compile_with(text, MANY - 1, name, value, &program, &error), IMP_STATUS_OK);
    expression_free(program);
    ck_assert_int_eq(compile_with(text, MANY, name, value, &program, &error), IMP_STATUS_PARAMETER);
    ck_assert_str_eq(error.message, "got 4097 constants, must be at most 4096");
    ck_assert_int_eq(error.at, EXPRESSION_AT_CONSTANTS);
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
    ck_assert_int_eq(compile_with(text, 2, name, value, &program, &error), IMP_STATUS_PARAMETER);
    ck_assert_str_eq(error.message, "line 1, column 1: unknown name 'radios', did you mean "
                                    "'radius'?; known: u, v, t, pi, e, height, radius");
    ck_assert_int_eq(error.at, 2);
    ck_assert_int_eq(compile_with(text, 60, name, value, &program, &error), IMP_STATUS_PARAMETER);
    ck_assert_ptr_nonnull(
        strstr(error.message, "known: u, v, t, pi, e, height, radius, constant_0"));
    ck_assert_str_eq(error.message + strlen(error.message) - 5, ", ...");
}
END_TEST

/* --- Limits ----------------------------------------------------------------------------------- */

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
    ck_assert_int_eq(compile_with(text, 0, NULL, NULL, &program, &error), IMP_STATUS_PARAMETER);
    ck_assert_int_eq(error.at, EXPRESSION_AT_ALL);
    ck_assert_str_eq(error.message,
                     "x, y and z have more than 512 common parts to be kept at once");
    free(sum);
    free(product);
}
END_TEST

/* There are as many values at once as there may be: slots are used to the last, and again. */
START_TEST(all_slots_can_be_used)
{
    char *sum = sum_of_sines("", "+", 500), *product = sum_of_sines("2*", "*", 500);
    expression_program *program = compiled_three(sum, product, sum);
    const double p[] = {0.5, 0, 0};
    double x[3], error[3], by_hand = 0;
    ck_assert_int_eq(expression_point(program, p, x, error), IMP_STATUS_OK);
    for (int k = 1; k <= 500; ++k) by_hand += sin(k * 0.5);
    ck_assert_double_le(fabs(x[0] - by_hand), error[0] + 1e-11);
    ck_assert_double_eq(x[2], x[0]);
    expression_free(program);
    free(sum);
    free(product);
}
END_TEST

/* --- Damage ----------------------------------------------------------------------------------- */

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
        size_t length = random_bits(&state) % (sizeof text - 1);
        bool any = random_bits(&state) % 4 == 0;
        for (size_t i = 0; i < length; ++i) {
            uint64_t bits = random_bits(&state);
            text[i] = any ? (char)(1 + bits % 255) : pieces[bits % (sizeof pieces - 1)];
        }
        text[length] = '\0';
        try_any(text);
    }
}
END_TEST

static const char *const sound[] = {
    "1",           "2.5E+2",        "pi*u",          "-2^-2^2",          "u/(v/t)",
    "u*u*u*u",     "v^(1/3)",       "e^u",           "sqrt(t^2)",        "exp(u)*cbrt(t)",
    "log2(8)",     "atan2(u,v)",    "max(u,v,t,1)",  "hypot(u,v,t)^2",   "sqrt(u^2+v^2)",
    "lerp(u,v,t)", "copysign(v,v)", "clamp(t,-1,1)", "copysign(t,-2*t)", "radius+a*sin(u)",
};

START_TEST(damaged_formulas_are_refused_or_taken_and_nothing_else)
{
    uint64_t state = suite_seed();
    const size_t count = sizeof sound / sizeof sound[0];
    for (int k = 0; k < suite_times(20000); ++k) {
        char text[128];
        snprintf(text, sizeof text, "%s%c%s", sound[random_bits(&state) % count],
                 "+-*/^,( )"[random_bits(&state) % 9], sound[random_bits(&state) % count]);
        size_t at = random_bits(&state) % strlen(text);
        if (random_bits(&state) % 2)
            memmove(text + at, text + at + 1, strlen(text + at));
        else
            text[at] = (char)(1 + random_bits(&state) % 126);
        try_any(text);
    }
}
END_TEST

SUITE_MAIN("expression faults", every_fault_is_told_with_its_line_and_column,
           constants_need_names_that_mean_nothing_else, constants_are_limited_in_number,
           an_unknown_name_is_compared_with_the_constants,
           depth_is_limited_and_length_of_signs_and_sums_is_not,
           a_number_of_a_thousand_digits_is_refused, a_long_name_is_cut_in_the_message,
           too_many_operations_are_refused_where_they_exceed, too_many_values_at_once_are_refused,
           all_slots_can_be_used, random_bytes_are_refused_or_taken_and_nothing_else,
           damaged_formulas_are_refused_or_taken_and_nothing_else)

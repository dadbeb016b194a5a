/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/spline.h"

/* The pieces of a spline as formulas. The curve between two keys is that of spline.h, by the values
 * a, b and the slopes p, q at both: with h the step in time and s in [0, 1],
 *
 *   a + (b - a) s^2 (3 - 2 s) + h (p s (1 - s)^2 - q s^2 (1 - s)),
 *
 * or with the second derivatives c, d at both the quintic
 *
 *   a + (b - a) s^3 (10 - 15 s + 6 s^2) + h (p s (1 - s)^3 (1 + 3 s) - q s^3 (1 - s) (4 - 3 s))
 *     + h^2 / 2 (c s^2 (1 - s)^3 + d s^3 (1 - s)^2).
 *
 * The difference b - a keeps intervals of s from a times nearly all of [0, 1] on either side. */

static void write_name(const spline_text *text, size_t lane, const char *of,
                       const imp_text_sink *to)
{
    imp_add_text(to, text->name);
    imp_add_whole(to, lane);
    imp_add_text(to, of);
}

/* (key_to - key_from) / (time_to - time_from). */
static void write_secant(const spline_text *text, size_t lane, size_t from, size_t key,
                         const imp_text_sink *to)
{
    imp_add_text(to, "(");
    text->write_key(text->context, 0, key, lane, to);
    imp_add_text(to, " - ");
    text->write_key(text->context, 0, from, lane, to);
    imp_add_text(to, ")/(");
    imp_add_number(to, text->of->time[key]);
    imp_add_text(to, " - ");
    imp_add_number(to, text->of->time[from]);
    imp_add_text(to, ")");
}

/* The slope at a key, as spline_tangent has it. */
static void write_slope(const spline_text *text, size_t lane, size_t key, const imp_text_sink *to)
{
    const size_t last = text->of->pieces;
    if (last == 1) {
        write_secant(text, lane, 0, 1, to);
    } else if (key > 0 && key < last) {
        write_secant(text, lane, key - 1, key + 1, to);
    } else {
        const size_t next = key == 0 ? 1 : last - 1;
        imp_add_text(to, "2*");
        write_secant(text, lane, key == 0 ? 0 : next, key == 0 ? 1 : last, to);
        imp_add_text(to, " - ");
        write_secant(text, lane, next - 1, next + 1, to);
    }
}

static void write_given(const spline_text *text, size_t lane, int order, size_t key,
                        const imp_text_sink *to)
{
    if (order == 1 && text->orders == 0)
        write_slope(text, lane, key, to);
    else
        text->write_key(text->context, order, key, lane, to);
}

/* The factors of the values' difference, and of slope and second derivative at both ends; NULL: no
 * such term. */
typedef struct spline_form {
    const char *step, *factor[2][2];
} spline_form;

static const spline_form *form_of(const spline_text *text)
{
    static const spline_form line = {"s", {{NULL, NULL}, {NULL, NULL}}};
    static const spline_form cubic = {"s^2*(3 - 2*s)",
                                      {{"h*s*(1 - s)^2", "h*s^2*(s - 1)"}, {NULL, NULL}}};
    static const spline_form quintic = {"s^3*(10 - 15*s + 6*s^2)",
                                        {{"h*s*(1 - s)^3*(1 + 3*s)", "h*s^3*(s - 1)*(4 - 3*s)"},
                                         {"h^2/2*s^2*(1 - s)^3", "h^2/2*s^3*(1 - s)^2"}}};
    return text->of->kinked ? &line : text->orders == 2 ? &quintic : &cubic;
}

/* Writes a + (b - a)*F for the values a and b at both ends. */
static void write_values(const spline_text *text, size_t lane, size_t piece, const char *factor,
                         const imp_text_sink *to)
{
    write_given(text, lane, 0, piece, to);
    imp_add_text(to, " + ((");
    write_given(text, lane, 0, piece + 1, to);
    imp_add_text(to, ") - (");
    write_given(text, lane, 0, piece, to);
    imp_add_text(to, "))*");
    imp_add_text(to, factor);
}

static void write_lane(const spline_text *text, size_t piece, size_t lane, const imp_text_sink *to)
{
    const spline_form *form = form_of(text);
    write_name(text, lane, " = ", to);
    write_values(text, lane, piece, form->step, to);
    for (int order = 1; order < 3 && form->factor[order - 1][0] != NULL; ++order)
        for (size_t end = 0; end < 2; ++end) {
            imp_add_text(to, " + (");
            write_given(text, lane, order, piece + end, to);
            imp_add_text(to, ")*");
            imp_add_text(to, form->factor[order - 1][end]);
        }
    imp_add_text(to, "; ");
}

void spline_write_part(const spline_text *text, size_t piece, const imp_text_sink *to)
{
    const double *time = text->of->time, lo = time[piece], hi = time[piece + 1];
    const bool is_first = piece == 0, is_last = piece + 1 == text->of->pieces;
    imp_add_range(to, "t", text->hold && is_first ? -INFINITY : lo,
                  text->hold && is_last ? INFINITY : hi);
    imp_define(to, "t0", lo);
    imp_add_text(to, "h = ");
    imp_add_number(to, hi);
    imp_add_text(to, " - t0; s = ");
    imp_add_text(to, text->hold && (is_first || is_last) ? "clamp((t - t0)/h, 0, 1); "
                                                         : "(t - t0)/h; ");
    for (size_t lane = 0; lane < text->of->lanes; ++lane) write_lane(text, piece, lane, to);
}

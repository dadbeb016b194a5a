/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/frame.h"

#include "plugins/common/squares.h"

static void keep(const imp_model from[3], near_constant to[3])
{
    for (int i = 0; i < 3; ++i) to[i] = near_of(from[i]);
}

/* Exactly along a coordinate axis; -1: it is not. */
static int aligned_with(const imp_model axis[3])
{
    int along = -1;
    for (int i = 0; i < 3; ++i) {
        if (axis[i].a == 0 && axis[i].e == 0) continue;
        if (along >= 0 || axis[i].e != 0) return -1;
        along = i;
    }
    return along;
}

static frame aligned_frame(int i, bool is_negative)
{
    frame f = {.a = {{0, 0}}};
    f.a[(i + 1) % 3] = near_exact(1);
    f.b[(i + 2) % 3] = near_exact(is_negative ? -1 : 1);
    f.k[i] = near_exact(is_negative ? -1 : 1);
    return f;
}

/* Lemma. k is a unit vector in exact arithmetic, and so is a, which is perpendicular to it; then b
 * = k x a is the third, and a x b = a x (k x a) = k. The models hold these exact vectors. With the
 * coordinate axis that k is farthest from, |k x e| >= (2/3)^(1/2): the quotient is well defined. */
frame frame_about(const imp_model axis[3])
{
    frame f;
    imp_model k[3], a[3], b[3], other[3];
    const int along = aligned_with(axis);
    if (along >= 0) return aligned_frame(along, axis[along].a < 0);
    axis_unit(axis, k);
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (fabs(k[i].a) < fabs(k[least].a)) least = i;
    for (int i = 0; i < 3; ++i) other[i] = imp_num(i == least);
    axis_cross(k, other, b);
    axis_unit(b, a);
    axis_cross(k, a, b);
    keep(a, f.a);
    keep(b, f.b);
    keep(k, f.k);
    return f;
}

void frame_ring(const frame *f, imp_model r, imp_model u, imp_model out[3])
{
    imp_model sin_u, cos_u;
    imp_sincos(u, &sin_u, &cos_u);
    const imp_model x = imp_mul(r, cos_u), y = imp_mul(r, sin_u);
    for (int i = 0; i < 3; ++i) {
        const near_constant pair[3] = {f->a[i], f->b[i], near_exact(0)};
        const imp_model both[3] = {x, y, imp_num(0)};
        out[i] = axis_dot(pair, both);
    }
}

imp_model frame_across_squared(const frame *f, const imp_model m[3])
{
    const imp_model flat[2] = {axis_dot(f->a, m), axis_dot(f->b, m)};
    return sum_of_squares(flat, 2);
}

/* --- As text ---------------------------------------------------------------------------------- */

static void define_vector(const imp_text_sink *to, const char *name, const near_constant v[3])
{
    for (size_t i = 0; i < 3; ++i) imp_define_at(to, name, i, v[i].value);
}

/* What frame_about does, as formulas: by the coordinate axis that k is farthest from. */
void frame_write(const frame *f, const imp_text_sink *to)
{
    static const char *const across[3] = {"h = hypot(k1, k2); a0 = 0; a1 = k2/h; a2 = -k1/h; ",
                                          "h = hypot(k0, k2); a0 = -k2/h; a1 = 0; a2 = k0/h; ",
                                          "h = hypot(k0, k1); a0 = k1/h; a1 = -k0/h; a2 = 0; "};
    int least = 0;
    bool is_exact = true;
    for (int i = 0; i < 3; ++i) {
        if (fabs(f->k[i].value) < fabs(f->k[least].value)) least = i;
        is_exact = is_exact && f->a[i].error == 0 && f->b[i].error == 0 && f->k[i].error == 0;
    }
    if (is_exact) {
        define_vector(to, "a", f->a);
        define_vector(to, "b", f->b);
        define_vector(to, "k", f->k);
        return;
    }
    imp_add_text(to, "l = hypot(w0, w1, w2); k0 = w0/l; k1 = w1/l; k2 = w2/l; ");
    imp_add_text(to, across[least]);
    imp_add_text(to, "b0 = k1*a2 - k2*a1; b1 = k2*a0 - k0*a2; b2 = k0*a1 - k1*a0; ");
}

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* A type in C++17. Overloaded operators let the formula read like mathematics, and the tables are
 * compile-time constants. Exceptions must not leave a callback, so nothing here throws.
 *
 * A puddle after a drop has fallen into it: rings run outward and decay with the distance. */

#include <impinge/formula.h>
#include <impinge/plugin.h>
#include <new>

namespace
{

/* --- Models with operators ------------------------------------------------------------ */

imp_model operator+(imp_model a, imp_model b) { return imp_add(a, b); }
imp_model operator-(imp_model a, imp_model b) { return imp_sub(a, b); }
imp_model operator*(imp_model a, imp_model b) { return imp_mul(a, b); }
imp_model operator*(double k, imp_model a) { return imp_scale(a, k); }
imp_model operator-(imp_model a) { return imp_neg(a); }

/* --- Parameters ----------------------------------------------------------------------- */

enum { SIZE, HEIGHT, RINGS, SPEED, ROWS };

constexpr imp_parameter parameters[ROWS] = {
    IMP_ROW_POSITIVE("size", "length", "1", "distance at which the height falls to 37%"),
    IMP_ROW_POSITIVE("height", "length", "0.1", "height in the middle"),
    IMP_ROW_POSITIVE("rings", "rad/length^2", "12", "density of the rings"),
    IMP_ROW_POSITIVE("speed", "rad/time", "10", "how fast they run outward"),
};

/* --- The surface ---------------------------------------------------------------------- */

class Puddle
{
  public:
    explicit Puddle(const imp_value *values)
        : size_(values[SIZE].number[0]), height_(values[HEIGHT].number[0]),
          rings_(values[RINGS].number[0]), speed_(values[SPEED].number[0])
    {
    }

    void domain(double lo[3], double hi[3]) const
    {
        for (int j = 0; j < 2; ++j) lo[j] = -2 * size_, hi[j] = 2 * size_;
        lo[2] = -INFINITY, hi[2] = INFINITY;
    }

    /* r2 = u^2 + v^2: (u, v, height exp(-r2/size^2) cos(rings r2 - speed t)) */
    void formula(imp_model u, imp_model v, imp_model t, imp_model out[3]) const
    {
        const imp_model r2 = imp_sqr(u) + imp_sqr(v);
        const imp_model size = imp_num(size_);
        const imp_model far = imp_sqr(imp_div(u, size)) + imp_sqr(imp_div(v, size));
        out[0] = u;
        out[1] = v;
        out[2] = height_ * (imp_exp(-far) * imp_cos(rings_ * r2 - speed_ * t));
    }

  private:
    double size_, height_, rings_, speed_;
};

/* --- The callbacks -------------------------------------------------------------------- */

imp_status puddle_create(const imp_value *values, void **self, imp_create_error *)
{
    *self = new (std::nothrow) Puddle(values);
    return *self != nullptr ? IMP_OK : IMP_INTERNAL;
}

void puddle_destroy(void *self) { delete static_cast<Puddle *>(self); }

void puddle_domain(const void *self, double lo[3], double hi[3])
{
    static_cast<const Puddle *>(self)->domain(lo, hi);
}

void puddle_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    static_cast<const Puddle *>(self)->formula(u, v, t, out);
}
IMP_SURFACE_FORMULA(puddle_formula)

constexpr imp_surface_type puddle = [] {
    imp_surface_type type =
        IMP_SURFACE_VALUE_OF("puddle", puddle, puddle_formula, puddle_destroy);
    type.summary = "rings that run outward and decay";
    type.equation = "r2 = u^2 + v^2: (u, v, height exp(-r2/size^2) cos(rings r2 - speed t)), "
                    "u and v in [-2 size, 2 size]";
    type.example = "puddle height=0.2";
    return type;
}();

} // namespace

IMPINGE_SURFACE_PLUGIN("puddle", "1.0", "MIT", "The Impinge authors", puddle);

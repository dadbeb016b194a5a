/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* A type of a class, in C++17. Operators let the formula read like mathematics, the tables are
 * compile-time constants, and what a constructor throws rejects the parameters.
 *
 * A puddle after a drop has fallen into it: rings run outward and decay with the distance. */

#include <impinge/model.hpp>

namespace
{

enum { SIZE, HEIGHT, RINGS, SPEED };

constexpr imp_parameter rows[] = {
    IMP_ROW_POSITIVE("size", "length", "1", "distance at which the height falls to 37%"),
    IMP_ROW_POSITIVE("height", "length", "0.1", "height in the middle"),
    IMP_ROW_POSITIVE("rings", "rad/length^2", "12", "density of the rings"),
    IMP_ROW_POSITIVE("speed", "rad/time", "10", "how fast they run outward"),
};

class puddle
{
  public:
    explicit puddle(const imp_value *values)
        : size_(values[SIZE].number[0]), height_(values[HEIGHT].number[0]),
          rings_(values[RINGS].number[0]), speed_(values[SPEED].number[0])
    {
        if (!(size_ < 1e100)) throw impinge::rejected{SIZE, "must be below 1e100"};
    }

    impinge::domain domain() const { return {-2 * size_, 2 * size_, -2 * size_, 2 * size_}; }

    /* r2 = u^2 + v^2: (u, v, height exp(-r2/size^2) cos(rings r2 - speed t)) */
    impinge::point formula(const impinge::model &u, const impinge::model &v,
                           const impinge::model &t) const
    {
        const impinge::model r2 = sqr(u) + sqr(v), far = sqr(u / size_) + sqr(v / size_);
        return {u, v, height_ * (exp(-far) * cos(rings_ * r2 - speed_ * t))};
    }

  private:
    double size_, height_, rings_, speed_;
};

constexpr imp_surface_type type = impinge::surface_of<puddle>(
    rows, {"puddle", "rings that run outward and decay",
           "r2 = u^2 + v^2: (u, v, height exp(-r2/size^2) cos(rings r2 - speed t)), u and v in "
           "[-2 size, 2 size]",
           "puddle height=0.2"});

} // namespace

IMPINGE_SURFACE_PLUGIN("puddle", "1.0", "MIT", "The Impinge authors", type);

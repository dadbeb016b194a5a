/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* The flanks of an involute gear in C++17: gear.c by a class for the gear, which reads the values,
 * and one for a flank, which is a piece. */

#include <impinge/model.hpp>

#include <cmath>
#include <vector>

namespace
{

enum { TEETH, BASE, ROLL, WIDTH };

constexpr imp_parameter rows[] = {
    IMP_ROW_INTEGER("teeth", "1", "12", 3, 1000, "how many teeth it has"),
    IMP_ROW_POSITIVE("base", "length", "1", "radius of the base circle"),
    IMP_ROW_BETWEEN("roll", "rad", "0.6", 0.01, 3, "how far a flank unrolls"),
    IMP_ROW_POSITIVE("width", "length", "0.5", "along the z axis"),
};

/* The half tooth at the base circle, in parts of the pitch. */
constexpr double HALF_TOOTH = 0.3;

class flank
{
  public:
    flank(double base, double angle, double sign, double roll, double width)
        : base_(base), angle_(angle), sign_(sign), roll_(roll), width_(width)
    {
    }

    impinge::domain domain() const { return {0, roll_, -0.5 * width_, 0.5 * width_}; }

    /* With phi = angle + s u, s = 1 or -1 for either side of a tooth: (base (cos phi + s u sin
     * phi), base (sin phi - s u cos phi), v). */
    impinge::point formula(const impinge::model &u, const impinge::model &v,
                           const impinge::model &) const
    {
        const impinge::model way = sign_ * u, phi = way + angle_;
        const impinge::model sine = sin(phi), cosine = cos(phi);
        return {base_ * (cosine + way * sine), base_ * (sine - way * cosine), v};
    }

  private:
    double base_, angle_, sign_, roll_, width_;
};

class gear
{
  public:
    explicit gear(const imp_value *values)
    {
        const double teeth = values[TEETH].number[0], roll = values[ROLL].number[0];
        const double pitch = 2 * 3.14159265358979311600 / teeth;
        if (roll - std::atan(roll) >= HALF_TOOTH * pitch)
            throw impinge::rejected{ROLL, "the flanks of a tooth meet before that"};
        for (int tooth = 0; tooth < static_cast<int>(teeth); ++tooth)
            for (const double sign : {1.0, -1.0})
                flanks_.emplace_back(values[BASE].number[0], pitch * (tooth - sign * HALF_TOOTH),
                                     sign, roll, values[WIDTH].number[0]);
    }

    const std::vector<flank> &pieces() const { return flanks_; }

  private:
    std::vector<flank> flanks_;
};

constexpr imp_surface_type type = impinge::surface_of_pieces<gear, flank>(
    rows, {"gear-pieces", "flanks of an involute gear",
           "phi = angle + s u: (base (cos phi + s u sin phi), base (sin phi - s u cos phi), v)",
           "gear-pieces teeth=20 roll=0.5"});

} // namespace

IMPINGE_SURFACE_PLUGIN("gear-pieces", "1.0", "MIT", "The Impinge authors", type);

/* SPDX-FileCopyrightText: @author@
 * SPDX-License-Identifier: MIT */

/* A square drumhead that is fixed at its rim and swings up and down. Replace the formula, its
 * domain and the parameters with your own. */

#include <impinge/model.hpp>

namespace
{

/* --- Parameters ------------------------------------------------------------------------------- */

enum { HEIGHT, RATE };

constexpr imp_parameter rows[] = {
    IMP_ROW_NUMBER("height", "length", "0.25", "how far the middle swings"),
    IMP_ROW_POSITIVE("rate", "rad/time", "6", "how fast it swings"),
};

/* --- The surface ------------------------------------------------------------------------------ */

class drum
{
  public:
    /* The host has checked the kind and range of each value against the table above. Check
     * everything else here, and on an error throw impinge::rejected. */
    explicit drum(const imp_value *values)
        : height_(values[HEIGHT].number[0]), rate_(values[RATE].number[0])
    {
    }

    /* -1 <= u, v <= 1, at any time. */
    impinge::domain domain() const { return {-1, 1, -1, 1}; }

    /* Evaluation, rates and inclusions follow from the formula, with proof. */
    impinge::point formula(const impinge::model &u, const impinge::model &v,
                           const impinge::model &t) const
    {
        return {u, v, height_ * ((1 - sqr(u)) * (1 - sqr(v)) * sin(rate_ * t))};
    }

  private:
    double height_, rate_;
};

/* --- The plugin ------------------------------------------------------------------------------- */

constexpr imp_surface_type type = impinge::surface_of<drum>(
    rows,
    {"@name@", "square drumhead that swings",
     "(u, v, height (1 - u^2) (1 - v^2) sin(rate t)), u and v in [-1,1]", "@name@ height=0.5"});

} // namespace

#ifndef PACKAGE_VERSION /* set by the build; the default for one without it: */
#define PACKAGE_VERSION "0.1"
#endif
IMPINGE_SURFACE_PLUGIN("@name@", PACKAGE_VERSION, "MIT", "@author@", type);

/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_HPP
#define IMPINGE_MODEL_HPP

#include <impinge/formula.h>
#include <impinge/plugin.h>

#include <exception>
#include <new>
#include <type_traits>
#include <utility>

/* Surface types in C++17
 * ======================
 *
 * A class with a formula becomes a type. Its constructor reads the values, and may throw
 * impinge::rejected.
 *
 *   class ball
 *   {
 *     public:
 *       explicit ball(const imp_value *values) : radius_(values[0].number[0]) {}
 *       impinge::domain domain() const { return {0, IMP_TWO_PI_UPPER, -1, 1}; }
 *       impinge::point formula(impinge::model u, impinge::model v, impinge::model t) const
 *       {
 *           return {radius_ * cos(u), radius_ * sin(u), v + 0.5 * t};
 *       }
 *
 *     private:
 *       double radius_;
 *   };
 *   constexpr imp_parameter rows[] = {IMP_ROW_POSITIVE("radius", "length", "1", "radius")};
 *   constexpr imp_surface_type type = impinge::surface_of<ball>(
 *       rows, {"ball", "a tube that rises", "(radius cos u, radius sin u, v + t/2)",
 *              "ball radius=2"});
 *   IMPINGE_SURFACE_PLUGIN("ball", "1.0", "MIT", "your name", type);
 *
 * A lambda is enough where all parameters are single numbers: impinge::surface_from<shape,
 * where>(rows, texts), with constexpr lambdas shape(const double *numbers, model u, model v, model
 * t) -> point and where(const double *numbers) -> domain.
 *
 * A type of many surfaces in one instance has a class for the whole and one for a piece:
 * impinge::surface_of_pieces<gear, flank>(rows, texts). `gear` has the constructor, and pieces(),
 * which returns a reference to its array of flanks (size() and [], std::vector for one); `flank`
 * has domain and formula.
 *
 * Instances are deleted by the host's call of destroy. No exception leaves a callback: one that is
 * thrown in create rejects the parameters with its text, any other is IMP_STATUS_INTERNAL.
 * [thread-safe], as in <impinge/surface.h>. */

namespace impinge
{

/* --- Models with operators -------------------------------------------------------------------- */

/* A value of <impinge/model.h>. Numbers convert to it; operations with a number cost less than with
 * a model. */
class model
{
  public:
    model() : value_(imp_num(0)) {}
    model(double number) : value_(imp_num(number)) {}
    model(const imp_model &value) : value_(value) {}
    operator imp_model() const { return value_; }

    friend model operator+(const model &a, const model &b) { return imp_add(a, b); }
    friend model operator+(const model &a, double k) { return imp_shift(a, k); }
    friend model operator+(double k, const model &a) { return imp_shift(a, k); }
    friend model operator-(const model &a, const model &b) { return imp_sub(a, b); }
    friend model operator-(const model &a, double k) { return imp_shift(a, -k); }
    friend model operator-(double k, const model &a) { return imp_shift(imp_neg(a), k); }
    friend model operator-(const model &a) { return imp_neg(a); }
    friend model operator*(const model &a, const model &b) { return imp_mul(a, b); }
    friend model operator*(double k, const model &a) { return imp_scale(a, k); }
    friend model operator*(const model &a, double k) { return imp_scale(a, k); }
    friend model operator/(const model &a, const model &b) { return imp_div(a, b); }
    friend model operator/(const model &a, double k) { return imp_div(a, imp_num(k)); }
    friend model operator/(double k, const model &a) { return imp_div(imp_num(k), a); }

    friend model sqr(const model &a) { return imp_sqr(a); }
    friend model sqrt(const model &a) { return imp_sqrt(a); }
    friend model exp(const model &a) { return imp_exp(a); }
    friend model log(const model &a) { return imp_log(a); }
    friend model sin(const model &a) { return imp_sin(a); }
    friend model cos(const model &a) { return imp_cos(a); }
    friend model tan(const model &a) { return imp_tan(a); }
    friend model asin(const model &a) { return imp_asin(a); }
    friend model acos(const model &a) { return imp_acos(a); }
    friend model atan(const model &a) { return imp_atan(a); }
    friend model atan2(const model &y, const model &x) { return imp_atan2(y, x); }
    friend model sinh(const model &a) { return imp_sinh(a); }
    friend model cosh(const model &a) { return imp_cosh(a); }
    friend model tanh(const model &a) { return imp_tanh(a); }
    friend model abs(const model &a) { return imp_abs(a); }
    friend model min(const model &a, const model &b) { return imp_min(a, b); }
    friend model max(const model &a, const model &b) { return imp_max(a, b); }
    friend model pow(const model &a, double p) { return imp_pow(a, p); }
    friend model pow(const model &a, int n) { return imp_powi(a, n); }

  private:
    imp_model value_;
};

struct point {
    model x, y, z;
};

/* u from u_lo to u_hi, v likewise; at all times unless given. */
struct domain {
    double u_lo, u_hi, v_lo, v_hi, t_lo = -INFINITY, t_hi = INFINITY;
};

/* What a constructor throws: which parameter (row; -1: the type as a whole) is wrong, and a
 * sentence that lives on. */
struct rejected {
    int parameter;
    const char *text;
};

struct texts {
    const char *name, *summary, *equation, *example;
};

/* --- Callbacks -------------------------------------------------------------------------------- */

/* For a class T as above. */
template <class T> struct callbacks {
    static imp_status create(const imp_value *values, void **self, imp_create_error *why) noexcept
    {
#if defined(__cpp_exceptions)
        try {
            *self = new T(values);
            return IMP_STATUS_OK;
        } catch (const rejected &wrong) {
            return imp_reject(why, wrong.parameter, -1, "%s", wrong.text);
        } catch (const std::bad_alloc &) {
            return IMP_STATUS_INTERNAL;
        } catch (const std::exception &wrong) {
            return imp_reject(why, -1, -1, "%s", wrong.what());
        } catch (...) {
            return IMP_STATUS_INTERNAL;
        }
#else
        (void)why;
        *self = new (std::nothrow) T(values);
        return *self != nullptr ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
#endif
    }

    static void destroy(void *self) noexcept { delete static_cast<T *>(self); }

    static void domain_of(const void *self, double lo[3], double hi[3]) noexcept
    {
        const domain d = static_cast<const T *>(self)->domain();
        imp_set_domain(lo, hi, d.u_lo, d.u_hi, d.v_lo, d.v_hi);
        lo[2] = d.t_lo;
        hi[2] = d.t_hi;
    }

    static void formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
    {
        const point p = static_cast<const T *>(self)->formula(model(u), model(v), model(t));
        out[0] = p.x;
        out[1] = p.y;
        out[2] = p.z;
    }

    template <class Work> static imp_status guarded(Work work) noexcept
    {
#if defined(__cpp_exceptions)
        try {
            return work();
        } catch (...) {
            return IMP_STATUS_INTERNAL;
        }
#else
        return work();
#endif
    }

    static imp_status eval(const void *self, size_t n, const double *p, double *x,
                           double *error) noexcept
    {
        return guarded([=] { return imp_surface_formula_eval_(formula, self, n, p, x, error); });
    }

    static imp_status rate(const void *self, const imp_region *region,
                           imp_rate_matrix *rates) noexcept
    {
        return guarded([=] { return imp_surface_formula_rate_(formula, self, region, rates); });
    }

    static imp_status include(const void *self, const imp_region *region, imp_model out[3]) noexcept
    {
        return guarded([=] { return imp_surface_formula_include_(formula, self, region, out); });
    }
};

/* For a class with pieces(). */
template <class T> struct piece_callbacks {
    static size_t count(const void *self) noexcept
    {
        return static_cast<const T *>(self)->pieces().size();
    }

    static const void *piece(const void *self, size_t index) noexcept
    {
        const auto &piece = static_cast<const T *>(self)->pieces()[index];
        return &piece;
    }
};

/* The type whose instances are Made, and whose other callbacks get a Shape. */
template <class Made, class Shape, size_t Rows>
constexpr imp_surface_type surface_type_(const imp_parameter (&rows)[Rows], const texts &say)
{
    using made = callbacks<Made>;
    using shape = callbacks<Shape>;
    imp_surface_type type = imp_surface_value_(
        imp_type_value_<imp_surface_type>(say.name, rows, Rows, made::create, made::destroy),
        shape::domain_of, shape::eval, shape::rate, shape::include);
    type.summary = say.summary;
    type.equation = say.equation;
    type.example = say.example;
    return type;
}

/* The type of a class, which a lambda may complete with more callbacks. */
template <class T, size_t Rows>
constexpr imp_surface_type surface_of(const imp_parameter (&rows)[Rows], const texts &say)
{
    return surface_type_<T, T>(rows, say);
}

/* The type of a class whose instances have pieces. */
template <class Whole, class Piece, size_t Rows>
constexpr imp_surface_type surface_of_pieces(const imp_parameter (&rows)[Rows], const texts &say)
{
    static_assert(std::is_lvalue_reference<decltype(std::declval<const Whole &>().pieces())>::value,
                  "pieces() must return a reference to what the instance keeps");
    imp_surface_type type = surface_type_<Whole, Piece>(rows, say);
    type.piece_count = piece_callbacks<Whole>::count;
    type.piece = piece_callbacks<Whole>::piece;
    return type;
}

/* The instance of a lambda: its numbers, in the order of the rows. */
template <const auto &Shape, const auto &Where, size_t Rows> class numbers
{
  public:
    explicit numbers(const imp_value *values)
    {
        for (size_t k = 0; k < Rows; ++k) number_[k] = values[k].number[0];
    }
    impinge::domain domain() const { return Where(number_); }
    point formula(const model &u, const model &v, const model &t) const
    {
        return Shape(number_, u, v, t);
    }

  private:
    double number_[Rows];
};

template <const auto &Shape, const auto &Where, size_t Rows>
constexpr imp_surface_type surface_from(const imp_parameter (&rows)[Rows], const texts &say)
{
    return surface_of<numbers<Shape, Where, Rows>>(rows, say);
}

} // namespace impinge

#endif /* IMPINGE_MODEL_HPP */

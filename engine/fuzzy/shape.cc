#include "engine/fuzzy/shape.h"

#include <cmath>

namespace etude {
namespace {

double Rise(double from, double to, double x) { return x >= to ? 1.0 : x <= from ? 0.0 : (x - from) / (to - from); }
double Fall(double from, double to, double x) { return x <= from ? 1.0 : x >= to ? 0.0 : (to - x) / (to - from); }

struct At {
  double x;
  double operator()(const Triangular& s) const {
    return x <= s.peak ? Rise(s.left, s.peak, x) : Fall(s.peak, s.right, x);
  }
  double operator()(const Trapezoidal& s) const {
    return x < s.left_top ? Rise(s.left, s.left_top, x) : Fall(s.right_top, s.right, x);
  }
  double operator()(const Gaussian& s) const {
    const double z = (x - s.mean) / s.sigma;
    return std::exp(-0.5 * z * z);
  }
  double operator()(const Singleton& s) const { return x == s.at ? 1.0 : 0.0; }
};

struct CutAt {
  double grade;
  Cut operator()(const Triangular& s) const { return Sides(s.left, s.peak, s.peak, s.right); }
  Cut operator()(const Trapezoidal& s) const { return Sides(s.left, s.left_top, s.right_top, s.right); }
  Cut operator()(const Gaussian& s) const {
    const double reach = s.sigma * std::sqrt(-2 * std::log(grade));
    return {s.mean - reach, s.mean + reach};
  }
  Cut operator()(const Singleton& s) const { return {s.at, s.at}; }
  Cut Sides(double left, double left_top, double right_top, double right) const {
    // From the top, so that grade 1 gives the top itself.
    return {left_top - (1 - grade) * (left_top - left), right_top + (1 - grade) * (right - right_top)};
  }
};

}  // namespace

double GradeOf(const Shape& shape, double input) { return std::visit(At{input}, shape); }

Cut CutOf(const Shape& shape, double grade) { return std::visit(CutAt{grade}, shape); }

}  // namespace etude

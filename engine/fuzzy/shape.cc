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

}  // namespace

double GradeOf(const Shape& shape, double input) { return std::visit(At{input}, shape); }

}  // namespace etude

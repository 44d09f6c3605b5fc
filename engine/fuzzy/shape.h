#pragma once

#include <variant>

namespace etude {

/// The shapes of membership functions that paper A names (section 2.4, figure 1). Inputs in the feature's unit.
struct Triangular {
  double left, peak, right;  ///< 0 up to `left`, 1 at `peak`, 0 from `right`; rising, equal where a side is upright
};
struct Trapezoidal {
  double left, left_top, right_top, right;  ///< 0 up to `left`, 1 between the tops, 0 from `right`; rising
};
struct Gaussian {
  double mean, sigma;  ///< exp(−(x − mean)² / 2 sigma²), sigma > 0
};
struct Singleton {
  double at;  ///< 1 there, 0 elsewhere
};
using Shape = std::variant<Triangular, Trapezoidal, Gaussian, Singleton>;

/// The grade of membership of an input, in [0, 1].
double GradeOf(const Shape& shape, double input);

struct Cut {
  double low = 0, high = 0;  ///< closed
};

/// The α-cut: the inputs of at least this grade, in (0, 1]. One interval, since every shape is convex. Grade 0 gives
/// the support of a shape with straight sides.
Cut CutOf(const Shape& shape, double grade);

}  // namespace etude

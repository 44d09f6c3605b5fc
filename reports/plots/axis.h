#pragma once

#include <string>
#include <vector>

namespace etude {

/// A number axis of a panel, in the panel's own units.
struct Axis {
  double low = 0, high = 1;
  bool is_logarithmic = false;
  double from = 0, to = 1;  ///< where `low` and `high` lie; `from` may be the larger one

  /// Where a value lies. What is beyond an end lies on it.
  double At(double value) const;
  /// About five round values; of a logarithmic axis powers of ten. Never empty.
  std::vector<double> Ticks() const;
};

/// An axis that holds all values. Where `floor` is above 0 and the values spread over more than two decades it is
/// logarithmic, and what lies below `floor` is drawn on its end. Without values it is 0…1.
Axis AxisOf(const std::vector<double>& values, double floor);

/// One that holds zero too, always linear.
Axis AxisAroundZero(const std::vector<double>& values);

/// How an axis names a tick: "0.01", "12", "−3", "1e-5".
std::string TickText(double value);

}  // namespace etude

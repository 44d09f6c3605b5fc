#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace etude {

/// Searches the plane for the point with the smallest loss. Keeps the best of all points tried, beginning with the
/// origin. A point whose loss is nullopt is never taken.
class PlaneSearch {
 public:
  using Loss = std::function<std::optional<double>(double x, double y)>;

  PlaneSearch(Loss loss, double at_origin) : loss_of_(std::move(loss)), loss_(at_origin) {}

  double x() const { return x_; }
  double y() const { return y_; }
  double loss() const { return loss_; }

  /// Moves to (x, y) if its loss is smaller; returns true if it did.
  bool Try(double x, double y) {
    const auto loss = loss_of_(x, y);
    if (!loss || !(*loss < loss_)) return false;
    x_ = x;
    y_ = y;
    loss_ = *loss;
    return true;
  }

  /// Pattern search: steps along both axes as long as this lowers the loss, and halves the step from 0.5 down to 0.002.
  void Refine() {
    constexpr double kFirstStep = 0.5, kLastStep = 0.002;
    for (double step = kFirstStep; step > kLastStep;) {
      const double x = x_, y = y_;
      if (!(Try(x + step, y) || Try(x - step, y) || Try(x, y + step) || Try(x, y - step))) step *= 0.5;
    }
  }

 private:
  Loss loss_of_;
  double x_ = 0, y_ = 0, loss_;
};

}  // namespace etude

#pragma once

#include <span>

namespace etude {

/// What one kind of cost says of the pairs of a row: those of one frame that may be left. Rows are asked for in rising
/// order.
class PairRows {
 public:
  virtual ~PairRows() = default;
  /// The costs of leaving at `leave_frame` and entering at each of `enter_frames`; `costs` has as many places.
  virtual void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) = 0;
};

}  // namespace etude

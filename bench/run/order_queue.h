#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "bench/run/plan.h"

namespace etude {

/// The orders of a run that no worker has yet, by condition. What the worlds of a condition share (thresholds, tuned
/// weights) every worker prepares for itself, so a worker stays with its condition while there are orders, then takes
/// the next condition that nobody has begun, and only then helps with the one that has most orders left.
class OrderQueue {
 public:
  /// Where a worker is that has not begun anything.
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  OrderQueue(const Plan& plan, std::vector<Order> orders);

  bool empty() const { return left_ == 0; }
  std::size_t size() const { return left_; }
  /// The next order of a worker, of at least one; `condition` is where that worker is, and is then.
  Order Take(std::size_t& condition);
  /// An order that its worker did not end comes first among those of its condition.
  void PutBack(Order order);

 private:
  std::size_t ConditionWithMost() const;

  std::vector<std::deque<Order>> conditions_;  ///< in the order of the plan
  std::vector<std::size_t> first_worlds_;      ///< of each, ascending
  std::size_t begun_ = 0;                      ///< so many conditions were begun
  std::size_t left_ = 0;
};

}  // namespace etude

#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <vector>

#include "bench/run/plan.h"

namespace etude {

/// The orders of a run that no worker has yet, by condition. What the worlds of a condition share (thresholds, tuned
/// weights) every worker prepares for itself, so a worker stays with its condition while there are orders, then takes
/// the next condition that nobody has begun, and only then helps with the one that has most orders left. Conditions of
/// long worlds are helped with first: a long world that is begun last leaves all other workers idle.
class OrderQueue {
 public:
  /// Where a worker is that has not begun anything.
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  /// `is_long`: whether worlds of this scenario take long, as far as is known.
  OrderQueue(const Plan& plan, std::vector<Order> orders, std::function<bool(int scenario)> is_long);

  bool empty() const { return left_ == 0; }
  std::size_t size() const { return left_; }
  /// The next order of a worker, of at least one; `condition` is where that worker is, and is then.
  Order Take(std::size_t& condition);
  /// An order that its worker did not end comes first among those of its condition.
  void PutBack(Order order);

 private:
  struct Condition {
    int scenario = 0;
    std::size_t first_world = 0;
    std::deque<Order> orders = {};
  };
  std::size_t Choose();

  std::vector<Condition> conditions_;  ///< in the order of the plan
  std::function<bool(int scenario)> is_long_;
  std::vector<std::size_t> open_;  ///< conditions that were begun and had orders left
  std::size_t begun_ = 0;          ///< so many conditions were begun, or had nothing to do
  std::size_t left_ = 0;
};

}  // namespace etude

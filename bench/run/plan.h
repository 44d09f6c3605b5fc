#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/run/setup.h"

namespace etude {

/// One unit of work: a trial of a scenario under one of its conditions.
struct World {
  int scenario = 0;
  int condition = 0;
  int trial = 0;
};

/// A part of a run, "2/8": the worlds whose place in the plan is index − 1 modulo count.
struct Shard {
  int index = 1;
  int count = 1;
  bool operator==(const Shard&) const = default;
  bool IsWhole() const { return count == 1; }
};

/// Reads "2/8"; complains unless 1 ≤ index ≤ count ≤ 100,000.
Result<Shard> ParseShard(const std::string& text);
/// "2/8"
std::string ToString(const Shard& shard);

/// A world, and which of its methods are to be run there (ascending).
struct Order {
  std::size_t world = 0;
  std::vector<std::size_t> methods;
};

/// All cells of a run, numbered in canonical order: scenario, condition, trial, method.
class Plan {
 public:
  explicit Plan(std::span<const PreparedScenario> scenarios);

  std::span<const PreparedScenario> scenarios() const { return scenarios_; }
  std::size_t world_count() const { return worlds_.size(); }
  std::size_t cell_count() const { return first_cells_.back(); }
  const World& world(std::size_t index) const { return worlds_[index]; }
  const PreparedScenario& scenario_of(std::size_t world) const { return scenarios_[worlds_[world].scenario]; }
  /// The number of a cell.
  std::size_t CellAt(std::size_t world, std::size_t method) const { return first_cells_[world] + method; }
  std::size_t MethodCount(std::size_t world) const { return first_cells_[world + 1] - first_cells_[world]; }
  /// The world of a cell; its method is `cell − CellAt(world, 0)`.
  std::size_t WorldOf(std::size_t cell) const;
  /// The row of a cell, without a result.
  Row IdentityOf(std::size_t cell) const;
  bool IsIn(const Shard& shard, std::size_t world) const {
    return world % static_cast<std::size_t>(shard.count) == static_cast<std::size_t>(shard.index - 1);
  }
  /// The orders that are left of a shard, given which cells are done.
  std::vector<Order> OrdersFor(const Shard& shard, const std::vector<bool>& done) const;

 private:
  std::span<const PreparedScenario> scenarios_;
  std::vector<World> worlds_;
  std::vector<std::size_t> first_cells_;  ///< of each world, and the count of all at the end
};

/// The orders of a run that no worker has yet, by condition. What the worlds of a condition share (thresholds, tuned
/// weights) every worker prepares for itself, so a worker stays with its condition while there are orders, then takes
/// the next condition that nobody has begun, and only then helps with the one that has most orders left. Conditions of
/// long worlds are helped with first: a long world that is begun last leaves all other workers idle.
class OrderQueue {
 public:
  /// The condition of a worker that has not begun anything.
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

#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/run/setup.h"

namespace etude {

/// A trial of a scenario under one of its conditions.
struct World {
  int scenario = 0;
  int condition = 0;
  int trial = 0;
};

/// A part of a run, written as "2/8" (`index`/`count`): the worlds whose number in the plan, modulo `count`, is `index`
/// − 1.
struct Shard {
  int index = 1;
  int count = 1;
  bool operator==(const Shard&) const = default;
  bool IsWhole() const { return count == 1; }
};

/// Parses "2/8". Fails unless 1 ≤ index ≤ count ≤ 100,000.
Result<Shard> ParseShard(const std::string& text);
std::string ToString(const Shard& shard);

/// A piece of work for a worker: a world, and the ascending indices of the methods to be run in it.
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
  std::size_t CellAt(std::size_t world, std::size_t method) const { return first_cells_[world] + method; }
  std::size_t MethodCount(std::size_t world) const { return first_cells_[world + 1] - first_cells_[world]; }
  /// Returns the index of the world to which a cell belongs. The index of the cell's method is `cell − CellAt(world,
  /// 0)`.
  std::size_t WorldOf(std::size_t cell) const;
  /// Returns the row of a cell, still without a result.
  Row IdentityOf(std::size_t cell) const;
  bool IsIn(const Shard& shard, std::size_t world) const {
    return world % static_cast<std::size_t>(shard.count) == static_cast<std::size_t>(shard.index - 1);
  }
  /// Returns orders for those cells of a shard that are not done. `done` has one flag per cell.
  std::vector<Order> OrdersFor(const Shard& shard, const std::vector<bool>& done) const;

 private:
  std::span<const PreparedScenario> scenarios_;
  std::vector<World> worlds_;
  /// Number of the first cell of each world; the last entry is the number of all cells.
  std::vector<std::size_t> first_cells_;
};

/// The orders that no worker has taken yet, by condition. The worlds of a condition share data (thresholds, tuned
/// weights), which every worker must prepare for itself. A worker therefore stays with its condition until no orders of
/// this condition are left. Then the worker begins the next condition that no worker has begun. If every condition has
/// been begun, the worker joins the condition with the most orders left. A worker joins a begun condition that has long
/// worlds even if other conditions have not been begun, because a long world that is begun last leaves all other
/// workers idle.
class OrderQueue {
 public:
  /// The condition of a worker that has not had an order yet.
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  /// `is_long` returns true if the worlds of a scenario are known to take long.
  OrderQueue(const Plan& plan, std::vector<Order> orders, std::function<bool(int scenario)> is_long);

  bool empty() const { return left_ == 0; }
  std::size_t size() const { return left_; }
  /// Removes and returns the next order; there must be one. `condition` is the worker's condition, which this function
  /// updates.
  Order Take(std::size_t& condition);
  /// Puts back an order that a worker did not finish: the order becomes the first one of its condition again.
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
  std::vector<std::size_t> open_;  ///< conditions that were begun; some of them may have no orders left
  std::size_t begun_ = 0;          ///< number of begun conditions; they are the first ones
  std::size_t left_ = 0;
};

}  // namespace etude

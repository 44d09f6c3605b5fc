#pragma once

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
  /// What is left to do of a shard, given which cells are done.
  std::vector<Order> OrdersFor(const Shard& shard, const std::vector<bool>& done) const;

 private:
  std::span<const PreparedScenario> scenarios_;
  std::vector<World> worlds_;
  std::vector<std::size_t> first_cells_;  ///< of each world, and the count of all at the end
};

}  // namespace etude

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"

namespace etude {

/// Runs every method of a world, in order, and returns the cells; if the world must be skipped, returns skipped cells.
inline std::vector<CellResult> RunWorld(const Task& task, const WorldKey& key, std::size_t methods,
                                        bool keeps_motion = false) {
  const std::unique_ptr<TaskWorld> world = task.MakeWorld(key, keeps_motion);
  const std::optional<std::string> why_skipped = world->WhySkipped();
  std::vector<CellResult> cells;
  for (std::size_t method = 0; method < methods; ++method) {
    cells.push_back(why_skipped ? CellResult::Ended(Status::kSkipped, *why_skipped) : world->Run(method));
  }
  return cells;
}

}  // namespace etude

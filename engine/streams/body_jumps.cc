#include "engine/streams/body_jumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/base/order_statistics.h"

namespace etude {

bool BodyJumps::Take(const RecordedFrame& frame) {
  constexpr std::size_t kMinJoints = 5;
  constexpr double kMinJump_m = 0.5, kMaxSpeed = 12;
  if (!start_s_) start_s_ = frame.time_s;
  const auto is_shown = [](const auto& place) { return place.has_value(); };
  if (std::ranges::none_of(frame.places, is_shown)) return false;
  const auto before = std::exchange(before_, frame);
  if (!before) return false;
  // Compare with the last frame that shows a body.
  std::vector<double> moved;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (before->places[i] && frame.places[i]) moved.push_back(glm::distance(*before->places[i], *frame.places[i]));
  }
  if (moved.size() < kMinJoints) return false;
  const double jump = Median(std::move(moved));
  if (jump <= std::max(kMinJump_m, kMaxSpeed * (frame.time_s - before->time_s))) return false;
  if (++count_ == 1) {
    first_m_ = jump;
    first_s_ = frame.time_s - *start_s_;
  }
  return true;
}

std::string BodyJumps::Describe() const {
  if (count_ == 0) return "";
  const std::string times = count_ == 1 ? "" : fmt::format(" {} times, first", count_);
  return fmt::format("the body jumps{} by {:.2f} m at {:.2f} s; has the sensor changed to another person?", times,
                     first_m_, first_s_);
}

}  // namespace etude

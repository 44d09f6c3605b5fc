#pragma once

#include <cstddef>
#include <optional>

namespace etude {

/// Calls `fill(from, at, to, share)` for each frame `at` of each gap of at most `max_gap` frames: `from` and `to` are
/// the frames before and after the gap, and `share` rises from 0 at `from` to 1 at `to`. `is_known(frame)` returns
/// false in gaps. The frames before the first known one and after the last one are not gaps. Returns the number of
/// calls.
template <typename IsKnown, typename Fill>
int FillGaps(std::size_t frames, std::size_t max_gap, const IsKnown& is_known, const Fill& fill) {
  int filled = 0;
  std::optional<std::size_t> last;
  for (std::size_t to = 0; to < frames; ++to) {
    if (!is_known(to)) continue;
    const std::size_t from = last.value_or(to), length = to - from;
    for (std::size_t at = from + 1; length <= max_gap + 1 && at < to; ++at, ++filled) {
      fill(from, at, to, static_cast<double>(at - from) / static_cast<double>(length));
    }
    last = to;
  }
  return filled;
}

}  // namespace etude

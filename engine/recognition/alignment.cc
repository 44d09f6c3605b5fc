#include "engine/recognition/alignment.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace etude {
namespace {

constexpr double kUnreachable = std::numeric_limits<double>::infinity();
constexpr std::uint8_t kBegins = 3;  // a value of `advances_`: the path begins at this step

}  // namespace

SubsequenceAligner::SubsequenceAligner(std::span<const PoseVector> pattern, int longest)
    : pattern_(pattern),
      longest_(longest),
      distances_(pattern.size()),
      starts_(pattern.size()),
      advances_(static_cast<std::size_t>(longest) * pattern.size()) {
  assert(!pattern.empty() && longest >= 1);
  Reset();
}

void SubsequenceAligner::Reset() {
  count_ = 0;
  costs_.assign(pattern_.size(), kUnreachable);
}

void SubsequenceAligner::Update(const PoseVector& seen) {
  const int now = count_++;
  const std::size_t size = pattern_.size();
  std::uint8_t* advances = advances_.data() + static_cast<std::size_t>(now % longest_) * size;
  // Compute the local distances of this step to every step of the pattern.
  SquaredDistances(seen, pattern_, distances_);

  // Extend the best paths by this step. Go from the pattern's end to its start, so that costs_[j - 1] and costs_[j - 2]
  // still hold the values of the previous step.
  for (std::size_t j = size; j-- > 0;) {
    // The path may stay at pattern step j.
    double best = costs_[j];
    std::uint8_t advance = 0;
    int start = starts_[j];
    // The path may advance by one step.
    if (j >= 1 && costs_[j - 1] < best) {
      best = costs_[j - 1];
      advance = 1;
      start = starts_[j - 1];
    }
    // The path may advance by two steps, which also costs the distance to the skipped step.
    if (j >= 2 && costs_[j - 2] + distances_[j - 1] < best) {
      best = costs_[j - 2] + distances_[j - 1];
      advance = 2;
      start = starts_[j - 2];
    }
    if (j == 0) {  // a new path costs nothing, so it replaces any older one
      best = 0;
      advance = kBegins;
      start = now;
    }
    // Give a path that has become too long an infinite cost.
    const bool is_too_long = now - start >= longest_;
    costs_[j] = is_too_long ? kUnreachable : best + distances_[j];
    starts_[j] = start;
    advances[j] = advance;
  }
}

std::vector<StepPair> SubsequenceAligner::Path() const {
  std::vector<StepPair> path;
  if (count_ == 0 || costs_.back() == kUnreachable) return path;
  const std::size_t size = pattern_.size();
  int seen = count_ - 1, taught = static_cast<int>(size) - 1;
  for (;; --seen) {
    path.push_back({seen, taught});
    const std::uint8_t advance =
        advances_[static_cast<std::size_t>(seen % longest_) * size + static_cast<std::size_t>(taught)];
    if (advance == kBegins) break;
    taught -= advance;
  }
  std::ranges::reverse(path);
  return path;
}

}  // namespace etude

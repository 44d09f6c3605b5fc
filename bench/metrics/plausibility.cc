#include "bench/metrics/plausibility.h"

#include <algorithm>

namespace etude {

double FaultyShare(std::span<const MotionFault> faults, FaultKind kind, double duration_s) {
  std::vector<std::pair<double, double>> times;
  for (const MotionFault& fault : faults) {
    if (fault.kind == kind) times.emplace_back(fault.from_s, fault.to_s);
  }
  std::ranges::sort(times);
  double sum = 0, counted_to = 0;
  for (const auto& [from, to] : times) {
    sum += std::max(to - std::max(from, counted_to), 0.0);
    counted_to = std::max(counted_to, to);
  }
  return std::min(sum / duration_s, 1.0);
}

double LargestFault(std::span<const MotionFault> faults, FaultKind kind) {
  double largest = 0;
  for (const MotionFault& fault : faults) {
    if (fault.kind == kind) largest = std::max(largest, fault.size);
  }
  return largest;
}

double FaultCount(std::span<const MotionFault> faults, FaultKind kind) {
  return static_cast<double>(std::ranges::count(faults, kind, &MotionFault::kind));
}

std::vector<std::string> BeyondLimits(const std::map<std::string, double>& values,
                                      const std::map<std::string, double>& limits) {
  std::vector<std::string> beyond;
  for (const auto& [id, limit] : limits) {
    const auto value = values.find(id);
    if (value != values.end() && value->second > limit) beyond.push_back(id);
  }
  return beyond;
}

}  // namespace etude

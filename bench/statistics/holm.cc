#include "bench/statistics/holm.h"

#include <algorithm>

namespace etude {

std::vector<std::optional<double>> HolmCorrected(std::span<const std::optional<double>> p_values) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    if (p_values[i]) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return *p_values[a] != *p_values[b] ? *p_values[a] < *p_values[b] : a < b;
  });
  std::vector<std::optional<double>> corrected(p_values.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double factor = static_cast<double>(p_values.size() - rank);
    largest = std::max(largest, std::min(1.0, factor * *p_values[order[rank]]));
    corrected[order[rank]] = largest;
  }
  return corrected;
}

}  // namespace etude

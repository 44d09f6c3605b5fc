#include "engine/fuzzy/rules.h"

#include <algorithm>

namespace etude {

std::vector<double> InferPoses(const RuleBase& base, const Grades& grades) {
  std::vector<double> activations(base.poses.size(), 0.0);
  for (const Rule& rule : base.rules) {
    double weakest = 1;
    for (std::size_t term : rule.terms) weakest = std::min(weakest, grades[term]);
    activations[rule.pose] = std::max(activations[rule.pose], weakest);
  }
  return activations;
}

const std::string* ChoosePose(const RuleBase& base, const Grades& grades) {
  const std::vector<double> activations = InferPoses(base, grades);
  const auto strongest = std::ranges::max_element(activations);
  if (strongest == activations.end() || *strongest == 0) return nullptr;
  return &base.poses[static_cast<std::size_t>(strongest - activations.begin())];
}

}  // namespace etude

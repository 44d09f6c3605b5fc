#include "reports/paper/paper_a_figures.h"

#include <cmath>

namespace etude {

const std::vector<PaperAFigure>& PaperAFigures() {
  using enum Feature;
  static const std::vector<PaperAFigure> figures = {
      {5, kRH, "arm raise", "degrees between upper arm and down", {2, 3, 4}, ""},
      {6,
       kRHE,
       "elbow bent",
       "degrees between upper arm and forearm",
       {5, 6},
       "The grades do not sum to 1: so printed."},
      {7,
       kPosture,
       "lying to jumping",
       "height of the body's centre, standing = 80",
       {7, 8, 9, 10},
       "Equation 9 is printed as a second “sit”; “stand” is meant."},
      {8, kTrunk, "trunk bent", "180 degrees less the lean", {12, 11}, "The grades do not sum to 1: so printed."},
      {9, kRF, "leg spread", "degrees between thigh and down", {13, 14}, ""},
      {10, kRFK, "knee bent", "degrees inside the knee", {16, 15}, "The grades do not sum to 1: so printed."},
  };
  return figures;
}

double MeanRoundTripError(Feature feature, const Memberships& memberships, Defuzzification method) {
  constexpr int kSteps = 120;
  const Universe& universe = memberships.universes[static_cast<std::size_t>(feature)];
  double sum = 0;
  int count = 0;
  for (int i = 0; i <= kSteps; ++i) {
    PoseFeatures pose;
    pose[feature] = universe.low + (universe.high - universe.low) * i / kSteps;
    const auto back = DefuzzifyFeature(Fuzzify(pose, memberships), feature, memberships, method);
    if (!back) continue;  // no grade at all says nothing to go back to
    sum += std::abs(*back - pose[feature]);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace etude

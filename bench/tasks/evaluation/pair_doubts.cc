#include "bench/tasks/evaluation/pair_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/metrics/alignment.h"
#include "bench/tasks/evaluation/time_doubts.h"

namespace etude {
namespace {

constexpr double kMin_mm = 50;  // smallest mean error that a change of the answer may explain

/// Returns the mean joint error, millimetres, of the answer after one change of all positions; 0 below a nanometre,
/// which is rounding. Answer and truth must both show some joint.
double MeanErrorAfter(const EvaluatedPair& pair, const Similarity& change) {
  FrameFits fits;
  fits.fits = {change};
  fits.length = pair.found.FrameCount();
  constexpr double kRounding_mm = 1e-6;
  const double mean_mm = *MeanJointErrorMm(pair, fits);
  return mean_mm < kRounding_mm ? 0 : mean_mm;
}

/// Returns a doubt if one root stays at the origin and the other one does not; otherwise "".
std::string DoubtOnRoots(const EvaluatedPair& pair) {
  constexpr double kAtOrigin_m = 0.001, kElsewhere_m = 0.05;
  const auto reach = [](const std::vector<glm::dvec3>& root) {
    double farthest = -1;  // −1: never seen
    for (const glm::dvec3& p : root) farthest = std::max(farthest, IsSeen(p) ? glm::length(p) : -1);
    return farthest;
  };
  const double of_found = reach(pair.found_root), of_truth = reach(pair.true_root);
  const auto [least, most] = std::minmax(of_found, of_truth);
  if (least < 0 || least > kAtOrigin_m || most < kElsewhere_m) return "";
  return fmt::format(
      "the root of the {} stays at the origin, and the {}'s does not: if positions are relative to the root, only "
      "metrics that align each frame, such as mpjpe_root_mm, are meaningful",
      of_found < of_truth ? "answer" : "truth", of_found < of_truth ? "truth" : "answer");
}

/// Returns a doubt if the answer fits far better with other axes; otherwise "". If `has_doubts`, one of the files has
/// doubts, which usually explain another up axis.
std::string DoubtOnAxes(const EvaluatedPair& pair, bool has_doubts) {
  constexpr double kNearAxis = 0.99, kFarBetter = 0.1;
  const auto fit = Fit(MomentsOf(pair.found.positions, pair.truth.positions), false);
  if (!fit) return "";
  // Name, for each axis of the answer, the axis of the truth along which it lies.
  std::string axes;
  int named = 0;
  bool is_changed = false, is_up_changed = true;
  for (int axis = 0; axis < 3; ++axis) {
    for (int to = 0; to < 3; ++to) {
      const double along = fit->rotation[axis][to];
      if (std::abs(along) < kNearAxis) continue;
      axes += fmt::format("{}{}{}", axes.empty() ? "" : ", ", along < 0 ? "−" : "", "XYZ"[to]);
      ++named;
      if (axis == 1 && to == 1 && along > 0) is_up_changed = false;
      is_changed = is_changed || to != axis || along < 0;
    }
  }
  if (!is_changed || named < 3 || (is_up_changed && has_doubts)) return "";
  const double before = MeanErrorAfter(pair, {}), after = MeanErrorAfter(pair, *fit);
  if (before < kMin_mm || after > kFarBetter * before) return "";
  return fmt::format(
      "the answer's axes X, Y, Z seem to point along the truth's {}: with these axes, and moved, its mean error is "
      "{:.3g} mm instead of {:.3g}",
      axes, after, before);
}

/// Returns a doubt if the answer fits far better at another place; otherwise "".
std::string DoubtOnPlace(const EvaluatedPair& pair) {
  constexpr double kSmallPart = 0.04;
  const PointMoments moments = MomentsOf(pair.found.positions, pair.truth.positions);
  if (moments.count == 0) return "";
  const glm::dvec3 away = moments.mean - moments.target_mean;
  const double before = MeanErrorAfter(pair, {}), after = MeanErrorAfter(pair, {.translation = -away});
  if (before < kMin_mm || after > kSmallPart * before) return "";
  return fmt::format(
      "all of the answer is displaced by ({:.3f}, {:.3f}, {:.3f}) m: without this, its mean error is {:.3g} mm instead "
      "of {:.3g}; do both files have the same origin and floor?",
      away.x, away.y, away.z, after, before);
}

/// Returns a doubt if the answer fits far better after a rotation that exchanges no axes, or at another size; otherwise
/// "". `has_doubts` is as for DoubtOnAxes.
std::string DoubtOnHeading(const EvaluatedPair& pair, bool has_doubts) {
  constexpr double kFarBetter = 0.1, kBetter = 0.5, kMinSize = 0.02, kMinTurn_deg = 2, kUpright = 0.999;
  const PointMoments moments = MomentsOf(pair.found.positions, pair.truth.positions);
  const auto turned = Fit(moments, false), sized = Fit(moments, true);
  if (!turned || !sized) return "";
  const double before = MeanErrorAfter(pair, {}), of_turned = MeanErrorAfter(pair, *turned),
               of_sized = MeanErrorAfter(pair, *sized);
  const bool is_sized = of_sized < kBetter * of_turned && std::abs(sized->scale - 1) > kMinSize;
  const double after = is_sized ? of_sized : of_turned;
  if (before < kMin_mm || after > kFarBetter * before) return "";
  // State the rotation from the truth to the answer: about Y if the answer stays upright.
  const glm::dmat3 away = glm::transpose(turned->rotation);
  const double angle_deg =
      glm::degrees(std::acos(std::clamp((away[0][0] + away[1][1] + away[2][2] - 1) / 2, -1.0, 1.0)));
  const bool is_upright = away[1][1] > kUpright;
  if (!is_upright && has_doubts) return "";
  std::string change;
  if (angle_deg >= kMinTurn_deg) {
    change = is_upright ? fmt::format("turned by {:.0f}° about Y", std::copysign(angle_deg, away[2][0]))
                        : fmt::format("turned by {:.0f}°, and its up axis leans by {:.0f}°", angle_deg,
                                      glm::degrees(std::acos(std::clamp(away[1][1], -1.0, 1.0))));
  }
  if (is_sized) change += fmt::format("{}{:.3f} times as large", change.empty() ? "" : " and ", 1 / sized->scale);
  if (change.empty()) return "";
  return fmt::format(
      "all of the answer is {}: without this, and moved, its mean error is {:.3g} mm instead of {:.3g}; are both files "
      "in the same coordinates?",
      change, after, before);
}

}  // namespace

std::vector<std::string> DoubtsOnPair(const JudgedSide& truth, const JudgedSide& answer, const MatchedMotions& matched,
                                      double start_s) {
  const bool has_doubts = !truth.motion.doubts.empty() || !answer.motion.doubts.empty();
  std::vector<std::string> doubts{DoubtOnRoots(matched.pair), DoubtOnAxes(matched.pair, has_doubts)};
  if (doubts[0].empty() && doubts[1].empty()) doubts.push_back(DoubtOnPlace(matched.pair));
  if (std::ranges::all_of(doubts, &std::string::empty)) doubts.push_back(DoubtOnHeading(matched.pair, has_doubts));
  doubts.push_back(DoubtOnClock(truth, answer, start_s));
  if (!matched.lag && doubts.back().empty()) doubts.push_back(DoubtOnTimes(truth, answer, start_s));
  std::erase(doubts, "");
  return doubts;
}

}  // namespace etude

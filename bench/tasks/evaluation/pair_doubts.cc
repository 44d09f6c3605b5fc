#include "bench/tasks/evaluation/pair_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "bench/metrics/alignment.h"
#include "bench/metrics/time_shift.h"
#include "bench/tasks/evaluation/judged_frames.h"

namespace etude {
namespace {

constexpr double kToMm = 1000;
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

/// Compares distances between joints, on which a file's origin, axes and root have no effect. At most eight joints and
/// 150 frames of the truth, evenly chosen, are compared.
class DistanceComparison {
 public:
  DistanceComparison(const JudgedSide& truth, const JudgedSide& answer) {
    constexpr std::size_t kMaxFrames = 150;
    const auto chosen = [](const JudgedSide& side) {
      const std::size_t count = std::min(side.joints.size(), kMaxJoints);
      std::vector<int> joints;
      for (std::size_t i = 0; i < count; ++i) joints.push_back(side.joints[i * side.joints.size() / count]);
      return JointColumns(side.motion, joints, side.motion.FrameCount());
    };
    answer_ = chosen(answer);
    const PointTracks all = chosen(truth);
    stride_ = 1 + all.FrameCount() / kMaxFrames;
    for (std::size_t f = 0; f < all.FrameCount(); f += stride_) true_.push_back(DistancesAt(all.Frame(f)));
  }

  struct Difference {
    double rms_m = std::numeric_limits<double>::infinity(), count = 0;
  };

  /// Compares frame f of the truth with the answer's frame nearest to `at(f)`. The mean difference of each pair of
  /// joints is left out, because bodies differ.
  template <typename At>
  Difference Compare(const At& at) const {
    std::array<double, kMaxPairs> counts{}, sums{}, squares{};
    for (std::size_t i = 0; i < true_.size(); ++i) {
      const double frame = std::round(at(static_cast<double>(i * stride_)));
      if (frame < 0 || frame >= static_cast<double>(answer_.FrameCount())) continue;
      const auto found = DistancesAt(answer_.Frame(static_cast<std::size_t>(frame)));
      for (std::size_t pair = 0; pair < kMaxPairs; ++pair) {
        const double difference = found[pair] - true_[i][pair];
        if (std::isnan(difference)) continue;
        counts[pair] += 1;
        sums[pair] += difference;
        squares[pair] += difference * difference;
      }
    }
    double sum = 0, count = 0;
    for (std::size_t pair = 0; pair < kMaxPairs; ++pair) {
      if (counts[pair] > 0) sum += std::max(0.0, squares[pair] - sums[pair] * sums[pair] / counts[pair]);
      count += counts[pair];
    }
    if (count == 0) return {};
    return {std::sqrt(sum / count), count};
  }

 private:
  static constexpr std::size_t kMaxJoints = 8, kMaxPairs = kMaxJoints * (kMaxJoints - 1) / 2;

  static std::array<double, kMaxPairs> DistancesAt(std::span<const glm::dvec3> joints) {
    std::array<double, kMaxPairs> distances{};
    distances.fill(std::nan(""));
    std::size_t pair = 0;
    for (std::size_t a = 0; a < joints.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) distances[pair++] = glm::distance(joints[a], joints[b]);
    }
    return distances;
  }

  PointTracks answer_;
  std::size_t stride_ = 1;
  std::vector<std::array<double, kMaxPairs>> true_;
};

/// Returns the side's joints, each replaced by the joint of the body's other side that has the mirrored role.
std::vector<int> WithSidesExchanged(const JudgedSide& side) {
  std::vector<int> exchanged = side.joints;
  for (int& joint : exchanged) {
    const auto role =
        std::ranges::find_if(AllRoles(), [&](Role one) { return side.motion.roles[Index(one)] == joint; });
    if (role == AllRoles().end()) continue;
    const int other = side.motion.roles[Index(Mirrored(*role))];
    if (other >= 0) joint = other;
  }
  return exchanged;
}

/// Returns true if the answer's left and right hip are in the opposite order to the truth's hips, frame by frame.
/// `at(f)` is the answer's frame for frame f of the truth.
template <typename At>
bool AreHipsOpposed(const RawMotion& truth, const RawMotion& answer, const At& at) {
  const auto across = [](const RawMotion& motion, std::size_t frame) {
    const int left = motion.roles[Index(Role::kLeftHip)], right = motion.roles[Index(Role::kRightHip)];
    if (left < 0 || right < 0) return NotSeen();
    return motion.At(frame, static_cast<std::size_t>(left)) - motion.At(frame, static_cast<std::size_t>(right));
  };
  double sum = 0;
  for (std::size_t f = 0; f < truth.FrameCount(); ++f) {
    const double frame = std::round(at(static_cast<double>(f)));
    if (frame < 0 || frame >= static_cast<double>(answer.FrameCount())) continue;
    const double alike = glm::dot(across(truth, f), across(answer, static_cast<std::size_t>(frame)));
    if (std::isfinite(alike)) sum += alike;
  }
  return sum < 0;
}

/// Returns a doubt if the answer fits far better at other times, or with left and right exchanged, which in a walk
/// looks like a lag of half a cycle; otherwise "".
std::string DoubtOnTimes(const JudgedSide& true_side, const JudgedSide& found_side, double start_s) {
  constexpr double kBetter = 0.5, kMin_m = 0.01, kMinCompared = 0.5, kOtherLength = 0.05;
  constexpr std::size_t kMinFrames = 5;
  const RawMotion &truth = true_side.motion, &answer = found_side.motion;
  if (std::min(truth.FrameCount(), answer.FrameCount()) < kMinFrames) return "";
  const DistanceComparison comparison(true_side, found_side);
  const auto shifted = [&](double shift_s) {
    return comparison.Compare([&](double f) { return (f / truth.rate_hz + start_s + shift_s) * answer.rate_hz; });
  };
  const auto paired = shifted(0);
  if (!(paired.rms_m > kMin_m) || paired.count == 0) return "";
  // Find the best shift in whole frames of the truth. A shift at the end of the range is not believed. In a motion that
  // repeats, many shifts fit nearly as well; of these, take the best one among the neighbours of the smallest one.
  constexpr double kNearlyAsWell = 1.2;
  const int reach = static_cast<int>(std::floor(kMaxTimeShift_s * truth.rate_hz));
  std::vector<double> rms_m;
  for (int shift = -reach; shift <= reach; ++shift) {
    const auto there = shifted(shift / truth.rate_hz);
    const bool is_enough = there.count >= kMinCompared * paired.count;
    rms_m.push_back(is_enough ? there.rms_m : std::numeric_limits<double>::infinity());
  }
  const double least_m = std::ranges::min(rms_m);
  const auto at = [&](int shift) { return rms_m[static_cast<std::size_t>(reach + shift)]; };
  const auto fits = [&](int shift) { return std::abs(shift) <= reach && at(shift) <= kNearlyAsWell * least_m; };
  int best = 0, smallest = 1;
  double best_m = paired.rms_m;
  while (smallest < reach && !fits(smallest) && !fits(-smallest)) ++smallest;
  for (const int way : {-1, 1}) {
    for (int shift = way * smallest; fits(shift) && least_m < kBetter * paired.rms_m; shift += way) {
      if (at(shift) >= best_m) continue;
      best = shift;
      best_m = at(shift);
    }
  }
  const std::vector<int> joints = WithSidesExchanged(found_side);
  const auto unmoved = [&](double f) { return (f / truth.rate_hz + start_s) * answer.rate_hz; };
  const auto exchanged = DistanceComparison(true_side, {answer, joints}).Compare(unmoved);
  if (exchanged.rms_m < kBetter * paired.rms_m && AreHipsOpposed(truth, answer, unmoved)) {
    return fmt::format(
        "the answer's left and right seem to be exchanged: with the joints of the other side, distances between joints "
        "differ by {:.3g} mm instead of {:.3g}",
        kToMm * exchanged.rms_m, kToMm * paired.rms_m);
  }
  // Spread the answer over the whole truth, as if it had another rate.
  const double truth_steps = static_cast<double>(truth.FrameCount()) - 1,
               answer_steps = static_cast<double>(answer.FrameCount()) - 1,
               rate_hz = answer_steps / truth_steps * truth.rate_hz;
  if (std::abs(rate_hz / answer.rate_hz - 1) > kOtherLength) {
    const auto spread = comparison.Compare([&](double f) { return f * answer_steps / truth_steps; });
    const auto still = comparison.Compare([](double) { return 0.0; });  // how much the truth itself varies
    if (spread.rms_m < kBetter * std::min(still.rms_m, best_m)) {
      return fmt::format(
          "spread over the whole truth, the answer's frames fit far better: is its rate about {:.0f} Hz instead of "
          "{:.4g}?",
          rate_hz, answer.rate_hz);
    }
  }
  // Much that is left shows another motion, such as a mirrored or a reversed one.
  constexpr double kMaxLeft_m = 0.08;
  if (best == 0 || std::abs(best) == reach || best_m > kMaxLeft_m) return "";
  // A part without motion fits a body that stands still, so FindLag must find a shift, too. A shift below one frame of
  // the slower file may only come from taking the nearest frames.
  const auto found = FindLag(true_side, found_side, start_s);
  if (!found) return "";
  constexpr double kSame = 2, kLeast = 0.99;  // frames
  const double frame_s = 1 / std::min(truth.rate_hz, answer.rate_hz), coarse_s = best / truth.rate_hz;
  const bool is_same = std::abs(found->shift_s - coarse_s) <= kSame * frame_s;
  const double shift_s = is_same ? found->shift_s : coarse_s;
  if (std::abs(shift_s) < kLeast * frame_s) return "";
  return fmt::format(
      "the answer seems to be {:.3g} s {}: with this shift, distances between joints differ by {:.3g} mm "
      "instead of {:.3g}{}",
      std::abs(shift_s), shift_s > 0 ? "late" : "early", kToMm * best_m, kToMm * paired.rms_m,
      is_same ? " (--lag find measures and removes it)" : "");
}

}  // namespace

std::vector<std::string> DoubtsOnPair(const JudgedSide& truth, const JudgedSide& answer, const MatchedMotions& matched,
                                      double start_s) {
  const bool has_doubts = !truth.motion.doubts.empty() || !answer.motion.doubts.empty();
  std::vector<std::string> doubts{DoubtOnRoots(matched.pair), DoubtOnAxes(matched.pair, has_doubts)};
  if (doubts[0].empty() && doubts[1].empty()) doubts.push_back(DoubtOnPlace(matched.pair));
  if (std::ranges::all_of(doubts, &std::string::empty)) doubts.push_back(DoubtOnHeading(matched.pair, has_doubts));
  if (!matched.lag) doubts.push_back(DoubtOnTimes(truth, answer, start_s));
  std::erase(doubts, "");
  return doubts;
}

}  // namespace etude

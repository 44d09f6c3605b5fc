#include "bench/tasks/evaluation/time_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/metrics/time_shift.h"
#include "bench/tasks/evaluation/distance_comparison.h"
#include "bench/tasks/evaluation/judged_frames.h"

namespace etude {
namespace {

constexpr double kToMm = 1000;

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

/// Returns true if, in the truth's frames `begin` to `end` (exclusive), the answer's left and right hip are mostly in
/// the opposite order to the truth's hips. `at(f)` is the answer's frame for frame f of the truth.
template <typename At>
bool AreHipsOpposed(const RawMotion& truth, const RawMotion& answer, const At& at, std::size_t begin, std::size_t end) {
  const auto across = [](const RawMotion& motion, std::size_t frame) {
    const int left = motion.roles[Index(Role::kLeftHip)], right = motion.roles[Index(Role::kRightHip)];
    if (left < 0 || right < 0) return NotSeen();
    return motion.At(frame, static_cast<std::size_t>(left)) - motion.At(frame, static_cast<std::size_t>(right));
  };
  double sum = 0;
  for (std::size_t f = begin; f < end; ++f) {
    const double frame = std::round(at(static_cast<double>(f)));
    if (frame < 0 || frame >= static_cast<double>(answer.FrameCount())) continue;
    const double alike = glm::dot(across(truth, f), across(answer, static_cast<std::size_t>(frame)));
    if (std::isfinite(alike)) sum += alike;
  }
  return sum < 0;
}

/// The mean squared difference of some compared frames, for each shift.
class MeanSquares {
 public:
  explicit MeanSquares(std::size_t shifts) : sums_(shifts), counts_(shifts) {}

  /// Adds (`sign` 1) or removes (−1) a frame's squares, one for each shift.
  void Add(std::span<const double> squares, double sign) {
    for (std::size_t shift = 0; shift < squares.size(); ++shift) {
      if (std::isnan(squares[shift])) continue;
      sums_[shift] += sign * squares[shift];
      counts_[shift] += sign;
    }
  }

  /// Returns the mean at a shift; infinity if less than half as many frames are compared as at another shift.
  double At(std::size_t shift) const {
    const double enough = 0.5 * std::max(1.0, std::ranges::max(counts_));
    return counts_[shift] >= enough ? std::max(sums_[shift], 0.0) / counts_[shift] : kNever;
  }

  double Least() const { return At(Nearest(0)); }

  /// Returns the shift with the least mean. In a motion that repeats, many shifts fit nearly as well: of those whose
  /// means are at most `nearly` times as large, returns the local minimum nearest to `origin`.
  std::size_t Nearest(std::size_t origin, double nearly = 1) const {
    std::vector<double> means;
    for (std::size_t shift = 0; shift < sums_.size(); ++shift) means.push_back(At(shift));
    const double most = nearly * std::ranges::min(means);
    const auto away = [&](std::size_t shift) { return shift > origin ? shift - origin : origin - shift; };
    std::size_t best = origin;
    bool is_found = false;
    for (std::size_t shift = 0; shift < means.size(); ++shift) {
      if (means[shift] > most || (is_found && away(shift) >= away(best))) continue;
      best = shift;
      is_found = true;
    }
    while (best + 1 < means.size() && means[best + 1] < means[best]) ++best;
    while (best > 0 && means[best - 1] < means[best]) --best;
    return best;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  std::vector<double> sums_, counts_;
};

/// A clock of the answer that runs at another speed than the truth's, or jumps once.
struct OtherClock {
  double mean_square = std::numeric_limits<double>::infinity();
  std::size_t first = 0, last = 0;  ///< shift at the beginning and at the end
  std::size_t jump = 0;             ///< the compared frame from which on the shift is `last`; 0: it changes evenly
};

/// Returns the mean squares of the compared frames `begin` to `end` (exclusive).
MeanSquares MeanOf(const std::vector<double>& squares, std::size_t shifts, std::size_t begin, std::size_t end) {
  MeanSquares mean(shifts);
  for (std::size_t i = begin; i < end; ++i) mean.Add(std::span(squares).subspan(i * shifts, shifts), 1);
  return mean;
}

/// Finds the one jump of the shift that fits best. Each part has at least a tenth of the compared frames.
OtherClock BestJump(const std::vector<double>& squares, std::size_t shifts) {
  constexpr double kNearlyAsWell = 1.4;
  const std::size_t frames = squares.size() / shifts, margin = frames / 10 + 1;
  MeanSquares before(shifts), after = MeanOf(squares, shifts, 0, frames);
  OtherClock best;
  for (std::size_t i = 0; i + margin < frames; ++i) {
    const auto frame = std::span(squares).subspan(i * shifts, shifts);
    before.Add(frame, 1);
    after.Add(frame, -1);
    if (i + 1 < margin) continue;
    const double part = static_cast<double>(i + 1) / static_cast<double>(frames),
                 mean = part * before.Least() + (1 - part) * after.Least();
    if (mean < best.mean_square) best = {.mean_square = mean, .jump = i + 1};
  }
  if (best.jump == 0) return best;  // too little can be compared
  // Frames near the jump fit no shift if the answer lacks them.
  const std::size_t near = margin / 2;
  best.first = MeanOf(squares, shifts, 0, best.jump - near).Nearest(shifts / 2, kNearlyAsWell);
  best.last = MeanOf(squares, shifts, best.jump + near, frames).Nearest(best.first, kNearlyAsWell);
  return best;
}

/// Finds the even change of the shift, by at most `max_change`, that fits best. At least half as many frames must be
/// compared as without a shift.
OtherClock BestDrift(const std::vector<double>& squares, std::size_t shifts, double max_change) {
  const std::size_t frames = squares.size() / shifts;
  const auto along = [&](std::size_t first, std::size_t last) {
    const double change = static_cast<double>(last) - static_cast<double>(first);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < frames; ++i) {
      const double shift =
          static_cast<double>(first) + change * static_cast<double>(i) / static_cast<double>(frames - 1);
      const double square = squares[i * shifts + static_cast<std::size_t>(std::round(shift))];
      if (std::isnan(square)) continue;
      sum += square;
      count += 1;
    }
    return std::pair(sum / count, count);
  };
  OtherClock best;
  const double enough = 0.5 * along(shifts / 2, shifts / 2).second;
  for (std::size_t first = 0; first < shifts; ++first) {
    for (std::size_t last = 0; last < shifts; ++last) {
      if (std::abs(static_cast<double>(last) - static_cast<double>(first)) > max_change) continue;
      const auto [mean, count] = along(first, last);
      if (count >= enough && mean < best.mean_square) best = {mean, first, last, 0};
    }
  }
  return best;
}

}  // namespace

std::string DoubtOnClock(const JudgedSide& true_side, const JudgedSide& found_side, double start_s) {
  constexpr double kFinest_s = 1.0 / 30, kBetter = 0.5, kMin_m = 0.01, kMaxLeft_m = 0.08, kMaxRateError = 0.05;
  constexpr std::size_t kMinFrames = 30;
  const RawMotion &truth = true_side.motion, &answer = found_side.motion;
  const DistanceComparison comparison(true_side, found_side);
  const std::size_t frames = comparison.FrameCount();
  if (frames < kMinFrames) return "";
  const double step_s = std::max({kFinest_s, 1 / truth.rate_hz, 1 / answer.rate_hz});
  const double reach = std::floor(kMaxTimeShift_s / step_s);
  const std::size_t shifts = 2 * static_cast<std::size_t>(reach) + 1;
  const auto seconds = [&](std::size_t shift) { return (static_cast<double>(shift) - reach) * step_s; };
  const std::vector<double> squares = comparison.SquaresByShift(shifts, [&](double f, std::size_t shift) {
    return (f / truth.rate_hz + start_s + seconds(shift)) * answer.rate_hz;
  });
  // Compare the best clocks with the best constant shift, of which each is a more general case.
  const double constant_m = std::sqrt(MeanOf(squares, shifts, 0, frames).Least()),
               length_s = static_cast<double>(truth.FrameCount() - 1) / truth.rate_hz;
  if (!(constant_m > kMin_m)) return "";
  const OtherClock jump = BestJump(squares, shifts),
                   drift = BestDrift(squares, shifts, kMaxRateError * length_s / step_s);
  const OtherClock& best = drift.mean_square <= jump.mean_square ? drift : jump;
  const double best_m = std::sqrt(best.mean_square), first_s = seconds(best.first), last_s = seconds(best.last);
  const double least_change_s = best.jump > 0 ? step_s : 2 * step_s;
  constexpr double kSafe = 0.999;  // rounding
  if (best_m > std::min(kBetter * constant_m, kMaxLeft_m) || std::abs(last_s - first_s) < kSafe * least_change_s) {
    return "";
  }
  // Half a cycle of a walk looks like left and right exchanged.
  const auto jump_frame = static_cast<std::size_t>(comparison.FrameAt(best.jump));
  const auto at = [&](double f) {
    const double part =
        best.jump > 0 ? (f < static_cast<double>(jump_frame) ? 0 : 1) : f / static_cast<double>(truth.FrameCount() - 1);
    return (f / truth.rate_hz + start_s + first_s + part * (last_s - first_s)) * answer.rate_hz;
  };
  if (AreHipsOpposed(truth, answer, at, 0, jump_frame) ||
      AreHipsOpposed(truth, answer, at, jump_frame, truth.FrameCount())) {
    return "";
  }
  const std::string gain = fmt::format("with this, distances between joints differ by {:.3g} mm instead of {:.3g}",
                                       kToMm * best_m, kToMm * constant_m);
  const auto lag = [](double late_s) {
    return fmt::format("{:.2g} s {}", std::abs(late_s), late_s < 0 ? "early" : "late");
  };
  if (best.jump == 0) {
    return fmt::format("the answer's clock seems to drift, from {} to {}, as at {:.5g} Hz instead of {:.5g}: {}",
                       lag(first_s), lag(last_s), answer.rate_hz * (1 + (last_s - first_s) / length_s), answer.rate_hz,
                       gain);
  }
  return fmt::format("the answer's clock seems to jump by {:.2g} s about {:.3g} s after the beginning ({}): {}",
                     last_s - first_s, static_cast<double>(jump_frame) / truth.rate_hz,
                     last_s < first_s ? "are frames missing?" : "are frames there twice, or was it paused?", gain);
}

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
  if (exchanged.rms_m < kBetter * paired.rms_m && AreHipsOpposed(truth, answer, unmoved, 0, truth.FrameCount())) {
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

}  // namespace etude

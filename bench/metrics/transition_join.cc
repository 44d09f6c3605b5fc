#include "bench/metrics/transition_join.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "bench/metrics/speed_profile.h"
#include "bench/metrics/transition_smoothness.h"

namespace etude {
namespace {

constexpr double kCmPerMetre = 100;
constexpr int kLiveFrames = 10;
constexpr double kMinJudgedSpeed = 0.05;  // metres per second; clips that move more slowly are not judged
constexpr double kVelocitySeconds = 0.1;  // factor that converts velocities to distances

int LastFrame(const JoinView& view) { return static_cast<int>(view.shown.size()) - 1; }

bool HasArrived(const BodyPose& shown, const BodyPose& wanted) {
  return std::ranges::all_of(AllRoles(),
                             [&](Role role) { return glm::distance(shown[role], wanted[role]) <= kArrived; });
}

/// Returns the largest second difference of any joint at a frame, centimetres; nothing if a neighbouring frame is
/// missing.
std::optional<double> JumpCm(std::span<const BodyPose> poses, int frame) {
  if (frame < 1 || frame + 1 >= static_cast<int>(poses.size())) return std::nullopt;
  double worst = 0;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    const auto at = [&](int f) -> const glm::dvec3& { return poses[f].joints[j]; };
    worst = std::max(worst, glm::length(at(frame + 1) - 2.0 * at(frame) + at(frame - 1)));
  }
  return kCmPerMetre * worst;
}

/// Returns the larger of the two clips' own jumps at a frame of the join, centimetres.
double OwnJumpCm(const JoinView& view, int frame) {
  return std::max(JumpCm(view.left, frame).value_or(0), JumpCm(view.wanted, frame - view.last).value_or(0));
}

double MeanOf(std::span<const double> values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Returns the smallest mean of ten successive speeds; nothing if there are fewer than ten.
std::optional<double> SlowestTen(std::span<const double> speeds) {
  std::optional<double> slowest;
  for (std::size_t i = 0; i + kLiveFrames <= speeds.size(); ++i) {
    const double mean = MeanOf(speeds.subspan(i, kLiveFrames));
    slowest = std::min(slowest.value_or(mean), mean);
  }
  return slowest;
}

}  // namespace

std::optional<int> SettledFrame(const JoinView& view) {
  const int end = std::min(LastFrame(view), view.last + static_cast<int>(view.wanted.size()) - 1);
  int settled = end + 1;
  while (settled > view.last && HasArrived(view.shown[settled - 1], view.wanted[settled - 1 - view.last])) --settled;
  return settled <= end ? std::optional(settled) : std::nullopt;
}

std::optional<double> SettleSeconds(const JoinView& view) {
  const auto settled = SettledFrame(view);
  return settled ? std::optional((*settled - view.request) / view.rate_hz) : std::nullopt;
}

int JoinEnd(const JoinView& view) {
  const int settled = SettledFrame(view).value_or(LastFrame(view));
  return std::min(std::max(settled, view.last + kWindowReach), LastFrame(view));
}

double JoinSlideCmps(const JoinView& view) {
  const int second = view.last + static_cast<int>(view.rate_hz);
  return FootSlideCmps(view.shown, view.first, std::max(JoinEnd(view), second), view.rate_hz);
}

bool IsCalmlyNatural(const JoinView& view, double limit_cm) {
  constexpr double kMinLimit_cm = 1;  // lower bound: without it, a clip that stands still would forbid all motion
  constexpr double kOwnAllowance = 1.25;
  const double limit = std::max(limit_cm, kMinLimit_cm);
  const int end = JoinEnd(view);
  for (int frame = view.first; frame <= end; ++frame) {
    const auto jump = JumpCm(view.shown, frame);
    if (jump && *jump > std::max(limit, kOwnAllowance * OwnJumpCm(view, frame))) return false;
  }
  return true;
}

double Liveness(const JoinView& view) {
  const BodyMotion motion{view.rate_hz, {view.shown.begin(), view.shown.end()}};
  const int second = static_cast<int>(view.rate_hz), end = std::max(JoinEnd(view), view.first + kLiveFrames);
  const auto slowest = [&](int first, int last) { return SlowestTen(MeanJointSpeed(motion, first, last)); };
  const auto join = slowest(view.first, end);
  const auto before = slowest(view.first - second, view.first), after = slowest(end, end + second);
  if (!join || !(before || after)) return 1;
  const double clips = std::min(before.value_or(*join), after.value_or(*join));
  return clips < kMinJudgedSpeed ? 1 : std::min(1.0, *join / clips);
}

RealFrames::Row RealFrames::RowOf(const BodyPose& before, const BodyPose& now, double rate_hz) {
  // Hands and feet come first because their positions differ most between frames. For a frame that differs much, the
  // sum of squares then soon exceeds the best sum, and the summation stops.
  using enum Role;
  static constexpr std::array kOrder = {kLeftHand,       kRightHand,    kLeftFoot,      kRightFoot, kHead,
                                        kLeftElbow,      kRightElbow,   kLeftKnee,      kRightKnee, kHipCentre,
                                        kShoulderCentre, kLeftWrist,    kRightWrist,    kLeftAnkle, kRightAnkle,
                                        kSpine,          kLeftShoulder, kRightShoulder, kLeftHip,   kRightHip};
  static_assert(kOrder.size() == kRoleCount);
  // Write joint positions and scaled velocities, relative to the body's position and heading on the floor.
  const FloorMove to_origin = ToOrigin(now);
  const BodyPose places = to_origin.Apply(now), places_before = to_origin.Apply(before);
  Row row{};
  auto next = row.begin();
  for (Role role : kOrder) {
    const glm::dvec3 &place = places[role], movement = (place - places_before[role]) * (rate_hz * kVelocitySeconds);
    for (const glm::dvec3& v : {place, movement}) {
      for (int axis = 0; axis < 3; ++axis) *next++ = static_cast<float>(v[axis]);
    }
  }
  return row;
}

RealFrames::RealFrames(std::span<const BodyMotion> clips) {
  for (const BodyMotion& clip : clips) {
    for (std::size_t f = 1; f < clip.poses.size(); ++f) {
      rows_.push_back(RowOf(clip.poses[f - 1], clip.poses[f], clip.rate_hz));
    }
  }
}

double RealFrames::DistanceCm(const BodyPose& before, const BodyPose& now, double rate_hz, std::size_t& nearest) const {
  assert(!rows_.empty());
  const Row query = RowOf(before, now, rate_hz);
  constexpr std::size_t kStep = 12;
  static_assert(kNumbers % kStep == 0);
  // Returns the squared distance to a row. The summation stops once the sum reaches `enough`.
  const auto squared = [&](const Row& row, double enough) {
    double sum = 0;
    for (std::size_t i = 0; i < kNumbers && sum < enough; i += kStep) {
      for (std::size_t k = i; k < i + kStep; ++k) {
        const double off = static_cast<double>(query[k]) - static_cast<double>(row[k]);
        sum += off * off;
      }
    }
    return sum;
  };
  constexpr double kNever = 1e300;
  // Begin with a row that is probably near, because then most other sums stop early.
  nearest = std::min(nearest, rows_.size() - 1);
  double best = squared(rows_[nearest], kNever);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double here = squared(rows_[i], best);
    if (here >= best) continue;
    best = here;
    nearest = i;
  }
  return kCmPerMetre * std::sqrt(best / kRoleCount);
}

double StrangeCmSeconds(const JoinView& view, const RealFrames& real) {
  double sum = 0;
  std::size_t nearest = 0;
  const int end = JoinEnd(view);
  for (int frame = view.first + 1; frame <= end; ++frame) {
    sum += real.DistanceCm(view.shown[frame - 1], view.shown[frame], view.rate_hz, nearest);
    ++nearest;  // the next frame is probably near the next row
  }
  return sum / view.rate_hz;
}

std::vector<Support> JoinSupport(const JoinView& view) {
  constexpr double kJudgedSeconds = 1.2;
  const int judged = view.first + static_cast<int>(std::lround(kJudgedSeconds * view.rate_hz));
  std::vector<SupportingClip> clips = {{.poses = view.left, .begin = 0, .left_at = view.first},
                                       {.poses = view.wanted, .begin = view.last}};
  clips.insert(clips.end(), view.between.begin(), view.between.end());
  return FindSupport(view.shown, clips, view.first, std::min(std::max(JoinEnd(view), judged), LastFrame(view)),
                     view.rate_hz);
}

int UnsupportedFrames(std::span<const Support> support) {
  int longest = 0, run = 0;
  for (const Support& frame : support) {
    run = frame.Holds() ? 0 : run + 1;
    longest = std::max(longest, run);
  }
  return longest;
}

bool IsSupported(std::span<const Support> support) { return UnsupportedFrames(support) < kFloatingFrames; }

std::optional<double> BalanceCm(const JoinView& view, std::span<const Support> support) {
  std::vector<double> offsets;
  for (std::size_t i = 0; i < support.size(); ++i) {
    const auto offset = BalanceOffset(view.shown[view.first + i], support[i].joints);
    if (offset) offsets.push_back(kCmPerMetre * *offset);
  }
  return offsets.empty() ? std::nullopt : std::optional(MeanOf(offsets));
}

bool IsCleanByVersion3(const CleanMeasures& m) {
  constexpr double kMaxSlide_cmps = 6, kMaxSettle_s = 1.5, kMaxStrange_cm_s = 10, kMinLive = 0.5, kMaxSkipped = 1.0 / 3;
  return m.natural && m.calmly_natural && m.slide_cmps <= std::max(kMaxSlide_cmps, m.own_slide_cmps) && m.settle_s &&
         *m.settle_s <= kMaxSettle_s && m.strange_cm_s <= kMaxStrange_cm_s && m.live >= kMinLive && m.supported &&
         m.skipped_share <= kMaxSkipped;
}

}  // namespace etude

#include "engine/retargeting/exchanged_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include "engine/base/names.h"

namespace etude {
namespace {

using enum Role;

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<std::array<Role, 4>, 2> kChains = {
    {{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand}, {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}}};

/// The mean of a number over frames, and the number's standard deviation.
struct Spread {
  double count = 0, sum = 0, squares = 0;
  void Add(double value) {
    count += 1;
    sum += value;
    squares += value * value;
  }
  double Mean() const { return count > 0 ? sum / count : 0; }
  double Deviation() const { return std::sqrt(std::max(0.0, count > 0 ? squares / count - Mean() * Mean() : 0)); }
};

/// The evidence that the left and right limbs between two pairs of joints cross, because the joints of one pair are
/// exchanged.
struct Crossing {
  bool is_certain = false;
  bool may_be = false;  ///< true if exchanging one pair makes the limbs shorter in nearly all frames
};

Crossing CrossingOf(std::span<const JointPositions> frames, Role near, Role far) {
  constexpr double kShorter = 0.97, kMuchShorter = 0.8, kRatio = 2, kMoves = 0.01, kNearlyAll = 0.9;
  Spread straight, crossed;
  double shorter = 0;
  for (const JointPositions& frame : frames) {
    const auto &a = frame[Index(near)], &b = frame[Index(Mirrored(near))];
    const auto &c = frame[Index(far)], &d = frame[Index(Mirrored(far))];
    if (!a || !b || !c || !d) continue;
    const double as_it_is = glm::distance(*a, *c) + glm::distance(*b, *d);
    const double exchanged = glm::distance(*a, *d) + glm::distance(*b, *c);
    straight.Add(as_it_is);
    crossed.Add(exchanged);
    shorter += exchanged < kShorter * as_it_is ? 1 : 0;
  }
  const double length = straight.Mean(), deviation = straight.Deviation();
  const bool may_be = straight.count > 0 && shorter >= kNearlyAll * straight.count;
  const bool is_constant = crossed.Mean() < kShorter * length && deviation > kMoves * length &&
                           deviation > kRatio * crossed.Deviation();
  // In no real motion are the knees crossed in nearly all frames, or the elbows near the opposite shoulders.
  const bool is_impossible =
      (near == kLeftHip && may_be) || (near == kLeftShoulder && crossed.Mean() < kMuchShorter * length);
  return {.is_certain = is_constant || is_impossible, .may_be = may_be};
}

/// Returns true if the line of the hips points opposite to the line of the shoulders in nearly all frames.
bool IsTrunkTwisted(std::span<const JointPositions> frames) {
  constexpr double kNearlyAll = 0.9;
  double seen = 0, opposite = 0;
  for (const JointPositions& frame : frames) {
    const auto &a = frame[Index(kLeftShoulder)], &b = frame[Index(kRightShoulder)];
    const auto &c = frame[Index(kLeftHip)], &d = frame[Index(kRightHip)];
    if (!a || !b || !c || !d) continue;
    seen += 1;
    opposite += glm::dot(*a - *b, *c - *d) < 0 ? 1 : 0;
  }
  return seen > 0 && opposite >= kNearlyAll * seen;
}

}  // namespace

std::vector<Role> FindExchangedJoints(std::span<const JointPositions> frames) {
  std::vector<Role> exchanged, others;
  for (const auto& chain : kChains) {
    // If each of the first two limbs of a chain may cross, the two count as crossing.
    std::array<Crossing, 3> limbs;
    for (std::size_t i = 0; i < limbs.size(); ++i) limbs[i] = CrossingOf(frames, chain[i], chain[i + 1]);
    if (limbs[0].may_be && limbs[1].may_be) limbs[0].is_certain = limbs[1].is_certain = true;
    bool is_exchanged = chain[0] == kLeftHip && IsTrunkTwisted(frames);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (i > 0 && limbs[i - 1].is_certain) is_exchanged = !is_exchanged;
      const auto shows = [&](const JointPositions& frame) { return frame[Index(chain[i])].has_value(); };
      const bool is_seen = std::ranges::any_of(frames, shows);
      if (is_seen) (is_exchanged ? exchanged : others).push_back(chain[i]);
    }
  }
  return exchanged.size() <= others.size() ? exchanged : others;
}

std::vector<Exchange> FindExchanges(std::span<const JointPositions> frames, double rate_hz) {
  constexpr double kShorter = 0.25, kMinApart_m = 0.05, kMinRate_hz = 10;
  std::vector<Exchange> found;
  for (const auto& chain : kChains) {
    for (const Role left : chain) {
      // For each frame: the sum of the distances that the two joints move from the frame before, with their names as
      // they are (`straight`) or exchanged in this frame (`crossed`); NaN if a joint is not seen.
      std::vector<double> straight(frames.size(), kUnseen), crossed = straight;
      for (std::size_t f = 1; f < frames.size() && rate_hz >= kMinRate_hz; ++f) {
        const auto &a = frames[f - 1][Index(left)], &b = frames[f - 1][Index(Mirrored(left))];
        const auto &c = frames[f][Index(left)], &d = frames[f][Index(Mirrored(left))];
        if (!a || !b || !c || !d || glm::distance(*a, *b) < kMinApart_m) continue;
        straight[f] = glm::distance(*a, *c) + glm::distance(*b, *d);
        crossed[f] = glm::distance(*a, *d) + glm::distance(*b, *c);
      }
      const auto step = [&](std::size_t f) { return f < frames.size() ? std::min(straight[f], crossed[f]) : kUnseen; };
      for (std::size_t f = 1; f < frames.size(); ++f) {
        // fmax ignores a NaN, the value of a neighbouring frame in which a joint is not seen.
        const double usual = std::fmax(std::fmax(step(f - 1), step(f + 1)), crossed[f]);
        if (usual < kShorter * straight[f]) found.push_back({left, f});
      }
    }
  }
  return found;
}

std::string DescribeExchangedJoints(std::span<const JointPositions> frames, double rate_hz,
                                    const std::function<std::string(Role)>& name_of) {
  const auto pair_of = [&](Role left) { return name_of(left) + " – " + name_of(Mirrored(left)); };
  std::vector<std::string> said, pairs;
  for (const Role left : FindExchangedJoints(frames)) pairs.push_back(pair_of(left));
  if (!pairs.empty()) said.push_back("left and right look exchanged, because limbs cross: " + Join(pairs));
  pairs.clear();
  std::set<std::size_t> times;
  for (const auto& [left, frame] : FindExchanges(frames, rate_hz)) {
    if (pairs.empty() || pairs.back() != pair_of(left)) pairs.push_back(pair_of(left));
    times.insert(frame);
  }
  if (!times.empty()) {
    said.push_back(
        fmt::format("left and right exchange their places from one frame to the next, {} (first at {:.2f} s): {}",
                    times.size() == 1 ? "once" : fmt::format("{} times", times.size()),
                    static_cast<double>(*times.begin()) / rate_hz, Join(pairs)));
  }
  return Join(said, "; ");
}

std::string DescribeExchangedJoints(std::span<const JointPositions> frames, double rate_hz) {
  return DescribeExchangedJoints(frames, rate_hz, [](Role role) { return std::string(RoleName(role)); });
}

bool PointFeetBackwards(std::span<const BodyPose> poses) {
  constexpr double kAgainst = 0.2, kNearlyAll = 0.9;
  const auto points_back = [](const BodyPose& pose, Role knee, Role ankle, Role foot) {
    const glm::dvec3 front = glm::cross(pose[kLeftHip] - pose[kRightHip], pose[knee] - pose[ankle]);
    const glm::dvec3 toes = pose[foot] - pose[ankle];
    return glm::dot(front, toes) < -kAgainst * glm::length(front) * glm::length(toes);
  };
  const auto backwards = std::ranges::count_if(poses, [&](const BodyPose& pose) {
    return points_back(pose, kLeftKnee, kLeftAnkle, kLeftFoot) &&
           points_back(pose, kRightKnee, kRightAnkle, kRightFoot);
  });
  return static_cast<double>(backwards) >= kNearlyAll * static_cast<double>(poses.size());
}

}  // namespace etude

#include "engine/retargeting/exchanged_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/base/names.h"
#include "engine/motion/support.h"

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

constexpr double kMinExchangeApart_m = 0.05, kMinExchangeRate_hz = 10;

/// An exchange of two points, and the distances that they move if their names are exchanged.
struct Candidate {
  std::size_t frame = 0;
  double crossed = 0;
};

/// Returns the frames in which two points exchange their places; `one` and `other` return a point's position in a
/// frame, and `moves` returns true if both points move by more than a third of kMinExchangeApart_m, as each exchange
/// does.
template <typename One, typename Other, typename Moves>
std::vector<Candidate> CandidatesOf(std::size_t frames, const One& one, const Other& other, const Moves& moves) {
  constexpr double kShorter = 0.25;
  // The sums of the distances that the two points move from the frame before, with their names as they are (`straight`)
  // or exchanged in this frame (`crossed`); NaN if a point is not seen.
  struct Sums {
    double straight = kUnseen, crossed = kUnseen;
  };
  const auto sums_at = [&](std::size_t f) -> Sums {
    if (f == 0 || f >= frames) return {};
    const MarkerPosition &a = one(f - 1), &b = other(f - 1), &c = one(f), &d = other(f);
    if (!a || !b || !c || !d || glm::distance(*a, *b) < kMinExchangeApart_m) return {};
    return {glm::distance(*a, *c) + glm::distance(*b, *d), glm::distance(*a, *d) + glm::distance(*b, *c)};
  };
  const auto step = [&](std::size_t f) {
    const Sums sums = sums_at(f);
    return std::min(sums.straight, sums.crossed);
  };
  std::vector<Candidate> found;
  for (std::size_t f = 1; f < frames; ++f) {
    if (!moves(f)) continue;
    const Sums here = sums_at(f);
    if (!(here.crossed < kShorter * here.straight)) continue;
    // fmax ignores a NaN, the value of a neighbouring frame in which a joint is not seen.
    const double usual = std::fmax(std::fmax(step(f - 1), step(f + 1)), here.crossed);
    if (usual < kShorter * here.straight) found.push_back({f, here.crossed});
  }
  return found;
}

bool Moves(const MarkerPosition& before, const MarkerPosition& after) {
  return before && after && glm::distance(*before, *after) > kMinExchangeApart_m / 3;
}

/// Returns all pairs of joints, those of left and right first.
std::vector<std::pair<Role, Role>> PairsOfJoints() {
  std::vector<std::pair<Role, Role>> pairs;
  for (const auto& chain : kChains) {
    for (const Role left : chain) pairs.emplace_back(left, Mirrored(left));
  }
  for (const Role joint : AllRoles()) {
    for (const Role other : AllRoles()) {
      if (Index(joint) < Index(other) && other != Mirrored(joint)) pairs.emplace_back(joint, other);
    }
  }
  return pairs;
}

/// Finds the frames in which two points exchange their places. Unseen points do not count.
std::vector<std::size_t> FindExchangesOf(std::span<const MarkerPosition> one, std::span<const MarkerPosition> other,
                                         double rate_hz) {
  std::vector<std::size_t> found;
  if (rate_hz < kMinExchangeRate_hz) return found;
  const auto place = [](std::span<const MarkerPosition> track) {
    return [track](std::size_t f) -> const MarkerPosition& { return track[f]; };
  };
  const auto moves = [&](std::size_t f) { return Moves(one[f - 1], one[f]) && Moves(other[f - 1], other[f]); };
  for (const Candidate& candidate : CandidatesOf(std::min(one.size(), other.size()), place(one), place(other), moves)) {
    found.push_back(candidate.frame);
  }
  return found;
}

/// Returns "`what` exchange their places from one frame to the next, 2 times (first at 1.20 s): " and the pairs.
/// `times` are frames.
std::string DescribeExchanges(std::string_view what, const std::set<std::size_t>& times, double rate_hz,
                              const std::vector<std::string>& pairs) {
  return fmt::format("{} exchange positions from one frame to the next, {} (first at {:.2f} s): {}", what,
                     times.size() == 1 ? "once" : fmt::format("{} times", times.size()),
                     static_cast<double>(*times.begin()) / rate_hz, Join(pairs));
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
  if (rate_hz < kMinExchangeRate_hz) return {};
  // Mark the joints that move far enough.
  std::vector<JointSet> moved(frames.size());
  for (std::size_t f = 1; f < frames.size(); ++f) {
    for (std::size_t j = 0; j < kRoleCount; ++j) moved[f][j] = Moves(frames[f - 1][j], frames[f][j]);
  }
  // Find the candidates of each pair, and the least sum of each joint in each frame.
  std::vector<std::pair<Exchange, double>> candidates;
  std::map<std::pair<std::size_t, Role>, double> least;
  for (const auto& [joint, other] : PairsOfJoints()) {
    const std::size_t i = Index(joint), j = Index(other);
    const auto place = [&frames](std::size_t at) {
      return [&frames, at](std::size_t f) -> const MarkerPosition& { return frames[f][at]; };
    };
    for (const Candidate& one :
         CandidatesOf(frames.size(), place(i), place(j), [&](std::size_t f) { return moved[f][i] && moved[f][j]; })) {
      candidates.push_back({{joint, other, one.frame}, one.crossed});
      for (const Role role : {joint, other}) {
        const auto [at, is_new] = least.emplace(std::pair(one.frame, role), one.crossed);
        if (!is_new) at->second = std::min(at->second, one.crossed);
      }
    }
  }
  std::vector<Exchange> found;
  for (const auto& [one, crossed] : candidates) {
    if (crossed <= least[{one.frame, one.joint}] && crossed <= least[{one.frame, one.other}]) found.push_back(one);
  }
  return found;
}

std::string DescribeExchangedJoints(std::span<const JointPositions> frames, double rate_hz,
                                    const std::function<std::string(Role)>& name_of) {
  const auto pair_of = [&](Role left) { return name_of(left) + " – " + name_of(Mirrored(left)); };
  std::vector<std::string> said, pairs;
  for (const Role left : FindExchangedJoints(frames)) pairs.push_back(pair_of(left));
  if (!pairs.empty()) said.push_back("left and right are probably exchanged, because limbs cross: " + Join(pairs));
  // Describe the exchanges of left and right, and those of other joints.
  const std::vector<Exchange> exchanges = FindExchanges(frames, rate_hz);
  for (const bool is_mirrored : {true, false}) {
    pairs.clear();
    std::set<std::size_t> times;
    for (const auto& [joint, other, frame] : exchanges) {
      if ((other == Mirrored(joint)) != is_mirrored) continue;
      const std::string pair = name_of(joint) + " – " + name_of(other);
      if (std::ranges::find(pairs, pair) == pairs.end()) pairs.push_back(pair);
      times.insert(frame);
    }
    if (times.empty()) continue;
    said.push_back(DescribeExchanges(is_mirrored ? "left and right" : "joints", times, rate_hz, pairs));
  }
  return Join(said, "; ");
}

std::string DescribeExchangedJoints(std::span<const JointPositions> frames, double rate_hz) {
  return DescribeExchangedJoints(frames, rate_hz, [](Role role) { return std::string(RoleName(role)); });
}

std::string DescribeExchangedMarkers(const MarkerMotion& markers, const MarkerColumns& one,
                                     const MarkerColumns& other) {
  constexpr std::size_t kListed = 4;
  const auto track_of = [&](std::size_t column) {
    std::vector<MarkerPosition> track;
    for (const auto& frame : markers.frames) track.push_back(frame[column]);
    return track;
  };
  std::vector<std::string> pairs;
  std::set<std::size_t> times;
  for (const auto& [key, column] : one) {
    const auto same = other.find(key);
    if (same == other.end()) continue;
    const auto frames = FindExchangesOf(track_of(column), track_of(same->second), markers.rate_hz);
    if (frames.empty()) continue;
    times.insert(frames.begin(), frames.end());
    pairs.push_back(markers.names[column] + " – " + markers.names[same->second]);
  }
  if (times.empty()) return "";
  if (pairs.size() > kListed) {
    pairs.resize(kListed);
    pairs.emplace_back("…");
  }
  return DescribeExchanges("markers of two people", times, markers.rate_hz, pairs);
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

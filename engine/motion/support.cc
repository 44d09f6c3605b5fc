#include "engine/motion/support.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/motion/parabola.h"

namespace etude {

namespace {

/// Returns the velocities of all joints in one frame, as JointVelocities defines them.
BodyPose VelocityAt(std::span<const BodyPose> poses, int frame, double rate_hz) {
  const int before = std::max(frame - 1, 0), after = std::min(frame + 1, static_cast<int>(poses.size()) - 1);
  BodyPose velocity;
  if (after == before) return velocity;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    velocity.joints[j] = (poses[after].joints[j] - poses[before].joints[j]) * (rate_hz / (after - before));
  }
  return velocity;
}

double FloorSpeed(const glm::dvec3& velocity) { return std::hypot(velocity.x, velocity.z); }

/// Returns a flag for each frame: true if the centre of mass's downward acceleration is SupportRules::min_fall or more.
/// The acceleration is the second difference over a tenth of a second in each direction. A frame in the first or the
/// last tenth of a second has the flag of the nearest frame for which this difference exists.
std::vector<bool> FallingFrames(std::span<const BodyPose> poses, double rate_hz, const SupportRules& rules) {
  constexpr double kReach_s = 0.1;
  const int reach = std::max(static_cast<int>(std::lround(kReach_s * rate_hz)), 1);
  const int last = static_cast<int>(poses.size()) - 1;
  std::vector<bool> falls(poses.size());
  if (last < 2 * reach) return falls;
  std::vector<double> height;
  for (const BodyPose& pose : poses) height.push_back(MassCentre(pose).y);
  const double per_s = rate_hz / reach;
  for (int f = 0; f <= last; ++f) {
    const int middle = std::clamp(f, reach, last - reach);
    const double bend = height[middle - reach] - 2 * height[middle] + height[middle + reach];
    falls[f] = -bend * per_s * per_s >= rules.min_fall;
  }
  return falls;
}

// Finds the lowest joints of one frame and which of them are at rest.
Bearing BearingOf(const BodyPose& pose, const BodyPose& velocity, bool falls, const SupportRules& rules) {
  constexpr double kGliding = 3;
  double lowest = pose.joints[0].y;
  for (const glm::dvec3& joint : pose.joints) lowest = std::min(lowest, joint.y);
  Bearing bearing;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    if (pose.joints[j].y > lowest + rules.lowest) continue;
    bearing.rests[j] = !falls && glm::length(velocity.joints[j]) <= rules.rest_speed;
    const double over_floor = FloorSpeed(velocity.joints[j]);
    const double from_hips = FloorSpeed(velocity.joints[j] - velocity[Role::kHipCentre]);
    bearing.bears[j] = over_floor <= rules.rest_speed || over_floor <= kGliding * from_hips;
  }
  if (bearing.rests.any()) bearing.bears = bearing.rests;
  return bearing;
}

/// Returns true if the centre of mass is in free flight from frame `first` to `last`: a parabola fits its height, and
/// its downward acceleration is near gravity's.
bool FitsFlight(std::span<const BodyPose> poses, int first, int last, double rate_hz, const SupportRules& rules) {
  constexpr int kMinFrames = 5;
  if (last - first + 1 < kMinFrames) return false;
  std::vector<double> heights;
  for (int i = first; i <= last; ++i) heights.push_back(MassCentre(poses[i]).y);
  const Parabola fit = FitParabola(heights, rate_hz);
  return rules.min_fall <= fit.fall && fit.fall <= rules.max_fall && fit.stray <= rules.flight_stray;
}

/// Removes raised feet from the joints that bear a clip's body: an ankle whose heel is up while the toes bear the
/// body, and toes high above the lowest joint. (Ankle and toes may be slow enough to count as at rest.) If no other
/// joint bears the body in a frame, the frame is not changed.
void RemoveRaisedFeet(std::span<const BodyPose> poses, const SupportRules& rules, std::vector<Bearing>& bearing) {
  using enum Role;
  for (const auto& [ankle, foot] : {std::pair{kLeftAnkle, kLeftFoot}, std::pair{kRightAnkle, kRightFoot}}) {
    const auto rise = [&](std::size_t f) { return poses[f][ankle].y - poses[f][foot].y; };
    // A foot is flat in the frame in which the ankle is lowest relative to the toes, among frames in which ankle and
    // toes rest.
    double flat = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < poses.size(); ++f) {
      if (bearing[f].rests[Index(ankle)] && bearing[f].rests[Index(foot)]) flat = std::min(flat, rise(f));
    }
    for (std::size_t f = 0; f < poses.size(); ++f) {
      double lowest = poses[f].joints[0].y;
      for (const glm::dvec3& joint : poses[f].joints) lowest = std::min(lowest, joint.y);
      JointSet raised;
      raised[Index(ankle)] = bearing[f].bears[Index(foot)] && rise(f) > flat + rules.heel;
      raised[Index(foot)] = poses[f][foot].y > lowest + rules.toes;
      if ((bearing[f].bears & ~raised).none()) continue;
      bearing[f].rests &= ~raised;
      bearing[f].bears &= ~raised;
    }
  }
}

/// Returns true if the ground can have thrown the body into the air at frame `from`: in that frame and in the frame
/// before it, the acceleration of the centre of mass needs a force of at most SupportRules::max_push. Also returns true
/// if one of these accelerations is unknown, because fewer than two frames come before `from` or none comes after it.
bool IsThrown(std::span<const BodyPose> poses, int from, double rate_hz, const SupportRules& rules) {
  constexpr double kGravity = 9.81;
  if (from < 2 || from + 1 >= static_cast<int>(poses.size())) return true;
  const auto height = [&](int f) { return MassCentre(poses[f]).y; };
  return std::ranges::all_of(std::array{from - 1, from}, [&](int f) {
    const double up = (height(f + 1) - 2 * height(f) + height(f - 1)) * rate_hz * rate_hz;
    return up / kGravity + 1 <= rules.max_push;
  });
}

// Marks each run of frames without support that is a flight.
void MarkFlights(std::span<const BodyPose> shown, int first, double rate_hz, const SupportRules& rules,
                 std::vector<Support>& support) {
  const auto by_nothing = [](const Support& s) { return !s.Holds(); };
  for (auto begin = std::ranges::find_if(support, by_nothing); begin != support.end();) {
    const auto end = std::find_if_not(begin, support.end(), by_nothing);
    const int from = first + static_cast<int>(begin - support.begin()), to = from + static_cast<int>(end - begin) - 1;
    const bool takes_off_and_lands = begin != support.begin() && end != support.end();
    if (takes_off_and_lands && IsThrown(shown, from, rate_hz, rules) &&
        (FitsFlight(shown, from, to, rate_hz, rules) || FitsFlight(shown, from - 1, to + 1, rate_hz, rules))) {
      std::for_each(begin, end, [](Support& s) { s.flight = true; });
    }
    begin = std::find_if(end, support.end(), by_nothing);
  }
}

}  // namespace

std::vector<BodyPose> JointVelocities(std::span<const BodyPose> poses, double rate_hz) {
  std::vector<BodyPose> velocities;
  velocities.reserve(poses.size());
  for (int f = 0; f < static_cast<int>(poses.size()); ++f) velocities.push_back(VelocityAt(poses, f, rate_hz));
  return velocities;
}

std::vector<Bearing> FindBearing(std::span<const BodyPose> poses, double rate_hz, const SupportRules& rules) {
  const std::vector<BodyPose> velocities = JointVelocities(poses, rate_hz);
  const std::vector<bool> falls = FallingFrames(poses, rate_hz, rules);
  std::vector<Bearing> bearing;
  for (std::size_t f = 0; f < poses.size(); ++f) bearing.push_back(BearingOf(poses[f], velocities[f], falls[f], rules));
  return bearing;
}

FootContacts FindFootContacts(std::span<const BodyPose> poses, double rate_hz) {
  FootContacts contacts;
  for (const Bearing& bearing : FindBearing(poses, rate_hz, kFootRules)) {
    contacts[0].push_back(bearing.bears[Index(Role::kLeftAnkle)] || bearing.bears[Index(Role::kLeftFoot)]);
    contacts[1].push_back(bearing.bears[Index(Role::kRightAnkle)] || bearing.bears[Index(Role::kRightFoot)]);
  }
  return contacts;
}

/// Analyses a clip once; then returns the support that the clip gives in shown frames.
class SupportFinder::ClipSupport {
 public:
  ClipSupport(const SupportingClip& clip, double rate_hz, const SupportRules& rules)
      : clip_(clip),
        rules_(rules),
        window_(static_cast<int>(std::lround(rules.window_s * rate_hz))),
        velocities_(JointVelocities(clip.poses, rate_hz)),
        bearing_(FindBearing(clip.poses, rate_hz, rules)) {
    RemoveRaisedFeet(clip.poses, rules, bearing_);
    lowest_.fill(std::numeric_limits<double>::infinity());
    for (std::size_t f = 0; f < bearing_.size(); ++f) {
      ever_bear_ |= bearing_[f].bears;
      ever_rest_ |= bearing_[f].rests;
      for (std::size_t j = 0; j < kRoleCount; ++j) {
        if (bearing_[f].bears[j]) lowest_[j] = std::min(lowest_[j], clip.poses[f].joints[j].y);
      }
    }
  }

  JointSet SupportAt(int frame, const BodyPose& pose, const BodyPose& velocity) const {
    JointSet joints;
    if (clip_.poses.empty()) return joints;
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      joints[j] = ever_bear_[j] && (Follows(frame, j, pose, velocity) || RestsAsHere(frame, j, pose, velocity));
    }
    return joints;
  }

 private:
  int LastFrame() const { return static_cast<int>(clip_.poses.size()) - 1; }
  double Height(int frame, std::size_t j) const { return clip_.poses[frame].joints[j].y; }

  // Returns true if the joint moves like the same joint of the clip, and if the clip's joint bears the body in this
  // frame or a neighbouring one.
  bool Follows(int frame, std::size_t j, const BodyPose& pose, const BodyPose& velocity) const {
    const int now = frame - clip_.begin;
    for (int f = std::max(now - 1, 0); f <= std::min(now + 1, LastFrame()); ++f) {
      if (bearing_[f].bears[j] && std::abs(pose.joints[j].y - Height(f, j)) <= rules_.height &&
          glm::distance(velocity.joints[j], velocities_[f].joints[j]) <= rules_.rest_speed) {
        return true;
      }
    }
    return false;
  }

  // Returns true if the joint is at rest at a height at which the clip's joint also rests.
  bool RestsAsHere(int frame, std::size_t j, const BodyPose& pose, const BodyPose& velocity) const {
    if (glm::length(velocity.joints[j]) > rules_.rest_speed) return false;
    const double height = pose.joints[j].y;
    const std::vector<double> heights = HeightsOfRest(frame, j);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      // A joint that has sunk into the floor is also supported.
      if (i == 0 && height >= heights[i] - rules_.level && height <= heights[i] + rules_.height) return true;
      // A height is a separate surface only if it is more than `rules_.level` above the next lower height. (Toes rest a
      // little lower while the heel bears the body.)
      const bool surface = i > 0 && heights[i] - heights[i - 1] > rules_.level;
      if (surface && std::abs(height - heights[i]) <= rules_.height) return true;
    }
    return false;
  }

  /// Returns the heights, ascending, at which the clip's joint rests near frame `frame`. If the frame is before or
  /// after the clip, the clip's first or last frame is used. For a joint that never rests (walking on the spot),
  /// returns the lowest height at which the joint bears the body.
  std::vector<double> HeightsOfRest(int frame, std::size_t j) const {
    const int from = std::min(frame, clip_.left_at) - window_ - clip_.begin, to = frame + window_ - clip_.begin;
    std::vector<double> heights;
    for (int f = std::clamp(from, 0, LastFrame()); f <= std::clamp(to, 0, LastFrame()); ++f) {
      if (bearing_[f].rests[j]) heights.push_back(Height(f, j));
    }
    if (heights.empty() && !ever_rest_[j]) return {lowest_[j]};
    std::ranges::sort(heights);
    return heights;
  }

  SupportingClip clip_;
  SupportRules rules_;
  int window_ = 0;  // SupportRules::window_s in frames
  std::vector<BodyPose> velocities_;
  std::vector<Bearing> bearing_;
  JointSet ever_bear_, ever_rest_;           // a joint that rests is in both sets
  std::array<double, kRoleCount> lowest_{};  // the lowest height at which each joint bears the body
};

SupportFinder::SupportFinder(std::span<const SupportingClip> clips, double rate_hz, const SupportRules& rules)
    : rate_hz_(rate_hz), rules_(rules) {
  for (const SupportingClip& clip : clips) clip_supports_.emplace_back(clip, rate_hz, rules);
}

SupportFinder::~SupportFinder() = default;

std::vector<Support> SupportFinder::Find(std::span<const BodyPose> shown, int first, int last) const {
  assert(0 <= first && last < static_cast<int>(shown.size()));
  std::vector<Support> support;
  // A flight may continue after frame `last`: follow it until it lands.
  const auto goes_on = [&](int frame) {
    return frame <= last || (!support.back().Holds() && frame < static_cast<int>(shown.size()));
  };
  for (int frame = first; goes_on(frame); ++frame) {
    Support& here = support.emplace_back();
    const BodyPose velocity = VelocityAt(shown, frame, rate_hz_);
    for (const ClipSupport& clip_support : clip_supports_) {
      here.joints |= clip_support.SupportAt(frame, shown[frame], velocity);
    }
  }
  MarkFlights(shown, first, rate_hz_, rules_, support);
  support.resize(static_cast<std::size_t>(last - first + 1));
  return support;
}

std::vector<Support> FindSupport(std::span<const BodyPose> shown, std::span<const SupportingClip> clips, int first,
                                 int last, double rate_hz, const SupportRules& rules) {
  return SupportFinder(clips, rate_hz, rules).Find(shown, first, last);
}

glm::dvec3 MassCentre(const BodyPose& pose) {
  using enum Role;
  struct Segment {
    Role from, to;
    double mass, centre;  // share of the body's mass; position between `from` (0) and `to` (1)
  };
  static constexpr std::array kMiddle = {Segment{kShoulderCentre, kHead, 0.081, 1.0},
                                         Segment{kShoulderCentre, kHipCentre, 0.497, 0.5}};
  static constexpr std::array kLimbs = {
      Segment{kLeftShoulder, kLeftElbow, 0.028, 0.436}, Segment{kLeftElbow, kLeftWrist, 0.016, 0.430},
      Segment{kLeftWrist, kLeftHand, 0.006, 0.506},     Segment{kLeftHip, kLeftKnee, 0.100, 0.433},
      Segment{kLeftKnee, kLeftAnkle, 0.0465, 0.433},    Segment{kLeftAnkle, kLeftFoot, 0.0145, 0.500}};
  glm::dvec3 centre{0};
  const auto add = [&](Role from, Role to, const Segment& s) {
    centre += s.mass * glm::mix(pose[from], pose[to], s.centre);
  };
  for (const Segment& segment : kMiddle) add(segment.from, segment.to, segment);
  for (const Segment& segment : kLimbs) {
    add(segment.from, segment.to, segment);
    add(Mirrored(segment.from), Mirrored(segment.to), segment);
  }
  return centre;
}

std::optional<double> BalanceOffset(const BodyPose& pose, const JointSet& joints) {
  const glm::dvec3 mass = MassCentre(pose);
  return OffsetFromJoints({mass.x, mass.z}, pose, joints);
}

std::optional<double> OffsetFromJoints(const glm::dvec2& point, const BodyPose& pose, const JointSet& joints) {
  std::vector<glm::dvec2> points;  // positions on the floor relative to `point`
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    if (joints[j]) points.push_back(glm::dvec2(pose.joints[j].x, pose.joints[j].z) - point);
  }
  if (points.empty()) return std::nullopt;
  // The hull does not contain the origin if, as seen from the origin, all points lie to the left of some vertex. The
  // hull's nearest point is then on a line segment between two of the points.
  bool holds = true;
  double nearest = glm::length(points.front());
  for (const glm::dvec2& a : points) {
    const auto is_left = [&](const glm::dvec2& p) { return a.x * p.y - a.y * p.x >= 0; };
    holds = holds && !std::ranges::all_of(points, is_left);
    for (const glm::dvec2& b : points) {
      const glm::dvec2 line = b - a;
      const double squared = glm::dot(line, line);
      const double along = squared > 0 ? std::clamp(-glm::dot(a, line) / squared, 0.0, 1.0) : 0;
      nearest = std::min(nearest, glm::length(a + along * line));
    }
  }
  return holds ? 0 : nearest;
}

}  // namespace etude

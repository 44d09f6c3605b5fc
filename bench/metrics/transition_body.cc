#include "bench/metrics/transition_body.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/motion/limb_faults.h"
#include "engine/motion/parabola.h"

namespace etude {
namespace {

using enum Role;

constexpr double kToCm = 100, kGravity = 9.81;
constexpr std::array kSides = {Side::kLeft, Side::kRight};

Role OnSide(Side side, Role left) { return side == Side::kLeft ? left : Mirrored(left); }

double FloorSpeed(const glm::dvec3& velocity) { return std::hypot(velocity.x, velocity.z); }

double LowestOf(const BodyPose& pose) { return std::ranges::min(pose.joints, {}, &glm::dvec3::y).y; }

/// Returns the horizontal direction from one joint to another, radians about +Y; nothing if one is nearly above the
/// other.
std::optional<double> HeadingOf(const glm::dvec3& from, const glm::dvec3& to) {
  constexpr double kShort = 0.03;
  const double x = to.x - from.x, z = to.z - from.z;
  return std::hypot(x, z) < kShort ? std::nullopt : std::optional(std::atan2(x, z));
}

/// Returns the turn from one heading to another, radians, in [−π, π].
double Turn(double from, double to) { return std::remainder(to - from, 2 * kPi); }

/// Returns the heading of the hips: perpendicular to the line between the hips, radians about +Y.
std::optional<double> HipHeading(const BodyPose& pose) {
  const auto line = HeadingOf(pose[kRightHip], pose[kLeftHip]);
  return line ? std::optional(*line - 0.5 * kPi) : std::nullopt;
}

/// Returns the acceleration of the centre of mass in every frame, metres per second². It comes from the least-squares
/// parabola through the nine frames (0.3 s) around the frame. Near an end of the motion, a frame takes the value of the
/// nearest frame that has nine frames around it. All values are 0 if the motion is shorter than nine frames.
std::vector<glm::dvec3> MassAccelerations(std::span<const glm::dvec3> centres, double rate_hz) {
  constexpr int kReach = 4;
  const int last = static_cast<int>(centres.size()) - 1;
  std::vector<glm::dvec3> accelerations(centres.size(), glm::dvec3(0));
  for (int f = 0; f <= last && last >= 2 * kReach; ++f) {
    const int middle = std::clamp(f, kReach, last - kReach);
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, 2 * kReach + 1> places{};
      for (int i = -kReach; i <= kReach; ++i) places[i + kReach] = centres[middle + i][axis];
      accelerations[f][axis] = -FitParabola(places, rate_hz).fall;
    }
  }
  return accelerations;
}

/// Returns the largest angle by which a joint of a pose exceeds its limit, degrees; 0 if all joints are within their
/// limits. `bears` is the set of joints that support the body. A foot's direction relative to the hips is judged only
/// if the foot supports the body and the trunk is upright.
double BeyondJoints(const BodyPose& pose, const JointSet& bears) {
  constexpr double kKnee = 25, kMinElbow = 20, kMinKnee = 20, kNeck = 75, kTrunk = 75, kInward = 60, kOutward = 110;
  constexpr double kUpright = 0.7;
  const auto angle = [&](Role a, Role b, Role c) {
    return Degrees(AngleBetween(pose[a] - pose[b], pose[c] - pose[b]));
  };
  double worst = std::max(0.0, 180 - angle(kSpine, kShoulderCentre, kHead) - kNeck);
  // Measure the trunk's twist about its own axis.
  const glm::dvec3 trunk = pose[kShoulderCentre] - pose[kHipCentre], axis = UnitOr(trunk, {0, 1, 0});
  const auto across = [&](Role left) {
    const glm::dvec3 line = pose[left] - pose[Mirrored(left)];
    return line - glm::dot(line, axis) * axis;
  };
  worst = std::max(worst, Degrees(AngleBetween(across(kLeftHip), across(kLeftShoulder))) - kTrunk);
  const auto hips = HipHeading(pose);
  for (const Side side : kSides) {
    const auto on = [&](Role left) { return OnSide(side, left); };
    worst = std::max({worst, KneeOverextension(pose, side) - kKnee,
                      kMinElbow - angle(on(kLeftShoulder), on(kLeftElbow), on(kLeftWrist)),
                      kMinKnee - angle(on(kLeftHip), on(kLeftKnee), on(kLeftAnkle))});
    const bool bears_here = bears[Index(on(kLeftFoot))] || bears[Index(on(kLeftAnkle))];
    if (!bears_here || trunk.y < kUpright * glm::length(trunk)) continue;
    const auto toes = HeadingOf(pose[on(kLeftAnkle)], pose[on(kLeftFoot)]);
    if (!hips || !toes) continue;
    const double outward = Degrees(Turn(*hips, *toes)) * (side == Side::kLeft ? 1 : -1);
    worst = std::max({worst, outward - kOutward, -outward - kInward});
  }
  return worst;
}

/// Returns the largest depth by which an arm overlaps the trunk, neck or head, or one shank the other, centimetres; 0
/// if nothing overlaps.
double Overlap(const BodyPose& pose) {
  constexpr double kArm = 0.035, kLegs = 0.03;
  const double legs = SegmentDistance(pose[kLeftKnee], pose[kLeftAnkle], pose[kRightKnee], pose[kRightAnkle]);
  return kToCm *
         std::max({0.0, kArm - ArmFromSpine(pose, Side::kLeft), kArm - ArmFromSpine(pose, Side::kRight), kLegs - legs});
}

/// The measurements of one frame.
struct BodyFrame {
  bool flight = false;
  // nullopt if no joint supports the body; zmp_cm also if the ground bears less than half of the weight
  std::optional<double> zmp_cm, slip_mps2;
  double glide_cm = 0;  // travel of the slowest supporting joint or foot (MeasureBody)
  double beyond_deg = 0, overlap_cm = 0, sunk_cm = 0;
  std::array<std::optional<double>, 2> twist = {};  // heading of the hips relative to each resting foot, radians
};

/// A motion, with the centre of mass and the joint velocities of every frame.
struct Moving {
  Moving(std::span<const BodyPose> motion, double rate)
      : poses(motion), rate_hz(rate), velocities(JointVelocities(motion, rate)) {
    for (const BodyPose& pose : motion) centres.push_back(MassCentre(pose));
    accelerations = MassAccelerations(centres, rate);
  }

  std::span<const BodyPose> poses;
  double rate_hz;
  std::vector<BodyPose> velocities;
  std::vector<glm::dvec3> centres = {}, accelerations = {};
};

/// Measures a frame, apart from the values that depend on the clips: glide_cm and sunk_cm stay 0.
BodyFrame FrameOf(const Moving& moving, int f, const Support& support) {
  constexpr double kFriction = 1, kCarried = 0.5, kRest = 0.3;
  const BodyPose &pose = moving.poses[f], &velocity = moving.velocities[f];
  BodyFrame frame;
  frame.flight = support.flight;
  // From the force that the ground must exert, compute the part per mass that friction or contact cannot provide
  // (slip), and the point at which the force acts (ZMP).
  if (!support.flight && support.joints.any()) {
    const glm::dvec3 &a = moving.accelerations[f], &c = moving.centres[f];
    const double up = a.y + kGravity;
    frame.slip_mps2 = std::max(FloorSpeed(a) - kFriction * std::max(up, 0.0), 0.0) + std::max(-up, 0.0);
    double ground = c.y;
    for (const Role role : AllRoles()) {
      if (support.joints[Index(role)]) ground = std::min(ground, pose[role].y);
    }
    const double lever = (c.y - ground) / up;
    if (up >= kCarried * kGravity)
      frame.zmp_cm = kToCm * *OffsetFromJoints({c.x - lever * a.x, c.z - lever * a.z}, pose, support.joints);
  }
  frame.beyond_deg = BeyondJoints(pose, support.joints);
  frame.overlap_cm = Overlap(pose);
  // Compute the heading of the hips relative to each foot at rest.
  const auto hips = HipHeading(pose);
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const Role ankle = OnSide(kSides[i], kLeftAnkle), foot = OnSide(kSides[i], kLeftFoot);
    const bool bears = support.joints[Index(ankle)] || support.joints[Index(foot)];
    const auto toes = HeadingOf(pose[ankle], pose[foot]);
    if (!bears || !hips || !toes || glm::length(velocity[ankle]) > kRest || glm::length(velocity[foot]) > kRest)
      continue;
    frame.twist[i] = Turn(*toes, *hips);
  }
  return frame;
}

/// Returns the largest value that is sustained over `length` successive frames. Each run of this length counts with its
/// minimum; the largest of these minima is returned. Frames without a value are skipped, but a flight ends a run.
/// Returns 0 if no run is long enough, and nothing if no frame has a value.
template <class Value>
std::optional<double> Sustained(std::span<const BodyFrame> frames, std::size_t length, const Value& value) {
  std::optional<double> worst;
  std::vector<double> recent;
  for (const BodyFrame& frame : frames) {
    if (frame.flight) recent.clear();
    const std::optional<double> here = value(frame);
    if (!here) continue;
    worst = worst.value_or(0);
    recent.push_back(*here);
    if (recent.size() < length) continue;
    worst = std::max(*worst, *std::min_element(recent.end() - static_cast<std::ptrdiff_t>(length), recent.end()));
  }
  return worst;
}

/// Returns the largest sum of glide_cm over half a second, centimetres.
double FarthestGlide(std::span<const BodyFrame> frames) {
  constexpr std::size_t kFrames = 15;
  double farthest = 0, sum = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sum += frames[i].glide_cm;
    if (i >= kFrames) sum -= frames[i - kFrames].glide_cm;
    farthest = std::max(farthest, sum);
  }
  return farthest;
}

/// Returns the largest turn of the hips relative to a foot while the foot rests, degrees.
double LargestTwist(std::span<const BodyFrame> frames) {
  double largest = 0;
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    double turned = 0, least = 0, most = 0;
    std::optional<double> before;
    for (const BodyFrame& frame : frames) {
      const auto& twist = frame.twist[side];
      if (twist && before) {
        turned += Turn(*before, *twist);
        least = std::min(least, turned);
        most = std::max(most, turned);
        largest = std::max(largest, most - least);
      } else {
        turned = least = most = 0;
      }
      before = twist;
    }
  }
  return Degrees(largest);
}

/// Reduces the measurements of all frames to one value for each of kBodyRules, in the order of the rules.
BodyMeasures Reduced(std::span<const BodyFrame> frames) {
  constexpr std::size_t kZmp = 5, kSlip = 3, kJoint = 3, kOverlap = 2, kSunk = 4;
  const auto of = [](double BodyFrame::*member) {
    return [member](const BodyFrame& frame) { return std::optional(frame.*member); };
  };
  return {Sustained(frames, kZmp, [](const BodyFrame& frame) { return frame.zmp_cm; }),
          Sustained(frames, kSlip, [](const BodyFrame& frame) { return frame.slip_mps2; }),
          FarthestGlide(frames),
          LargestTwist(frames),
          Sustained(frames, kJoint, of(&BodyFrame::beyond_deg)),
          Sustained(frames, kOverlap, of(&BodyFrame::overlap_cm)),
          Sustained(frames, kSunk, of(&BodyFrame::sunk_cm))};
}

/// Measures one of the joined clips by itself, at the time of the join.
class BesideClip {
 public:
  /// `begin` is the frame of the shown motion that corresponds to poses[0]. Measures the clip from frame `first` to
  /// frame `last` of the shown motion, and one second more on either side.
  BesideClip(std::span<const BodyPose> poses, int begin, int first, int last, double rate_hz) {
    // Include one more second on either side, because the support in a frame also depends on the frames around it.
    constexpr int kAround = 30;
    const int from = std::clamp(first - begin - kAround, 0, static_cast<int>(poses.size()) - 1);
    const int to = std::clamp(last - begin + kAround, from, static_cast<int>(poses.size()) - 1);
    poses_ = poses.subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from + 1));
    begin_ = begin + from;
    const std::array itself = {SupportingClip{.poses = poses_}};
    const Moving moving(poses_, rate_hz);
    const std::vector<Support> support = FindSupport(poses_, itself, 0, to - from, rate_hz);
    for (int f = 0; f <= to - from; ++f) {
      frames_.push_back(FrameOf(moving, f, support[f]));
      bears_.push_back(support[f].joints);
    }
  }

  /// Returns the measurements of the clip within `reach` frames of a shown frame. Beyond the clip's ends, its first or
  /// last frame is used.
  std::span<const BodyFrame> Around(int frame, int reach) const {
    const auto [from, to] = Indices(frame, reach);
    return std::span(frames_).subspan(from, to - from + 1);
  }

  /// Returns the height of the clip's lowest joint in the frames within a third of a second of a shown frame, metres.
  double Floor(int frame) const {
    constexpr int kWindow = 10;
    const auto [from, to] = Indices(frame, kWindow);
    double floor = LowestOf(poses_[from]);
    for (std::size_t f = from; f <= to; ++f) floor = std::min(floor, LowestOf(poses_[f]));
    return floor;
  }

  std::span<const BodyPose> poses() const { return poses_; }
  /// Returns the index in poses() that belongs to frame `frame` of the shown motion. Returns nullopt if this index lies
  /// outside poses(), or if the clip's body is supported there, but not by this joint.
  std::optional<int> BearsAt(int frame, std::size_t joint) const {
    const int now = frame - begin_;
    if (now < 0 || now >= static_cast<int>(poses_.size())) return std::nullopt;
    return bears_[now][joint] || bears_[now].none() ? std::optional(now) : std::nullopt;
  }

 private:
  std::pair<std::size_t, std::size_t> Indices(int frame, int reach) const {
    const int last = static_cast<int>(poses_.size()) - 1, now = frame - begin_;
    return {static_cast<std::size_t>(std::clamp(now - reach, 0, last)),
            static_cast<std::size_t>(std::clamp(now + reach, 0, last))};
  }

  std::span<const BodyPose> poses_;
  int begin_ = 0;
  std::vector<BodyFrame> frames_;
  std::vector<JointSet> bears_;
};

/// Returns the horizontal distance that a joint moves from the previous frame or to the next, whichever is shorter,
/// centimetres. A joint that has just come to rest or is about to leave therefore counts as at rest. If a clip is
/// given, the movement of the clip's joint at its frame `clip_frame` is subtracted first. Returns nothing if neither
/// neighbour frame exists.
std::optional<double> TravelOf(std::span<const BodyPose> poses, int frame, std::size_t joint,
                               std::span<const BodyPose> clip = {}, int clip_frame = 0) {
  std::optional<double> slowest;
  for (const int step : {-1, 1}) {
    const auto way = [&](std::span<const BodyPose> all, int from) -> std::optional<glm::dvec3> {
      const int to = from + step;
      if (to < 0 || to >= static_cast<int>(all.size())) return std::nullopt;
      return all[to].joints[joint] - all[from].joints[joint];
    };
    auto own = way(poses, frame);
    if (!own) continue;
    if (!clip.empty()) {
      const auto beside = way(clip, clip_frame);
      if (!beside) continue;
      *own -= *beside;
    }
    const double here = FloorSpeed(*own) * kToCm;
    slowest = std::min(slowest.value_or(here), here);
  }
  return slowest;
}

/// Returns the smallest `speed(joint)` over the joints of a set; 0 for an empty set.
template <class Speed>
double SlowestOf(const JointSet& joints, const Speed& speed) {
  std::optional<double> slowest;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    if (!joints[j]) continue;
    const double here = speed(j);
    slowest = std::min(slowest.value_or(here), here);
  }
  return slowest.value_or(0);
}

/// Sets zmp_cm, slip_mps2, beyond_deg and overlap_cm of a frame to 0, each if it is at most 1.25 times the largest
/// value that the clips themselves reach within three frames of this frame.
void Excuse(std::span<const BesideClip> clips, int shown_frame, BodyFrame& frame) {
  constexpr int kReach = 3;
  constexpr double kAllowance = 1.25;
  BodyFrame own;
  for (const BesideClip& clip : clips) {
    for (const BodyFrame& at : clip.Around(shown_frame, kReach)) {
      own.zmp_cm = std::max(own.zmp_cm, at.zmp_cm);
      own.slip_mps2 = std::max(own.slip_mps2, at.slip_mps2);
      own.beyond_deg = std::max(own.beyond_deg, at.beyond_deg);
      own.overlap_cm = std::max(own.overlap_cm, at.overlap_cm);
    }
  }
  if (frame.zmp_cm && *frame.zmp_cm <= kAllowance * own.zmp_cm.value_or(0)) frame.zmp_cm = 0;
  if (frame.slip_mps2 && *frame.slip_mps2 <= kAllowance * own.slip_mps2.value_or(0)) frame.slip_mps2 = 0;
  if (frame.beyond_deg <= kAllowance * own.beyond_deg) frame.beyond_deg = 0;
  if (frame.overlap_cm <= kAllowance * own.overlap_cm) frame.overlap_cm = 0;
}

}  // namespace

BodyMeasures MeasureBody(const JoinView& view, std::span<const Support> support) {
  const int end = view.first + static_cast<int>(support.size()) - 1;
  // Measure each clip by itself.
  std::vector<BesideClip> clips;
  const auto add = [&](std::span<const BodyPose> poses, int begin) {
    if (!poses.empty()) clips.emplace_back(poses, begin, view.first, end, view.rate_hz);
  };
  add(view.left, 0);
  add(view.wanted, view.last);
  for (const SupportingClip& clip : view.between) add(clip.poses, clip.begin);
  // Measure each frame of the join.
  JointSet feet;
  for (const Side side : kSides) feet.set(Index(OnSide(side, kLeftAnkle))).set(Index(OnSide(side, kLeftFoot)));
  // A velocity depends on one frame on either side, an acceleration on four. At an end of the motion, an acceleration
  // depends on the nine frames at this end.
  constexpr int kReach = 8;
  const int from = std::max(view.first - kReach, 0);
  const Moving moving(view.shown.subspan(from, std::min<std::size_t>(end + kReach + 1, view.shown.size()) - from),
                      view.rate_hz);
  std::vector<BodyFrame> frames;
  for (int f = view.first; f <= end; ++f) {
    const Support& held = support[f - view.first];
    BodyFrame frame = FrameOf(moving, f - from, held);
    Excuse(clips, f, frame);
    // Glide is the distance moved by the slowest supporting joint. If no joint supports the body, it is the distance
    // moved by the slowest joint of the feet; in flight, it is 0. If the joint also supports the body in a clip, or
    // if no joint supports the body in the clip, the joint's movement relative to the clip counts instead if it is
    // shorter.
    if (!held.flight) {
      frame.glide_cm = SlowestOf(held.joints.any() ? held.joints : feet, [&](std::size_t j) {
        double slowest = TravelOf(view.shown, f, j).value_or(0);
        for (const BesideClip& clip : clips) {
          const auto at = clip.BearsAt(f, j);
          if (at) slowest = std::min(slowest, TravelOf(view.shown, f, j, clip.poses(), *at).value_or(slowest));
        }
        return slowest;
      });
    }
    // Measure how far the body is below the lowest joint of the clips.
    double floor = clips.front().Floor(f);
    for (const BesideClip& clip : clips) floor = std::min(floor, clip.Floor(f));
    frame.sunk_cm = kToCm * std::max(floor - LowestOf(view.shown[f]), 0.0);
    frames.push_back(frame);
  }
  BodyMeasures measures = Reduced(frames);
  // A turn counts as 0 if it is at most 1.25 times the turn in a clip.
  constexpr std::size_t kTurn = 3;
  constexpr double kAllowance = 1.25;
  for (const BesideClip& clip : clips) {
    const double own = LargestTwist(clip.Around((view.first + end) / 2, (end - view.first + 1) / 2));
    if (*measures[kTurn] <= kAllowance * own) measures[kTurn] = 0;
  }
  return measures;
}

bool IsPossible(const BodyMeasures& measures) {
  constexpr double kRounding = 1e-9;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    if (measures[i] && *measures[i] > kBodyRules[i].limit + kRounding) return false;
  }
  return true;
}

}  // namespace etude

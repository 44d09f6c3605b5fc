#include "engine/retargeting/to_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/base/angles.h"
#include "engine/base/names.h"
#include "engine/formats/bvh.h"
#include "engine/motion/sample.h"

namespace etude {
namespace {

using enum Role;

struct Unit {
  std::string_view name;
  double metres;
};

// Neighbours differ by more than 2.1 m / 1.3 m, so at most one fits.
constexpr double kSmallestStature = 1.3;
constexpr double kLargestStature = 2.1;
constexpr std::array<Unit, 6> kUnits = {{
    {"metre", 1.0},
    {"foot", 0.3048},
    {"CMU", 0.0254 / 0.45},  // mocap.cs.cmu.edu: inches times 0.45
    {"inch", 0.0254},
    {"centimetre", 0.01},
    {"millimetre", 0.001},
}};
constexpr double kDefaultStature = 1.70;

constexpr double kLongestSeconds = 3600;
constexpr double kSmallestBody = 1e-6;  // in any unit: nothing to scale up

/// Evaluates single frames of one clip.
class Poser {
 public:
  Poser(const Clip& clip, const JointMap& map) : clip_(clip), map_(map) {}

  BodyPose At(double seconds) { return Pose(SampleClip(clip_, seconds)); }
  BodyPose Frame(std::size_t index) { return Pose(clip_.frames[index]); }

 private:
  BodyPose Pose(const LocalPose& local) {
    ComputeGlobals(clip_.skeleton, local, globals_);
    return Evaluate(map_, globals_);
  }

  const Clip& clip_;
  const JointMap& map_;
  std::vector<GlobalTransform> globals_;
};

double WorstGap(const BodyPose& a, const BodyPose& b) {
  double worst = 0;
  for (Role role : AllRoles()) worst = std::max(worst, glm::distance(a[role], b[role]));
  return worst;
}

/// A T-pose that the motion does not begin with, but jumps away from: by far more than its next step,
/// and by more than a hand's width.
bool BeginsWithForeignTPose(const Clip& clip, Poser& poser) {
  if (clip.frames.size() < 2) return false;
  const BodyPose first = poser.Frame(0);
  const BodyPose second = poser.Frame(1);
  constexpr double kJumpPerStature = 0.05;
  constexpr double kJumpPerNextStep = 5;
  const double jump = WorstGap(first, second);
  const double next_step = clip.frames.size() > 2 ? WorstGap(second, poser.Frame(2)) : 0;
  return IsTPose(first) && jump > kJumpPerStature * Stature(first) && jump > kJumpPerNextStep * next_step;
}

/// The value below which `part` of all values lie.
double Percentile(std::vector<double> values, double part) {
  const auto rank = static_cast<std::size_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

template <typename Measure>
std::vector<double> OverFrames(const std::vector<BodyPose>& poses, Measure measure) {
  std::vector<double> values;
  values.reserve(poses.size());
  for (const BodyPose& pose : poses) values.push_back(measure(pose));
  return values;
}

double LowestFootPoint(const BodyPose& pose) {
  return std::min({pose[kLeftFoot].y, pose[kRightFoot].y, pose[kLeftAnkle].y, pose[kRightAnkle].y});
}

/// Files may be Z-up or mirrored; both would give wrong motions that look almost right.
Result<void> CheckAxes(const std::vector<BodyPose>& poses, const std::string& file) {
  glm::dvec3 up(0);
  double toes_forward = 0;
  for (const BodyPose& pose : poses) {
    const glm::dvec3 body = pose[kHead] - 0.5 * (pose[kLeftAnkle] + pose[kRightAnkle]);
    up += body / std::max(glm::length(body), kSmallestBody);
    const glm::dvec3 toes = (pose[kLeftFoot] - pose[kLeftAnkle]) + (pose[kRightFoot] - pose[kRightAnkle]);
    toes_forward += glm::dot(Facing(pose), toes);
  }
  up /= static_cast<double>(poses.size());
  constexpr double kStanding = 0.9;
  constexpr double kLying = 0.3;
  if (std::abs(up.z) > kStanding && std::abs(up.y) < kLying) {
    return Fail({file}, "the body stands along Z; only files with Y up are read");
  }
  if (toes_forward < 0) {
    return Fail({file}, "the feet point backwards: left and right are swapped, or the axes are left-handed");
  }
  return {};
}

std::optional<Unit> FindUnit(double stature) {
  for (const Unit& unit : kUnits) {
    const double metres = stature * unit.metres;
    if (metres >= kSmallestStature && metres <= kLargestStature) return unit;
  }
  return std::nullopt;
}

std::string Note(double metres_per_unit, const std::optional<Unit>& unit, const BodyConversion& done,
                 const JointMap& map) {
  std::string note = fmt::format("1 unit = {:.4g} cm", 100 * metres_per_unit);
  note += unit ? fmt::format(" ({})", unit->name)
               : fmt::format(" (unknown unit, scaled to a stature of {:.2f} m)", kDefaultStature);
  if (done.dropped_t_pose) note += "; dropped a leading T-pose";
  if (!map.composed.empty()) {
    std::vector<std::string> names;
    for (Role role : map.composed) names.emplace_back(RoleName(role));
    note += "; not in the file, composed: " + Join(names);
  }
  return note;
}

}  // namespace

double Stature(const BodyPose& pose) {
  const auto way = [&](std::initializer_list<Role> roles) {
    double length = 0;
    for (auto role = roles.begin(); role + 1 != roles.end(); ++role) {
      length += glm::distance(pose[*role], pose[*(role + 1)]);
    }
    return length;
  };
  // Below the ankles and above the head's joint: 4 to 12 % of the stature in the files at hand.
  constexpr double kMeasuredShare = 0.92;
  const double left_leg = way({kLeftAnkle, kLeftKnee, kLeftHip});
  const double right_leg = way({kRightAnkle, kRightKnee, kRightHip});
  const double trunk_and_head = way({kHipCentre, kSpine, kShoulderCentre, kHead});
  return (0.5 * (left_leg + right_leg) + trunk_and_head) / kMeasuredShare;
}

bool IsTPose(const BodyPose& pose) {
  const glm::dvec3 up(0, 1, 0);
  const glm::dvec3 left = glm::cross(up, Facing(pose));
  const double tolerance = Radians(30);
  const auto points = [&](Role from, Role to, const glm::dvec3& direction) {
    return AngleBetween(pose[to] - pose[from], direction) < tolerance;
  };
  return points(kLeftShoulder, kLeftElbow, left) && points(kLeftElbow, kLeftWrist, left) &&
         points(kRightShoulder, kRightElbow, -left) && points(kRightElbow, kRightWrist, -left) &&
         points(kLeftHip, kLeftKnee, -up) && points(kLeftKnee, kLeftAnkle, -up) && points(kRightHip, kRightKnee, -up) &&
         points(kRightKnee, kRightAnkle, -up) && points(kHipCentre, kShoulderCentre, up);
}

Result<BodyConversion> ToBodyMotion(const Clip& clip, const JointMap& map, const std::string& file,
                                    const BodyOptions& options) {
  if (clip.frames.empty()) return Fail({file}, "no frames; at least one is needed");
  Poser poser(clip, map);
  const double rate_hz = options.rate_hz;
  BodyConversion done;
  done.motion.rate_hz = rate_hz;
  done.dropped_t_pose = BeginsWithForeignTPose(clip, poser);

  const std::size_t first = done.dropped_t_pose ? 1 : 0;
  const double start = static_cast<double>(first) / clip.rate_hz;
  const double seconds = static_cast<double>(clip.frames.size() - 1 - first) / clip.rate_hz;
  if (seconds > kLongestSeconds) {
    return Fail({file}, "the clip lasts {:.0f} s; allowed: {:.0f} s", seconds, kLongestSeconds);
  }
  constexpr double kRounding = 1e-6;  // of a frame: keeps the last one when the rates divide evenly
  const auto count = static_cast<std::size_t>(seconds * rate_hz + kRounding) + 1;
  std::vector<BodyPose>& poses = done.motion.poses;
  poses.reserve(count);
  for (std::size_t i = 0; i < count; ++i) poses.push_back(poser.At(start + static_cast<double>(i) / rate_hz));

  if (auto ok = CheckAxes(poses, file); !ok) return tl::unexpected(ok.error());
  const double stature = Percentile(OverFrames(poses, Stature), 0.5);
  if (stature < kSmallestBody) return Fail({file}, "the body's joints all lie in one point; it needs a size");
  const std::optional<Unit> unit = FindUnit(stature);
  done.metres_per_unit = unit ? unit->metres : kDefaultStature / stature;
  // Not the very lowest: a single frame in which a marker was lost must not lift the whole clip.
  constexpr double kLow = 0.05;
  const double floor = Percentile(OverFrames(poses, LowestFootPoint), kLow);
  for (BodyPose& pose : poses) {
    for (glm::dvec3& joint : pose.joints) joint = (joint - glm::dvec3(0, floor, 0)) * done.metres_per_unit;
  }
  done.note = Note(done.metres_per_unit, unit, done, map);
  return done;
}

Result<BodyConversion> ReadBodyMotion(std::string_view bytes, const std::string& file) {
  auto clip = ReadBvh(bytes, file);
  if (!clip) return tl::unexpected(clip.error());
  auto map = FindJointMap(clip->skeleton, file);
  if (!map) return tl::unexpected(map.error());
  return ToBodyMotion(*clip, *map, file);
}

}  // namespace etude

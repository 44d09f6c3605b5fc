#include <etude/motion.h>

#include <algorithm>
#include <cmath>

#include "engine/api/convert.h"
#include "engine/formats/amass.h"
#include "engine/formats/bvh.h"
#include "engine/formats/c3d.h"
#include "engine/formats/npz.h"
#include "engine/formats/trc.h"
#include "engine/fuzzy/features.h"
#include "engine/motion/clip.h"
#include "engine/motion/edit.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/markers.h"
#include "engine/retargeting/rig.h"
#include "engine/retargeting/to_body.h"

namespace etude::engine {
namespace {

constexpr double kMinRateHz = 1, kMaxRateHz = 1000;

void CheckRate(double rate_hz) {
  if (rate_hz >= kMinRateHz && rate_hz <= kMaxRateHz) return;
  throw BadInput(fmt::format("a rate of {} Hz; allowed: {} to {}", rate_hz, kMinRateHz, kMaxRateHz));
}

/// Resamples a body's motion by turning its joints, so that limbs keep their lengths.
BodyMotion Resampled(const BodyMotion& motion, double rate_hz) {
  const Clip clip = Resample(RigClip(motion, motion.poses.front(), ""), rate_hz);
  std::array<int, kRoleCount> joints;
  for (const etude::Role role : AllRoles())
    joints[Index(role)] = clip.skeleton.Find(std::string(etude::RoleName(role)));
  BodyMotion resampled{.rate_hz = rate_hz, .poses = {}};
  std::vector<GlobalTransform> globals;
  for (const LocalPose& frame : clip.frames) {
    ComputeGlobals(clip.skeleton, frame, globals);
    BodyPose& pose = resampled.poses.emplace_back();
    for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = globals[joints[i]].position;
  }
  return resampled;
}

Motion MotionOfMarkers(const MarkerMotion& markers, const std::string& file, double rate_hz, char up = 0) {
  const std::vector<MarkerBody> bodies = OrThrow(FindMarkerBodies(markers, file, up));
  if (bodies.size() == 1) return FromBodyMotion(Resampled(bodies.front().motion, rate_hz));
  throw BadInput(fmt::format("{}: markers of {} people; allowed: of one", file, bodies.size()));
}

Motion MotionOfClip(const Clip& clip, const std::string& file, double rate_hz) {
  const JointMap map = OrThrow(FindJointMap(clip.skeleton, file));
  BodyOptions options;
  options.rate_hz = rate_hz;
  return FromBodyMotion(OrThrow(etude::ToBodyMotion(clip, map, file, options)).motion);
}

}  // namespace

std::string_view Version() { return ETUDE_VERSION; }

std::string_view RoleName(Role role) {
  const auto place = static_cast<std::size_t>(role);
  if (place >= kRoleCount) throw BadInput("no role");
  return etude::RoleName(AllRoles()[place]);
}

Motion FromBodyMotion(const BodyMotion& motion) {
  Motion made{.rate_hz = motion.rate_hz, .poses = {}};
  made.poses.reserve(motion.poses.size());
  for (const BodyPose& pose : motion.poses) made.poses.push_back({pose.joints});
  return made;
}

BodyMotion ToBodyMotion(const Motion& motion) {
  CheckRate(motion.rate_hz);
  BodyMotion made{.rate_hz = motion.rate_hz, .poses = {}};
  made.poses.reserve(motion.poses.size());
  for (const Pose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) {
      if (std::isfinite(joint.x + joint.y + joint.z)) continue;
      throw BadInput(fmt::format("frame {}: a joint's place is not finite", made.poses.size()));
    }
    made.poses.push_back({pose.joints});
  }
  return made;
}

std::vector<BodyMotion> ToBodyMotions(std::span<const Motion> clips) {
  if (clips.empty()) throw BadInput("no clips");
  std::vector<BodyMotion> motions;
  for (const Motion& clip : clips) {
    const auto number = motions.size();
    if (clip.poses.empty()) throw BadInput(fmt::format("clip {}: no frames", number));
    if (clip.rate_hz != clips.front().rate_hz) {
      throw BadInput(
          fmt::format("clip {}: {} Hz; allowed: that of clip 0, {} Hz", number, clip.rate_hz, clips.front().rate_hz));
    }
    motions.push_back(ToBodyMotion(clip));
  }
  return motions;
}

double StandingHipsOf(const BodyPose& first) {
  const double hips = StandingHipHeight(first);
  if (hips > 0) return hips;
  throw BadInput("frame 0: a body without legs");
}

void CheckBudget(double budget_s) {
  constexpr double kMaxWait_s = 3600;
  if (budget_s >= 0 && budget_s <= kMaxWait_s) return;
  throw BadInput(fmt::format("a budget of {} s; allowed: 0 to {}", budget_s, kMaxWait_s));
}

Motion ReadMotion(std::string_view bytes, const std::string& file, double rate_hz) {
  CheckRate(rate_hz);
  if (IsZip(bytes)) return MotionOfClip(OrThrow(ReadAmass(OrThrow(ReadNpz(bytes, file)), file)), file, rate_hz);
  if (IsC3d(bytes)) {
    const C3d c3d = OrThrow(ReadC3d(bytes, file));
    return MotionOfMarkers(c3d.markers, file, rate_hz, c3d.up);
  }
  if (bytes.starts_with("PathFileType")) return MotionOfMarkers(OrThrow(ReadTrc(bytes, file)), file, rate_hz);
  return MotionOfClip(OrThrow(ReadBvh(bytes, file)), file, rate_hz);
}

}  // namespace etude::engine

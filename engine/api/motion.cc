#include <etude/motion.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/api/convert.h"
#include "engine/base/names.h"
#include "engine/formats/amass.h"
#include "engine/formats/bvh.h"
#include "engine/formats/c3d.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/motive_csv.h"
#include "engine/formats/npz.h"
#include "engine/formats/trc.h"
#include "engine/fuzzy/features.h"
#include "engine/motion/clip.h"
#include "engine/motion/edit.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/marker_sets.h"
#include "engine/retargeting/markers.h"
#include "engine/retargeting/rig.h"
#include "engine/retargeting/to_body.h"
#include "engine/retargeting/up_axis.h"

namespace etude::engine {
namespace {

constexpr double kMinRateHz = 1, kMaxRateHz = 1000;

void CheckRate(double rate_hz) {
  if (rate_hz >= kMinRateHz && rate_hz <= kMaxRateHz) return;
  throw BadInput(fmt::format("a rate of {} Hz; allowed: {} to {}", rate_hz, kMinRateHz, kMaxRateHz));
}

/// Returns true if two rates differ by rounding only: a rate that was computed from a column of times is rounded.
bool KeepsRate(double a_hz, double b_hz) { return std::abs(a_hz / b_hz - 1) < 1e-6; }

/// Resamples a body's motion by rotating its joints, so that limbs keep their lengths.
BodyMotion Resampled(const BodyMotion& motion, double rate_hz) {
  if (KeepsRate(motion.rate_hz, rate_hz)) return {.rate_hz = rate_hz, .poses = motion.poses};
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

std::optional<UpAxis> UpOf(const ReadingOptions& options) {
  if (options.up == 0) return std::nullopt;
  if (options.up != 'y' && options.up != 'z') throw BadInput(fmt::format("up: '{}'; allowed: y, z", options.up));
  return options.up == 'z' ? UpAxis::kZ : UpAxis::kY;
}

std::optional<double> UnitOf(const ReadingOptions& options) {
  if (options.metres_per_unit == 0) return std::nullopt;
  constexpr double kMin_m = 1e-6, kMax_m = 1e3;
  if (options.metres_per_unit >= kMin_m && options.metres_per_unit <= kMax_m) return options.metres_per_unit;
  throw BadInput(fmt::format("metres_per_unit: {}; allowed: {:g} to {:g}", options.metres_per_unit, kMin_m, kMax_m));
}

Motion MotionOfMarkers(const MarkerMotion& markers, const std::string& file, double rate_hz, UpRule rule,
                       const ReadingOptions& options) {
  if (const auto up = UpOf(options)) rule = {.axis = AxisOf(*up), .evidence = UpEvidence::kTold, .source = "told"};
  if (!options.marker_set.empty() && std::ranges::count(MarkerSetKeys(), options.marker_set) == 0) {
    throw BadInput(UnknownName("marker set", options.marker_set, MarkerSetKeys()));
  }
  const std::vector<MarkerBody> bodies = OrThrow(FindMarkerBodies(
      markers, file,
      {.up = rule, .keep_floor = options.keep_floor, .metres_per_unit = UnitOf(options), .set = options.marker_set}));
  if (bodies.size() != 1)
    throw BadInput(fmt::format("{}: markers of {} people; allowed: markers of one person", file, bodies.size()));
  const MarkerBody& body = bodies.front();
  Motion motion = FromBodyMotion(Resampled(body.motion, rate_hz));
  motion.changes = body.changes;
  if (!KeepsRate(body.motion.rate_hz, rate_hz)) {
    motion.changes.push_back(fmt::format("resampled from {:.6g} to {:.6g} Hz", body.motion.rate_hz, rate_hz));
  }
  return motion;
}

Motion MotionOfClip(const Clip& clip, const std::string& file, double rate_hz, std::optional<UpRule> rule,
                    const ReadingOptions& options, const std::vector<std::string>& remarks = {}) {
  const JointMap map = OrThrow(FindJointMap(clip.skeleton, file, nullptr, clip.frames));
  const BodyConversion body = OrThrow(etude::ToBodyMotion(clip, map, file,
                                                          {.rate_hz = rate_hz,
                                                           .metres_per_unit = UnitOf(options),
                                                           .up = UpOf(options),
                                                           .up_rule = std::move(rule),
                                                           .keep_floor = options.keep_floor}));
  Motion motion = FromBodyMotion(body.motion);
  motion.changes = body.changes;
  motion.changes.insert(motion.changes.end(), remarks.begin(), remarks.end());
  return motion;
}

/// Reads Etude's own arrays, which are used as they are.
Motion MotionOfArrays(const Npz& arrays, const std::string& file, double rate_hz, const ReadingOptions& options) {
  if (!IsBodyNpz(arrays)) return MotionOfClip(OrThrow(ReadAmass(arrays, file)), file, rate_hz, AmassUp(), options);
  const RawMotion raw = OrThrow(ReadRawNpz(arrays, file));
  std::optional<BodyMotion> read = BodyOf(raw);
  if (!read) return MotionOfMarkers(etude::MarkersOf(raw), file, rate_hz, {.evidence = UpEvidence::kFormat}, options);
  BodyMotion& body = *read;
  const UpFinding up{.axis = AxisOf(UpOf(options).value_or(UpAxis::kY)), .evidence = UpEvidence::kTold};
  for (BodyPose& pose : body.poses) {
    for (glm::dvec3& joint : pose.joints) joint = TurnedUp(joint, up.axis);
  }
  Motion motion = FromBodyMotion(Resampled(body, rate_hz));
  motion.changes = {"Etude's own arrays"};
  if (const std::string turn = DescribeTurn(up); !turn.empty()) motion.changes.push_back(turn);
  if (!KeepsRate(body.rate_hz, rate_hz)) {
    motion.changes.push_back(fmt::format("resampled from {:.6g} to {:.6g} Hz", body.rate_hz, rate_hz));
  }
  return motion;
}

MarkerMotion MarkersOf(const JointCsv& csv) {
  MarkerMotion markers{.rate_hz = csv.rate_hz.value_or(kJudgedRateHz), .names = {}, .frames = {}};
  for (const etude::Role role : AllRoles()) markers.names.emplace_back(etude::RoleName(role));
  for (const auto& frame : csv.frames) markers.frames.emplace_back(frame.begin(), frame.end());
  return markers;
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
      throw BadInput(fmt::format("frame {}: a joint's position is not finite", made.poses.size()));
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
      throw BadInput(fmt::format("clip {}: {} Hz; allowed: the rate of clip 0, {} Hz", number, clip.rate_hz,
                                 clips.front().rate_hz));
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

Motion ReadMotion(std::string_view bytes, const std::string& file, double rate_hz, const ReadingOptions& options) {
  CheckRate(rate_hz);
  if (IsZip(bytes)) return MotionOfArrays(OrThrow(ReadNpz(bytes, file)), file, rate_hz, options);
  if (IsC3d(bytes)) {
    const C3d c3d = OrThrow(ReadC3d(bytes, file));
    return MotionOfMarkers(c3d.markers, file, rate_hz, C3dUp(c3d.up, c3d.is_up_negative), options);
  }
  if (bytes.starts_with("PathFileType")) {
    return MotionOfMarkers(OrThrow(ReadTrc(bytes, file)), file, rate_hz, TrcUp(), options);
  }
  if (IsMotiveCsv(bytes)) {
    return MotionOfMarkers(OrThrow(ReadMotiveCsv(bytes, file)), file, rate_hz, MotiveUp(), options);
  }
  if (bytes.substr(0, bytes.find('\n')).find("_x_m") != std::string_view::npos) {
    return MotionOfMarkers(MarkersOf(OrThrow(ReadJointCsv(bytes, file))), file, rate_hz, JointCsvUp(), options);
  }
  std::vector<std::string> remarks;
  const Clip clip = OrThrow(ReadBvh(bytes, file, &remarks));
  return MotionOfClip(clip, file, rate_hz, std::nullopt, options, remarks);
}

}  // namespace etude::engine

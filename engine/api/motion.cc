#include <etude/motion.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/api/checks.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/formats/amass.h"
#include "engine/formats/bvh.h"
#include "engine/formats/c3d.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/motive_csv.h"
#include "engine/formats/npz.h"
#include "engine/formats/point_table.h"
#include "engine/formats/row_clock.h"
#include "engine/formats/trc.h"
#include "engine/fuzzy/features.h"
#include "engine/motion/clip.h"
#include "engine/motion/edit.h"
#include "engine/retargeting/array_evidence.h"
#include "engine/retargeting/body_choice.h"
#include "engine/retargeting/exchanged_sides.h"
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
  throw BadInput(fmt::format("the rate is {} Hz; allowed: {} to {} Hz", rate_hz, kMinRateHz, kMaxRateHz));
}

/// Returns true if two rates differ by rounding only: a rate that was computed from a column of times is rounded.
bool KeepsRate(double a_hz, double b_hz) { return std::abs(a_hz / b_hz - 1) < 1e-6; }

/// Resamples a body's motion by interpolating the rotations of its joints, so that limbs keep their lengths.
BodyMotion Resampled(const BodyMotion& motion, double rate_hz) {
  if (KeepsRate(motion.rate_hz, rate_hz)) return {.rate_hz = rate_hz, .poses = motion.poses};
  const Clip clip = Resample(RigClip(motion, motion.poses.front(), ""), rate_hz);
  std::array<int, kRoleCount> joints;
  for (const Role role : AllRoles()) joints[Index(role)] = clip.skeleton.Find(std::string(RoleName(role)));
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
  throw BadInput(fmt::format("metres_per_unit is {}; allowed: {:g} to {:g}", options.metres_per_unit, kMin_m, kMax_m));
}

/// A motion, and sentences for users about findings and changes.
struct ReadBody {
  BodyMotion motion;
  std::vector<std::string> changes;
};

ReadBody ResampledBody(const BodyMotion& motion, std::vector<std::string> changes, double rate_hz) {
  for (std::string said : {DescribeResampling(motion.rate_hz, rate_hz), DescribeImpossibleHeight(motion.poses),
                           DescribeSlowRate(motion.rate_hz)}) {
    if (!said.empty()) changes.push_back(std::move(said));
  }
  return {Resampled(motion, rate_hz), std::move(changes)};
}

ReadBody BodyOfMarkers(const MarkerMotion& markers, const std::string& file, double rate_hz, UpRule rule,
                       const ReadingOptions& options, std::string layout = "") {
  if (const auto up = UpOf(options)) rule = {.axis = AxisOf(*up), .evidence = UpEvidence::kTold, .source = "told"};
  if (!options.marker_set.empty() && std::ranges::count(MarkerSetKeys(), options.marker_set) == 0) {
    throw BadInput(UnknownName("marker set", options.marker_set, MarkerSetKeys()));
  }
  const std::vector<MarkerBody> bodies = OrThrow(FindMarkerBodies(markers, file,
                                                                  {.up = rule,
                                                                   .keep_floor = options.keep_floor,
                                                                   .metres_per_unit = UnitOf(options),
                                                                   .set = options.marker_set,
                                                                   .layout = std::move(layout)}));
  if (bodies.size() != 1)
    throw BadInput(fmt::format("{}: found markers of {} people; allowed: markers of one person", file, bodies.size()));
  return ResampledBody(bodies.front().motion, bodies.front().changes, rate_hz);
}

ReadBody BodyOfClip(const Clip& clip, const std::string& file, double rate_hz, std::optional<UpRule> rule,
                    const ReadingOptions& options, const std::vector<std::string>& remarks = {}) {
  const BodyChoice chosen = OrThrow(ChooseBody(clip, file));
  BodyConversion body = OrThrow(ToBodyMotion(clip, chosen.map, file,
                                             {.rate_hz = rate_hz,
                                              .metres_per_unit = UnitOf(options),
                                              .up = UpOf(options),
                                              .up_rule = std::move(rule),
                                              .keep_floor = options.keep_floor}));
  body.changes.insert(body.changes.end(), remarks.begin(), remarks.end());
  body.Doubt(chosen.doubt);
  return {std::move(body.motion), std::move(body.changes)};
}

ReadBody BodyOfArrays(const Npz& arrays, const std::string& file, double rate_hz, const ReadingOptions& options) {
  if (!IsBodyNpz(arrays)) return BodyOfClip(OrThrow(ReadAmass(arrays, file)), file, rate_hz, AmassUp(), options);
  const RawMotion raw = OrThrow(ReadRawNpz(arrays, file, {.metres_per_unit = UnitOf(options), .up = UpOf(options)}));
  ReadBody read;
  if (const auto body = BodyOf(raw)) {
    read = ResampledBody(*body, {"Etude's own arrays"}, rate_hz);
    const std::string crossing = DescribeExchangedJoints(RolesIn(raw), raw.rate_hz);
    if (!crossing.empty()) read.changes.push_back(crossing);
  } else {
    ReadingOptions others = options;  // `raw` already has the user's unit and axis
    others.metres_per_unit = 0;
    others.up = 0;
    others.keep_floor = true;
    read = BodyOfMarkers(MarkersOf(raw), file, rate_hz, RawArraysUp(), others);
  }
  read.changes.insert(read.changes.end(), raw.notes.begin(), raw.notes.end());
  return read;
}

ReadBody BodyOfBytes(std::string_view bytes, const std::string& file, double rate_hz, const ReadingOptions& options) {
  bytes = WithoutByteOrderMark(bytes);
  if (IsZip(bytes)) return BodyOfArrays(OrThrow(ReadNpz(bytes, file)), file, rate_hz, options);
  const std::string_view heading = FirstLine(bytes);
  if (heading.starts_with("PathFileType")) {  // before C3D, whose first two bytes may be a line end and a P
    return BodyOfMarkers(OrThrow(ReadTrc(bytes, file)), file, rate_hz, TrcUp(), options);
  }
  if (IsC3d(bytes)) {
    const C3d c3d = OrThrow(ReadC3d(bytes, file));
    return BodyOfMarkers(c3d.markers, file, rate_hz, C3dUp(c3d.up, c3d.is_up_negative), options);
  }
  if (IsMotiveCsv(bytes)) {
    return BodyOfMarkers(OrThrow(ReadMotiveCsv(bytes, file)), file, rate_hz, MotiveUp(), options);
  }
  if (!IsJointCsv(heading) && IsPointTable(bytes)) {
    PointTable table = OrThrow(ReadPointTable(bytes, file));
    MarkerMotion markers = OrThrow(LayOnClock(std::move(table.rows), file));
    if (!table.has_unit) ScaleToPerson(markers);
    return BodyOfMarkers(markers, file, rate_hz, TableUp(), options, "table");
  }
  if (IsJointCsv(heading)) {
    const MarkerMotion markers = OrThrow(LayOnClock(OrThrow(ReadJointCsv(bytes, file)), file));
    return BodyOfMarkers(markers, file, rate_hz, JointCsvUp(), options);
  }
  std::vector<std::string> remarks;
  const Clip clip = OrThrow(ReadBvh(bytes, file, &remarks));
  return BodyOfClip(clip, file, rate_hz, std::nullopt, options, remarks);
}

}  // namespace

std::string_view Version() { return ETUDE_VERSION; }

const BodyMotion& Checked(const BodyMotion& motion) {
  CheckRate(motion.rate_hz);
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    for (const glm::dvec3& joint : motion.poses[frame].joints) {
      if (std::isfinite(joint.x + joint.y + joint.z)) continue;
      throw BadInput(fmt::format("frame {}: a joint's position is not finite", frame));
    }
  }
  return motion;
}

void CheckClips(std::span<const BodyMotion> clips) {
  if (clips.empty()) throw BadInput("no clips");
  for (std::size_t i = 0; i < clips.size(); ++i) {
    if (clips[i].poses.empty()) throw BadInput(fmt::format("clip {}: no frames", i));
    if (clips[i].rate_hz != clips.front().rate_hz) {
      throw BadInput(fmt::format("the rate of clip {} is {} Hz; allowed: {} Hz, as in clip 0", i, clips[i].rate_hz,
                                 clips.front().rate_hz));
    }
    Checked(clips[i]);
  }
}

double StandingHipsOf(const BodyPose& first) {
  const double hips = StandingHipHeight(first);
  if (hips > 0) return hips;
  throw BadInput("frame 0: a body without legs");
}

void CheckBudget(double budget_s) {
  constexpr double kMaxWait_s = 3600;
  if (budget_s >= 0 && budget_s <= kMaxWait_s) return;
  throw BadInput(fmt::format("the waiting time budget_s is {} s; allowed: 0 to {} s", budget_s, kMaxWait_s));
}

BodyMotion ReadMotion(std::string_view bytes, const std::string& file, double rate_hz, const ReadingOptions& options,
                      std::vector<std::string>* changes) {
  CheckRate(rate_hz);
  ReadBody body = BodyOfBytes(bytes, file, rate_hz, options);
  if (changes != nullptr) *changes = std::move(body.changes);
  return std::move(body.motion);
}

}  // namespace etude::engine

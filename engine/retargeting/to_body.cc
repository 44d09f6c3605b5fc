#include "engine/retargeting/to_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/motion/statistics.h"
#include "engine/retargeting/body_sampler.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/orientation.h"
#include "engine/retargeting/root_travel.h"

namespace etude {
namespace {

using enum Role;

constexpr double kMinStature = 1.45;
constexpr double kMaxStature = 2.1;
constexpr double kMinSensedStature = 1.2;  // for millimetres: depth sensors write them, and measure the head too low

struct Unit {
  std::string_view name;
  double metres;
  double min_stature = kMinStature;
};

// The ratio of two neighbouring units exceeds 2.1 m / 1.45 m, so at most one unit fits.
constexpr std::array<Unit, 6> kUnits = {{
    {"metre", 1.0},
    {"foot", 0.3048},
    {"CMU", 0.0254 / 0.45},  // mocap.cs.cmu.edu: an inch divided by 0.45
    {"inch", 0.0254},
    {"centimetre", 0.01},
    {"millimetre", 0.001, kMinSensedStature},
}};
constexpr double kDefaultStature = 1.70;

constexpr double kMaxSeconds = 3600;
constexpr double kMaxPoses = 500'000;
constexpr double kMinToldFloor_cm = 0.1;  // smaller heights are rounding errors
constexpr double kMinBody = 1e-6;  // in the file's unit; a smaller body counts as one without size

/// Returns true for a skeleton that Etude wrote: its joints have the names of roles (ends in a BVH have no names), and
/// it stands along Y at rest. Such files have Y up.
bool IsOwnSkeleton(const Skeleton& skeleton, const BodyPose& rest) {
  constexpr double kStanding = 0.9;
  constexpr std::array kEnds = {kHead, kLeftHand, kRightHand, kLeftFoot, kRightFoot};
  return BodyAxis(rest).y > kStanding && std::ranges::all_of(AllRoles(), [&](Role role) {
           return std::ranges::count(kEnds, role) > 0 || skeleton.Find(std::string(RoleName(role))) >= 0;
         });
}

/// Returns the up axis that the user gives, otherwise the format's, otherwise the axis that FindUp finds.
UpFinding UpOf(const BodyOptions& options, const Skeleton& skeleton, const BodyPose& rest, const UpSamples& samples) {
  if (options.up) return {.axis = AxisOf(*options.up), .evidence = UpEvidence::kTold};
  if (options.found_up) return *options.found_up;
  if (options.up_rule) return FindUp(samples.poses, samples.rate_hz, *options.up_rule);
  if (IsOwnSkeleton(skeleton, rest)) return FindUp(samples.poses, samples.rate_hz, OwnJointsUp());
  return FindUp(rest, samples.poses, samples.rate_hz);
}

UpAxis AsUpAxis(const UpFinding& up) { return up.axis.z > 0 ? UpAxis::kZ : UpAxis::kY; }

/// Replaces the joints' scales in every frame by the scales in the rest pose.
void ResetScales(Clip& clip) {
  for (LocalPose& frame : clip.frames) {
    for (std::size_t i = 0; i < frame.size(); ++i) frame[i].scale = clip.skeleton.joints[i].rest.scale;
  }
}

double WorstGap(const BodyPose& a, const BodyPose& b) {
  double worst = 0;
  for (Role role : AllRoles()) worst = std::max(worst, glm::distance(a[role], b[role]));
  return worst;
}

/// Returns the length, in frames, of a constant T-pose at the start that does not belong to the motion: the motion's
/// first step away from the T-pose exceeds 5 % of the stature and is much larger than the second step. Returns 0
/// without such a T-pose.
std::size_t CountForeignTPose(const Clip& clip, BodySampler& sampler, UpAxis up) {
  constexpr double kStillPerStature = 1e-4;
  constexpr double kJumpPerStature = 0.05;
  constexpr double kJumpPerNextStep = 5;
  const auto pose_at = [&](std::size_t frame) { return Upright(sampler.At(static_cast<double>(frame)), up); };
  const std::size_t count = clip.frames.size();
  const BodyPose first = pose_at(0);
  if (!IsTPose(first)) return 0;
  // Find the end of the constant pose, then compare the jump with the step after it.
  std::size_t next = 1;
  while (next < count && WorstGap(first, pose_at(next)) < kStillPerStature * Stature(first)) ++next;
  if (next == count) return 0;
  const BodyPose second = pose_at(next);
  const double jump = WorstGap(first, second);
  const double next_step = next + 1 < count ? WorstGap(second, pose_at(next + 1)) : 0;
  return jump > kJumpPerStature * Stature(first) && jump > kJumpPerNextStep * next_step ? next : 0;
}

template <typename Measure>
std::vector<double> OverFrames(std::span<const BodyPose> poses, Measure measure) {
  std::vector<double> values;
  values.reserve(poses.size());
  for (const BodyPose& pose : poses) values.push_back(measure(pose));
  return values;
}

bool IsFinite(const BodyPose& pose) {
  return std::ranges::all_of(pose.joints,
                             [](const glm::dvec3& joint) { return std::isfinite(glm::dot(joint, joint)); });
}

/// Resamples the clip from frame `first` to its end, and rotates it upright.
Result<std::vector<BodyPose>> Resampled(const Clip& clip, BodySampler& sampler, std::size_t first, double rate_hz,
                                        UpAxis up, const std::string& file) {
  const auto frames = static_cast<double>(clip.frames.size() - 1 - first);
  const double seconds = frames / clip.rate_hz;
  if (seconds > kMaxSeconds) {
    return Fail({file}, "the clip lasts {:.0f} s; allowed: at most {:.0f} s{}", seconds, kMaxSeconds,
                clip.rate_hz < 1
                    ? fmt::format("; frames are {:.3g} s apart: are the times in milliseconds?", 1 / clip.rate_hz)
                    : "");
  }
  if (seconds * rate_hz > kMaxPoses) {
    return Fail({file}, "{:.0f} s at {:g} Hz are too many poses; allowed: at most {:.0f} poses", seconds, rate_hz,
                kMaxPoses);
  }
  constexpr double kRounding = 1e-6;  // share of a frame; keeps the last frame if the rates divide evenly
  const auto count = static_cast<std::size_t>(seconds * rate_hz + kRounding) + 1;
  std::vector<BodyPose> poses;
  poses.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double frame = std::min(static_cast<double>(i) * clip.rate_hz / rate_hz, frames);
    poses.push_back(Upright(sampler.At(static_cast<double>(first) + frame), up));
    if (!IsFinite(poses.back())) {
      return Fail({file}, "in frame {:.0f} joints are too far away from the origin",
                  static_cast<double>(first) + frame);
    }
  }
  return poses;
}

/// Returns the unit in which `stature` is a human's, or null if there is no such unit.
const Unit* UnitOf(double stature) {
  const auto is_human = [&](const Unit& unit) {
    return stature * unit.metres >= unit.min_stature && stature * unit.metres <= kMaxStature;
  };
  const auto* const found = std::ranges::find_if(kUnits, is_human);
  return found == kUnits.end() ? nullptr : found;
}

constexpr double kMaxRatio = 1.25;
bool AreAlike(double ratio) { return ratio > 1 / kMaxRatio && ratio < kMaxRatio; }

/// Uses metres, the stated unit of a file, if no unit fits the stature, but a child or a giant is possible. Adds a
/// remark if the stature contradicts the stated unit.
void UseMetres(double stature, BodyConversion& done, std::vector<std::string>& remarks) {
  constexpr double kMinStated = 0.4, kMaxStated = 3;
  if (done.metres_per_unit == 1) return;
  if (done.unit == "unknown" && stature >= kMinStated && stature <= kMaxStated) {
    done.unit = "metre";
    done.metres_per_unit = 1;
    return;
  }
  // Some FBX files state centimetres, although their numbers are metres; other programs then write such a small body.
  constexpr double kPerCentimetre = 100;
  if (done.unit == "unknown" && kPerCentimetre * stature >= kMinStated && kPerCentimetre * stature <= kMaxStated) {
    done.unit = "metre, divided by 100";
    done.metres_per_unit = kPerCentimetre;
  }
  remarks.push_back(fmt::format(
      "Etude does not use the unit that the file or the file format states, because the body would be {:.3g} m tall",
      stature));
}

/// Finds the unit by the stature of the rest pose, which all clips of a file share. If the stature in the frames
/// differs from it by a factor of more than kMaxRatio, uses the stature in the frames, because some files store the
/// offsets of the joints, and others the scale of the hips, only in the frames. `remarks` gets texts about doubtful
/// statures. If the given unit is implausible, fails, naming `file` and the likely unit.
Result<void> FindUnit(const BodyPose& rest, const std::vector<BodyPose>& poses, const BodyOptions& options,
                      const std::string& file, BodyConversion& done, std::vector<std::string>& remarks) {
  const std::optional<double>& given = options.metres_per_unit;
  const double at_rest = Stature(rest), own = MedianStature(poses), moving = options.stature.value_or(own);
  // Compare the stature in the frames with the stature in the rest pose and the stature in the file's other clips, and
  // compare the frames with each other.
  const double ratio = moving / at_rest;
  const bool is_alike = AreAlike(ratio);
  if (!AreAlike(own / moving)) {
    remarks.push_back(
        fmt::format("in this clip, the body is {:.3g} times as tall as in the median frame of the file", own / moving));
  }
  const std::vector<double> statures = OverFrames(poses, Stature);
  const double least = LowerPercentile(statures, 0.05), most = LowerPercentile(statures, 0.95);
  if (!AreAlike(most / least))
    remarks.push_back(fmt::format("the size of the body changes between frames by a factor of {:.2g}", most / least));
  const double stature = is_alike ? at_rest : moving;
  if (stature < kMinBody)
    return Fail({file}, "all joints of the body are at the same position; allowed: joints at different positions");
  const Unit* const unit = UnitOf(stature);
  // A given unit must be plausible.
  if (given) {
    constexpr double kMinGiven = 0.4, kMaxGiven = 4;
    const double told = stature * *given;
    const std::string likely = unit == nullptr
                                   ? ""
                                   : fmt::format("; with 1 unit = {:.4g} cm ({}), the body would be {:.2f} m tall",
                                                 100 * unit->metres, unit->name, stature * unit->metres);
    if (told < kMinGiven || told > kMaxGiven) {
      return Fail({file},
                  "with the given unit (1 unit = {:.4g} cm), the body is {:.3g} m tall; allowed: {:g} to {:g} m{}",
                  100 * *given, told, kMinGiven, kMaxGiven, likely);
    }
    if ((told < kMinStature || told > kMaxStature) && unit != nullptr) {
      remarks.push_back(fmt::format("with the given unit, the body is {:.2f} m tall{}", told, likely));
    }
    done.unit = "given";
    done.metres_per_unit = *given;
    return {};
  }
  // Otherwise take the unit that gives a human stature, or scale to the default.
  done.unit = unit == nullptr ? "unknown" : unit->name;
  done.metres_per_unit = unit == nullptr ? kDefaultStature / stature : unit->metres;
  const bool is_scaled = at_rest >= kMinBody && !is_alike && unit == nullptr && UnitOf(at_rest) != nullptr;
  if (options.states_metres && !is_scaled) UseMetres(stature, done, remarks);
  constexpr double kSame = 0.05;
  // Only a rest pose with a size can be compared with the frames.
  if (at_rest < kMinBody || std::abs(ratio - 1) <= kSame) return {};
  remarks.push_back(fmt::format("in the frames, the body is {:.3g} times as tall as in the rest pose", ratio));
  if (!is_scaled) return {};
  const Unit* const of_rest = UnitOf(at_rest);
  done.unit = "scaled";
  done.metres_per_unit = of_rest->metres / ratio;
  remarks.back() += fmt::format("; Etude scaled the body to the height of the rest pose, {:.2f} m ({})",
                                at_rest * of_rest->metres, of_rest->name);
  return {};
}

double FindFloor(const std::vector<BodyPose>& poses) {
  // Take a percentile, not the minimum: a single frame with a lost marker must not raise the whole clip.
  constexpr double kLow = 0.05;
  return LowerPercentile(OverFrames(poses, LowestHeight), kLow);
}

double LeftLegLength(const BodyPose& pose) {
  return glm::distance(pose[kLeftHip], pose[kLeftKnee]) + glm::distance(pose[kLeftKnee], pose[kLeftAnkle]);
}

/// Returns the height `told` if it differs from FindFloor's height by less than a leg's length, otherwise FindFloor's
/// height.
double FloorOf(const std::vector<BodyPose>& poses, const std::optional<double>& told) {
  const double own = FindFloor(poses);
  return told && std::abs(own - *told) <= LeftLegLength(poses.front()) ? *told : own;
}

/// Converts to metres, with the floor at 0.
void PlaceOnFloor(std::vector<BodyPose>& poses, const BodyConversion& done) {
  for (BodyPose& pose : poses) {
    for (glm::dvec3& joint : pose.joints) joint = (joint - glm::dvec3(0, done.floor, 0)) * done.metres_per_unit;
  }
}

/// Returns the axis of the file, other than +Y, along which the mean body axis lies; "" if there is none.
std::string LiesAlong(std::span<const BodyPose> poses) {
  constexpr double kLying = 0.9;
  const glm::dvec3 axis = MeanBodyAxis(poses);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(axis[i]) > kLying && !(i == 1 && axis[i] > 0)) return std::string(axis[i] < 0 ? "−" : "") + "XYZ"[i];
  }
  return "";
}

/// Lists the findings and changes as texts for users.
std::vector<std::string> ChangesOf(const BodyConversion& done, const JointMap& map, const Clip& clip,
                                   const std::string& lies) {
  // Describe unit, axis and frames.
  std::vector<std::string> changes = {
      fmt::format("1 unit = {:.4g} cm", 100 * done.metres_per_unit) +
      (done.unit == "unknown"
           ? fmt::format(" (unknown unit; Etude scaled the body to a height of {:.2f} m)", kDefaultStature)
           : fmt::format(" ({})", done.unit))};
  if (std::string turn = DescribeTurn(done.found_up); !turn.empty()) changes.push_back(std::move(turn));
  if (!lies.empty()) changes.push_back(lies);
  if (!done.found_up.doubt.empty() && lies.empty()) changes.push_back(done.found_up.doubt);
  if (done.dropped_frames > 0) {
    changes.push_back("dropped a leading T-pose" +
                      (done.dropped_frames > 1 ? fmt::format(" of {} frames", done.dropped_frames) : ""));
  }
  if (std::string said = DescribeResampling(clip.rate_hz, done.motion.rate_hz); !said.empty()) {
    changes.push_back(std::move(said));
  }
  // Describe floor and joints.
  const double floor_cm = 100 * done.floor * done.metres_per_unit;
  if (std::abs(floor_cm) >= kMinToldFloor_cm) {
    changes.push_back(fmt::format("Etude moved the floor from {:.4g} cm to 0", floor_cm));
  }
  const auto names_of = [](const std::vector<Role>& roles) {
    std::vector<std::string> names;
    for (const Role role : roles) names.emplace_back(RoleName(role));
    return Join(names);
  };
  if (!map.composed.empty())
    changes.push_back("joints that are not in the file, so Etude constructed them: " + names_of(map.composed));
  if (!map.by_anatomy.empty()) {
    changes.push_back(fmt::format("roles found by the skeleton's shape instead of by names (confidence {:.2f}): {}",
                                  map.confidence, names_of(map.by_anatomy)));
  }
  return changes;
}

}  // namespace

double MedianStature(std::span<const BodyPose> poses) { return LowerPercentile(OverFrames(poses, Stature), 0.5); }

glm::dmat4 WorldFromFile(const BodyConversion& body) {
  const auto turned = [&](const glm::dvec3& axis) { return glm::dvec4(Upright(axis, body.up), 0); };
  const glm::dmat4 upright(turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), glm::dvec4(0, 0, 0, 1));
  const glm::dmat4 on_floor = glm::translate(glm::dmat4(1), glm::dvec3(0, -body.floor, 0));
  return glm::scale(glm::dmat4(1), glm::dvec3(body.metres_per_unit)) * on_floor * upright;
}

std::optional<Ground> FindGround(std::span<const Clip> clips, const JointMap& map, const BodyOptions& options) {
  std::vector<BodyPose> poses;
  UpSamples samples;
  BodyPose rest;
  for (const Clip& clip : clips) {
    BodySampler sampler(clip, map);
    rest = sampler.Rest();
    for (std::size_t f = 0; f < clip.frames.size(); ++f) poses.push_back(sampler.At(static_cast<double>(f)));
    UpSamples own = SamplesForUp(clip, sampler);
    samples.rate_hz = own.rate_hz;
    std::ranges::move(own.poses, std::back_inserter(samples.poses));
  }
  if (poses.empty() || !std::ranges::all_of(poses, IsFinite)) return std::nullopt;
  Ground ground{.found_up = UpOf(options, clips.front().skeleton, rest, samples)};
  ground.up = AsUpAxis(ground.found_up);
  for (BodyPose& pose : poses) pose = Upright(pose, ground.up);
  ground.floor = options.floor.value_or(FindFloor(poses));
  ground.stature = options.stature.value_or(MedianStature(poses));
  return ground;
}

std::optional<double> UndoScales(std::span<Clip> clips, const JointMap& map) {
  std::vector<double> shown, unscaled;
  double at_rest = 0;
  for (const Clip& clip : clips) {
    BodySampler sampler(clip, map);
    at_rest = Stature(sampler.Rest());
    // Compare the stature in sampled frames with and without the frames' scales.
    Clip still{.name = "", .skeleton = clip.skeleton, .rate_hz = clip.rate_hz, .frames = {}};
    for (const BodyPose& pose : SampledPoses(clip, sampler)) shown.push_back(Stature(pose));
    for (std::size_t i = 0; i < clip.frames.size(); i += SampleStep(clip)) still.frames.push_back(clip.frames[i]);
    ResetScales(still);
    BodySampler without(still, map);
    for (std::size_t i = 0; i < still.frames.size(); ++i) {
      unscaled.push_back(Stature(without.At(static_cast<double>(i))));
    }
  }
  if (shown.empty() || UnitOf(at_rest) == nullptr) return std::nullopt;
  const double ratio = LowerPercentile(std::move(shown), 0.5) / at_rest;
  if (AreAlike(ratio) || !AreAlike(LowerPercentile(std::move(unscaled), 0.5) / at_rest)) return std::nullopt;
  for (Clip& clip : clips) ResetScales(clip);
  return ratio;
}

std::string DescribeResampling(double from_hz, double to_hz) {
  const std::string from = fmt::format("{:.6g}", from_hz), to = fmt::format("{:.6g}", to_hz);
  return from == to ? "" : fmt::format("resampled from {} to {} Hz", from, to);
}

std::string DescribeSlowRate(double rate_hz) {
  constexpr double kSlow_hz = 7.5;
  if (rate_hz > kSlow_hz) return "";
  return fmt::format(
      "at {:.3g} Hz, the frames are too far apart for fast motion: speeds, accelerations and foot contacts between the "
      "frames are not known",
      rate_hz);
}

std::string DescribeImpossibleHeight(std::span<const BodyPose> poses) {
  // From a newborn to more than the tallest man on record. Below kMaxInfant_m, a child's legs, from hips to ankles, are
  // at most 0.41 of its stature; an adult's are about half.
  constexpr double kLeast_m = 0.5, kMost_m = 2.75, kMaxInfant_m = 0.85, kMaxInfantLegs = 0.46;
  if (poses.empty()) return "";
  const double stature = MedianStature(poses);
  if (stature < kLeast_m || stature > kMost_m) {
    return fmt::format("the body is {:.3g} m tall, which is not a person's height; is the file's unit right?", stature);
  }
  const double legs = LowerPercentile(OverFrames(poses, LeftLegLength), 0.5);
  if (stature > kMaxInfant_m || legs < kMaxInfantLegs * stature) return "";
  return fmt::format(
      "the body is {:.3g} m tall, but the legs have an adult's proportion of the height; is the file's unit right?",
      stature);
}

std::string DescribeLikelyUnit(double stature, double metres_per_unit) {
  const Unit* const unit = UnitOf(stature / metres_per_unit);
  if (unit == nullptr || std::abs(unit->metres / metres_per_unit - 1) < 1e-6) return "";
  return fmt::format("Etude uses 1 unit = {:.4g} cm; with 1 unit = {:.4g} cm ({}), the body would be {:.2f} m tall",
                     100 * metres_per_unit, 100 * unit->metres, unit->name, stature / metres_per_unit * unit->metres);
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
  // Determine the up axis. If Y is up but the body lies along another axis, `lies` states this axis for users.
  if (clip.frames.empty()) return Fail({file}, "the motion has no frames; allowed: at least one");
  BodySampler sampler(clip, map);
  BodyConversion done;
  const BodyPose rest = sampler.Rest();
  const UpSamples samples = SamplesForUp(clip, sampler);
  done.found_up = UpOf(options, clip.skeleton, rest, samples);
  done.up = AsUpAxis(done.found_up);
  std::string lies = !options.up && done.up == UpAxis::kY ? LiesAlong(samples.poses) : "";
  if (!lies.empty()) {
    const bool at_rest = LiesAlong(std::span(&rest, 1)) == lies;
    lies = fmt::format("the body {}{}, and Etude assumes that Y is up",
                       lies == "−Y" ? "is upside down" : "lies along " + lies, at_rest ? ", also at rest" : "");
    if (at_rest) lies += "; if another axis is up, rotate the file first";
  }
  const std::size_t t_pose = CountForeignTPose(clip, sampler, done.up);
  if (options.drop_t_pose) done.dropped_frames = t_pose;

  // Sample, check sides, find the unit and the floor, and convert.
  ASSIGN_OR_RETURN(auto poses, Resampled(clip, sampler, done.dropped_frames, options.rate_hz, done.up, file));
  ASSIGN_OR_RETURN(const double overstretch, CheckSides(poses, map, file));
  RETURN_IF_ERROR(CheckLimbs(poses, file));
  std::vector<std::string> remarks;
  RETURN_IF_ERROR(FindUnit(rest, poses, options, file, done, remarks));
  done.floor = options.keep_floor ? 0 : FloorOf(poses, options.floor);
  PlaceOnFloor(poses, done);
  done.motion = {.rate_hz = options.rate_hz, .poses = std::move(poses)};
  done.changes = ChangesOf(done, map, clip, lies);
  for (const std::string& said : {lies, lies.empty() ? done.found_up.doubt : ""}) {
    if (!said.empty()) done.doubts.push_back(said);
  }
  for (const std::string& remark : remarks) {
    done.changes.push_back(remark);
    if (!options.metres_per_unit) done.doubts.push_back(remark);  // a unit given by the user is not doubted
  }
  if (overstretch > 0)
    done.changes.push_back(fmt::format("the knees are overextended by {:.0f}° on average", Degrees(overstretch)));
  if (t_pose > done.dropped_frames) {
    done.Doubt(fmt::format("the motion begins with {} frame{} of a T-pose, from which it jumps", t_pose,
                           t_pose == 1 ? "" : "s"));
  }
  done.Doubt(DescribeImpossibleHeight(done.motion.poses));
  done.Doubt(DescribeSlowRate(clip.rate_hz));
  done.Doubt(DescribeRootTravel(clip, map));
  return done;
}

}  // namespace etude

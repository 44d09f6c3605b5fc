#include "engine/retargeting/joint_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "engine/formats/array_clock.h"
#include "engine/retargeting/array_evidence.h"
#include "engine/retargeting/data_set_names.h"
#include "engine/retargeting/joint_layouts.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/marker_repairs.h"
#include "engine/retargeting/rig.h"
#include "engine/retargeting/up_axis.h"

namespace etude {
namespace {

constexpr const char* kFromCamera = "the body stands along −Y, as in a camera's frame, so Etude rotated it to Y up";
constexpr const char* kOnHands = "the body is upside down on its hands, so Etude assumes a handstand with Y up";

/// Reads the position at `index`; NaN means not seen. Returns nullopt if a coordinate exceeds ±10⁹.
std::optional<glm::dvec3> PlaceIn(const NumberArray& array, std::size_t index) {
  constexpr double kMaxAbsolute = 1e9;
  const double* at = &array.values[3 * index];
  const glm::dvec3 place(at[0], at[1], at[2]);
  if (std::isnan(place.x + place.y + place.z)) return NotSeen();
  const glm::dvec3 size = glm::abs(place);
  return std::max({size.x, size.y, size.z}) > kMaxAbsolute ? std::nullopt : std::optional(place);
}

/// Returns the only text of the array `name`, in lower case; "" without such an array, or if it has several texts.
std::string TextOf(const Npz& arrays, const std::string& name) {
  const auto found = arrays.texts.find(name);
  if (found == arrays.texts.end() || found->second.size() != 1) return "";
  return InLowerCase(found->second.front());
}

/// Returns the length of the arrays' unit in metres; appends each assumption to `notes`.
Result<double> UnitOf(const Npz& arrays, const RawMotion& motion, const std::string& file,
                      std::vector<std::string>& notes) {
  double unit = 1;
  if (const NumberArray* number = arrays.Find("unit"); number != nullptr && number->values.size() == 1) {
    unit = number->values[0];
  } else if (const std::string text = TextOf(arrays, "unit"); !text.empty()) {
    ASSIGN_OR_RETURN(unit, ReadUnit(text, {file}));
  } else if (arrays.Contains("unit")) {
    return Fail(
        {file},
        "the array 'unit' is neither one number nor one text; allowed: the metres in one unit, or the unit's name");
  }
  constexpr double kMinExtent_m = 0.3, kMaxExtent_m = 4;
  const double spread = SpreadOf(motion.positions, motion.joints.size());
  const auto likely = UnitOfSpread(spread);
  const bool is_small = unit > 0 && unit * spread < kMinExtent_m;
  if (unit > 0 && unit * spread <= kMaxExtent_m && !(is_small && likely)) {
    if (unit != 1) notes.push_back(fmt::format("1 unit = {:g} cm", 100 * unit));
    return unit;
  }
  if (!likely) {
    return Fail({file},
                "the joints extend {:.3g} m in the median frame if the unit is {:g} m; allowed: at most {:g} m; use "
                "`unit` in the file or in a joint map to set the unit",
                unit * spread, unit, kMaxExtent_m);
  }
  notes.push_back(fmt::format("1 unit = {:g} cm, because in units of {:g} m the joints would extend {:.3g} m",
                              100 * *likely, unit, unit * spread));
  return *likely;
}

/// Replaces positions that stand for gaps by NaN (RepairMarkers), places the frames at even steps by the clock's times,
/// if there are any (LayOnClock), and states this in the notes.
Result<void> LeaveGapsOut(ArrayClock clock, const std::string& file, RawMotion& motion) {
  MarkerMotion markers = MarkersOf(motion);
  RepairMarkers(markers);
  ASSIGN_OR_RETURN(markers, LayOnClock(std::move(markers), std::move(clock), file));
  motion.rate_hz = markers.rate_hz;
  motion.start_s = markers.start_s;
  if (markers.remark.empty() && markers.frames.size() == motion.FrameCount()) return {};
  if (!markers.remark.empty()) motion.notes.push_back(markers.remark);
  motion.positions.clear();
  for (const auto& frame : markers.frames) {
    for (const auto& shown : frame) motion.positions.push_back(shown.value_or(NotSeen()));
  }
  return {};
}

/// Assigns the roles that the joints play by the names of their data set, if there is one, and notes a change.
void TakeRolesOfDataSet(RawMotion& motion) {
  const auto known = FindDataSet(motion.joints);
  if (!known) return;
  const auto before = motion.roles;
  for (const KnownJoint& one : known->joints) {
    const auto role = FindRole(one.joint);
    if (!role || one.points.size() > 1) continue;
    std::ranges::replace(motion.roles, static_cast<int>(one.points.front()), -1);
    motion.roles[Index(*role)] = static_cast<int>(one.points.front());
  }
  if (motion.roles != before) motion.notes.push_back(fmt::format("joints of {}, found by name", known->data_set));
}

NumberArray ArrayOf(std::vector<std::size_t> shape, std::vector<double> values = {}) {
  return {.shape = std::move(shape), .values = std::move(values)};
}

void Add(const glm::dvec3& v, NumberArray& array) {
  for (int axis = 0; axis < 3; ++axis) array.values.push_back(v[axis]);
}

}  // namespace

Result<ArrayJoints> JointsOfArray(const NumberArray& array, const std::optional<std::string>& layout,
                                  const std::string& file, std::optional<UpAxis> told) {
  constexpr std::size_t kHumanMl3dFeatures = 263;
  if (array.shape.size() == 2 && array.shape[1] == kHumanMl3dFeatures) {
    return Fail(
        {file},
        "the array of {} contains features of HumanML3D; convert the features to joints (docs/clips.md#humanml3d)",
        ShapeText(array));
  }
  if (array.shape.size() != 3 || array.shape[2] != 3 || array.shape[0] == 0) {
    return Fail({file}, "found an array of {}; allowed: frames × joints × 3", ShapeText(array));
  }
  // Find the layout by its name or by the number of joints.
  const std::size_t frames = array.shape[0], joints = array.shape[1];
  const auto fits = [&](const JointLayout& one) { return one.joints.size() == joints; };
  const auto is_named = [&](const JointLayout& one) {
    return fits(one) && (layout ? *layout == one.name : one.is_usual);
  };
  const auto count = std::ranges::count_if(JointLayouts(), is_named);
  if (count != 1) {
    return Fail({file},
                "found {} joints{}; allowed: {}#LAYOUT, where LAYOUT has the same number of joints and is one of {}",
                joints,
                layout      ? " in the layout " + Quote(*layout)
                : count > 1 ? ", as several layouts have"
                            : ", as no layout has",
                file, Join(JointLayoutNames()));
  }
  const JointLayout& found = *std::ranges::find_if(JointLayouts(), is_named);
  // Copy the positions; a NaN is a missing joint.
  MarkerMotion motion{.rate_hz = kJudgedRateHz, .names = {}, .frames = {}};
  for (const std::string_view joint : found.joints) motion.names.emplace_back(joint);
  std::vector<glm::dvec3> places;
  for (std::size_t f = 0; f < frames; ++f) {
    auto& frame = motion.frames.emplace_back(joints);
    for (std::size_t j = 0; j < joints; ++j) {
      const auto place = PlaceIn(array, f * joints + j);
      if (!place) return Fail({file}, "frame {}, joint {} lies beyond ±10⁹", f, j);
      places.push_back(*place);
      if (IsSeen(*place)) frame[j] = *place;
    }
  }
  if (const JointLayout* const better = FindBetterLayout(places, found)) {
    return Fail(
        {file},
        "in the layout {}, limbs have impossible lengths; allowed: {}#{}, in which the limbs have possible lengths",
        found.name, file, better->name);
  }
  // Convert to metres.
  const double unit = motion.metres_per_unit = UnitOfSpread(SpreadOf(places, joints)).value_or(1);
  const Standing standing = told ? Standing::kUnknown : FindStanding(places, motion.names);
  const bool is_turned = standing == Standing::kAlongMinusY;
  const glm::dvec3 scale = unit * (is_turned ? glm::dvec3(1, -1, -1) : glm::dvec3(1));
  for (auto& frame : motion.frames) {
    for (auto& place : frame) {
      if (place) *place *= scale;
    }
  }
  motion.remark = fmt::format("layout {}, 1 unit = {:g} cm", found.name, 100 * unit);
  if (is_turned) motion.remark += std::string("; ") + kFromCamera;
  if (standing == Standing::kOnHands) motion.remark += std::string("; ") + kOnHands;
  return ArrayJoints{std::move(motion), std::string(found.name), is_turned};
}

Result<std::optional<NumberArray>> JointsOfSam(const Npz& arrays, const std::string& file, std::string& note) {
  // An axis of length 1 after the frames counts the people of one picture.
  const auto of_one_person = [](NumberArray array, std::size_t rank) {
    if (array.shape.size() == rank + 1 && array.shape[1] == 1) array.shape.erase(array.shape.begin() + 1);
    return array;
  };
  for (const char* name : {"pred_joint_coords", "pred_keypoints_3d"}) {
    const NumberArray* const found = arrays.Find(name);
    if (found == nullptr) continue;
    NumberArray joints = of_one_person(*found, 3);
    if (joints.shape.size() != 3 || joints.shape[2] != 3) {
      return Fail({file}, "the array {} has the shape {}; allowed: frames × joints × 3, for one person", name,
                  ShapeText(*found));
    }
    note = "SAM 3D Body's arrays are in the camera's frame; Etude rotated them to Y up, assuming a level camera";
    NumberArray moved;
    if (const NumberArray* const camera = arrays.Find("pred_cam_t")) {
      moved = of_one_person(*camera, 2);
      if (moved.shape != std::vector<std::size_t>{joints.shape[0], 3}) {
        return Fail({file},
                    "the array pred_cam_t has the shape {}, and {} the shape {}; allowed: frames × 3 and frames × "
                    "joints × 3, with the same number of frames",
                    ShapeText(*camera), name, ShapeText(*found));
      }
    } else {
      note += "; the body stays in place, because the file has no array pred_cam_t with positions";
    }
    for (std::size_t i = 0; i < joints.values.size(); ++i) {
      if (!moved.values.empty()) joints.values[i] += moved.values[3 * (i / (3 * joints.shape[1])) + i % 3];
      if (i % 3 != 0) joints.values[i] = -joints.values[i];  // y down and z forwards become y up and z backwards
    }
    return std::optional(std::move(joints));
  }
  return std::nullopt;
}

std::string DescribeFewFrames(const MarkerMotion& motion) {
  constexpr std::size_t kMaxFrames = 12;
  constexpr double kMaxStep_m = 0.25, kMaxChange_m = 0.12;  // 7.5 m/s, and 3.6 m/s without the body's travel, at 30 Hz
  if (motion.frames.size() < 2 || motion.frames.size() > kMaxFrames) return "";
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 1; f < motion.frames.size(); ++f) {
    std::vector<glm::dvec3> steps;
    glm::dvec3 mean(0);
    for (std::size_t j = 0; j < motion.names.size(); ++j) {
      const MarkerPosition &from = motion.frames[f - 1][j], &to = motion.frames[f][j];
      if (from && to) steps.push_back(*to - *from);
    }
    if (steps.empty()) return "";
    for (const glm::dvec3& step : steps) mean += step / static_cast<double>(steps.size());
    std::vector<double> lengths, changes;
    for (const glm::dvec3& step : steps) {
      lengths.push_back(glm::length(step));
      changes.push_back(glm::length(step - mean));
    }
    const double step = Median(lengths);
    if (step < kMaxStep_m && Median(changes) < kMaxChange_m) return "";
    least = std::min(least, step);
  }
  return fmt::format(
      "in each of the {} frames, most joints jump by at least {:.0f} cm to the next frame: does the first axis of the "
      "array count people instead of frames?",
      motion.frames.size(), 100 * least);
}

std::string WriteBodyNpz(const BodyMotion& motion, const BodyPose& rest, double start_s) {
  const Clip clip = RigClip(motion, rest, "");
  const std::size_t frames = motion.poses.size();
  NumberArray positions = ArrayOf({frames, kRoleCount, 3}), translations = positions,
              offsets = ArrayOf({kRoleCount, 3});
  NumberArray rotations = ArrayOf({frames, kRoleCount, 4}), parents = ArrayOf({kRoleCount});
  // Write names, parents and offsets of the skeleton.
  std::vector<std::string> names;
  for (const Joint& joint : clip.skeleton.joints) {
    names.push_back(joint.name);
    parents.values.push_back(joint.parent);
    Add(joint.rest.translation, offsets);
  }
  // Write positions and local transforms of every frame.
  std::vector<GlobalTransform> globals;
  for (const LocalPose& frame : clip.frames) {
    ComputeGlobals(clip.skeleton, frame, globals);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      Add(globals[i].position, positions);
      Add(frame[i].translation, translations);
      const glm::dquat& turn = frame[i].rotation;
      for (const double part : {turn.w, turn.x, turn.y, turn.z}) rotations.values.push_back(part);
    }
  }
  std::map<std::string, NumberArray> arrays = {
      {"positions", std::move(positions)}, {"translations", std::move(translations)},
      {"rotations", std::move(rotations)}, {"offsets", std::move(offsets)},
      {"parents", std::move(parents)},     {"rate_hz", ArrayOf({}, {motion.rate_hz})}};
  // A motion that does not begin at 0 s needs times.
  for (std::size_t k = 0; k < frames && start_s != 0; ++k) {
    NumberArray& times = arrays.try_emplace("times", ArrayOf({frames})).first->second;
    times.values.push_back(start_s + static_cast<double>(k) / motion.rate_hz);
  }
  return WriteNpz(arrays, {{"names", std::move(names)}, {"unit", {"m"}}, {"up", {"y"}}});
}

bool IsBodyNpz(const Npz& arrays) {
  return arrays.arrays.contains("positions") || std::ranges::count(arrays.skipped, "positions") > 0;
}

Result<RawMotion> ReadRawNpz(const Npz& arrays, const std::string& file, const ArrayOptions& told) {
  if (!arrays.arrays.contains("positions")) {
    return Fail({file},
                "the array 'positions' contains other data than numbers; allowed: floating-point numbers and integers");
  }
  const NumberArray& positions = arrays.arrays.at("positions");
  const auto& shape = positions.shape;
  if (shape.size() != 3 || shape[0] == 0 || shape[1] == 0 || shape[2] != 3) {
    return Fail({file}, "positions of {}; allowed: frames × joints × 3", ShapeText(positions));
  }
  RawMotion motion;
  motion.name = file;
  ArrayClock clock;
  if (!told.rate_hz) {
    ASSIGN_OR_RETURN(clock, ClockOfArrays(arrays, shape[0], file));
    if (!clock.IsStated()) {
      return Fail({file},
                  "found no rate_hz (frames per second); allowed: rate_hz with one number from 0.1 to 10000, as in "
                  "numpy.savez(…, positions=p, rate_hz=30), or `times` in seconds, or `rate: 30` in a joint map (the "
                  "file's arrays: {})",
                  NamesOfArrays(arrays));
    }
  }
  motion.rate_hz = told.rate_hz.value_or(kJudgedRateHz);
  // Read the joints' names, and find the roles that they play.
  if (const auto names = arrays.texts.find("names"); names != arrays.texts.end()) {
    motion.joints = names->second;
  } else if (std::ranges::find(arrays.skipped, "names") != arrays.skipped.end() || arrays.arrays.contains("names")) {
    return Fail({file},
                "the array 'names' is not a list of texts; allowed: a list such as numpy.array([\"hip_centre\", …])");
  } else if (shape[1] == kRoleCount) {
    for (const Role role : AllRoles()) motion.joints.emplace_back(RoleName(role));
  }
  const std::size_t joints = motion.joints.size();
  if (joints != shape[1])
    return Fail({file}, "found {} joints and {} names (the file's arrays: {}); allowed: one name for each joint",
                shape[1], joints, NamesOfArrays(arrays));
  std::set<std::string_view> known;
  for (std::size_t j = 0; j < joints; ++j) {
    if (!known.insert(motion.joints[j]).second) {
      return Fail({file}, "the array 'names' contains {} twice; allowed: a different name for each joint",
                  Quote(motion.joints[j]));
    }
    if (const auto role = FindRole(motion.joints[j])) motion.roles[Index(*role)] = static_cast<int>(j);
  }
  TakeRolesOfDataSet(motion);
  if (int& root = motion.roles[Index(Role::kHipCentre)]; root < 0) {
    const int pelvis = motion.Find("pelvis"), hips = motion.Find("hips");
    root = pelvis >= 0 && (hips < 0 || pelvis < hips) ? pelvis : hips;
  }
  // Read the positions; a joint with a NaN is not seen.
  motion.positions.reserve(shape[0] * joints);
  for (std::size_t i = 0; i < shape[0] * joints; ++i) {
    const auto place = PlaceIn(positions, i);
    if (!place)
      return Fail({file}, "in frame {}, a coordinate of joint {} is out of range; allowed: ±10⁹", i / joints,
                  i % joints);
    motion.positions.push_back(*place);
  }
  RETURN_IF_ERROR(LeaveGapsOut(std::move(clock), file, motion));
  // Convert to metres and Y up.
  double unit = told.metres_per_unit.value_or(1);
  if (told.metres_per_unit) {
    constexpr double kMinExtent_m = 0.1, kMaxExtent_m = 4;
    const double extent = unit * SpreadOf(motion.positions, joints);
    if (extent > 0 && (extent < kMinExtent_m || extent > kMaxExtent_m)) {
      return Fail({file},
                  "with the given unit (1 unit = {:.4g} cm), the joints extend {:.3g} m; allowed: {:g} to {:g} m",
                  100 * unit, extent, kMinExtent_m, kMaxExtent_m);
    }
    motion.notes.push_back(fmt::format("1 unit = {:g} cm (given)", 100 * unit));
  } else {
    ASSIGN_OR_RETURN(unit, UnitOf(arrays, motion, file, motion.notes));
  }
  const std::string axis = TextOf(arrays, "up");
  if (!axis.empty() && axis != "y" && axis != "z") return Fail({file}, "up is {}; allowed: y, z", Quote(axis));
  if (axis.empty() && arrays.Contains("up")) return Fail({file}, "the array 'up' is not one text; allowed: 'y', 'z'");
  const UpAxis up = told.up.value_or(axis == "z" ? UpAxis::kZ : UpAxis::kY);
  if (up == UpAxis::kZ) {
    motion.notes.push_back(fmt::format("turned upright from Z up ({})", told.up ? "given" : "the file's `up`"));
  }
  for (glm::dvec3& place : motion.positions) place = Upright(unit * place, up);
  const Standing standing = told.up ? Standing::kUnknown : FindStanding(motion.positions, motion.joints);
  if (!axis.empty()) {
    const bool lies = standing == Standing::kAlongZ, is_down = standing == Standing::kAlongMinusY;
    if (lies || is_down) {
      motion.Doubt(fmt::format("with the file's `up: {}`, the body {}", axis,
                               lies ? "lies along the floor" : "stands on its head"));
    }
  } else if (standing == Standing::kAlongMinusY) {
    motion.notes.emplace_back(kFromCamera);
    motion.is_of_camera = true;
    for (glm::dvec3& place : motion.positions) place *= glm::dvec3(1, -1, -1);
  } else if (standing == Standing::kOnHands) {
    motion.Doubt(kOnHands);
  } else if (standing == Standing::kAlongZ) {
    motion.Doubt("with Y up, the body lies along Z; if it stands, state `up: z` in the file or in a joint map");
  } else if (const auto body = told.up ? std::nullopt : BodyOf(motion)) {
    motion.Doubt(FindUp(body->poses, motion.rate_hz, RawArraysUp()).doubt);
  }
  return motion;
}

std::optional<BodyMotion> BodyOf(const RawMotion& raw) {
  const bool has_roles = std::ranges::none_of(raw.roles, [](int joint) { return joint < 0; });
  if (raw.joints.size() != kRoleCount || !has_roles || !std::ranges::all_of(raw.positions, IsSeen)) return std::nullopt;
  BodyMotion motion{.rate_hz = raw.rate_hz, .poses = std::vector<BodyPose>(raw.FrameCount())};
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    for (const Role role : AllRoles()) {
      motion.poses[f][role] = raw.At(f, static_cast<std::size_t>(raw.roles[Index(role)]));
    }
  }
  return motion;
}

std::vector<JointPositions> RolesIn(const RawMotion& motion) {
  std::vector<JointPositions> frames(motion.FrameCount());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      if (motion.roles[i] < 0) continue;
      const glm::dvec3& place = motion.At(f, static_cast<std::size_t>(motion.roles[i]));
      if (IsSeen(place)) frames[f][i] = place;
    }
  }
  return frames;
}

MarkerMotion MarkersOf(const RawMotion& motion) {
  MarkerMotion markers{.rate_hz = motion.rate_hz, .names = motion.joints, .frames = {}};
  markers.start_s = motion.start_s;
  for (std::size_t f = 0; f < motion.FrameCount(); ++f) {
    auto& frame = markers.frames.emplace_back(motion.joints.size());
    for (std::size_t j = 0; j < frame.size(); ++j) {
      if (IsSeen(motion.At(f, j))) frame[j] = motion.At(f, j);
    }
  }
  return markers;
}

}  // namespace etude

#include "engine/retargeting/joint_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string_view>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/rig.h"

namespace etude {
namespace {

struct JointLayout {
  std::string_view name;
  std::vector<std::string_view> joints;  ///< names that FindMarkerBodies recognises or ignores
};

/// The 70 keypoints of SAM 3D Body and the 127 joints of its body model MHR, in their order. Those that play a role are
/// listed under the role's name: a foot ends at its big toe (keypoints) or its ball (joints), a hand at its middle
/// finger.
constexpr std::string_view kMhrKeypoints =
    "nose left_eye right_eye left_ear right_ear left_shoulder right_shoulder left_elbow right_elbow left_hip "
    "right_hip left_knee right_knee left_ankle right_ankle left_foot left_small_toe left_heel right_foot "
    "right_small_toe right_heel right_thumb_tip right_thumb_first right_thumb_second right_thumb_third "
    "right_index_tip right_index_first right_index_second right_index_third right_hand right_middle_first "
    "right_middle_second right_middle_third right_ring_tip right_ring_first right_ring_second right_ring_third "
    "right_pinky_tip right_pinky_first right_pinky_second right_pinky_third right_wrist left_thumb_tip "
    "left_thumb_first left_thumb_second left_thumb_third left_index_tip left_index_first left_index_second "
    "left_index_third left_hand left_middle_first left_middle_second left_middle_third left_ring_tip "
    "left_ring_first left_ring_second left_ring_third left_pinky_tip left_pinky_first left_pinky_second "
    "left_pinky_third left_wrist left_olecranon right_olecranon left_cubital_fossa right_cubital_fossa "
    "left_acromion right_acromion shoulder_centre";
constexpr std::string_view kMhrJoints =
    "body_world hip_centre left_hip left_knee left_ankle l_talocrural l_subtalar l_transversetarsal left_foot "
    "l_lowleg_twist1_proc l_lowleg_twist2_proc l_lowleg_twist3_proc l_lowleg_twist4_proc l_upleg_twist0_proc "
    "l_upleg_twist1_proc l_upleg_twist2_proc l_upleg_twist3_proc l_upleg_twist4_proc right_hip right_knee "
    "right_ankle r_talocrural r_subtalar r_transversetarsal right_foot r_lowleg_twist1_proc r_lowleg_twist2_proc "
    "r_lowleg_twist3_proc r_lowleg_twist4_proc r_upleg_twist0_proc r_upleg_twist1_proc r_upleg_twist2_proc "
    "r_upleg_twist3_proc r_upleg_twist4_proc c_spine0 spine c_spine2 c_spine3 r_clavicle right_shoulder "
    "right_elbow r_wrist_twist right_wrist r_pinky0 r_pinky1 r_pinky2 r_pinky3 r_pinky_null r_ring1 r_ring2 "
    "r_ring3 r_ring_null r_middle1 r_middle2 r_middle3 right_hand r_index1 r_index2 r_index3 r_index_null "
    "r_thumb0 r_thumb1 r_thumb2 r_thumb3 r_thumb_null r_lowarm_twist1_proc r_lowarm_twist2_proc "
    "r_lowarm_twist3_proc r_lowarm_twist4_proc r_uparm_twist0_proc r_uparm_twist1_proc r_uparm_twist2_proc "
    "r_uparm_twist3_proc r_uparm_twist4_proc l_clavicle left_shoulder left_elbow l_wrist_twist left_wrist "
    "l_pinky0 l_pinky1 l_pinky2 l_pinky3 l_pinky_null l_ring1 l_ring2 l_ring3 l_ring_null l_middle1 l_middle2 "
    "l_middle3 left_hand l_index1 l_index2 l_index3 l_index_null l_thumb0 l_thumb1 l_thumb2 l_thumb3 l_thumb_null "
    "l_lowarm_twist1_proc l_lowarm_twist2_proc l_lowarm_twist3_proc l_lowarm_twist4_proc l_uparm_twist0_proc "
    "l_uparm_twist1_proc l_uparm_twist2_proc l_uparm_twist3_proc l_uparm_twist4_proc shoulder_centre "
    "c_neck_twist1_proc c_neck_twist0_proc c_head c_jaw c_teeth c_jaw_null c_tongue0 c_tongue1 c_tongue2 "
    "c_tongue3 c_tongue4 r_eye r_eye_null l_eye l_eye_null head";

const std::vector<JointLayout>& Layouts() {
  static const std::vector<JointLayout> layouts = [] {
    std::vector<JointLayout> made;
    // Etude's own twenty roles, and SMPL without and with hands.
    JointLayout own{"etude", {}};
    for (const Role role : AllRoles()) own.joints.push_back(RoleName(role));
    made.push_back(std::move(own));
    const std::vector<std::string_view> body = {
        "hip_centre",      "left_hip",    "right_hip",    "spine1",     "left_knee",     "right_knee",
        "spine",           "left_ankle",  "right_ankle",  "spine3",     "left_foot",     "right_foot",
        "shoulder_centre", "left_collar", "right_collar", "head",       "left_shoulder", "right_shoulder",
        "left_elbow",      "right_elbow", "left_wrist",   "right_wrist"};
    made.push_back({"smpl", body});
    made.push_back({"smpl", body});
    for (const std::string_view hand : {"left_hand", "right_hand"}) made.back().joints.push_back(hand);
    // The keypoints of pose estimators and data sets.
    made.push_back({"h36m",
                    {"hip_centre", "right_hip", "right_knee", "right_ankle", "left_hip", "left_knee", "left_ankle",
                     "spine", "shoulder_centre", "nose", "head", "left_shoulder", "left_elbow", "left_wrist",
                     "right_shoulder", "right_elbow", "right_wrist"}});
    made.push_back({"coco",
                    {"nose", "left_eye", "right_eye", "left_ear", "right_ear", "left_shoulder", "right_shoulder",
                     "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip", "right_hip", "left_knee",
                     "right_knee", "left_ankle", "right_ankle"}});
    made.push_back(
        {"body_25", {"Nose", "Neck",    "RShoulder", "RElbow", "RWrist",  "LShoulder", "LElbow", "LWrist", "MidHip",
                     "RHip", "RKnee",   "RAnkle",    "LHip",   "LKnee",   "LAnkle",    "REye",   "LEye",   "REar",
                     "LEar", "LBigToe", "LSmallToe", "LHeel",  "RBigToe", "RSmallToe", "RHeel"}});
    made.push_back({"halpe_26", {"Nose",    "LEye",      "REye",      "LEar",   "REar", "LShoulder", "RShoulder",
                                 "LElbow",  "RElbow",    "LWrist",    "RWrist", "LHip", "RHip",      "LKnee",
                                 "RKnee",   "LAnkle",    "RAnkle",    "Head",   "Neck", "Hip",       "LBigToe",
                                 "RBigToe", "LSmallToe", "RSmallToe", "LHeel",  "RHeel"}});
    made.push_back({"mhr70", SplitAt(kMhrKeypoints, ' ')});
    made.push_back({"mhr", SplitAt(kMhrJoints, ' ')});
    return made;
  }();
  return layouts;
}

/// Returns the median over the frames of the joints' largest extent along an axis, in the file's unit. A NaN is a
/// missing joint.
double SpreadOf(std::span<const glm::dvec3> positions, std::size_t joints) {
  std::vector<double> spreads;
  for (std::size_t begin = 0; begin < positions.size(); begin += joints) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::dvec3& place : positions.subspan(begin, joints)) {
      if (!IsSeen(place)) continue;
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
    if (low.x <= high.x) spreads.push_back(std::max({high.x - low.x, high.y - low.y, high.z - low.z}));
  }
  return spreads.empty() ? 0 : UpperMedian(std::move(spreads));
}

/// Returns the unit in which `spread` is a person's size, 0.8 to 2.3 m; nullopt if there is none.
std::optional<double> UnitOfSpread(double spread) {
  for (const double unit : {1.0, 0.01, 0.001}) {
    if (spread * unit >= 0.8 && spread * unit <= 2.3) return unit;
  }
  return std::nullopt;
}

constexpr const char* kFromCamera = "the body stands along −Y, as in a camera's frame: turned to Y up";

/// The direction in which bodies stand, if it is not +Y.
enum class Standing { kNotTold, kAlongMinusY, kAlongZ };

/// Finds the direction in which the body stands: the shoulders lie above the knees along that direction in three of
/// four frames that show both.
Standing HowItStands(std::span<const glm::dvec3> positions, const std::vector<std::string>& names) {
  const auto column_of = [&](Role role) {
    return static_cast<std::size_t>(std::ranges::find(names, RoleName(role)) - names.begin());
  };
  const std::array<std::size_t, 4> columns = {column_of(Role::kLeftShoulder), column_of(Role::kRightShoulder),
                                              column_of(Role::kLeftKnee), column_of(Role::kRightKnee)};
  if (std::ranges::count(columns, names.size()) > 0) return Standing::kNotTold;
  constexpr double kUpright = 0.8;  // cosine
  int seen = 0, upside_down = 0, along_z = 0;
  for (std::size_t begin = 0; begin < positions.size(); begin += names.size()) {
    const auto place = [&](std::size_t i) { return positions[begin + columns[i]]; };
    const glm::dvec3 body = place(0) + place(1) - place(2) - place(3);
    const double length = glm::length(body);
    seen += std::isnan(length) ? 0 : 1;
    upside_down += body.y < -kUpright * length ? 1 : 0;
    along_z += std::abs(body.z) > kUpright * length ? 1 : 0;
  }
  if (upside_down > 0 && 4 * upside_down >= 3 * seen) return Standing::kAlongMinusY;
  return along_z > 0 && 4 * along_z >= 3 * seen ? Standing::kAlongZ : Standing::kNotTold;
}

/// Reads the position at `index`; NaN means not seen. Returns nullopt if a coordinate exceeds ±10⁹.
std::optional<glm::dvec3> PlaceIn(const NumberArray& array, std::size_t index) {
  constexpr double kMaxAbsolute = 1e9;
  const double* at = &array.values[3 * index];
  const glm::dvec3 place(at[0], at[1], at[2]);
  if (std::isnan(place.x + place.y + place.z)) return NotSeen();
  const glm::dvec3 size = glm::abs(place);
  return std::max({size.x, size.y, size.z}) > kMaxAbsolute ? std::nullopt : std::optional(place);
}

/// Returns the first text of the array `name`, in lower case; "" if there is no such array.
std::string TextOf(const Npz& arrays, const std::string& name) {
  const auto found = arrays.texts.find(name);
  if (found == arrays.texts.end() || found->second.size() != 1) return "";
  std::string text = found->second.front();
  std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

Result<double> RateOf(const Npz& arrays, const std::string& file) {
  constexpr double kMinRate_hz = 0.1, kMaxRate_hz = 10'000;
  const NumberArray* rate = arrays.Find("rate_hz");
  const bool is_right =
      rate != nullptr && rate->values.size() == 1 && rate->values[0] >= kMinRate_hz && rate->values[0] <= kMaxRate_hz;
  if (is_right) return rate->values[0];
  return Fail(
      {file},
      "{}; allowed: one number from {:g} to {:g}, as numpy.savez(…, positions=p, rate_hz=30) writes it, or `rate: "
      "30` in a joint map",
      rate != nullptr || std::ranges::find(arrays.skipped, "rate_hz") != arrays.skipped.end()
          ? "rate_hz is not such a number"
          : "positions without rate_hz, the frames per second",
      kMinRate_hz, kMaxRate_hz);
}

/// Returns the length of the arrays' unit in metres; states in `notes` whatever was assumed.
Result<double> UnitOf(const Npz& arrays, const RawMotion& motion, const std::string& file,
                      std::vector<std::string>& notes) {
  double unit = 1;
  if (const NumberArray* number = arrays.Find("unit"); number != nullptr && number->values.size() == 1) {
    unit = number->values[0];
  } else if (const std::string text = TextOf(arrays, "unit"); !text.empty()) {
    ASSIGN_OR_RETURN(unit, ReadUnit(text, {file}));
  }
  constexpr double kMaxExtent_m = 4;
  const double spread = SpreadOf(motion.positions, motion.joints.size());
  if (unit > 0 && unit * spread <= kMaxExtent_m) {
    if (unit != 1) notes.push_back(fmt::format("1 unit = {:g} cm", 100 * unit));
    return unit;
  }
  const auto likely = UnitOfSpread(spread);
  if (!likely) {
    return Fail(
        {file},
        "the joints extend {:.3g} m in the median frame, in a unit of {:g} m; allowed: at most {:g}; `unit` in the "
        "file or in a joint map says what unit it is",
        unit * spread, unit, kMaxExtent_m);
  }
  notes.push_back(fmt::format("1 unit = {:g} cm: in units of {:g} m the joints extend {:.3g} m", 100 * *likely, unit,
                              unit * spread));
  return *likely;
}

NumberArray ArrayOf(std::vector<std::size_t> shape, std::vector<double> values = {}) {
  return {.shape = std::move(shape), .values = std::move(values)};
}

void Add(const glm::dvec3& v, NumberArray& array) {
  for (int axis = 0; axis < 3; ++axis) array.values.push_back(v[axis]);
}

}  // namespace

std::vector<std::string> JointLayoutNames() {
  std::vector<std::string> names;
  for (const JointLayout& layout : Layouts()) {
    if (names.empty() || names.back() != layout.name) names.emplace_back(layout.name);
  }
  return names;
}

std::vector<std::string> JointsOfLayout(std::string_view layout, std::size_t joints) {
  for (const JointLayout& one : Layouts()) {
    if (one.name == layout && one.joints.size() == joints) return {one.joints.begin(), one.joints.end()};
  }
  return {};
}

Result<MarkerMotion> JointsOfArray(const NumberArray& array, const std::optional<std::string>& layout,
                                   const std::string& file, std::string& note, std::optional<UpAxis> told) {
  constexpr std::size_t kHumanMl3dFeatures = 263;
  if (array.shape.size() == 2 && array.shape[1] == kHumanMl3dFeatures) {
    return Fail({file}, "an array of {}: features of HumanML3D; convert them to joints (docs/clips.md#humanml3d)",
                ShapeText(array));
  }
  if (array.shape.size() != 3 || array.shape[2] != 3 || array.shape[0] == 0) {
    return Fail({file}, "an array of {}; allowed: frames × joints × 3", ShapeText(array));
  }
  // Find the layout by its name or by the number of joints.
  const std::size_t frames = array.shape[0], joints = array.shape[1];
  const auto fits = [&](const JointLayout& one) { return one.joints.size() == joints; };
  const auto is_named = [&](const JointLayout& one) { return fits(one) && (!layout || *layout == one.name); };
  const auto count = std::ranges::count_if(Layouts(), is_named);
  if (count != 1) {
    return Fail({file}, "{} joints{}; allowed: {}#LAYOUT, LAYOUT one of {} with as many joints", joints,
                layout      ? " in the layout " + Quote(*layout)
                : count > 1 ? " of several layouts"
                            : " of no layout",
                file, Join(JointLayoutNames()));
  }
  const JointLayout& found = *std::ranges::find_if(Layouts(), is_named);
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
  // Convert to metres.
  const double unit = motion.metres_per_unit = UnitOfSpread(SpreadOf(places, joints)).value_or(1);
  const bool is_turned = !told && HowItStands(places, motion.names) == Standing::kAlongMinusY;
  const glm::dvec3 scale = unit * (is_turned ? glm::dvec3(1, -1, -1) : glm::dvec3(1));
  for (auto& frame : motion.frames) {
    for (auto& place : frame) {
      if (place) *place *= scale;
    }
  }
  note = fmt::format("layout {}, 1 unit = {:g} cm", found.name, 100 * unit);
  if (is_turned) note += std::string("; ") + kFromCamera;
  return motion;
}

std::optional<NumberArray> JointsOfSam(const Npz& arrays) {
  for (const char* name : {"pred_joint_coords", "pred_keypoints_3d"}) {
    const auto found = arrays.arrays.find(name);
    if (found == arrays.arrays.end()) continue;
    NumberArray joints = found->second;
    const auto moved = arrays.arrays.find("pred_cam_t");
    const bool fits = moved != arrays.arrays.end() && joints.shape.size() == 3 && joints.shape[2] == 3 &&
                      moved->second.shape == std::vector<std::size_t>{joints.shape[0], 3};
    for (std::size_t i = 0; joints.shape.size() == 3 && joints.shape[2] == 3 && i < joints.values.size(); ++i) {
      if (fits) joints.values[i] += moved->second.values[3 * (i / (3 * joints.shape[1])) + i % 3];
      if (i % 3 != 0) joints.values[i] = -joints.values[i];  // y down and z forwards become y up and z backwards
    }
    return joints;
  }
  return std::nullopt;
}

std::string WriteBodyNpz(const BodyMotion& motion, const BodyPose& rest) {
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
  return WriteNpz({{"positions", std::move(positions)},
                   {"translations", std::move(translations)},
                   {"rotations", std::move(rotations)},
                   {"offsets", std::move(offsets)},
                   {"parents", std::move(parents)},
                   {"rate_hz", ArrayOf({}, {motion.rate_hz})}},
                  {{"names", std::move(names)}, {"unit", {"m"}}, {"up", {"y"}}});
}

bool IsBodyNpz(const Npz& arrays) {
  return arrays.arrays.contains("positions") || std::ranges::count(arrays.skipped, "positions") > 0;
}

Result<RawMotion> ReadRawNpz(const Npz& arrays, const std::string& file, const ArrayOptions& told) {
  if (!arrays.arrays.contains("positions")) {
    return Fail({file}, "positions: not plain numbers; allowed: floats and whole numbers");
  }
  const NumberArray& positions = arrays.arrays.at("positions");
  const auto& shape = positions.shape;
  if (shape.size() != 3 || shape[0] == 0 || shape[1] == 0 || shape[2] != 3) {
    return Fail({file}, "positions of {}; allowed: frames × joints × 3", ShapeText(positions));
  }
  RawMotion motion;
  motion.name = file;
  if (told.rate_hz) {
    motion.rate_hz = *told.rate_hz;
  } else {
    ASSIGN_OR_RETURN(motion.rate_hz, RateOf(arrays, file));
  }
  // Read the joints' names, and find the roles that they play.
  if (const auto names = arrays.texts.find("names"); names != arrays.texts.end()) {
    motion.joints = names->second;
  } else if (std::ranges::find(arrays.skipped, "names") != arrays.skipped.end() || arrays.arrays.contains("names")) {
    return Fail({file}, "names: allowed: a list of texts, as numpy.array([\"hip_centre\", …]) makes it");
  } else if (shape[1] == kRoleCount) {
    for (const Role role : AllRoles()) motion.joints.emplace_back(RoleName(role));
  }
  const std::size_t joints = motion.joints.size();
  if (joints != shape[1]) return Fail({file}, "{} joints and {} names; allowed: one name for each", shape[1], joints);
  std::set<std::string_view> known;
  for (std::size_t j = 0; j < joints; ++j) {
    if (!known.insert(motion.joints[j]).second) {
      return Fail({file}, "names: {} twice; allowed: one name for each joint", Quote(motion.joints[j]));
    }
    if (const auto role = FindRole(motion.joints[j])) motion.roles[Index(*role)] = static_cast<int>(j);
  }
  if (int& root = motion.roles[Index(Role::kHipCentre)]; root < 0) {
    const int pelvis = motion.Find("pelvis"), hips = motion.Find("hips");
    root = pelvis >= 0 && (hips < 0 || pelvis < hips) ? pelvis : hips;
  }
  // Read the positions; a joint with a NaN is not seen.
  motion.positions.reserve(shape[0] * joints);
  for (std::size_t i = 0; i < shape[0] * joints; ++i) {
    const auto place = PlaceIn(positions, i);
    if (!place) return Fail({file}, "positions of frame {}: joint {} lies beyond ±10⁹", i / joints, i % joints);
    motion.positions.push_back(*place);
  }
  // Convert to metres and Y up.
  double unit = told.metres_per_unit.value_or(1);
  if (told.metres_per_unit) {
    constexpr double kMinExtent_m = 0.1, kMaxExtent_m = 4;
    const double extent = unit * SpreadOf(motion.positions, joints);
    if (extent > 0 && (extent < kMinExtent_m || extent > kMaxExtent_m)) {
      return Fail({file}, "in the unit given (1 unit = {:.4g} cm) the joints extend {:.3g} m; allowed: {:g} to {:g} m",
                  100 * unit, extent, kMinExtent_m, kMaxExtent_m);
    }
    motion.notes.push_back(fmt::format("1 unit = {:g} cm (told)", 100 * unit));
  } else {
    ASSIGN_OR_RETURN(unit, UnitOf(arrays, motion, file, motion.notes));
  }
  const std::string axis = TextOf(arrays, "up");
  if (!axis.empty() && axis != "y" && axis != "z") return Fail({file}, "up is {}; allowed: y, z", Quote(axis));
  const UpAxis up = told.up.value_or(axis == "z" ? UpAxis::kZ : UpAxis::kY);
  if (up == UpAxis::kZ) {
    motion.notes.push_back(fmt::format("turned upright from Z up ({})", told.up ? "given" : "the file's `up`"));
  }
  for (glm::dvec3& place : motion.positions) place = Upright(unit * place, up);
  const Standing standing =
      told.up || !axis.empty() ? Standing::kNotTold : HowItStands(motion.positions, motion.joints);
  if (standing == Standing::kAlongMinusY) {
    motion.notes.emplace_back(kFromCamera);
    for (glm::dvec3& place : motion.positions) place *= glm::dvec3(1, -1, -1);
  } else if (standing == Standing::kAlongZ) {
    motion.notes.emplace_back(
        "the body lies along Z, with Y up: if it stands, `up: z` in the file or a joint map says so");
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

MarkerMotion MarkersOf(const RawMotion& motion) {
  MarkerMotion markers{.rate_hz = motion.rate_hz, .names = motion.joints, .frames = {}};
  for (std::size_t f = 0; f < motion.FrameCount(); ++f) {
    auto& frame = markers.frames.emplace_back(motion.joints.size());
    for (std::size_t j = 0; j < frame.size(); ++j) {
      if (IsSeen(motion.At(f, j))) frame[j] = motion.At(f, j);
    }
  }
  return markers;
}

}  // namespace etude

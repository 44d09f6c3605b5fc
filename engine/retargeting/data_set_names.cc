#include "engine/retargeting/data_set_names.h"

#include <algorithm>
#include <map>

#include "engine/base/text.h"

namespace etude {
namespace {

/// A joint and the plain names of the points whose mean it is.
struct Named {
  std::string_view joint;
  std::vector<std::string_view> names;
};

/// The names of a data set's joints. They are used if the file has all names of `signs` and a left hip.
struct PublishedNames {
  std::string_view data_set;
  std::vector<std::string_view> signs;
  std::vector<Named> joints;  ///< uses the first names that the file has; others keep their usual meaning
};

/// Returns the names in the data sets' published code. Sources: smplx (joint_names.py) and HumanML3D; I2L-MeshNet for
/// the second SMPL and the second Human3.6M; Human3.6M's own names and MMPose's (h36m.py, mpi_inf_3dhp.py, halpe26.py);
/// MPI-INF-3DHP's mpii_get_joint_set.m; Microsoft's Kinect v1, v2 and Azure SDKs; OpenPose.
const std::vector<PublishedNames>& AllPublishedNames() {
  static const std::vector<PublishedNames> all = {
      {"SMPL", {"spine1", "spine2", "spine3"}, {{"spine", {"spine2"}}, {"shoulder_centre", {"neck"}}}},
      {"SMPL",
       {"torso", "spine", "chest"},
       {{"spine1", {"torso"}},
        {"spine3", {"chest"}},
        {"shoulder_centre", {"neck"}},
        {"left_collar", {"left_thorax"}},
        {"right_collar", {"right_thorax"}}}},
      {"Human3.6M",
       {"spine", "thorax"},
       {{"shoulder_centre", {"thorax"}},
        {"nose", {"necknose"}},
        {"nose", {"neckbase"}},
        {"left_ankle", {"left_ankle"}},
        {"left_ankle", {"left_foot"}},
        {"right_ankle", {"right_ankle"}},
        {"right_ankle", {"right_foot"}}}},
      {"Human3.6M", {"torso", "neck", "nose"}, {{"spine", {"torso"}}, {"shoulder_centre", {"neck"}}}},
      {"MPI-INF-3DHP",
       {"spine", "neck", "headtop"},
       {{"shoulder_centre", {"neck"}}, {"head", {"head"}}, {"head", {"headtop"}}}},
      {"Kinect",
       {"spinebase", "spinemid"},
       {{"hip_centre", {"spinebase"}}, {"spine", {"spinemid"}}, {"shoulder_centre", {"spineshoulder"}}}},
      {"Kinect",
       {"hipcenter", "shouldercenter"},
       {{"hip_centre", {"hipcenter"}}, {"shoulder_centre", {"shouldercenter"}}}},
      {"Azure Kinect", {"spinenavel", "spinechest"}, {{"shoulder_centre", {"neck"}}}},
      {"HALPE_26", {"hip", "neck", "nose", "left_bigtoe"}, {{"shoulder_centre", {"neck"}}, {"head", {"nose", "head"}}}},
      {"OpenPose BODY_25",
       {"midhip", "neck"},
       {{"hip_centre", {"midhip"}}, {"shoulder_centre", {"neck"}}, {"head", {"left_ear", "right_ear"}}}},
  };
  return all;
}

/// The names that mean the same joint in all these data sets.
const std::vector<Named>& CommonNames() {
  static const std::vector<Named> all = {{"hip_centre", {"pelvis"}},     {"hip_centre", {"hips"}},
                                         {"hip_centre", {"hip"}},        {"hip_centre", {"root"}},
                                         {"left_foot", {"left_foot"}},   {"left_foot", {"left_toe"}},
                                         {"left_foot", {"left_bigtoe"}}, {"right_foot", {"right_foot"}},
                                         {"right_foot", {"right_toe"}},  {"right_foot", {"right_bigtoe"}}};
  return all;
}

}  // namespace

std::string PlainJointName(std::string_view name) {
  constexpr std::string_view kSided[] = {"shoulder", "elbow", "wrist",  "hand",  "hip", "knee",
                                         "ankle",    "foot",  "toe",    "heel",  "eye", "bigtoe",
                                         "smalltoe", "ear",   "collar", "thorax"};
  std::string plain;
  for (const char c : InLowerCase(std::string(name.substr(name.rfind(':') + 1)))) {
    if (IsLower(c) || IsDigit(c) || static_cast<unsigned char>(c) >= 0x80) plain += c;
  }
  if (plain == "hipcentre") return "hip_centre";
  if (plain == "shouldercentre") return "shoulder_centre";
  for (const std::string_view word : kSided) {
    if (plain.find(word) == std::string::npos) continue;
    for (const std::string_view side : {"left", "right"}) {
      for (const std::string_view written : {side, side.substr(0, 1)}) {
        const bool fits =
            plain.size() == written.size() + word.size() &&
            (plain.starts_with(written) ? plain.ends_with(word) : plain.starts_with(word) && plain.ends_with(written));
        if (fits) return std::string(side) + "_" + std::string(word);
      }
    }
  }
  return plain;
}

std::optional<DataSetJoints> FindDataSet(std::span<const std::string> names) {
  std::map<std::string, std::size_t, std::less<>> points;
  for (std::size_t i = 0; i < names.size(); ++i) points.emplace(PlainJointName(names[i]), i);
  const auto has = [&](std::string_view name) { return points.contains(name); };
  const auto fits = [&](const PublishedNames& one) { return has("left_hip") && std::ranges::all_of(one.signs, has); };
  const auto found = std::ranges::find_if(AllPublishedNames(), fits);
  if (found == AllPublishedNames().end()) return std::nullopt;
  DataSetJoints known{found->data_set, {}};
  const auto is_known = [&](std::string_view joint) {
    return std::ranges::any_of(known.joints, [&](const KnownJoint& one) { return one.joint == joint; });
  };
  const auto is_used = [&](std::size_t point) {
    return std::ranges::any_of(
        known.joints, [&](const KnownJoint& one) { return one.points.size() == 1 && one.points.front() == point; });
  };
  const auto add = [&](std::string_view joint, const std::vector<std::string_view>& of) {
    if (is_known(joint) || !std::ranges::all_of(of, has)) return;
    KnownJoint one{std::string(joint), {}};
    for (const std::string_view name : of) one.points.push_back(points.find(name)->second);
    if (one.points.size() > 1 || !is_used(one.points.front())) known.joints.push_back(std::move(one));
  };
  // The data set's own names come first, then the common ones; all other names keep their usual meaning.
  for (const auto* table : {&found->joints, &CommonNames()}) {
    for (const Named& one : *table) add(one.joint, one.names);
  }
  for (const auto& [name, point] : points) add(name, {name});
  return known;
}

int FindJoint(const RawMotion& motion, std::string_view joint) {
  const int named = motion.Find(joint);
  if (named >= 0 || FindRole(joint) || !motion.parents.empty()) return named;
  if (const auto known = FindDataSet(motion.joints)) {
    const auto found = std::ranges::find(known->joints, joint, &KnownJoint::joint);
    if (found != known->joints.end() && found->points.size() == 1) return static_cast<int>(found->points.front());
  }
  const auto found = std::ranges::find_if(motion.joints, [&](const auto& one) { return PlainJointName(one) == joint; });
  return found == motion.joints.end() ? -1 : static_cast<int>(found - motion.joints.begin());
}

}  // namespace etude

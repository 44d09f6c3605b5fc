#include "engine/formats/kimodo.h"

#include <cmath>
#include <initializer_list>
#include <string_view>

#include "engine/formats/amass.h"
#include "engine/formats/array_clock.h"

namespace etude {
namespace {

constexpr std::size_t kWholeJoints = 77, kSmplJoints = 22;

struct SomaJoint {
  std::string name;
  int parent;
};
using SomaSkeleton = std::vector<SomaJoint>;

/// Adds joints in a chain: the first one is the child of `parent`, and every other joint is the child of the joint
/// before it. Returns the last one.
int AddChain(SomaSkeleton& joints, int parent, const std::string& prefix,
             std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    joints.push_back({prefix + std::string(name), parent});
    parent = static_cast<int>(joints.size()) - 1;
  }
  return parent;
}

/// Returns somaskel77, the skeleton with whole fingers, or somaskel30, which has two finger tips per hand.
SomaSkeleton MakeSoma(bool is_whole) {
  SomaSkeleton joints;
  const int head = AddChain(joints, -1, "", {"Hips", "Spine1", "Spine2", "Chest", "Neck1", "Neck2", "Head"});
  constexpr int kHips = 0, kChest = 3;
  if (is_whole) joints.push_back({"HeadEnd", head});
  for (const char* name : {"Jaw", "LeftEye", "RightEye"}) joints.push_back({name, head});
  for (const std::string side : {"Left", "Right"}) {
    const int hand = AddChain(joints, kChest, side, {"Shoulder", "Arm", "ForeArm", "Hand"});
    if (!is_whole) {
      for (const char* name : {"HandThumbEnd", "HandMiddleEnd"}) joints.push_back({side + name, hand});
      continue;
    }
    AddChain(joints, hand, side + "HandThumb", {"1", "2", "3", "End"});
    for (const char* finger : {"HandIndex", "HandMiddle", "HandRing", "HandPinky"})
      AddChain(joints, hand, side + finger, {"1", "2", "3", "4", "End"});
  }
  for (const std::string side : {"Left", "Right"}) {
    const int toes = AddChain(joints, kHips, side, {"Leg", "Shin", "Foot", "ToeBase"});
    if (is_whole) joints.push_back({side + "ToeEnd", toes});
  }
  return joints;
}

/// Returns Kimodo's skeleton of as many joints; somaskel30 for any other number.
SomaSkeleton SkeletonOf(std::size_t joints) {
  if (joints != kSmplJoints) return MakeSoma(joints == kWholeJoints);
  SomaSkeleton smpl;
  for (const Joint& joint : SmplSkeleton().joints) smpl.push_back({joint.name, joint.parent});
  smpl.resize(kSmplJoints);
  return smpl;
}

}  // namespace

bool IsKimodoNpz(const Npz& arrays) {
  return arrays.Find("posed_joints") != nullptr && arrays.Find("global_rot_mats") != nullptr;
}

Result<Clip> ReadKimodo(const Npz& arrays, const std::string& file, std::optional<double> told_hz,
                        std::vector<std::string>& remarks) {
  // Check the shapes and the values.
  const NumberArray &places = *arrays.Find("posed_joints"), &matrices = *arrays.Find("global_rot_mats");
  const std::size_t frames = places.shape.empty() ? 0 : places.shape[0];
  const SomaSkeleton soma = SkeletonOf(places.shape.size() > 1 ? places.shape[1] : 0);
  const std::size_t joints = soma.size();
  if (frames == 0 || places.shape != std::vector<std::size_t>{frames, joints, 3} ||
      matrices.shape != std::vector<std::size_t>{frames, joints, 3, 3}) {
    return Fail({file},
                "the shapes are {} for posed_joints and {} for global_rot_mats; allowed: frames × J × 3 and frames × J "
                "× 3 × 3, with J = 22, 30 or 77 (motions of robots, with 34 joints, are not supported)",
                ShapeText(places), ShapeText(matrices));
  }
  const auto place = [&](std::size_t frame, std::size_t joint) {
    const double* v = &places.values[3 * (frame * joints + joint)];
    return glm::dvec3(v[0], v[1], v[2]);
  };
  const auto matrix = [&](std::size_t frame, std::size_t joint) {
    const double* v = &matrices.values[9 * (frame * joints + joint)];  // nine numbers, row by row
    return glm::dmat3(v[0], v[3], v[6], v[1], v[4], v[7], v[2], v[5], v[8]);
  };
  constexpr double kRounding = 1e-3, kMaxPlace_m = 1e6;
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      const glm::dvec3 p = place(f, j);
      if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) <= kMaxPlace_m)) {
        return Fail({file}, "joint {} of frame {} is at ({}, {}, {}) m; allowed: coordinates within ±10⁶ m",
                    soma[j].name, f, p.x, p.y, p.z);
      }
      if (std::abs(glm::determinant(matrix(f, j)) - 1) <= kRounding) continue;
      return Fail({file}, "the matrix of joint {} in frame {} is not a rotation matrix", soma[j].name, f);
    }
  }
  // Find the rate.
  constexpr double kModelRate_hz = 30;
  std::optional<double> rate_hz = told_hz;
  if (!rate_hz) {
    std::string remark;
    ASSIGN_OR_RETURN(rate_hz, EvenRateOf(arrays, frames, file, remark));
    if (!rate_hz) remark = "the file states no frame rate, so Etude uses 30 Hz, the rate of Kimodo's model";
    if (!remark.empty()) remarks.push_back(remark);
  }
  // Make the skeleton at rest: the first frame's offsets, without rotations.
  Clip clip{.name = "kimodo", .skeleton = {}, .rate_hz = rate_hz.value_or(kModelRate_hz), .frames = {}};
  for (std::size_t j = 0; j < joints; ++j) {
    const int parent = soma[j].parent;
    Joint joint{.name = soma[j].name, .parent = parent, .rest = {}};
    if (parent >= 0) {
      joint.rest.translation = glm::transpose(matrix(0, parent)) * (place(0, j) - place(0, parent));
    }
    clip.skeleton.joints.push_back(std::move(joint));
  }
  // Make the frames: rotations relative to the parent.
  const LocalPose rest = RestPose(clip.skeleton);
  for (std::size_t f = 0; f < frames; ++f) {
    LocalPose& pose = clip.frames.emplace_back(rest);
    pose[0].translation = place(f, 0);
    for (std::size_t j = 0; j < joints; ++j) {
      const int parent = soma[j].parent;
      const glm::dmat3 above = parent < 0 ? glm::dmat3(1) : matrix(f, parent);
      pose[j].rotation = glm::normalize(glm::quat_cast(glm::transpose(above) * matrix(f, j)));
    }
  }
  return clip;
}

Result<std::optional<std::vector<bool>>> ReadFootContacts(const Npz& arrays, std::size_t frames,
                                                          const std::string& file) {
  const NumberArray* array = arrays.Find("foot_contacts");
  if (array == nullptr) return std::nullopt;
  if (array->shape != std::vector<std::size_t>{frames, 4}) {
    return Fail({file},
                "the shape of foot_contacts is {}; allowed: {} × 4 (left heel, left toes, right heel, right toes)",
                ShapeText(*array), frames);
  }
  std::vector<bool> contacts;
  for (const double value : array->values) contacts.push_back(value > 0.5);
  return contacts;
}

}  // namespace etude

#include "engine/formats/kimodo.h"

#include <cmath>


namespace etude {
namespace {

struct SomaJoint {
  const char* name;
  int parent;
};

/// somaskel30.
constexpr SomaJoint kSoma[] = {{"Hips", -1},
                               {"Spine1", 0},
                               {"Spine2", 1},
                               {"Chest", 2},
                               {"Neck1", 3},
                               {"Neck2", 4},
                               {"Head", 5},
                               {"Jaw", 6},
                               {"LeftEye", 6},
                               {"RightEye", 6},
                               {"LeftShoulder", 3},
                               {"LeftArm", 10},
                               {"LeftForeArm", 11},
                               {"LeftHand", 12},
                               {"LeftHandThumbEnd", 13},
                               {"LeftHandMiddleEnd", 13},
                               {"RightShoulder", 3},
                               {"RightArm", 16},
                               {"RightForeArm", 17},
                               {"RightHand", 18},
                               {"RightHandThumbEnd", 19},
                               {"RightHandMiddleEnd", 19},
                               {"LeftLeg", 0},
                               {"LeftShin", 22},
                               {"LeftFoot", 23},
                               {"LeftToeBase", 24},
                               {"RightLeg", 0},
                               {"RightShin", 26},
                               {"RightFoot", 27},
                               {"RightToeBase", 28}};
constexpr std::size_t kSomaJoints = std::size(kSoma);

}  // namespace

bool IsKimodoNpz(const Npz& arrays) {
  return arrays.Find("posed_joints") != nullptr && arrays.Find("global_rot_mats") != nullptr;
}

Result<Clip> ReadKimodo(const Npz& arrays, const std::string& file) {
  // Check the shapes and the values.
  const NumberArray &places = *arrays.Find("posed_joints"), &matrices = *arrays.Find("global_rot_mats");
  const std::size_t frames = places.shape.empty() ? 0 : places.shape[0];
  if (frames == 0 || places.shape != std::vector<std::size_t>{frames, kSomaJoints, 3} ||
      matrices.shape != std::vector<std::size_t>{frames, kSomaJoints, 3, 3}) {
    return Fail({file}, "posed_joints {}, global_rot_mats {}; allowed: frames × 30 × 3 and frames × 30 × 3 × 3",
                ShapeText(places), ShapeText(matrices));
  }
  const auto place = [&](std::size_t frame, std::size_t joint) {
    const double* v = &places.values[3 * (frame * kSomaJoints + joint)];
    return glm::dvec3(v[0], v[1], v[2]);
  };
  const auto matrix = [&](std::size_t frame, std::size_t joint) {
    const double* v = &matrices.values[9 * (frame * kSomaJoints + joint)];  // row by row
    return glm::dmat3(v[0], v[3], v[6], v[1], v[4], v[7], v[2], v[5], v[8]);
  };
  constexpr double kRounding = 1e-3, kMaxPlace_m = 1e6;
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < kSomaJoints; ++j) {
      const glm::dvec3 p = place(f, j);
      if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) <= kMaxPlace_m)) {
        return Fail({file}, "joint {} of frame {} is at {}, {}, {}; allowed: metres within ±10⁶", kSoma[j].name, f, p.x,
                    p.y, p.z);
      }
      if (std::abs(glm::determinant(matrix(f, j)) - 1) <= kRounding) continue;
      return Fail({file}, "the matrix of joint {} in frame {} is no rotation", kSoma[j].name, f);
    }
  }
  // The skeleton at rest: the first frame's offsets with no rotation.
  Clip clip{.name = "kimodo", .skeleton = {}, .rate_hz = 30, .frames = {}};
  for (std::size_t j = 0; j < kSomaJoints; ++j) {
    const int parent = kSoma[j].parent;
    Joint joint{.name = kSoma[j].name, .parent = parent, .rest = {}};
    if (parent >= 0) {
      joint.rest.translation = glm::transpose(matrix(0, parent)) * (place(0, j) - place(0, parent));
    }
    clip.skeleton.joints.push_back(std::move(joint));
  }
  // The frames: rotations relative to the parent.
  const LocalPose rest = RestPose(clip.skeleton);
  for (std::size_t f = 0; f < frames; ++f) {
    LocalPose& pose = clip.frames.emplace_back(rest);
    pose[0].translation = place(f, 0);
    for (std::size_t j = 0; j < kSomaJoints; ++j) {
      const int parent = kSoma[j].parent;
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
    return Fail({file}, "foot_contacts {}; allowed: {} × 4: left heel, left toes, right heel, right toes",
                ShapeText(*array), frames);
  }
  std::vector<bool> contacts;
  for (const double value : array->values) contacts.push_back(value > 0.5);
  return contacts;
}

}  // namespace etude

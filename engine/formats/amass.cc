#include "engine/formats/amass.h"

#include <array>
#include <cmath>
#include <optional>

#include "engine/base/angles.h"
#include "engine/formats/array_clock.h"

namespace etude {
namespace {

/// A joint of SMPL with its offset in our own T-pose: metres from the parent; X to the left, Y up, facing +Z. Segment
/// lengths follow Drillis and Contini (1966) for a height of 1.70 m.
struct SmplJoint {
  const char* name;
  int parent;
  glm::dvec3 offset;
  bool is_end_site = false;
};

constexpr std::size_t kJoints = 22;
const std::array<SmplJoint, kJoints + 5> kSmpl = {{{"pelvis", -1, {0, 0, 0}},
                                                   {"left_hip", 0, {0.09, -0.06, 0}},
                                                   {"right_hip", 0, {-0.09, -0.06, 0}},
                                                   {"spine1", 0, {0, 0.10, 0}},
                                                   {"left_knee", 1, {0, -0.4165, 0}},
                                                   {"right_knee", 2, {0, -0.4165, 0}},
                                                   {"spine2", 3, {0, 0.12, 0}},
                                                   {"left_ankle", 4, {0, -0.418, 0}},
                                                   {"right_ankle", 5, {0, -0.418, 0}},
                                                   {"spine3", 6, {0, 0.06, 0}},
                                                   {"left_foot", 7, {0.01, -0.045, 0.12}},
                                                   {"right_foot", 8, {-0.01, -0.045, 0.12}},
                                                   {"neck", 9, {0, 0.20, 0}},
                                                   {"left_collar", 9, {0.07, 0.11, 0}},
                                                   {"right_collar", 9, {-0.07, 0.11, 0}},
                                                   {"head", 12, {0, 0.085, 0.02}},
                                                   {"left_shoulder", 13, {0.11, 0.05, 0}},
                                                   {"right_shoulder", 14, {-0.11, 0.05, 0}},
                                                   {"left_elbow", 16, {0.30, 0, 0}},
                                                   {"right_elbow", 17, {-0.30, 0, 0}},
                                                   {"left_wrist", 18, {0.25, 0, 0}},
                                                   {"right_wrist", 19, {-0.25, 0, 0}},
                                                   {"head_end", 15, {0, 0.16, 0}, true},
                                                   {"left_foot_end", 10, {0, -0.01, 0.06}, true},
                                                   {"right_foot_end", 11, {0, -0.01, 0.06}, true},
                                                   {"left_hand_end", 20, {0.18, 0, 0}, true},
                                                   {"right_hand_end", 21, {-0.18, 0, 0}, true}}};

glm::dquat TurnOf(const double* axis_times_angle) {
  const glm::dvec3 turn(axis_times_angle[0], axis_times_angle[1], axis_times_angle[2]);
  const double angle = glm::length(turn);
  return angle > 0 ? glm::angleAxis(angle, turn / angle) : glm::dquat(1, 0, 0, 0);
}

/// Returns the number of values in a frame of an array of frames × values or frames × joints × 3; 0 for other arrays.
std::size_t WidthOf(const NumberArray* array) {
  if (array == nullptr) return 0;
  if (array->shape.size() == 3 && array->shape[2] == 3) return 3 * array->shape[1];
  return array->shape.size() == 2 ? array->shape[1] : 0;
}

}  // namespace

Skeleton SmplSkeleton() {
  Skeleton skeleton;
  for (const SmplJoint& joint : kSmpl) {
    skeleton.joints.push_back({.name = joint.name,
                               .parent = joint.parent,
                               .rest = {.translation = joint.offset},
                               .is_end_site = joint.is_end_site});
  }
  // The recordings have Z up and rotate the pelvis accordingly, so the rest pose rotates the pelvis in the same way.
  skeleton.joints.front().rest.rotation = glm::angleAxis(kPi / 2, glm::dvec3(1, 0, 0));
  return skeleton;
}

Result<Clip> ReadAmass(const Npz& npz, const std::string& file, std::optional<double> told_hz,
                       std::vector<std::string>* remarks) {
  // Find the arrays and check their shapes.
  const NumberArray *poses = npz.Find("poses"), *places = npz.Find("trans");
  const std::size_t width = WidthOf(poses);
  if ((width != 72 && width != 156 && width != 165) || WidthOf(places) != 3) {
    return Fail({file},
                "found the arrays {}; allowed: the arrays of AMASS (poses, frames × 72, 156 or 165; trans, frames × 3; "
                "mocap_framerate or mocap_frame_rate) or of Kimodo (posed_joints, global_rot_mats); save joint "
                "positions as a .npy file",
                NamesOfArrays(npz));
  }
  // Check frames, rate and values.
  const std::size_t frames = poses->shape[0];
  if (frames == 0) return Fail({file}, "no frames");
  if (places->shape[0] != frames) {
    return Fail({file}, "the array trans has {} frames, but the array poses has {}", places->shape[0], frames);
  }
  std::optional<double> stated_hz = told_hz;
  if (!told_hz) {
    std::string remark;
    ASSIGN_OR_RETURN(stated_hz, EvenRateOf(npz, frames, file, remark));
    if (remarks != nullptr && !remark.empty()) remarks->push_back(remark);
    if (!stated_hz) {
      return Fail(
          {file},
          "the file states no frame rate (its arrays: {}); allowed: the array mocap_framerate or mocap_frame_rate with "
          "the frames per second, or `--rate` (for `etude clip convert`: `--file-rate`; in a joint map: `rate: 60`)",
          NamesOfArrays(npz));
    }
  }
  constexpr double kMinRate_hz = 1, kMaxRate_hz = 10'000, kMaxValue = 1e6;
  const double rate_hz = *stated_hz;
  if (!(rate_hz >= kMinRate_hz && rate_hz <= kMaxRate_hz)) {
    return Fail({file}, "the rate is {} Hz; allowed: {} to {} Hz", rate_hz, kMinRate_hz, kMaxRate_hz);
  }
  for (const NumberArray* array : {poses, places}) {
    for (std::size_t i = 0; i < array->values.size(); ++i) {
      if (std::abs(array->values[i]) <= kMaxValue) continue;
      return Fail({file}, "array {}, frame {}: found {}; allowed: numbers within ±10⁶",
                  array == poses ? "poses" : "trans", i / WidthOf(array), array->values[i]);
    }
  }
  // A larger angle shows that rotations are in degrees instead of radians.
  constexpr double kMaxAngle = 4 * kPi;
  for (std::size_t t = 0; t < frames; ++t) {
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      const double* turn = &poses->values[t * width + 3 * joint];
      const double angle = glm::length(glm::dvec3(turn[0], turn[1], turn[2]));
      if (angle <= kMaxAngle) continue;
      return Fail({file},
                  "in frame {}, the array poses rotates {} by {:.4g} radians; allowed: at most 12.57 (4π); are the "
                  "values degrees?",
                  t, kSmpl[joint].name, angle);
    }
  }
  // Make the clip; rotations beyond the 22 body joints are left out.
  Clip clip{.name = "amass", .skeleton = SmplSkeleton(), .rate_hz = rate_hz, .frames = {}};
  const LocalPose rest = RestPose(clip.skeleton);
  for (std::size_t t = 0; t < frames; ++t) {
    LocalPose& pose = clip.frames.emplace_back(rest);
    for (int axis = 0; axis < 3; ++axis)
      pose[0].translation[axis] = places->values[3 * t + static_cast<std::size_t>(axis)];
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      pose[joint].rotation = TurnOf(&poses->values[t * width + 3 * joint]);
    }
  }
  return clip;
}

}  // namespace etude

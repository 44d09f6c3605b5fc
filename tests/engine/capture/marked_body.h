#pragma once

#include <cmath>
#include <vector>

#include "engine/base/angles.h"
#include "engine/cameras/camera.h"
#include "engine/kinematics/body_tree.h"
#include "engine/vision/strokes.h"

namespace etude {

/// Returns a state without straight limbs for each `phase`; near phases give near states.
inline TreeState ModelState(const KinematicTree& tree, double phase) {
  TreeState state = StandingState(tree);
  state.root_position = {0.1 * std::sin(phase), 0, 0.1 * std::cos(phase)};
  for (std::size_t i = 0; i < state.angles.size(); ++i) {
    const AngleRange& range = tree.limits[i];
    const double swing = 0.2 * std::sin(2.0 * static_cast<double>(i) + 1 + phase);
    state.angles[i] = 0.5 * (range.lower + range.upper) + swing * (range.upper - range.lower);
  }
  return state;
}

inline BodyPose ModelPose(double phase = 0) {
  const KinematicTree body = MakeBodyTree({});
  return ToBodyPose(body, ModelState(body, phase));
}

/// Returns a camera around the stage: 0° is in front of the body, 90° at its left hand.
inline ProjectionMatrix CameraAt(double degrees, double height) {
  const double a = Radians(degrees);
  return MatrixOf(LookAt({}, {3.8 * std::sin(a), height, 3.8 * std::cos(a)}, {0, 0.9, 0}));
}

/// Returns three cameras; no limb of a body in an everyday pose lies in a plane through all three. The first two stand
/// like paper B's pair.
inline std::vector<ProjectionMatrix> ThreeCameras() {
  return {CameraAt(-40, 1), CameraAt(40, 2.2), CameraAt(100, 1.5)};
}

/// Returns the marks of a perfect annotator on one picture.
inline Marks ExactMarks(const BodyPose& pose, const ProjectionMatrix& matrix) {
  Marks marks;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const auto& [from, to, first_half, second_half] = StrokeMarks()[i];
    marks.strokes[i] = PixelSegment{*Project(matrix, pose[from]), *Project(matrix, pose[to])};
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    marks.effectors[i] = Project(matrix, pose[EffectorMarks()[i].role]);
  }
  return marks;
}

/// Marks as `[camera][frame]`.
using TakeMarks = std::vector<std::vector<Marks>>;

inline TakeMarks ExactMarks(const std::vector<BodyPose>& poses, const std::vector<ProjectionMatrix>& cameras) {
  TakeMarks marks;
  for (const ProjectionMatrix& camera : cameras) {
    std::vector<Marks>& of_camera = marks.emplace_back();
    for (const BodyPose& pose : poses) of_camera.push_back(ExactMarks(pose, camera));
  }
  return marks;
}

/// Returns the unit vector along the limb that `mark` draws.
inline glm::dvec3 LimbOf(const BodyPose& pose, const StrokeMark& mark) {
  return glm::normalize(pose[mark.to] - pose[mark.from]);
}

}  // namespace etude

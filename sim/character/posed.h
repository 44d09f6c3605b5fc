#pragma once

#include <memory>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/to_body.h"
#include "sim/render/scene.h"

namespace etude {

/// Returns a character in a pose of its own skeleton, ready to be drawn: metres, Y up, transformed by `to_world`. For a
/// file's figure, `to_world` contains the units, axes and floor that ToBodyMotion has found.
Figure PosedFigure(const Character& character, const LocalPose& pose, const glm::dmat4& to_world = glm::dmat4(1));

/// Returns a character in a body's pose. The character must be bound to BodySkeleton(StandingPose()). It is scaled to
/// the body's proportions: each part to the length of the limb, and hips and chest to the distances between hip joints
/// and between shoulder joints. Set `is_closed` if all meshes are closed, as the meshes of the bear and the mannequin
/// are (`Surface::is_closed`).
Figure PosedFigure(const Character& character, const BodyPose& pose, bool is_closed = false);

/// Computes the joints in `pose` of a character bound to BodySkeleton(StandingPose()); the joints' axes are scaled to
/// the body's proportions.
std::vector<GlobalTransform> FilledGlobals(const Character& character, const BodyPose& pose);

/// Finds the part of the body that each joint of a skeleton moves: the part of the role that the joint's name states,
/// otherwise of the nearest ancestor with a role (an ear belongs to the head), otherwise the trunk.
std::vector<Part> PartsOfJoints(const Skeleton& skeleton);
/// Finds the part that each joint moves, for a file's skeleton with the roles of joints in `map`. Joints between neck
/// and head belong to the head unless they carry a shoulder.
std::vector<Part> PartsOfJoints(const Skeleton& skeleton, const JointMap& map);

/// Finds the part of each triangle: the part whose joints have the largest total weight at the triangle's corners.
std::vector<Part> PartsOfTriangles(const std::vector<Part>& parts_of_joints, const SkinnedMesh& mesh);

/// Makes one surface per mesh, with all data that do not depend on the pose.
std::vector<Surface> StillSurfaces(const Character& character, const std::vector<Part>& parts_of_joints);
/// Returns the figure in which the surfaces `still` are moved with the joints.
Figure FigureAt(const Character& character, const std::vector<Surface>& still,
                const std::vector<GlobalTransform>& globals);

/// Computes the joints of a skeleton's pose in world coordinates.
std::vector<GlobalTransform> GlobalsInWorld(const Skeleton& skeleton, const LocalPose& pose,
                                            const glm::dmat4& to_world);

/// The figure that a file contains besides a clip: the file's meshes and textures, which move on the file's own
/// skeleton as recorded.
class RecordedFigure {
 public:
  /// `clip` must be a clip of the character's skeleton; `map` and `body` must be the joint map and the conversion found
  /// for this clip.
  RecordedFigure(std::shared_ptr<const Character> character, Clip clip, const JointMap& map,
                 const BodyConversion& body);

  /// Returns the figure at a frame of the body's motion, which may be fractional (`SampleFrame`), moved along the floor
  /// by `move`.
  Figure At(double frame, const FloorMove& move = {}) const;

 private:
  std::shared_ptr<const Character> character_;
  Clip clip_;
  double first_ = 0;             // the clip's frame that became the motion's first frame
  double frames_per_frame_ = 1;  // frames of the clip per frame of the motion
  glm::dmat4 to_world_{1};
  std::vector<Surface> still_;  // one surface per mesh, with all data that do not depend on the pose
};

}  // namespace etude

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

/// Returns a character in a pose of its own skeleton, ready to be drawn: metres, Y up, moved as `to_world` says (of a
/// file's figure: the unit, axes and floor that ToBodyMotion has found).
Figure PosedFigure(const Character& character, const LocalPose& pose, const glm::dmat4& to_world = glm::dmat4(1));

/// Returns a character bound to BodySkeleton(StandingPose()) in a body's pose. A body of other proportions is filled
/// too: each part is as large as the limb that it clothes, hips and chest as wide as their joints are apart.
/// `is_closed`: its meshes are, as those of the bear and the mannequin (`Surface::is_closed`).
Figure PosedFigure(const Character& character, const BodyPose& pose, bool is_closed = false);

/// Computes the joints of such a character in `pose`; their axes are scaled as its limbs are.
std::vector<GlobalTransform> FilledGlobals(const Character& character, const BodyPose& pose);

/// Finds the part of the body that each joint of a skeleton moves: that of the role it is named after, else what the
/// nearest such joint upwards moves (an ear belongs to the head that it hangs from), else the trunk.
std::vector<Part> PartsOfJoints(const Skeleton& skeleton);
/// Finds these parts for a file's skeleton whose roles are in `map`; everything between neck and head is head, but what
/// carries a shoulder.
std::vector<Part> PartsOfJoints(const Skeleton& skeleton, const JointMap& map);

/// Finds the part that each triangle shows: the one whose joints move its corners most.
std::vector<Part> PartsOfTriangles(const std::vector<Part>& parts_of_joints, const SkinnedMesh& mesh);

/// Makes one surface per mesh with everything that no pose changes.
std::vector<Surface> StillSurfaces(const Character& character, const std::vector<Part>& parts_of_joints);
/// Moves those surfaces to where the joints take them.
Figure FigureAt(const Character& character, const std::vector<Surface>& still,
                const std::vector<GlobalTransform>& globals);

/// Computes the joints of a skeleton's pose in the world.
std::vector<GlobalTransform> GlobalsInWorld(const Skeleton& skeleton, const LocalPose& pose,
                                            const glm::dmat4& to_world);

/// The figure that a file brings along with its clip, moving as recorded: its meshes and textures on its own skeleton.
class RecordedFigure {
 public:
  /// Takes a clip of the character's skeleton, with the joint map and the body conversion that were found for it.
  RecordedFigure(std::shared_ptr<const Character> character, Clip clip, const JointMap& map,
                 const BodyConversion& body);

  /// Returns the figure at a frame of the body's motion, also between frames (`SampleFrame`), moved along the floor.
  Figure At(double frame, const FloorMove& move = {}) const;

 private:
  std::shared_ptr<const Character> character_;
  Clip clip_;
  double first_ = 0;             // the clip's frame that is the motion's first one
  double frames_per_frame_ = 1;  // of the clip, for one of the motion
  glm::dmat4 to_world_{1};
  std::vector<Surface> still_;  // one per mesh: all of it that no pose changes
};

}  // namespace etude

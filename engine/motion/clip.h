#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace etude {

/// A joint of a clip's own skeleton. Joints stand parents first; the root's parent is −1.
struct Joint {
  std::string name;
  int parent = -1;
  glm::dvec3 offset{0};      ///< from the parent in the rest pose, in the file's unit
  bool is_end_site = false;  ///< an end point without channels of its own (BVH "End Site")
};

struct Skeleton {
  std::vector<Joint> joints;

  /// The index of the joint of that name, or −1.
  int Find(const std::string& name) const;
};

/// A joint's place in its parent's frame.
struct LocalTransform {
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
};

/// One frame: a local transform for every joint of the skeleton.
using LocalPose = std::vector<LocalTransform>;

/// A motion clip with its own full skeleton, in its file's own unit and axes.
struct Clip {
  std::string name;
  Skeleton skeleton;
  double rate_hz = 30;
  std::vector<LocalPose> frames;
};

/// A joint's place in the world.
struct GlobalTransform {
  glm::dvec3 position{0};
  glm::dquat rotation{1, 0, 0, 0};
};

/// Forward kinematics of one frame: `out` gets one entry per joint.
void ComputeGlobals(const Skeleton& skeleton, const LocalPose& pose, std::vector<GlobalTransform>& out);

}  // namespace etude

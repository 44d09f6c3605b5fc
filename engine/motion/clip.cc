#include "engine/motion/clip.h"

namespace etude {

int Skeleton::Find(const std::string& name) const {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

LocalPose RestPose(const Skeleton& skeleton) {
  LocalPose rest;
  rest.reserve(skeleton.joints.size());
  for (const Joint& joint : skeleton.joints) rest.push_back(joint.rest);
  return rest;
}

void ComputeGlobals(const Skeleton& skeleton, const LocalPose& pose, std::vector<GlobalTransform>& out) {
  out.resize(skeleton.joints.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const LocalTransform& local = pose[i];
    glm::dmat3 axes = glm::mat3_cast(local.rotation);
    for (int k = 0; k < 3; ++k) axes[k] *= local.scale[k];
    const int parent = skeleton.joints[i].parent;
    if (parent < 0) {
      out[i] = {local.translation, axes};
    } else {
      const GlobalTransform& above = out[parent];
      out[i] = {above.position + above.axes * local.translation, above.axes * axes};
    }
  }
}

}  // namespace etude

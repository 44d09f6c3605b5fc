#include "engine/motion/clip.h"

namespace etude {

int Skeleton::Find(const std::string& name) const {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

void ComputeGlobals(const Skeleton& skeleton, const LocalPose& pose, std::vector<GlobalTransform>& out) {
  out.resize(skeleton.joints.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const int parent = skeleton.joints[i].parent;
    if (parent < 0) {
      out[i] = {pose[i].translation, pose[i].rotation};
    } else {
      const GlobalTransform& above = out[parent];
      out[i] = {above.position + above.rotation * pose[i].translation, above.rotation * pose[i].rotation};
    }
  }
}

}  // namespace etude

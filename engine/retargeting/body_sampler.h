#pragma once

#include <vector>

#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// Evaluates a clip's twenty joints at any time, in the file's unit and axes. Only the joints that carry a role are
/// looked at, and nothing is allocated per frame. `clip` must outlive this.
class BodySampler {
 public:
  BodySampler(const Clip& clip, const JointMap& map);

  BodyPose Rest();
  /// At a frame counted from 0, also between frames (SampleFrame); within the clip.
  BodyPose At(double frame);

 private:
  BodyPose Evaluated();

  const Clip& clip_;
  std::vector<int> joints_;  ///< of the clip: those with a role and all above them
  Skeleton skeleton_;        ///< of these joints alone
  JointMap map_;             ///< on that skeleton
  LocalPose local_;
  std::vector<GlobalTransform> globals_;
};

}  // namespace etude

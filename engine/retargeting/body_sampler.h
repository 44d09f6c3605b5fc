#pragma once

#include <cstddef>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// Evaluates a clip's twenty joints at any time, in the file's unit and axes. Only joints with a role and their
/// ancestors are evaluated, and no memory is allocated for a frame. `clip` must outlive this object.
class BodySampler {
 public:
  BodySampler(const Clip& clip, const JointMap& map);

  BodyPose Rest();
  /// Returns the pose at a frame number. The number counts from 0, may be fractional (SampleFrame), and must lie within
  /// the clip.
  BodyPose At(double frame);

 private:
  BodyPose Evaluated();

  const Clip& clip_;
  std::vector<int> joints_;  ///< indices in the clip: the joints with a role, and their ancestors
  Skeleton skeleton_;        ///< a skeleton of `joints_` only
  JointMap map_;             ///< the roles as joints of `skeleton_`
  LocalPose local_;
  std::vector<GlobalTransform> globals_;
};

/// Returns n such that every n-th frame gives about a hundred frames of the clip.
std::size_t SampleStep(const Clip& clip);
/// Samples the clip's joints at about a hundred frames, evenly spaced, in the file's axes.
std::vector<BodyPose> SampledPoses(const Clip& clip, BodySampler& sampler);

/// Poses of a clip that are sampled for FindUp: a tenth of a second apart, so that the person's steps show, but at most
/// a thousand poses.
struct UpSamples {
  std::vector<BodyPose> poses;
  double rate_hz = 0;
};
UpSamples SamplesForUp(const Clip& clip, BodySampler& sampler);

}  // namespace etude

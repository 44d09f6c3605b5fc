#include "engine/retargeting/body_sampler.h"

#include <algorithm>

namespace etude {

BodySampler::BodySampler(const Clip& clip, const JointMap& map) : clip_(clip), map_(map) {
  const std::vector<Joint>& all = clip.skeleton.joints;
  std::vector<bool> is_needed(all.size());
  for (const RolePoint& point : map.points) {
    for (int joint = point.joint; joint >= 0; joint = all[joint].parent) is_needed[joint] = true;
  }
  std::vector<int> index(all.size(), -1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_needed[i]) continue;
    index[i] = static_cast<int>(joints_.size());
    joints_.push_back(static_cast<int>(i));
    const int parent = all[i].parent;
    skeleton_.joints.push_back({.name = "", .parent = parent < 0 ? -1 : index[parent], .rest = all[i].rest});
  }
  for (RolePoint& point : map_.points) point.joint = index[point.joint];
  local_.resize(joints_.size());
}

BodyPose BodySampler::Rest() {
  for (std::size_t i = 0; i < joints_.size(); ++i) local_[i] = skeleton_.joints[i].rest;
  return Evaluated();
}

BodyPose BodySampler::At(double frame) {
  const auto index = static_cast<std::size_t>(frame);
  const double part = frame - static_cast<double>(index);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const LocalTransform& here = clip_.frames[index][joints_[i]];
    local_[i] = part == 0 ? here : Between(here, clip_.frames[index + 1][joints_[i]], part);
  }
  return Evaluated();
}

BodyPose BodySampler::Evaluated() {
  ComputeGlobals(skeleton_, local_, globals_);
  return Evaluate(map_, globals_);
}

std::size_t SampleStep(const Clip& clip) {
  constexpr std::size_t kSamples = 100;
  return 1 + clip.frames.size() / kSamples;
}

std::vector<BodyPose> SampledPoses(const Clip& clip, BodySampler& sampler) {
  std::vector<BodyPose> poses;
  for (std::size_t i = 0; i < clip.frames.size(); i += SampleStep(clip))
    poses.push_back(sampler.At(static_cast<double>(i)));
  return poses;
}

UpSamples SamplesForUp(const Clip& clip, BodySampler& sampler) {
  constexpr double kInterval_s = 0.1;
  constexpr std::size_t kMaxSamples = 1000;
  const auto apart = static_cast<std::size_t>(kInterval_s * clip.rate_hz);
  const std::size_t step = std::max({std::size_t{1}, apart, 1 + clip.frames.size() / kMaxSamples});
  UpSamples samples{.poses = {}, .rate_hz = clip.rate_hz / static_cast<double>(step)};
  for (std::size_t i = 0; i < clip.frames.size(); i += step)
    samples.poses.push_back(sampler.At(static_cast<double>(i)));
  return samples;
}

}  // namespace etude

#include "bench/training/training_clips.h"

#include <algorithm>

#include "sim/choreography/move.h"

namespace etude {
namespace {

std::vector<TrainingFrame> SampleFrames(const BodyMotion& motion, double standing_hip_height) {
  const int all = static_cast<int>(motion.poses.size());
  const int count = std::min(all, kFramesPerClip);
  std::vector<TrainingFrame> frames;
  for (int i = 0; i < count; ++i) {
    const BodyPose& pose = motion.poses[(2 * i + 1) * all / (2 * count)];
    frames.push_back({pose, ComputeFeatures(pose, standing_hip_height)});
  }
  return frames;
}

}  // namespace

TrainingClips SampleClips(std::vector<std::string> identities, std::span<const BodyMotion> clips,
                          const BodyProportions& proportions) {
  TrainingClips training{.identities = std::move(identities), .frames = {}};
  for (const BodyMotion& clip : PerformedBy(proportions, clips)) {
    training.frames.push_back(SampleFrames(clip, proportions.standing_hip_height));
  }
  return training;
}

Result<TrainingClips> GatherTrainingClips(std::span<const BodyMotion> clips, const std::vector<std::string>& identities,
                                          const BodyProportions& proportions) {
  std::vector<std::string> known;
  std::vector<BodyMotion> all;
  for (const std::string& name : BuiltinMoveNames()) {
    ASSIGN_OR_RETURN(auto move, LoadBuiltinMove(name));
    known.push_back("builtin:" + name);
    all.push_back(std::move(move.motion));
  }
  std::vector<std::size_t> others;
  std::vector<std::string> seen = known;
  for (std::size_t i = 0; i < identities.size(); ++i) {
    if (std::find(seen.begin(), seen.end(), identities[i]) != seen.end()) continue;
    seen.push_back(identities[i]);
    others.push_back(i);
  }
  const std::size_t wanted = std::min(others.size(), kMostTrainingClips - known.size());
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::size_t other = others[i * others.size() / wanted];
    known.push_back(identities[other]);
    all.push_back(clips[other]);
  }
  return SampleClips(std::move(known), all, proportions);
}

}  // namespace etude

#include "engine/fuzzy/fuzzy_motion.h"

namespace etude {

FuzzyMotion FuzzifyMotion(const BodyMotion& motion, double standing_hip_height, const FuzzySystem& system) {
  FuzzyMotion fuzzy{.rate_hz = motion.rate_hz, .features = {}, .grades = {}, .tags = {}, .poses = {}};
  for (const BodyPose& pose : motion.poses) {
    fuzzy.features.push_back(ComputeFeatures(pose, standing_hip_height));
    fuzzy.grades.push_back(Fuzzify(fuzzy.features.back(), system.memberships));
    fuzzy.tags.push_back(ChooseTags(fuzzy.grades.back()));
    const std::string* concluded = ChoosePose(system.rules, fuzzy.grades.back());
    fuzzy.poses.push_back(concluded == nullptr ? "" : *concluded);
  }
  return fuzzy;
}

}  // namespace etude

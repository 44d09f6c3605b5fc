#include "bench/model/recording.h"

#include <nlohmann/json.hpp>

#include "engine/base/named.h"

namespace etude {

Recording::Recording() = default;
Recording::Recording(std::vector<Track> motions, std::string extras)
    : tracks(std::move(motions)), extras_json(std::move(extras)) {}
Recording::Recording(const Recording&) = default;
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(const Recording&) = default;
Recording& Recording::operator=(Recording&&) noexcept = default;
Recording::~Recording() = default;

const BodyMotion* FindTrack(const Recording& recording, std::string_view name) {
  const Track* track = FindByName(recording.tracks, name);
  return track == nullptr ? nullptr : &track->motion;
}

Json EncodePose(const BodyPose& pose) {
  Json numbers = Json::array();
  for (const glm::dvec3& joint : pose.joints) {
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(joint[axis]);
  }
  return numbers;
}

void AddTo(Digest& digest, const BodyPose& pose) {
  for (const glm::dvec3& joint : pose.joints) digest.Add(joint.x).Add(joint.y).Add(joint.z);
}

}  // namespace etude

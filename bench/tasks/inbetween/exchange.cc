#include "bench/tasks/inbetween/exchange.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"

namespace etude {
namespace {

/// Encodes each pose as a list of numbers: the root's position, then one quaternion (w, x, y, z) per joint.
Json EncodePoses(std::span<const TreePose> poses) {
  Json encoded = Json::array();
  for (const TreePose& pose : poses) {
    Json& numbers = encoded.emplace_back(Json{pose.root.x, pose.root.y, pose.root.z});
    for (const glm::dquat& q : pose.turns) numbers.insert(numbers.end(), {q.w, q.x, q.y, q.z});
  }
  return encoded;
}

std::span<const TreePose> HiddenFrames(const HiddenWindow& hidden) {
  return std::span(hidden.motion.poses)
      .subspan(static_cast<std::size_t>(hidden.first), static_cast<std::size_t>(hidden.last - hidden.first + 1));
}

Result<TreePose> ReadPose(const Json& json, const std::string& path, std::size_t joints) {
  constexpr double kFarthest_m = 1e4, kOffLength = 0.01;
  ASSIGN_OR_RETURN(const auto numbers, ReadNumbers(json, path, 3 + 4 * joints, {-kFarthest_m, kFarthest_m}));
  TreePose pose{{numbers[0], numbers[1], numbers[2]}, {}};
  for (std::size_t at = 3; at < numbers.size(); at += 4) {
    const glm::dquat turn(numbers[at], numbers[at + 1], numbers[at + 2], numbers[at + 3]);
    if (std::abs(glm::length(turn) - 1) > kOffLength) {
      return Fail({}, "{}[{}…{}]: a quaternion of length {}; allowed: 1 ± {:g}", path, at, at + 3, glm::length(turn),
                  kOffLength);
    }
    pose.turns.push_back(glm::normalize(turn));
  }
  return pose;
}

}  // namespace

Payload GapPayload(const HiddenWindow& hidden, int given) {
  const std::span poses = hidden.motion.poses;
  Json offsets = Json::array();
  for (const glm::dvec3& offset : hidden.motion.tree.offsets) offsets.push_back({offset.x, offset.y, offset.z});
  const auto first = static_cast<std::size_t>(hidden.first), last = static_cast<std::size_t>(hidden.last);
  return PayloadOf({{"rate_hz", hidden.motion.rate_hz},
                    {"joints", hidden.motion.tree.names},
                    {"parents", hidden.motion.tree.parents},
                    {"offsets_m", std::move(offsets)},
                    {"gap", last - first + 1},
                    {"past", EncodePoses(poses.first(first))},
                    {"future", EncodePoses(poses.subspan(last + 1, static_cast<std::size_t>(given)))}});
}

Payload HiddenPayload(const HiddenWindow& hidden) { return PayloadOf({{"frames", EncodePoses(HiddenFrames(hidden))}}); }

Result<std::vector<TreePose>> ReadFrames(const Json& answer, const HiddenWindow& hidden) {
  AnswerFields fields(answer);
  const std::size_t missing = HiddenFrames(hidden).size();
  const Json& frames = fields.List("frames", missing, missing);
  RETURN_IF_ERROR(fields.Finish());
  std::vector<TreePose> read;
  for (std::size_t f = 0; f < missing; ++f) {
    ASSIGN_OR_RETURN(auto pose, ReadPose(frames[f], fields.PathOf("frames", f), hidden.motion.tree.size()));
    read.push_back(std::move(pose));
  }
  return read;
}

}  // namespace etude

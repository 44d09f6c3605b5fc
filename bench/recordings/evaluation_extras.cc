#include "bench/recordings/evaluation_extras.h"

#include <nlohmann/json.hpp>

namespace etude {
namespace {

using Json = nlohmann::ordered_json;

Json FramesOf(const RawMotion& motion) {
  Json frames = Json::array();
  for (std::size_t f = 0; f < motion.FrameCount(); ++f) {
    Json& numbers = frames.emplace_back(Json::array());
    for (std::size_t j = 0; j < motion.joints.size(); ++j) {
      const glm::dvec3& p = motion.At(f, j);
      for (int axis = 0; axis < 3; ++axis) numbers.push_back(IsSeen(p) ? Json(p[axis]) : Json());
    }
  }
  return frames;
}

Result<void> ReadFrames(const Json& frames, RawMotion& motion) {
  for (const Json& numbers : frames) {
    if (numbers.size() != 3 * motion.joints.size()) {
      return Fail({}, "found a frame of {} numbers for {} joints; needed: three numbers for each joint", numbers.size(),
                  motion.joints.size());
    }
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      motion.positions.push_back(
          numbers[i].is_null()
              ? NotSeen()
              : glm::dvec3(numbers[i].get<double>(), numbers[i + 1].get<double>(), numbers[i + 2].get<double>()));
    }
  }
  return {};
}

Result<EvaluationExtras> ToExtras(const Json& json) {
  EvaluationExtras extras;
  RawMotion& truth = extras.truth;
  truth.rate_hz = json.at("rate_hz").get<double>();
  truth.joints = json.at("joints").get<std::vector<std::string>>();
  truth.parents = json.at("parents").get<std::vector<int>>();
  const auto joints = static_cast<int>(truth.joints.size());
  if (joints == 0 || truth.parents.size() != truth.joints.size() || !(truth.rate_hz > 0)) {
    return Fail({},
                "found {} joints, {} parents and a frame rate of {} Hz; needed: at least one joint, one parent for "
                "each joint, and a rate above 0",
                joints, truth.parents.size(), truth.rate_hz);
  }
  for (const int parent : truth.parents) {
    if (parent < -1 || parent >= joints)
      return Fail(
          {},
          "found parent {}, but there are {} joints; allowed: the index of a joint, or -1 for a joint without a parent",
          parent, joints);
  }
  extras.answer = truth;
  RETURN_IF_ERROR(ReadFrames(json.at("truth"), truth));
  RETURN_IF_ERROR(ReadFrames(json.at("answer"), extras.answer));
  if (truth.positions.size() != extras.answer.positions.size())
    return Fail({}, "the two motions have different numbers of frames");
  return extras;
}

}  // namespace

std::string WriteEvaluationExtras(const EvaluationExtras& extras) {
  const RawMotion& truth = extras.truth;
  return Json{{"rate_hz", truth.rate_hz},
              {"joints", truth.joints},
              {"parents", truth.parents},
              {"truth", FramesOf(truth)},
              {"answer", FramesOf(extras.answer)}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<EvaluationExtras> ReadEvaluationExtras(std::string_view text) {
  try {
    return ToExtras(Json::parse(text));
  } catch (const Json::exception& error) {
    return Fail({}, "this recording of an evaluation cannot be read: {}", error.what());
  }
}

}  // namespace etude

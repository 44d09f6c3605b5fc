#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/names.h"
#include "engine/formats/json/json_text.h"
#include "engine/streams/bodies.h"
#include "engine/streams/format_readers.h"

namespace etude {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kAzureJoints = 32;
/// The number of each role's joint in the Azure Kinect's k4abt_joint_id_t, in the order of the roles.
constexpr std::array<std::size_t, kRoleCount> kJointOfRole = {0,  1,  3,  26,                  // trunk and head
                                                              5,  6,  7,  8,  12, 13, 14, 15,  // arms
                                                              18, 19, 20, 21, 22, 23, 24, 25};

/// A number of a list, or nothing.
std::optional<double> NumberAt(const Json& list, std::size_t i) {
  if (!list.is_array() || i >= list.size() || !list[i].is_number()) return std::nullopt;
  const double value = list[i].get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// K4ABT_JOINT_CONFIDENCE_*: 0 none, 1 low, 2 medium, 3 high. The offline processor itself writes none; recorders made
/// of it do, under one of these names.
const Json* ConfidencesOf(const Json& body) {
  for (const char* key : {"confidence_level", "confidence_levels", "joint_confidence"}) {
    const auto found = body.find(key);
    if (found != body.end() && found->is_array() && found->size() == kAzureJoints) return &*found;
  }
  return nullptr;
}

/// From the depth camera's space (X to its right, Y down, Z away from it, millimetres) to one with Y up in which a
/// person who faces it looks along +Z.
std::optional<glm::dvec3> PlaceAt(const Json& joint) {
  const auto x = NumberAt(joint, 0), y = NumberAt(joint, 1), z = NumberAt(joint, 2);
  if (!x || !y || !z || (*x == 0 && *y == 0 && *z == 0)) return std::nullopt;
  return glm::dvec3(*x, -*y, -*z);
}

class AzureReader {
 public:
  AzureReader(const Json& root, const std::string& file) : root_(root), file_(file) {}

  Result<StreamRecording> Read(const StreamReading& reading) {
    StreamRecording recording{.format = StreamFormat::kAzureKinect};
    const auto frames = root_.find("frames");
    if (frames == root_.end() || !frames->is_array()) {
      return Fail({file_}, "no list \"frames\"; allowed: JSON of the Azure Kinect body tracking's offline processor");
    }
    recording.rate_hz = reading.rate_hz.value_or(kJudgedRateHz);
    recording.tells_times = !reading.rate_hz && !frames->empty() && frames->front().contains("timestamp_usec");
    for (const Json& frame : *frames) RETURN_IF_ERROR(ReadFrame(frame, recording));
    recording.tells_states = tells_states_;
    RETURN_IF_ERROR(bodies_.Choose(reading, file_, recording));
    return recording;
  }

 private:
  Result<void> ReadFrame(const Json& frame, StreamRecording& recording) {
    const std::size_t t = recording.frames.size();
    RecordedFrame& recorded = recording.frames.emplace_back();
    recorded.time_s = static_cast<double>(t) / recording.rate_hz;
    const Json& bodies = frame.is_object() && frame.contains("bodies") ? frame["bodies"] : Json();
    if (!bodies.is_array()) return Fail({file_}, "frame {} has no list \"bodies\"", t);
    if (recording.tells_times) {
      const auto stamp = frame.find("timestamp_usec");
      if (stamp == frame.end() || !stamp->is_number()) return Fail({file_}, "frame {} has no \"timestamp_usec\"", t);
      recorded.time_s = stamp->get<double>() * 1e-6;
    }
    for (const Json& body : bodies) RETURN_IF_ERROR(ReadBody(body, t));
    return {};
  }

  Result<void> ReadBody(const Json& body, std::size_t t) {
    const bool has_joints = body.is_object() && body.contains("joint_positions");
    const std::size_t count = has_joints ? body["joint_positions"].size() : 0;
    if (count != kAzureJoints) {
      return Fail({file_}, "a body of frame {} has {} joint_positions; allowed: {}", t, count, kAzureJoints);
    }
    const Json* confidences = ConfidencesOf(body);
    tells_states_ = tells_states_ || confidences != nullptr;
    RolePlaces places;
    std::array<TrackingState, kRoleCount> states{};
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const std::size_t j = kJointOfRole[i];
      const double confidence = confidences == nullptr ? 2 : NumberAt(*confidences, j).value_or(0);
      if (confidence < 1) continue;
      places[i] = PlaceAt(body["joint_positions"][j]);
      if (confidence < 2) states[i] = TrackingState::kInferred;
    }
    const auto id = body.find("body_id");
    bodies_.Add(id != body.end() && id->is_number() ? id->dump() : "", t, places, states);
    return {};
  }

  const Json& root_;
  const std::string& file_;
  Bodies bodies_;
  bool tells_states_ = false;
};

}  // namespace

Result<StreamRecording> ReadAzureKinect(std::string_view text, const std::string& file, const StreamReading& reading) {
  ASSIGN_OR_RETURN(const Json root, ParseJsonText(text, file));
  try {
    return AzureReader(root, file).Read(reading);
  } catch (const Json::exception& error) {
    return Fail({file}, "JSON of another shape than the offline processor's: {}", error.what());
  }
}

}  // namespace etude

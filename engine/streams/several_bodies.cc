
#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/formats/json_text.h"
#include "engine/formats/text_scanner.h"
#include "engine/streams/bodies.h"
#include "engine/streams/format_readers.h"
#include "engine/streams/recording.h"

namespace etude {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kAzureJoints = 32;
/// The index of each role's joint in the Azure Kinect's k4abt_joint_id_t, in the order of the roles.
constexpr std::array<std::size_t, kRoleCount> kJointOfRole = {0,  1,  3,  26,                  // trunk and head
                                                              5,  6,  7,  8,  12, 13, 14, 15,  // arms
                                                              18, 19, 20, 21, 22, 23, 24, 25};

/// Returns the number at index `i` of a list; nullopt if there is no finite number.
std::optional<double> NumberAt(const Json& list, std::size_t i) {
  if (!list.is_array() || i >= list.size() || !list[i].is_number()) return std::nullopt;
  const double value = list[i].get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The ends of the names K4ABT_JOINT_CONFIDENCE_*; the index is the value.
constexpr std::string_view kConfidences[] = {"NONE", "LOW", "MEDIUM", "HIGH"};

/// Returns a confidence, which is written as a number or as its name; a value that is missing is 0, "none". Returns
/// nullopt for another name.
std::optional<double> ConfidenceAt(const Json& list, std::size_t i) {
  if (!list[i].is_string()) return NumberAt(list, i).value_or(0);
  const std::string name = InUpperCase(list[i].get<std::string>());
  const auto found = std::ranges::find(kConfidences, std::string_view(name).substr(name.rfind('_') + 1));
  if (found == std::end(kConfidences)) return std::nullopt;
  return static_cast<double>(found - std::begin(kConfidences));
}

/// Returns a body's confidences, K4ABT_JOINT_CONFIDENCE_* (0 none, 1 low, 2 medium, 3 high); null if the body has none.
/// The offline processor does not write confidences; recorders derived from this processor do, under one of these
/// names.
const Json* ConfidencesOf(const Json& body) {
  for (const char* key : {"confidence_level", "confidence_levels", "joint_confidence"}) {
    const auto found = body.find(key);
    if (found != body.end() && found->is_array() && found->size() == kAzureJoints) return &*found;
  }
  return nullptr;
}

/// Converts a position from the depth camera's space (X to the camera's right, Y down, Z away from the camera,
/// millimetres) to a space with Y up in which a person who faces the camera looks along +Z. Returns nullopt for a
/// missing position.
std::optional<glm::dvec3> PlaceAt(const Json& joint) {
  const auto x = NumberAt(joint, 0), y = NumberAt(joint, 1), z = NumberAt(joint, 2);
  if (!x || !y || !z || IsMissingPosition({*x, *y, *z})) return std::nullopt;
  return glm::dvec3(*x, -*y, -*z);
}

class AzureReader {
 public:
  AzureReader(const Json& root, const std::string& file) : root_(root), file_(file) {}

  Result<StreamRecording> Read(const StreamReading& reading) {
    StreamRecording recording{.format = StreamFormat::kAzureKinect};
    const auto frames = root_.find("frames");
    if (frames == root_.end() || !frames->is_array()) {
      return Fail({file_},
                  "the file has no list \"frames\"; allowed: JSON written by the offline processor of Azure Kinect "
                  "body tracking");
    }
    recording.rate_hz = reading.rate_hz.value_or(kJudgedRateHz);
    recording.records_times = !reading.rate_hz && !frames->empty() && frames->front().contains("timestamp_usec");
    for (const Json& frame : *frames) RETURN_IF_ERROR(ReadFrame(frame, recording));
    recording.records_states = tells_states_;
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
    if (recording.records_times) {
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
      return Fail({file_}, "a body in frame {} has {} joint_positions; allowed: {}", t, count, kAzureJoints);
    }
    const Json* confidences = ConfidencesOf(body);
    tells_states_ = tells_states_ || confidences != nullptr;
    RolePositions places;
    std::array<TrackingState, kRoleCount> states{};
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const std::size_t j = kJointOfRole[i];
      const auto confidence = confidences == nullptr ? std::optional(2.0) : ConfidenceAt(*confidences, j);
      if (!confidence) {
        return Fail({file_},
                    "a body in frame {} has the confidence level {}; allowed: 0 to 3, or K4ABT_JOINT_CONFIDENCE_NONE, "
                    "_LOW, _MEDIUM or _HIGH",
                    t, Quote((*confidences)[j].get<std::string>()));
      }
      if (*confidence < 1) continue;
      places[i] = PlaceAt(body["joint_positions"][j]);
      if (*confidence < 2) states[i] = TrackingState::kInferred;
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

/// Reads NTU RGB+D's text: the number of frames; for each frame the number of bodies; for each body its id, nine
/// numbers, the number of joints (25, in the Kinect v2's order), and for each joint x y z in metres, two pixels, a
/// quaternion and the SDK's tracking state (Shahroudy et al. 2016, the data set's read_skeleton_file).
class NtuReader {
 public:
  NtuReader(std::string_view text, const std::string& file) : scanner_(text, file), file_(file) {}

  Result<StreamRecording> Read(const StreamReading& reading) {
    constexpr int kMaxFrames = 1'000'000, kMaxBodies = 100;
    StreamRecording recording{.format = StreamFormat::kNtu, .records_states = true};
    recording.rate_hz = reading.rate_hz.value_or(kJudgedRateHz);
    ASSIGN_OR_RETURN(const int frames, Count("the number of frames", 1, kMaxFrames));
    for (int t = 0; t < frames; ++t) {
      recording.frames.push_back({.time_s = t / recording.rate_hz});
      ASSIGN_OR_RETURN(const int bodies, Count("the number of bodies", 0, kMaxBodies));
      recording.frames.back().line = line_;
      for (int b = 0; b < bodies; ++b) RETURN_IF_ERROR(ReadBody(static_cast<std::size_t>(t)));
    }
    RETURN_IF_ERROR(bodies_.Choose(reading, file_, recording));
    return recording;
  }

 private:
  Result<int> Count(std::string_view what, int least, int most) {
    const Token token = scanner_.Next();
    line_ = token.line;
    ASSIGN_OR_RETURN(const double value, scanner_.Number(token, what));
    if (value != std::floor(value) || value < least || value > most) {
      return Fail(scanner_.At(token), "{} as {}; allowed: {} to {}", token.text, what, least, most);
    }
    return static_cast<int>(value);
  }

  Result<void> ReadBody(std::size_t frame) {
    const std::string_view id = scanner_.Next().text;
    for (int i = 0; i < 9; ++i) RETURN_IF_ERROR(scanner_.Number(scanner_.Next(), "a body's value"));
    constexpr int kJoints = static_cast<int>(kKinectV2JointCount);
    RETURN_IF_ERROR(Count("the number of joints", kJoints, kJoints));
    std::array<Joint, kKinectV2JointCount> joints;
    for (Joint& read : joints) {
      ASSIGN_OR_RETURN(read, ReadJoint());
    }
    RolePositions places;
    std::array<TrackingState, kRoleCount> states{};
    for (const Role role : AllRoles()) {
      const Joint& joint = joints[KinectV2JointOf(role)];
      places[Index(role)] = joint.place;
      states[Index(role)] = joint.state;
    }
    bodies_.Add(id, frame, places, states);
    return {};
  }

  struct Joint {
    std::optional<glm::dvec3> place;
    TrackingState state = TrackingState::kTracked;
  };

  /// Reads one joint. A NaN means that the joint was not reported.
  Result<Joint> ReadJoint() {
    std::array<double, 12> values{};
    bool is_missing = false;
    for (double& value : values) {
      const Token token = scanner_.Next();
      if (token.text == "nan" || token.text == "NaN" || token.text == "-nan") {
        is_missing = true;
        continue;
      }
      ASSIGN_OR_RETURN(value, scanner_.Number(token, "a joint's value"));
    }
    const glm::dvec3 p(values[0], values[1], values[2]);
    const double state = values[11];
    Joint joint;
    if (is_missing || IsMissingPosition(p) || state == 0) return joint;
    joint.place = glm::dvec3(-p.x, p.y, -p.z);  // converted as in kinect_rows.cc (FromSensor)
    if (state == 1) joint.state = TrackingState::kInferred;
    return joint;
  }

  TextScanner scanner_;
  const std::string& file_;
  Bodies bodies_;
  int line_ = 0;
};

}  // namespace

Result<StreamRecording> ReadAzureKinect(std::string_view text, const std::string& file, const StreamReading& reading) {
  ASSIGN_OR_RETURN(const Json root, ParseJsonText(text, file));
  try {
    return AzureReader(root, file).Read(reading);
  } catch (const Json::exception& error) {
    return Fail({file}, "this is not JSON written by the offline processor of Azure Kinect body tracking: {}",
                error.what());
  }
}

Result<StreamRecording> ReadNtuSkeleton(std::string_view text, const std::string& file, const StreamReading& reading) {
  return NtuReader(text, file).Read(reading);
}

}  // namespace etude

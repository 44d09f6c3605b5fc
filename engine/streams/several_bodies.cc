#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/formats/json_text.h"
#include "engine/formats/text_scanner.h"
#include "engine/streams/format_readers.h"
#include "engine/streams/recording.h"

namespace etude {
namespace {

/// The people of one file, distinguished by the file's identifiers of bodies.
class Bodies {
 public:
  /// Adds a frame in which the body `id` is seen. `frame` is the frame's index in the file.
  void Add(std::string_view id, std::size_t frame, const RolePositions& places,
           const std::array<TrackingState, kRoleCount>& states);

  /// Copies one body into the recording's frames: the requested body, counted by first appearance, or, without a
  /// request, the body in most frames. Of bodies in equally many frames, takes the body that moves most, because
  /// sensors sometimes take furniture for a person. Calls JoinContinued before it chooses.
  Result<void> Choose(const StreamReading& reading, const std::string& file, StreamRecording& recording);

 private:
  struct Seen {
    std::size_t frame;
    RolePositions places;
    std::array<TrackingState, kRoleCount> states;
  };
  struct Body {
    std::string id;
    std::vector<Seen> frames;
  };

  /// Joins bodies that are one person (ours): a tracker that loses a person for a moment gives the person a new
  /// identifier. The second body must appear at most a second after the first body disappears, and the joints of the
  /// two must then be at most half a trunk apart on average. The nearest pair is joined first, and a body continues at
  /// most one other body. A remark reports each pair.
  void JoinContinued(StreamRecording& recording);

  static double PathOf(const Body& body);
  static std::optional<double> GapInTrunks(const Seen& before, const Seen& after);

  std::vector<Body> bodies_;
};

void Bodies::Add(std::string_view id, std::size_t frame, const RolePositions& places,
                 const std::array<TrackingState, kRoleCount>& states) {
  auto body = std::ranges::find(bodies_, id, &Body::id);
  if (body == bodies_.end()) body = bodies_.insert(bodies_.end(), Body{std::string(id), {}});
  body->frames.push_back({frame, places, states});
}

/// Returns the total length of the paths of all joints, in the file's unit.
double Bodies::PathOf(const Body& body) {
  double path = 0;
  for (std::size_t t = 1; t < body.frames.size(); ++t) {
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const auto &before = body.frames[t - 1].places[i], &now = body.frames[t].places[i];
      if (before && now) path += glm::distance(*before, *now);
    }
  }
  return path;
}

/// Returns the mean distance, in trunk lengths, between the joints that are in both frames; nullopt if a frame lacks
/// the trunk.
std::optional<double> Bodies::GapInTrunks(const Seen& before, const Seen& after) {
  const auto &hips = before.places[Index(Role::kHipCentre)], &neck = before.places[Index(Role::kShoulderCentre)];
  double sum = 0;
  int joints = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (!before.places[i] || !after.places[i]) continue;
    sum += glm::distance(*before.places[i], *after.places[i]);
    ++joints;
  }
  if (joints == 0 || !hips || !neck || *hips == *neck) return std::nullopt;
  return sum / joints / glm::distance(*hips, *neck);
}

void Bodies::JoinContinued(StreamRecording& recording) {
  constexpr double kMaxBreak_s = 1, kMaxGap = 0.5;
  struct Pair {
    double gap;
    std::size_t before, after;
  };
  // Collect the pairs in which the second body can continue the first.
  std::vector<Pair> pairs;
  const auto begin_of = [](const Body& body) { return body.frames.front().frame; };
  for (std::size_t a = 0; a < bodies_.size(); ++a) {
    const Seen& end = bodies_[a].frames.back();
    const auto first = std::ranges::upper_bound(bodies_, end.frame, {}, begin_of);  // sorted by first appearance
    for (auto b = static_cast<std::size_t>(first - bodies_.begin()); b < bodies_.size(); ++b) {
      const Seen& begin = bodies_[b].frames.front();
      if (recording.frames[begin.frame].time_s - recording.frames[end.frame].time_s > kMaxBreak_s) break;
      const auto gap = GapInTrunks(end, begin);
      if (gap && *gap <= kMaxGap) pairs.push_back({*gap, a, b});
    }
  }
  // Accept the nearest pairs first.
  std::ranges::stable_sort(pairs, {}, &Pair::gap);
  std::vector<std::optional<std::size_t>> next(bodies_.size());
  std::vector<bool> continues(bodies_.size(), false);
  for (const Pair& pair : pairs) {
    if (next[pair.before] || continues[pair.after]) continue;
    next[pair.before] = pair.after;
    continues[pair.after] = true;
  }
  // Join the bodies of each chain of accepted pairs.
  std::vector<Body> joined;
  for (std::size_t a = 0; a < bodies_.size(); ++a) {
    if (continues[a]) continue;
    Body body = std::move(bodies_[a]);
    for (auto b = next[a]; b; b = next[*b]) {
      const Body& later = bodies_[*b];
      recording.remarks.push_back(
          fmt::format("body {} continues as body {} from frame {} on; both are read as one person", body.id, later.id,
                      begin_of(later)));
      body.frames.insert(body.frames.end(), later.frames.begin(), later.frames.end());
      body.id = later.id;
    }
    joined.push_back(std::move(body));
  }
  bodies_ = std::move(joined);
}

Result<void> Bodies::Choose(const StreamReading& reading, const std::string& file, StreamRecording& recording) {
  if (bodies_.empty()) return {};
  JoinContinued(recording);
  // Choose the requested body, or the most frequent one.
  std::size_t chosen = 0;
  if (reading.body) {
    chosen = static_cast<std::size_t>(*reading.body);
    if (chosen >= bodies_.size())
      return Fail({file}, "there is no body {}; bodies in the file, counted from 0: {}", chosen, bodies_.size());
  } else {
    for (std::size_t b = 1; b < bodies_.size(); ++b) {
      const std::size_t most = bodies_[chosen].frames.size(), here = bodies_[b].frames.size();
      if (here > most || (here == most && PathOf(bodies_[b]) > PathOf(bodies_[chosen]))) chosen = b;
    }
  }
  if (bodies_.size() > 1) {
    recording.remarks.push_back(fmt::format("the file has {} bodies; body {} is read{}", bodies_.size(), chosen,
                                            reading.body ? "" : ", which is in the most frames"));
  }
  // Copy the joints of the chosen body to the recording.
  for (const Seen& seen : bodies_[chosen].frames) {
    recording.frames[seen.frame].places = seen.places;
    recording.frames[seen.frame].states = seen.states;
  }
  return {};
}

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
  if (!x || !y || !z || IsNoPlace({*x, *y, *z})) return std::nullopt;
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
      return Fail({file_}, "a body of frame {} has {} joint_positions; allowed: {}", t, count, kAzureJoints);
    }
    const Json* confidences = ConfidencesOf(body);
    tells_states_ = tells_states_ || confidences != nullptr;
    RolePositions places;
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
    return Fail({file}, "not JSON of the Azure Kinect body tracking's offline processor: {}", error.what());
  }
}

namespace {

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
    if (is_missing || IsNoPlace(p) || state == 0) return joint;
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

Result<StreamRecording> ReadNtuSkeleton(std::string_view text, const std::string& file, const StreamReading& reading) {
  return NtuReader(text, file).Read(reading);
}

}  // namespace etude

#include <cmath>

#include "engine/base/names.h"
#include "engine/formats/text_scanner.h"
#include "engine/streams/bodies.h"
#include "engine/streams/format_readers.h"

namespace etude {
namespace {

/// NTU RGB+D's text: the number of frames; of each frame the number of bodies; of each body its id and nine numbers,
/// the number of joints (25, the Kinect v2's order), and of each joint x y z in metres, two pixels, a quaternion and
/// the SDK's tracking state (Shahroudy et al. 2016, the data set's read_skeleton_file).
class NtuReader {
 public:
  NtuReader(std::string_view text, const std::string& file) : scanner_(text, file), file_(file) {}

  Result<StreamRecording> Read(const StreamReading& reading) {
    constexpr int kMostFrames = 1'000'000, kMostBodies = 100;
    StreamRecording recording{.format = StreamFormat::kNtu, .tells_states = true};
    recording.rate_hz = reading.rate_hz.value_or(kJudgedRateHz);
    ASSIGN_OR_RETURN(const int frames, Count("the number of frames", 1, kMostFrames));
    for (int t = 0; t < frames; ++t) {
      recording.frames.push_back({.time_s = t / recording.rate_hz});
      ASSIGN_OR_RETURN(const int bodies, Count("the number of bodies", 0, kMostBodies));
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
    RolePlaces places;
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

  /// A place may be nan: a joint that was not reported.
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
    if (is_missing || p == glm::dvec3(0) || state == 0) return joint;
    joint.place = glm::dvec3(-p.x, p.y, -p.z);  // as ReadKinectRows
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

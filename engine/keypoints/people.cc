#include "engine/keypoints/people.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "engine/base/named.h"
#include "engine/base/text.h"
#include "engine/vision/strokes.h"

namespace etude {
namespace {

constexpr std::array<std::string_view, kLandmarkCount> kNames = {
    "Nose",      "LEye",  "REye",    "LEar",      "REar",  "LShoulder", "RShoulder", "LElbow", "RElbow", "LWrist",
    "RWrist",    "LHip",  "RHip",    "LKnee",     "RKnee", "LAnkle",    "RAnkle",    "Neck",   "Head",   "LBigToe",
    "LSmallToe", "LHeel", "RBigToe", "RSmallToe", "RHeel", "MidHip",    "LHand",     "RHand"};

/// Parses a list of landmark names, separated by blanks; "-" stands for no landmark.
std::vector<Landmark> Listed(std::string_view names) {
  std::vector<Landmark> landmarks;
  for (const std::string_view name : SplitAt(names, ' ')) {
    landmarks.push_back(FindLandmark(name).value_or(Landmark::kNoLandmark));
  }
  return landmarks;
}

}  // namespace

std::string_view LandmarkName(Landmark landmark) { return kNames[Index(landmark)]; }

std::optional<Landmark> FindLandmark(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Landmark>(found - kNames.begin());
}

std::span<const KeypointLayout> KeypointLayouts() {
  constexpr std::size_t kFaceAndHands = 68 + 42;
  static const std::vector<KeypointLayout> layouts = {
      // Each list names the landmark at each index of an estimator's output; "-" is a point that is not used.
      {"coco",
       Listed("Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
              "RAnkle")},
      {"body_25",
       Listed("Nose Neck RShoulder RElbow RWrist LShoulder LElbow LWrist MidHip RHip RKnee RAnkle LHip LKnee LAnkle "
              "REye LEye REar LEar LBigToe LSmallToe LHeel RBigToe RSmallToe RHeel")},
      {"body_25b",
       Listed("Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
              "RAnkle Neck Head LBigToe LSmallToe LHeel RBigToe RSmallToe RHeel")},
      {"halpe_26",
       Listed("Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
              "RAnkle Head Neck MidHip LBigToe RBigToe LSmallToe RSmallToe LHeel RHeel")},
      {"halpe_26_hands",
       Listed("Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
              "RAnkle Head Neck MidHip LBigToe RBigToe LSmallToe RSmallToe LHeel RHeel LHand RHand")},
      {"coco_18",
       Listed("Nose Neck RShoulder RElbow RWrist LShoulder LElbow LWrist RHip RKnee RAnkle LHip LKnee LAnkle REye LEye "
              "REar LEar")},
      {"mediapipe",
       Listed("Nose - LEye - - REye - LEar REar - - LShoulder RShoulder LElbow RElbow LWrist RWrist - - - - - - LHip "
              "RHip LKnee RKnee LAnkle RAnkle LHeel RHeel LBigToe RBigToe")},
      {"h36m",
       Listed("MidHip RHip RKnee RAnkle LHip LKnee LAnkle - Neck - Head LShoulder LElbow LWrist RShoulder RElbow "
              "RWrist"),
       0, true},
      {"trt_pose",
       Listed("Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
              "RAnkle Neck"),
       0, true},
      // The following layouts have more points, of face and hands, which are ignored.
      {"coco_wholebody",
       Listed("Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
              "RAnkle LBigToe LSmallToe LHeel RBigToe RSmallToe RHeel"),
       kFaceAndHands},
      {"halpe_136",
       Listed("Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
              "RAnkle Head Neck MidHip LBigToe RBigToe LSmallToe RSmallToe LHeel RHeel"),
       kFaceAndHands},
  };
  return layouts;
}

std::vector<std::string> KeypointLayoutNames() { return NamesOf(KeypointLayouts()); }

const KeypointLayout* FindKeypointLayout(std::string_view name) { return FindByName(KeypointLayouts(), name); }

Landmark LandmarkOfName(std::string_view name) {
  std::string bare;
  for (const char c : name) {
    if (IsLower(c) || IsUpper(c)) bare += ToLower(c);
  }
  // Handle names that differ from ours by more than the word for the side.
  if (bare == "midhip" || bare == "hip" || bare == "pelvis" || bare == "root") return Landmark::kMidHip;
  if (bare == "headtop" || bare == "tophead") return Landmark::kHead;
  // Replace "left" and "right" by one letter in front of the name.
  for (const std::string_view side : {"left", "right"}) {
    if (bare.starts_with(side)) bare = std::string(side.substr(0, 1)) + std::string(bare.substr(side.size()));
    if (bare.ends_with(side))
      bare = std::string(side.substr(0, 1)) + std::string(bare.substr(0, bare.size() - side.size()));
  }
  for (const std::string_view side : {"l", "r"}) {
    if (bare == std::string(side) + "footindex") bare = std::string(side) + "bigtoe";
  }
  // A side may also be one letter at the end: "shoulder.L".
  const bool has_side_at_end = bare.ends_with('l') || bare.ends_with('r');
  const std::string turned = has_side_at_end ? bare.back() + bare.substr(0, bare.size() - 1) : bare;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (const std::string own = InLowerCase(std::string(kNames[i])); own == bare || own == turned)
      return static_cast<Landmark>(i);
  }
  return Landmark::kNoLandmark;
}

double HeightPx(const SeenPerson& person) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Keypoint& keypoint : person.keypoints) {
    if (keypoint.confidence <= 0) continue;
    low = std::min(low, keypoint.pixel.y);
    high = std::max(high, keypoint.pixel.y);
  }
  return std::max(0.0, high - low);
}

std::optional<Landmark> LandmarkAt(Role role) {
  if (role == Role::kShoulderCentre) return Landmark::kNeck;
  if (role == Role::kHead) return Landmark::kHead;
  for (const auto& [landmark, at] : kJointLandmarks) {
    if (at == role) return landmark;
  }
  return std::nullopt;
}

SeenPerson PersonOf(const Marks& marks) {
  std::array<glm::dvec2, kLandmarkCount> sums{};
  std::array<int, kLandmarkCount> counts{};
  const auto add = [&](Role role, const glm::dvec2& pixel) {
    if (const auto landmark = LandmarkAt(role)) {
      sums[Index(*landmark)] += pixel;
      ++counts[Index(*landmark)];
    }
  };
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!marks.strokes[i]) continue;
    add(StrokeMarks()[i].from, marks.strokes[i]->a);
    add(StrokeMarks()[i].to, marks.strokes[i]->b);
  }
  SeenPerson person;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (counts[i] > 0) person.keypoints[i] = {sums[i] / static_cast<double>(counts[i]), 1};
  }
  // Replace a stroke's end by the end effector's disc, which is more accurate.
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    const auto landmark = LandmarkAt(EffectorMarks()[i].role);
    if (marks.effectors[i] && landmark) person[*landmark] = {*marks.effectors[i], 1};
  }
  return person;
}

}  // namespace etude

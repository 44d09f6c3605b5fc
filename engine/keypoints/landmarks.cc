#include "engine/keypoints/landmarks.h"

#include <algorithm>
#include <array>

namespace etude {
namespace {

constexpr std::array<std::string_view, kLandmarkCount> kNames = {
    "Nose",      "LEye",  "REye",    "LEar",      "REar",  "LShoulder", "RShoulder", "LElbow", "RElbow", "LWrist",
    "RWrist",    "LHip",  "RHip",    "LKnee",     "RKnee", "LAnkle",    "RAnkle",    "Neck",   "Head",   "LBigToe",
    "LSmallToe", "LHeel", "RBigToe", "RSmallToe", "RHeel", "MidHip",    "LHand",     "RHand"};

/// The landmarks of a list of their names, apart by blanks.
std::vector<Landmark> Listed(std::string_view names) {
  std::vector<Landmark> landmarks;
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(' '), names.size());
    landmarks.push_back(*FindLandmark(names.substr(0, end)));
    names.remove_prefix(std::min(end + 1, names.size()));
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
  static const std::vector<KeypointLayout> layouts = {
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
  };
  return layouts;
}

std::vector<std::string> KeypointLayoutNames() {
  std::vector<std::string> names;
  for (const KeypointLayout& layout : KeypointLayouts()) names.push_back(layout.name);
  return names;
}

const KeypointLayout* FindKeypointLayout(std::string_view name) {
  const auto layouts = KeypointLayouts();
  const auto found = std::ranges::find(layouts, name, &KeypointLayout::name);
  return found == layouts.end() ? nullptr : &*found;
}

}  // namespace etude

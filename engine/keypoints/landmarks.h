#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// Places of a body that estimators of keypoints know, and the finger tips that marks tell. Left is the person's own.
enum class Landmark {
  kNose,
  kLeftEye,
  kRightEye,
  kLeftEar,
  kRightEar,
  kLeftShoulder,
  kRightShoulder,
  kLeftElbow,
  kRightElbow,
  kLeftWrist,
  kRightWrist,
  kLeftHip,
  kRightHip,
  kLeftKnee,
  kRightKnee,
  kLeftAnkle,
  kRightAnkle,
  kNeck,
  kHead,  ///< its top
  kLeftBigToe,
  kLeftSmallToe,
  kLeftHeel,
  kRightBigToe,
  kRightSmallToe,
  kRightHeel,
  kMidHip,
  kLeftHand,
  kRightHand,
};

constexpr std::size_t kLandmarkCount = 28;

constexpr std::size_t Index(Landmark landmark) { return static_cast<std::size_t>(landmark); }

/// "RHip", "LBigToe", …: as OpenPose and Pose2Sim call them.
std::string_view LandmarkName(Landmark landmark);
std::optional<Landmark> FindLandmark(std::string_view name);

/// Which landmark each number of an estimator's list of keypoints is.
struct KeypointLayout {
  std::string name;
  std::vector<Landmark> landmarks;
};

/// "coco" (17 points), "body_25" and "body_25b" (25 each, in different orders; OpenPose), "halpe_26"; "halpe_26_hands"
/// (ours): the same and the finger tips, which are all landmarks, as `etude export` writes marks.
std::span<const KeypointLayout> KeypointLayouts();
std::vector<std::string> KeypointLayoutNames();
/// Null when there is none of that name.
const KeypointLayout* FindKeypointLayout(std::string_view name);

}  // namespace etude

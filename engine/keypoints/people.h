#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

struct Marks;

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
  kNoLandmark,  ///< in layouts: a point that nothing here needs
};

constexpr std::size_t kLandmarkCount = 28;

constexpr std::size_t Index(Landmark landmark) { return static_cast<std::size_t>(landmark); }

/// Returns the name that OpenPose and Pose2Sim use: "RHip", "LBigToe", …
std::string_view LandmarkName(Landmark landmark);
std::optional<Landmark> FindLandmark(std::string_view name);

/// The order of the landmarks in an estimator's list of keypoints.
struct KeypointLayout {
  std::string name;
  std::vector<Landmark> landmarks;
  std::size_t more = 0;  ///< points of face and hands that follow, and are passed over
};

/// Returns all layouts: "coco" (17 points), "coco_18" (OpenPose's), "body_25" and "body_25b" (25 each, in different
/// orders; OpenPose), "halpe_26", "mediapipe" (33), "coco_wholebody" (133), "halpe_136"; "halpe_26_hands" (ours):
/// halpe_26 and the finger tips, which are all landmarks, as `etude export` writes marks.
std::span<const KeypointLayout> KeypointLayouts();
std::vector<std::string> KeypointLayoutNames();
/// Finds a layout by its name; null when there is none.
const KeypointLayout* FindKeypointLayout(std::string_view name);

/// Finds the landmark that estimators give one of these names, whatever its case and breaks: "left_shoulder",
/// "LShoulder", "Left Big Toe", "mid_hip"; kNoLandmark for other names.
Landmark LandmarkOfName(std::string_view name);

/// The pixel at which a picture shows a landmark, and the estimator's confidence: 0 = not seen, 1 = sure.
struct Keypoint {
  glm::dvec2 pixel{0};
  double confidence = 0;
};

/// One person in one picture.
struct SeenPerson {
  std::array<Keypoint, kLandmarkCount> keypoints;

  Keypoint& operator[](Landmark landmark) { return keypoints[Index(landmark)]; }
  const Keypoint& operator[](Landmark landmark) const { return keypoints[Index(landmark)]; }
};

/// Everybody in each frame of one camera, in no order.
using SeenPeople = std::vector<std::vector<SeenPerson>>;

/// Returns the height of the box around all keypoints that were seen, pixels; 0 when none was.
double HeightPx(const SeenPerson& person);

/// Makes keypoints of the marks of one picture (paper B, section 4.2): joints are the ends of strokes, their mean where
/// strokes meet; tips are the discs. What is marked has confidence 1.
SeenPerson PersonOf(const Marks& marks);

}  // namespace etude

#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/motion/body.h"

namespace [[gnu::visibility("default")]] etude {

struct Marks;
enum class Role;

/// The body landmarks that keypoint estimators detect, and the finger tips that marks show. Left and right are the
/// person's own.
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
  kHead,  ///< the top of the head
  kLeftBigToe,
  kLeftSmallToe,
  kLeftHeel,
  kRightBigToe,
  kRightSmallToe,
  kRightHeel,
  kMidHip,
  kLeftHand,
  kRightHand,
  kNoLandmark,  ///< in layouts: a point that is not used
};

constexpr std::size_t kLandmarkCount = 28;

constexpr std::size_t Index(Landmark landmark) { return static_cast<std::size_t>(landmark); }

/// The joints that are landmarks; shoulder centre, hip centre, spine and head are computed from several landmarks.
inline constexpr std::array<std::pair<Landmark, Role>, 16> kJointLandmarks = {
    {{Landmark::kLeftShoulder, Role::kLeftShoulder},
     {Landmark::kRightShoulder, Role::kRightShoulder},
     {Landmark::kLeftElbow, Role::kLeftElbow},
     {Landmark::kRightElbow, Role::kRightElbow},
     {Landmark::kLeftWrist, Role::kLeftWrist},
     {Landmark::kRightWrist, Role::kRightWrist},
     {Landmark::kLeftHand, Role::kLeftHand},
     {Landmark::kRightHand, Role::kRightHand},
     {Landmark::kLeftHip, Role::kLeftHip},
     {Landmark::kRightHip, Role::kRightHip},
     {Landmark::kLeftKnee, Role::kLeftKnee},
     {Landmark::kRightKnee, Role::kRightKnee},
     {Landmark::kLeftAnkle, Role::kLeftAnkle},
     {Landmark::kRightAnkle, Role::kRightAnkle},
     {Landmark::kLeftBigToe, Role::kLeftFoot},
     {Landmark::kRightBigToe, Role::kRightFoot}}};

/// Returns the landmark's name in OpenPose and Pose2Sim: "RHip", "LBigToe", …
std::string_view LandmarkName(Landmark landmark);
std::optional<Landmark> FindLandmark(std::string_view name);

/// Returns the landmark at a joint; nullopt for hip centre and spine.
std::optional<Landmark> LandmarkAt(Role role);

/// The order of the landmarks in an estimator's list of keypoints.
struct KeypointLayout {
  std::string name;
  std::vector<Landmark> landmarks;
  std::size_t more = 0;  ///< number of further points, of face and hands, that are ignored
  bool is_rare = false;  ///< found only by name, because a more usual layout has the same number of points
};

/// Returns all layouts: "coco" (17 points), "coco_18" (OpenPose's), the rare "h36m" (17 points; Human3.6M, MotionBERT)
/// and "trt_pose" (18 points; NVIDIA), "body_25" and "body_25b" (25 each, in different orders; OpenPose), "halpe_26",
/// "mediapipe" (33), "coco_wholebody" (133), "halpe_136", and "halpe_26_hands". The last one is ours: halpe_26 with the
/// finger tips. It contains every landmark, and `etude export` writes marks in it.
std::span<const KeypointLayout> KeypointLayouts();
std::vector<std::string> KeypointLayoutNames();
/// Finds a layout by its name; returns null if there is none.
const KeypointLayout* FindKeypointLayout(std::string_view name);

/// Finds a landmark by an estimator's name for it, ignoring case and separators: "left_shoulder", "LShoulder", "Left
/// Big Toe", "mid_hip". Returns kNoLandmark for other names.
Landmark LandmarkOfName(std::string_view name);

/// The pixel of a landmark in a picture, and the estimator's confidence (0 = not seen, 1 = certain).
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

/// All people in each frame of one camera, in no particular order.
using SeenPeople = std::vector<std::vector<SeenPerson>>;

/// Returns the height of the box around all keypoints that were seen, pixels; 0 if none was.
double HeightPx(const SeenPerson& person);

/// Makes keypoints from the marks of one picture (paper B, section 4.2): a joint is the end of a stroke, or the mean
/// of the ends where several strokes meet; an end effector is the centre of its disc. Marked landmarks have
/// confidence 1.
SeenPerson PersonOf(const Marks& marks);

}  // namespace etude

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// Which of a file's axes points upwards.
enum class UpAxis { kY, kZ };

/// What is found out by itself unless it is told here.
struct BodyOptions {
  double rate_hz = kJudgedRateHz;
  std::optional<double> metres_per_unit;
  std::optional<UpAxis> up;
  bool drop_t_pose = true;             ///< a leading one that the motion jumps away from
  bool canonical_proportions = false;  ///< retargeted (proportions.h), else the actor's own
};

/// A clip as the twenty joints: metres, Y up, feet on the floor.
struct BodyConversion {
  double metres_per_unit = 0;
  std::string unit;  ///< "centimetre", "CMU", …; "unknown" when none gave a human stature; "given"
  UpAxis up = UpAxis::kY;
  double floor = 0;  ///< height of the floor in the file's unit, along its up axis
  bool dropped_t_pose = false;
  /// What was found out and repaired, in plain words: "1 unit = 5.64 cm (CMU); dropped a leading T-pose".
  std::string note;
  BodyMotion motion;
};

/// Turns a clip into a body's motion (ours where no source is named):
/// - a leading T-pose is dropped when the body jumps away from it: CMU's converted files begin with one;
/// - resampled to `rate_hz` by turning joints (SampleClip), the first frame kept as it is;
/// - Z-up files (the body stands along Z) are turned upright;
/// - unit: the one of metre, foot, CMU (1/0.45 inch), inch, cm, mm under which the body's stature lies
///   within 1.3 and 2.1 m; none does: scaled to a stature of 1.70 m. The stature is the way from ankle
///   over knee, hip, spine and neck to the head (median over the frames), divided by 0.92;
/// - floor: the lowest point of the feet, 5th percentile over the frames, comes to y = 0. Where it
///   stands on the floor and where it faces stay as in the file.
///
/// Refused, naming `file`: no frames, over an hour, a body of no size, one whose feet point backwards (left and right
/// are swapped, or the axes left-handed).
Result<BodyConversion> ToBodyMotion(const Clip& clip, const JointMap& map, const std::string& file,
                                    const BodyOptions& options = {});

/// From the bytes of a BVH file to a body's motion: ReadBvh, FindJointMap, ToBodyMotion.
Result<BodyConversion> ReadBodyMotion(std::string_view bytes, const std::string& file);

/// The stature of a pose in its own unit, measured along the limbs as told above.
double Stature(const BodyPose& pose);

/// Whether the body stands with straight legs and both arms stretched out sideways.
bool IsTPose(const BodyPose& pose);

}  // namespace etude

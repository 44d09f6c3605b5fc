#pragma once

#include <optional>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/orientation.h"

namespace etude {

/// Facts about a file that are found out unless they are given here.
struct BodyOptions {
  double rate_hz = kJudgedRateHz;
  std::optional<double> metres_per_unit = std::nullopt;
  std::optional<UpAxis> up = std::nullopt;
  std::optional<double> floor = std::nullopt;    ///< its height along that axis, in the file's unit
  std::optional<double> stature = std::nullopt;  ///< of the body that moves, in the file's unit: Ground::stature
  bool drop_t_pose = true;                       ///< a leading one that the motion jumps away from
};

/// A clip as the twenty joints: metres, Y up, feet on the floor.
struct BodyConversion {
  double metres_per_unit = 0;
  std::string unit;  ///< "centimetre", "CMU", …; "unknown" when none gave a human stature; "scaled", "given"
  UpAxis up = UpAxis::kY;
  double floor = 0;                ///< height of the floor in the file's unit, along its up axis
  std::size_t dropped_frames = 0;  ///< at the clip's beginning: a T-pose
  /// The findings and repairs in plain words: "1 unit = 5.64 cm (CMU); dropped a leading T-pose".
  std::string note;
  BodyMotion motion;
};

/// Turns a clip into a body's motion (ours where no source is named):
/// - Z-up files are turned upright (FindUpAxis);
/// - a leading T-pose is dropped when the body jumps away from it: CMU's converted files begin with one;
/// - resampled to `rate_hz` by turning joints (SampleFrame), the first frame kept as it is;
/// - unit: the one of metre, foot, CMU (1/0.45 inch), inch, cm, mm under which the body's stature lies
///   within 1.45 (in millimetres, which depth sensors write, 1.2) and 2.1 m; none does (children, toys): scaled to a
///   stature of 1.70 m. The stature is the way from ankle over knee, hip, spine and neck to the head, divided by 0.92,
///   at rest; if the median over the frames is more than 1.25 times as much or little, that median (said), and where no
///   unit fits that, the rest pose's unit, by which the frames' scale is undone (places and all; UndoScales knows
///   better where it is one of joints). Over 1.05 times, or a size that changes over 1.25 times within the clip, is
///   said. Clips of one file share a unit: tell them FindGround's stature; one whose own median is another is told;
/// - floor: the lowest joint (finger tips aside), 5th percentile over the frames, comes to y = 0. Where it
///   stands on the floor and where it faces stay as in the file. Clips of one file share a floor: tell them FindGround;
///   one that stays farther from it than its legs are long has another root, and its own floor.
///
/// Refused, naming `file`: no frames, over an hour, over half a million poses, a body of no size, a given unit under
/// which it is not 0.4 to 4 m tall, one whose left arm is on the side of its right leg, or whose feet point backwards
/// (for composed feet: whose arms do, or whose knees do by over 35° or with the arms): left and right are swapped then,
/// or the axes left-handed. Knees that overstretch less are told.
Result<BodyConversion> ToBodyMotion(const Clip& clip, const JointMap& map, const std::string& file,
                                    const BodyOptions& options = {});

/// A file's upward axis, the height of its floor and the stature of who stands there.
struct Ground {
  UpAxis up = UpAxis::kY;
  double floor = 0;    ///< along that axis, in the file's unit
  double stature = 0;  ///< median over the frames, in the file's unit
};

/// The ground that clips of one skeleton in one file stand on, by the rules of ToBodyMotion over the frames of all of
/// them: who sits on a chair in one and stands up from it in another has no floor of his own in each, and who is
/// stretched in one no unit of his own. `options` may tell each. Nothing when no clip has a frame, or joints lie beyond
/// all measure.
std::optional<Ground> FindGround(std::span<const Clip> clips, const JointMap& map, const BodyOptions& options = {});

/// Takes out of a file's frames the scales that its rest pose has not, such as one on the hips: where the body at rest
/// is a person in some unit, the frames show it over 1.25 times as tall or small (median over the clips), and without
/// their scales would not. Returns how many times as tall; nothing when the clips stay as they are.
std::optional<double> UndoScales(std::span<Clip> clips, const JointMap& map);

/// Returns the transform from the file's unit and axes to where ToBodyMotion has put the body, for the clip's meshes.
glm::dmat4 WorldFromFile(const BodyConversion& body);

/// Says whether the body stands with straight legs and both arms stretched out sideways.
bool IsTPose(const BodyPose& pose);

}  // namespace etude

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/raw_motion.h"

namespace etude {

/// Angles over time, frames × names, degrees; NaN: unknown.
struct AngleTracks {
  std::vector<std::string> names;
  std::vector<double> degrees;
};

/// Returns the angles of hips, knees, ankles, shoulders, elbows, wrists, trunk and head, as far as a motion's joints
/// have the roles and rotations: `left_hip_flexion`, `left_hip_abduction`, `left_hip_rotation`, …; none without
/// rotations or without both hips.
///
/// Each is the rotation of the segment below a joint (the file's rotation of that joint) relative to the segment above;
/// pelvis and thorax are the joints that carry both hips and both shoulders. It is counted from a neutral pose: the
/// file's rest pose with thighs, shanks, upper arms and forearms turned by the shortest arc so that they hang, so that
/// a T-pose and an A-pose at rest give the same angles. Axes: X to the left (hip to hip at rest, horizontal), Y up, Z
/// ahead. Cardan sequence X, Z', Y'': flexion, abduction, rotation. Positive are flexion (of the ankle: dorsiflexion),
/// abduction away from the middle, and rotation inwards; of trunk and head: forward, to the left, and turning left. At
/// 90° of abduction, flexion and rotation cannot be distinguished (gimbal lock).
AngleTracks AnglesOfRotations(const RawMotion& motion);

/// Sums over the frames of one pair from which the agreement of two curves is computed.
struct AgreementSums {
  double count = 0;
  double mean_truth = 0, mean_found = 0;
  double square_truth = 0, square_found = 0, product = 0;  ///< of deviations from these means
};

/// A cell keeps a series along this axis for each angle: the angle's sums.
inline constexpr const char* kAgreementAxis = "agreement sums";
/// Return the sums as a list in the order of their declaration, and the sums of such a list; nothing for a list of
/// another length.
std::vector<double> EncodeSums(const AgreementSums& sums);
std::optional<AgreementSums> DecodeSums(std::span<const double> values);

/// Returns the sums of one column of angles over the frames in which both are known. The truth's angles are taken within
/// 180° of their circular mean, and the answer's within 180° of the truth's.
AgreementSums SumAgreement(const AngleTracks& found, const AngleTracks& truth, std::size_t column);

/// Returns the sums over the frames of both a and b.
AgreementSums Together(const AgreementSums& a, const AgreementSums& b);

/// Returns the root of the mean squared difference; nothing without frames.
std::optional<double> RmsOf(const AgreementSums& sums);
/// Returns found − truth; nothing without frames.
std::optional<double> BiasOf(const AgreementSums& sums);
/// Returns ICC(A,1) of McGraw and Wong 1996: two-way random, absolute agreement, single measure; a frame is a subject,
/// truth and answer are the two raters. Nothing with fewer than two frames, or if nothing varies by more than rounding.
std::optional<double> IccOf(const AgreementSums& sums);

}  // namespace etude

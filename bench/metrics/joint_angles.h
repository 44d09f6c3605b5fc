#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/raw_motion.h"

namespace etude {

/// Angles over time, frames × names, degrees. NaN: the angle is unknown.
struct AngleTracks {
  std::vector<std::string> names;
  std::vector<double> degrees;
};

/// Returns the angles of hips, knees, ankles, shoulders, elbows, wrists, trunk and head: `left_hip_flexion`,
/// `left_hip_abduction`, `left_hip_rotation`, … A joint is left out if the motion lacks its role. Returns no angles if
/// the motion has no rotations or lacks a hip, or if one hip lies exactly above the other at rest.
///
/// The angles of a joint describe the rotation of the segment below it (the file's rotation of that joint) relative to
/// the segment above. The pelvis is the nearest common ancestor of both hips, the thorax that of both shoulders.
/// Rotations are measured from a neutral pose: the file's rest pose, with thighs, shanks, upper arms and forearms
/// turned by the shortest arc until they hang down; a hand turns with its forearm. A T-pose and an A-pose at rest
/// therefore give the same angles. Axes: X to the left (hip to hip at rest, horizontal), Y up, Z ahead. Cardan sequence
/// X, Z', Y'': flexion, abduction, rotation. Positive angles mean flexion (for the ankle: dorsiflexion), abduction away
/// from the middle, and inward rotation; for trunk and head: bending forward, bending to the left, and turning left. At
/// 90° of abduction, flexion and rotation cannot be distinguished (gimbal lock).
AngleTracks AnglesOfRotations(const RawMotion& motion);

/// Sums over the frames of one pair of angle curves. The agreement of the two curves is computed from them.
struct AgreementSums {
  double count = 0;
  double mean_truth = 0, mean_found = 0;
  /// Sums of squares and of products of the deviations from the means.
  double square_truth = 0, square_found = 0, product = 0;
};

/// The axis name of a series that a cell stores for each angle. The series holds the angle's sums.
inline constexpr const char* kAgreementAxis = "agreement sums";
/// EncodeSums returns the sums as a list, in the order of their declaration. DecodeSums reads such a list; nothing if
/// the list has another length.
std::vector<double> EncodeSums(const AgreementSums& sums);
std::optional<AgreementSums> DecodeSums(std::span<const double> values);

/// Returns the sums of one column of angles over the frames in which truth and answer are known. 360° are added or
/// subtracted so that each true angle lies within 180° of the truth's circular mean, and each of the answer's angles
/// within 180° of the true angle.
AgreementSums SumAgreement(const AngleTracks& found, const AngleTracks& truth, std::size_t column);

/// Returns the sums over the frames of `a` and the frames of `b` together.
AgreementSums Together(const AgreementSums& a, const AgreementSums& b);

/// Returns the root mean square of answer − truth, degrees; nothing if there are no frames.
std::optional<double> RmsOf(const AgreementSums& sums);
/// Returns the mean of answer − truth, degrees; nothing if there are no frames.
std::optional<double> BiasOf(const AgreementSums& sums);
/// Returns ICC(A,1) of McGraw and Wong 1996: two-way random, absolute agreement, single measure. A frame is a subject;
/// truth and answer are the two raters. Returns nothing with fewer than two frames, or if nothing varies by more than
/// rounding.
std::optional<double> IccOf(const AgreementSums& sums);

}  // namespace etude

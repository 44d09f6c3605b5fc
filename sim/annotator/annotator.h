#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

#include "engine/motion/body.h"
#include "engine/vision/strokes.h"
#include "sim/annotator/evidence.h"
#include "sim/random/stream.h"

namespace etude {

/// The errors of a person who marks joint centres by hand.
struct PersonErrors {
  /// The standard deviation of a mark in u and in v, pixels: the mean over the joints, on a limb with clear contrast.
  /// All random errors are proportional to `error_px`; at 0, marks are exact, and no limb is overlooked or confused.
  /// Two pixels are about 13 mm on a person 4 m away *(ours)*.
  double error_px = 2;
};

/// Returns the relative difficulty of locating each joint centre, by role, with mean 1. The values are the standard
/// deviations σ that COCO and COCO-WholeBody use to evaluate keypoints, divided by their mean. COCO measured its σ on
/// 5,000 images annotated more than once, relative to the square root of a person's area: shoulders .079, elbows .072,
/// wrists .062, hips .107, knees .087, ankles .089; ears (used for the head) .035. COCO-WholeBody gives .068 for big
/// toes (used for the feet) and .026 for middle fingers (used for the hands). Only ratios of σ are used, because the
/// absolute values describe crowd workers on pictures of all kinds.
const std::array<double, kRoleCount>& RelativeDeviations();

/// A mark's error is the sum of three parts. These are the parts' shares of the error's variance *(ours; Bartlett,
/// Bussey and Flyger 2006 show that different operators differ more than repeated marks of one operator, and that
/// joints differ)*.
constexpr double kBiasShare = 0.3;         ///< share of the variance: a bias, constant for one joint and annotator
constexpr double kLastingShare = 0.4;      ///< share of the variance: “lasting” errors, correlated from frame to frame
constexpr double kIndependentShare = 0.3;  ///< share of the variance: errors drawn anew for each frame
/// The time constant of the lasting part: the number of frames at 30 Hz after which the autocorrelation of this part is
/// 1/e *(ours)*.
constexpr double kLastingFrames = 10;

/// Returns the unclearness, in (0, 1], of a limb with this contrast (`LimbEvidence::contrast`, levels). It is 1/2 at a
/// contrast of 20 levels, which is four times a camera's noise *(ours)*. All errors except the bias grow by the factor
/// (1 + unclearness).
double Unclearness(double contrast);

/// Probabilities and sizes of mistakes with a limb at `error_px` = 2. All are *(ours)* and proportional to `error_px`.
double MissProbability(const LimbEvidence& limb);  ///< 0.2 %, plus ≤ 10 % if hardly visible, plus ≤ 3 % if unclear
constexpr double kShortShare = 0.03;               ///< σ of the share of a limb's stroke that is missing at each end
constexpr double kSwapProbability = 0.0003;        ///< probability per frame that an exchange of left and right begins
constexpr double kOverlapSwapProbability = 0.002;  ///< times the limbs' overlap (0 to 1): added to kSwapProbability
constexpr double kSwapFrames = 5;                  ///< mean length of an exchange, in marked frames

/// The random numbers of one picture. How many numbers are drawn depends neither on the picture nor on the strength of
/// the errors.
struct PictureDice {
  std::array<glm::dvec2, kRoleCount> lasting;      ///< errors correlated over frames: standard normal in u and in v
  std::array<glm::dvec2, kRoleCount> independent;  ///< errors of this picture alone: standard normal in u and in v
  std::array<glm::dvec2, kStrokeCount> shortness;  ///< shortening of a stroke at its two ends: standard normal
  std::array<double, kStrokeCount> miss;           ///< decides if a limb is overlooked: uniform in [0, 1)
  std::array<double, 2> swap_begins;               ///< begins an exchange of [0] arms, [1] legs: uniform in [0, 1)
  std::array<double, 2> swap_lasts;                ///< length of an exchange of [0] arms, [1] legs: uniform in [0, 1)
};

/// Draws the random numbers of one annotator for one camera, frame by frame (marked frames only).
class AnnotatorDice {
 public:
  AnnotatorDice(const WorldKey& key, int annotator, int camera);

  /// Returns this person's bias at each joint centre, with unit variance: along a limb at the joint, and across this
  /// limb. The bias is the same for all cameras.
  const std::array<glm::dvec2, kRoleCount>& bias() const { return bias_; }
  /// Draws the numbers of a frame. Call it with ascending frames.
  const PictureDice& DrawNumbers(int frame);

 private:
  WorldKey key_;
  std::string purpose_;
  std::array<glm::dvec2, kRoleCount> bias_;
  int last_frame_ = -1;
  PictureDice dice_{};
};

/// Simulates the human who marks limbs and end effectors in the pictures of one camera (paper B, section 4.2), frame by
/// frame. The annotator sees only the picture (`SeePicture`), never the true joints, and makes human errors
/// (`PersonErrors`). Annotators with the same `key`, `annotator` and `camera` draw the same random numbers.
class Annotator {
 public:
  Annotator(const PersonErrors& errors, const EvidenceOptions& eye, const WorldKey& key, int annotator, int camera);

  /// Returns the marks for this picture. A mark is empty if the marked limb is not visible or is overlooked. A joint's
  /// error is drawn once: the joint's limbs and its disc are marked at the same pixel. Call it with ascending frames.
  Marks Mark(int frame, const AnnotatedPicture& picture);

 private:
  // Starts and ends exchanges of left and right.
  void SwapSides(const PictureDice& dice, PictureEvidence& seen);

  PersonErrors errors_;
  EvidenceOptions eye_;
  AnnotatorDice dice_;
  // The number of further marked frames in which left and right stay exchanged: [0] arms, [1] legs.
  std::array<int, 2> swapped_frames_{};
};

}  // namespace etude

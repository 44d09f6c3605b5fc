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
  /// It scales all random errors: at 0, nothing is inaccurate, overlooked or confused. Two pixels are about 13 mm on a
  /// person 4 m away *(ours)*.
  double error_px = 2;
};

/// Returns the relative difficulty of locating each joint centre, by role; the mean is 1. The values are the standard
/// deviations σ of two keypoint evaluations, divided by their mean. COCO's are of 5,000 images annotated more than
/// once, relative to the square root of a person's area: shoulders .079, elbows .072, wrists .062, hips .107, knees
/// .087, ankles .089; ears, for the head, .035. COCO-WholeBody's are for the tips: big toes .068, middle fingers .026.
/// Their absolute size is not used, because it describes crowd workers on pictures of all kinds.
const std::array<double, kRoleCount>& RelativeDeviations();

/// The parts of a mark's variance, as shares *(ours; Bartlett, Bussey and Flyger 2006 show that different operators
/// differ more than repeated marks of one operator, and that joints differ)*.
constexpr double kBiasShare = 0.3;         ///< bias of one annotator for one joint, constant over a take
constexpr double kLastingShare = 0.4;      ///< correlated from frame to frame
constexpr double kIndependentShare = 0.3;  ///< drawn for each frame
/// The number of frames at 30 Hz after which the autocorrelation of the lasting part is 1/e *(ours)*.
constexpr double kLastingFrames = 10;

/// Returns how unclear a limb of this contrast (`LimbEvidence::contrast`, counts) is, in (0, 1]. It is 1/2 at 20
/// counts, four times a camera's noise *(ours)*. All errors except the bias grow by the factor (1 + unclearness).
double Unclearness(double contrast);

/// Probabilities and sizes of mistakes with a limb for `error_px` = 2; all are *(ours)* and proportional to `error_px`.
double MissProbability(const LimbEvidence& limb);  ///< 0.2 % + up to 10 % if hardly visible + up to 3 % if unclear
constexpr double kShortShare = 0.03;               ///< standard deviation of the share left out at each end of a stroke
constexpr double kSwapProbability = 0.0003;        ///< per marked frame: left and right arms, or legs, are exchanged
constexpr double kOverlapSwapProbability = 0.002;  ///< added if both overlap, as seen from the side
constexpr double kSwapFrames = 5;                  ///< mean number of marked frames of an exchange

/// The random numbers of one picture; their count depends neither on the picture nor on the errors' strength.
struct PictureDice {
  std::array<glm::dvec2, kRoleCount> lasting;      ///< errors correlated over frames: standard normal in u and in v
  std::array<glm::dvec2, kRoleCount> independent;  ///< errors of this picture alone: standard normal in u and in v
  std::array<glm::dvec2, kStrokeCount> shortness;  ///< at both ends, standard normal
  std::array<double, kStrokeCount> miss;           ///< uniform in [0, 1)
  std::array<double, 2> swap_begins;               ///< uniform in [0, 1); arms, legs
  std::array<double, 2> swap_lasts;                ///< uniform in [0, 1); arms, legs
};

/// Draws the random numbers of one annotator for one camera, marked frame by marked frame.
class AnnotatorDice {
 public:
  AnnotatorDice(const WorldKey& key, int annotator, int camera);

  /// Returns this person's bias at each joint centre, with unit variance, along and across the limb beyond the joint;
  /// it is the same for all cameras.
  const std::array<glm::dvec2, kRoleCount>& bias() const { return bias_; }
  /// Draws the numbers of a frame. Frames must ascend.
  const PictureDice& DrawNumbers(int frame);

 private:
  WorldKey key_;
  std::string purpose_;
  std::array<glm::dvec2, kRoleCount> bias_;
  int last_frame_ = -1;
  PictureDice dice_{};
};

/// The human who marks limbs and end effectors in the pictures of one camera (paper B, section 4.2), frame by frame.
/// The annotator sees only the picture (`SeePicture`), never the true joints, and makes the errors of people
/// (`PersonErrors`). Annotators with the same key, number and camera draw the same random numbers for all pictures.
class Annotator {
 public:
  Annotator(const PersonErrors& errors, const EvidenceOptions& eye, const WorldKey& key, int annotator, int camera);

  /// Returns the marks for this picture; a mark is empty if its limb is not seen or is overlooked. A joint's error is
  /// drawn once: both its limbs and its disc use the same pixel. Frames must ascend.
  Marks Mark(int frame, const AnnotatedPicture& picture);

 private:
  // Begins and ends exchanges of left and right.
  void SwapSides(const PictureDice& dice, PictureEvidence& seen);

  PersonErrors errors_;
  EvidenceOptions eye_;
  AnnotatorDice dice_;
  std::array<int, 2> swapped_frames_{};  // remaining marked frames in which arms and legs are exchanged
};

}  // namespace etude

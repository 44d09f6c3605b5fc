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
  /// The standard deviation of a mark in u and in v, pixels: mean over the joints, on a limb that stands out clearly.
  /// Scales everything that is random: 0 is a perfect hand and a perfect eye, which overlook and mistake nothing. Two
  /// pixels are about 13 mm on a person 4 m away *(ours)*.
  double error_px = 2;
};

/// Returns how much harder each joint centre is to find than the mean one, by role. Computed from the standard
/// deviations σ that COCO's keypoint evaluation publishes (5,000 images annotated more than once; relative to the
/// square root of a person's area: shoulders .079, elbows .072, wrists .062, hips .107, knees .087, ankles .089, ears
/// .035, which stand for the head) and COCO-WholeBody's for the tips (big toes .068, middle fingers .026), divided by
/// their mean. Their absolute size is not taken: that is of a crowd in wild pictures.
const std::array<double, kRoleCount>& RelativeDeviations();

/// The shares of a mark's variance *(ours; that operators differ from each other more than from themselves, and from
/// joint to joint, is Bartlett, Bussey and Flyger 2006)*.
constexpr double kBiasShare = 0.3;         ///< of one annotator's idea of one joint, the same in all pictures of a take
constexpr double kLastingShare = 0.4;      ///< correlated from frame to frame
constexpr double kIndependentShare = 0.3;  ///< thrown anew
/// The number of frames at 30 Hz after which the correlation of the lasting part has fallen to 1/e *(ours)*.
constexpr double kLastingFrames = 10;

/// Returns how unclear a limb of this contrast (`LimbEvidence::contrast`, counts) is, in (0, 1]: 1/2 at 20 counts, four
/// times a camera's noise *(ours)*. Errors that are not bias grow by (1 + unclearness).
double Unclearness(double contrast);

/// The chances and sizes of mistakes with a limb, for `error_px` = 2; all are *(ours)* and proportional to `error_px`.
double MissProbability(const LimbEvidence& limb);  ///< 0.2 %, up to 10 % more when hardly seen, 3 % when unclear
constexpr double kShortShare = 0.03;               ///< deviation of the share of a stroke that is left out at each end
constexpr double kSwapProbability = 0.0003;        ///< per marked frame: left and right arms, or legs, are exchanged
constexpr double kOverlapSwapProbability = 0.002;  ///< so much more when both lie over each other, as from aside
constexpr double kSwapFrames = 5;                  ///< mean number of marked frames that an exchange lasts

/// The dice of one picture, as many whatever is seen in it and however strong errors are.
struct PictureDice {
  std::array<glm::dvec2, kRoleCount> lasting;      ///< of unit variance in u and v: one throw per joint
  std::array<glm::dvec2, kRoleCount> independent;  ///< likewise
  std::array<glm::dvec2, kStrokeCount> shortness;  ///< at both ends, standard normal
  std::array<double, kStrokeCount> miss;           ///< uniform in [0, 1)
  std::array<double, 2> swap_begins;               ///< uniform in [0, 1); arms, legs
  std::array<double, 2> swap_lasts;                ///< likewise
};

/// Throws the dice of one annotator for one camera, marked frame after marked frame.
class AnnotatorDice {
 public:
  AnnotatorDice(const WorldKey& key, int annotator, int camera);

  /// Returns this person's bias at each joint centre, of unit variance, along the limb beyond it and across: the same
  /// for all cameras.
  const std::array<glm::dvec2, kRoleCount>& bias() const { return bias_; }
  /// Throws the dice of a frame. Frames are asked for in order, each once.
  const PictureDice& Throw(int frame);

 private:
  WorldKey key_;
  std::string purpose_;
  std::array<glm::dvec2, kRoleCount> bias_;
  int last_frame_ = -1;
  PictureDice dice_{};
};

/// The human who marks limbs and end effectors in the pictures of one camera (paper B, section 4.2), frame after frame:
/// sees what a picture shows (`SeePicture`) and errs as people do (`PersonErrors`). True joints are not known here.
/// Annotators made from the same key, number and camera throw the same dice, whatever their pictures show.
class Annotator {
 public:
  Annotator(const PersonErrors& errors, const EvidenceOptions& eye, const WorldKey& key, int annotator, int camera);

  /// Returns the marks that are put on this picture; nothing for what is not seen, or overlooked. A joint is thrown
  /// once: both its limbs and its disc are drawn to the same pixel. Frames come in order, each once.
  Marks Mark(int frame, const AnnotatedPicture& picture);

 private:
  // Begins and ends exchanges of left and right.
  void SwapSides(const PictureDice& dice, PictureEvidence& seen);

  PersonErrors errors_;
  EvidenceOptions eye_;
  AnnotatorDice dice_;
  std::array<int, 2> swapped_frames_{};  // how many marked frames arms and legs stay exchanged
};

}  // namespace etude

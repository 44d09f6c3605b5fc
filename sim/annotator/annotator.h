#pragma once

#include <array>

#include "engine/vision/strokes.h"
#include "sim/annotator/errors.h"
#include "sim/annotator/evidence.h"
#include "sim/random/stream.h"

namespace etude {

/// The human who marks limbs and end effectors in the pictures of one camera (paper B, section 4.2), frame after frame:
/// sees what a picture shows (`SeePicture`) and errs as people do (`PersonErrors`). True joints are not known here.
/// Annotators made from the same key, number and camera throw the same dice, whatever their pictures show.
class Annotator {
 public:
  Annotator(const PersonErrors& errors, const EvidenceOptions& eye, const WorldKey& key, int annotator, int camera);

  /// The marks that are put on this picture; nothing for what is not seen, or overlooked. A joint is thrown once: both
  /// its limbs and its disc are drawn to the same pixel. Frames come in order, each once.
  Marks Mark(int frame, const AnnotatedPicture& picture);

 private:
  // Begins and ends exchanges of left and right.
  void Mistake(const PictureDice& dice, PictureEvidence& seen);

  PersonErrors errors_;
  EvidenceOptions eye_;
  AnnotatorDice dice_;
  std::array<int, 2> swapped_frames_{};  // how many marked frames arms and legs stay exchanged
};

}  // namespace etude

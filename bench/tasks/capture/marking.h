#pragma once

#include <vector>

#include "bench/metrics/annotation.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/vision/limb_colours.h"
#include "engine/vision/strokes.h"
#include "sim/annotator/annotator.h"
#include "sim/random/stream.h"

namespace etude {

/// Everyone who marks one take's pictures, cut out one way. Each draws on pictures of their own, which are read back
/// (`ReadMarks`). Two markings of the same world throw the same dice, whatever they are shown.
class Marking {
 public:
  /// `key` must outlive this. The world tells the number of cameras and the figure that performs: where joints lie in
  /// its limbs, and which point of the head is marked.
  Marking(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key);

  /// The marks of one picture as methods are told them: of a stroke or disc that both annotators drew, the mean; else
  /// the one there is. Nothing in frames that nobody is asked to mark. A camera's frames come in order.
  Marks Mark(std::size_t camera, std::size_t frame, const AnnotatedPicture& picture);

  /// The marks of someone who knows where the joints of `pose` are: what the picture shows of limbs and ends, marked
  /// exactly, and not drawn. Throws no dice.
  Marks MarkTrueJoints(std::size_t frame, const AnnotatedPicture& picture, const Camera& camera,
                       const BodyPose& pose) const;

  /// The marks that the colours of the coded suit give, of a performer who wears it. Throws no dice.
  Marks ReadColours(std::size_t frame, const AnnotatedPicture& picture) const;

  /// The marks of two annotators of each joint and each limb in all pictures marked so far; empty when one marks alone.
  const std::vector<MarkedTwice>& joints() const { return joints_; }
  const std::vector<MarkedTwice>& limbs() const { return limbs_; }

 private:
  void Compare(const Marks& first, const Marks& second);

  std::size_t mark_every_;
  EvidenceOptions eye_;
  LimbColours suit_;
  std::vector<std::vector<Annotator>> annotators_;  // [camera][annotator]
  std::vector<MarkedTwice> joints_, limbs_;
};

/// `FigureLook::head_below_crown` of a performer in the pose `body`: the same in every pose, like limb lengths,
/// and measured beforehand.
double HeadBelowCrown(const Figure& figure, const BodyPose& body);

/// Returns the mean of both marks for each stroke and disc, or the one there is.
Marks MeanMarks(const Marks& first, const Marks& second);

}  // namespace etude

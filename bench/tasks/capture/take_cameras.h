#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/marking.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/shooting.h"
#include "bench/tasks/capture/world.h"
#include "engine/base/image.h"
#include "engine/vision/person_finder.h"
#include "engine/vision/strokes.h"
#include "sim/render/renderer.h"

namespace etude {

/// An outside program that finds the person in the pictures of a take (docs/outside-methods.md). It has one session per
/// camera and one step per picture.
class SeatedSegmenter {
 public:
  /// `program` must outlive this object.
  explicit SeatedSegmenter(LiveProgram& program) : program_(program) {}

  /// Begins the session of a camera and sends the camera's picture of the empty room. The camera's other pictures must
  /// follow.
  void Begin(std::size_t camera, const ColourImage& background);
  /// Sends the next picture and returns the mask in the program's answer. If the program has failed or an answer was
  /// invalid, the mask is all zero, and the program is not asked again.
  Mask Detect(const ColourImage& picture);

  /// Returns the first error in an answer, or success.
  const Result<void>& complaint() const { return complaint_; }

 private:
  LiveProgram& program_;
  Result<void> complaint_;
  bool goes_on_ = true;
  std::size_t camera_ = 0, frame_ = 0;
};

/// The cameras of a take, and the data that all its pictures share: backgrounds, clocks, annotators.
class TakeCameras {
 public:
  /// The objects behind the references must outlive this object. The world must already have its first pose. Before a
  /// frame is shot, the world must have the poses that the frame needs.
  TakeCameras(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
              std::span<const PersonSource> sources, Renderer& renderer);

  /// One picture, and the mask and the marks that each PersonSource made from it.
  struct Picture {
    ColourImage colour;
    Mask person, shadow;  ///< the true masks
    std::vector<Mask> found;
    std::vector<Marks> marks;  ///< by source; no marks if a source is `for_silhouettes` without `has_keypoints`
  };

  /// The pictures of one camera. The TakeCameras that made this object must outlive it.
  class Feed {
   public:
    /// Shoots the next picture, cuts out the person, and marks the picture. The frames of a camera must come in order.
    Picture Next(std::size_t frame);

   private:
    friend class TakeCameras;
    Feed(TakeCameras& cameras, std::size_t camera);
    Mask Find(std::size_t source, const Picture& picture);
    Marks Mark(std::size_t source, std::size_t frame, const AnnotatedPicture& picture);

    TakeCameras& cameras_;
    std::size_t camera_;
    std::vector<PersonFinder> finders_;  // one finder per PersonSource
  };
  Feed FeedOf(std::size_t camera) { return Feed(*this, camera); }

  const std::vector<ColourImage>& backgrounds() const { return backgrounds_; }
  /// Returns the annotators of each PersonSource.
  const std::vector<Marking>& marking() const { return marking_; }

 private:
  const CaptureWorld& world_;
  const std::span<const PersonSource> sources_;
  Shooting shooting_;
  std::vector<ColourImage> backgrounds_;
  std::vector<Marking> marking_;
};

}  // namespace etude

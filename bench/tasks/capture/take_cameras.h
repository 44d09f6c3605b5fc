#pragma once

#include <cstddef>
#include <optional>
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

/// An outside program that finds the person in the pictures of a take (docs/outside-methods.md): one session per
/// camera, one step per picture.
class SeatedSegmenter {
 public:
  /// `program` must outlive this.
  explicit SeatedSegmenter(LiveProgram& program) : program_(program) {}

  /// Begins a camera: its empty room, then its pictures.
  void Begin(std::size_t camera, const ColourImage& background);
  /// Returns the mask that the program answers for the next picture. The mask is all zero if the program has failed or
  /// its answer was invalid; then the program is not asked again.
  Mask Detect(const ColourImage& picture);

  /// The complaint about an answer, or success.
  const Result<void>& complaint() const { return complaint_; }

 private:
  LiveProgram& program_;
  Result<void> complaint_;
  bool goes_on_ = true;
  std::size_t camera_ = 0, frame_ = 0;
};

/// The cameras of a take, and all that its pictures share: backgrounds, clocks, annotators.
class TakeCameras {
 public:
  /// References must outlive this. The world must already have its first pose, and must have the poses of a frame
  /// before that frame is shot.
  TakeCameras(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
              std::span<const PersonSource> sources, Renderer& renderer);

  /// One picture, and the result of each source.
  struct Picture {
    ColourImage colour;
    Mask person, shadow;  ///< the truth
    std::vector<Mask> found;
    std::vector<Marks> marks;  ///< empty for silhouettes without keypoints
  };

  /// The pictures of one camera. Its TakeCameras must outlive it.
  class Feed {
   public:
    /// Shoots, cuts out and marks the next picture. A camera's frames must come in order.
    Picture Next(std::size_t frame);

   private:
    friend class TakeCameras;
    Feed(TakeCameras& cameras, std::size_t camera);
    Mask Find(std::size_t source, const Picture& picture);
    Marks Mark(std::size_t source, std::size_t frame, const AnnotatedPicture& picture);

    TakeCameras& cameras_;
    std::size_t camera_;
    std::vector<PersonFinder> finders_;  // one per source
  };
  Feed FeedOf(std::size_t camera) { return Feed(*this, camera); }

  const std::vector<ColourImage>& backgrounds() const { return backgrounds_; }
  /// The annotators of each source.
  const std::vector<Marking>& marking() const { return marking_; }

 private:
  const CaptureWorld& world_;
  const std::span<const PersonSource> sources_;
  Shooting shooting_;
  std::vector<ColourImage> backgrounds_;
  std::vector<Marking> marking_;
};

}  // namespace etude

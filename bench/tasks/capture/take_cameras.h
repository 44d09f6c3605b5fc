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

/// A program that finds the person in the pictures of a take (docs/outside-methods.md): a session for every camera, a
/// step for every picture.
class SeatedSegmenter {
 public:
  /// `program` must outlive this.
  explicit SeatedSegmenter(LiveProgram& program) : program_(program) {}

  /// The next pictures are this camera's, of that empty room.
  void Begin(std::size_t camera, const ColourImage& background);
  /// The mask of what the program says has changed in the next picture. All zero when it has failed, or complained:
  /// then nothing more is asked.
  Mask Detect(const ColourImage& picture);

  /// The complaint about an answer; success when there was none.
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
  /// References must outlive this. The world has its first pose; later ones may follow, as long as they are there when
  /// a frame is shot.
  TakeCameras(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
              std::span<const PersonSource> sources, Renderer& renderer);

  /// One picture, and what each source makes of it.
  struct Picture {
    ColourImage colour;
    Mask person, shadow;  ///< the truth
    std::vector<Mask> found;
    std::vector<Marks> marks;  ///< none of silhouettes without keypoints
  };

  /// The pictures of one camera. Its TakeCameras must outlive it.
  class Feed {
   public:
    /// A camera's frames come in order.
    Picture Next(std::size_t frame);

   private:
    friend class TakeCameras;
    Feed(TakeCameras& cameras, std::size_t camera);
    Mask Find(std::size_t source, const Picture& picture);
    Marks Mark(std::size_t source, std::size_t frame, const AnnotatedPicture& picture);

    TakeCameras& cameras_;
    std::size_t camera_;
    std::vector<PersonFinder> finders_;  // of each source
  };
  Feed FeedOf(std::size_t camera) { return Feed(*this, camera); }

  const std::vector<ColourImage>& backgrounds() const { return backgrounds_; }
  /// The marking of each source.
  const std::vector<Marking>& marking() const { return marking_; }

 private:
  const CaptureWorld& world_;
  const std::span<const PersonSource> sources_;
  Shooting shooting_;
  std::vector<ColourImage> backgrounds_;
  std::vector<Marking> marking_;
};

}  // namespace etude

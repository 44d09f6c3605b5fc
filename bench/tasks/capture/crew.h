#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/tasks/capture/marking.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/shooting.h"
#include "bench/tasks/capture/world.h"
#include "engine/vision/person_finder.h"
#include "engine/vision/strokes.h"
#include "sim/render/renderer.h"

namespace etude {

/// The camera crew of a take: everything that all its pictures share.
class Crew {
 public:
  /// References must outlive this. The world has its first pose; later ones may follow, as long as they are there when
  /// a frame is shot.
  Crew(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
       std::span<const PersonSource> sources, Renderer& renderer);

  /// One picture, and what each source makes of it.
  struct Picture {
    ColourImage colour;
    Mask person, shadow;  ///< the truth
    std::vector<Mask> found;
    std::vector<Marks> marks;  ///< none of silhouettes
  };

  /// One camera at work. The crew must outlive it.
  class Station {
   public:
    /// A camera's frames come in order.
    Picture See(std::size_t frame);

   private:
    friend class Crew;
    Station(Crew& crew, std::size_t camera);
    Mask Find(std::size_t source, const Picture& picture);
    Marks Mark(std::size_t source, std::size_t frame, const AnnotatedPicture& picture);

    Crew& crew_;
    std::size_t camera_;
    std::vector<PersonFinder> finders_;  // of each source
  };
  Station At(std::size_t camera) { return Station(*this, camera); }

  const std::vector<ColourImage>& backgrounds() const { return backgrounds_; }
  /// Of each source.
  const std::vector<Marking>& marking() const { return marking_; }

 private:
  const CaptureWorld& world_;
  const std::span<const PersonSource> sources_;
  Shooting shooting_;
  std::vector<ColourImage> backgrounds_;
  std::vector<Marking> marking_;
};

}  // namespace etude

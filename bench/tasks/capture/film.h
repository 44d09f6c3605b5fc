#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/segmentation.h"
#include "bench/tasks/capture/take_cameras.h"
#include "bench/tasks/capture/world.h"
#include "engine/vision/strokes.h"
#include "sim/render/renderer.h"

namespace etude {

/// The result of one way of cutting out the person from a take. Indices: [camera][frame], or where that is said by
/// picture ([camera][picture]: those of `StudioOptions::picture_every` alone).
struct Observation {
  PersonSource source;
  std::vector<std::vector<Marks>> marks;  ///< nothing marked in frames that the annotator did not see
  std::vector<std::vector<Mask>>
      masks;        ///< by picture, half size; only when asked for, or for silhouettes (`kMostSilhouettes`)
  MaskScore score;  ///< mean over all pictures
  /// The agreement of two annotators over all pictures; empty when one marks alone.
  std::optional<double> annotator_distance_px, annotator_overlap;
  std::string masks_digest;
  std::string marks_digest;
};

/// Masks for silhouettes are kept of takes of at most so many pictures, all cameras together: 77 kB each.
constexpr std::size_t kMostSilhouettes = 4000;

struct Take {
  std::string pictures_digest;
  std::vector<ColourImage> stills;        ///< of each camera the picture of the middle frame; only with the masks
  std::vector<Observation> observations;  ///< one per source asked for, in that order
};

/// Takes each picture as it is shot, because there are too many to keep. `frame` is empty for the background.
using PictureSink = std::function<void(std::size_t camera, std::optional<std::size_t> frame, const ColourImage&)>;

/// Films the world and shows the pictures to the annotator: every picture is rendered once, cut out by each of
/// `sources`, and marked on each cut-out with the same dice.
Take Film(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
          std::span<const PersonSource> sources, bool wants_masks, Renderer& renderer, const PictureSink& sink = {});

}  // namespace etude

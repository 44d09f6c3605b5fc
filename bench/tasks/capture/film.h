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

/// The result of one segmenter (or of the truth in its place) on a take. Indices: [camera][frame]; "by picture" means
/// [camera][picture], where only every `StudioOptions::picture_every`-th frame has a picture.
struct Observation {
  PersonSource source;
  std::vector<std::vector<Marks>> marks;  ///< empty in frames that the annotator did not see
  std::vector<std::vector<Mask>>
      masks;        ///< by picture, half size; kept on request and for silhouettes (`kMaxSilhouettePictures`)
  MaskScore score;  ///< mean over all pictures
  /// The agreement of two annotators over all pictures; empty with a single annotator.
  std::optional<double> annotator_distance_px, annotator_overlap;
  std::string masks_digest;
  std::string marks_digest;
};

/// Masks for silhouettes are kept for takes of at most this many pictures over all cameras, 77 kB each.
constexpr std::size_t kMaxSilhouettePictures = 4000;

struct Take {
  std::string pictures_digest;
  std::vector<ColourImage> stills;        ///< each camera's picture of the middle frame; only if masks are kept
  std::vector<Observation> observations;  ///< one per requested source, in that order
};

/// Receives each picture as it is shot; there are too many to keep. `frame` is empty for the background.
using PictureSink = std::function<void(std::size_t camera, std::optional<std::size_t> frame, const ColourImage&)>;

/// Films the world and has the pictures annotated: every picture is rendered once, cut out by each of `sources`, and
/// marked on each cut-out with the same random draws.
Take Film(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
          std::span<const PersonSource> sources, bool wants_masks, Renderer& renderer, const PictureSink& sink = {});

}  // namespace etude

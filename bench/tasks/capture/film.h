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

/// The result of one segmenter on a take. The true masks may be used in place of the segmenter. Indices are
/// [camera][frame], or [camera][picture] for members "by picture": only every n-th frame has a picture
/// (`StudioOptions::picture_every`).
struct Observation {
  PersonSource source;
  std::vector<std::vector<Marks>> marks;  ///< the marks; empty in frames that are not to be marked (`IsMarked`)
  /// Masks by picture, half as wide and half as high as the picture. They are kept if the parameter `wants_masks` of
  /// `Film` is true, and for silhouettes if the take has at most kMaxSilhouettePictures pictures.
  std::vector<std::vector<Mask>> masks;
  MaskScore score;  ///< mean score over all pictures
  /// The agreement of two annotators over all pictures. Empty if there is one annotator.
  std::optional<double> annotator_distance_px, annotator_overlap;
  std::string masks_digest;
  std::string marks_digest;
};

/// Masks for silhouettes are kept only if a take has at most this many pictures, counted over all cameras. A mask
/// takes 77 kB.
constexpr std::size_t kMaxSilhouettePictures = 4000;

struct Take {
  std::string pictures_digest;
  std::vector<ColourImage> stills;        ///< each camera's picture of the middle frame; empty unless masks are kept
  std::vector<Observation> observations;  ///< one observation per requested source, in the order of the sources
};

/// Receives each picture when it is shot, because there are too many to keep. `frame` is empty for the background.
using PictureSink = std::function<void(std::size_t camera, std::optional<std::size_t> frame, const ColourImage&)>;

/// Films the world and has the pictures annotated. Every picture is rendered once. Each of `sources` cuts out the
/// person, and each cut-out is marked with the same random draws.
Take Film(const CaptureWorld& world, const StudioOptions& options, const WorldKey& key,
          std::span<const PersonSource> sources, bool wants_masks, Renderer& renderer, const PictureSink& sink = {});

}  // namespace etude

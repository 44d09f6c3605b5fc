#include "tools/capture/reduced_film.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

double ReductionOf(const Intrinsics& in, int side) {
  return std::max(1.0, static_cast<double>(std::max(in.width, in.height)) / side);
}

Rgb8 MeanOf(const ColourImage& picture, const FilmPatch& patch) {
  if (patch.right <= patch.left || patch.bottom <= patch.top) return {};
  const auto width = static_cast<unsigned>(patch.right - patch.left);
  const unsigned count = width * static_cast<unsigned>(patch.bottom - patch.top);
  unsigned r = count / 2, g = r, b = r;  // so that the division rounds
  for (int y = patch.top; y < patch.bottom; ++y) {
    const Rgb8* const row = &picture.At(patch.left, y);
    for (unsigned x = 0; x < width; ++x) r += row[x].r, g += row[x].g, b += row[x].b;
  }
  return {static_cast<std::uint8_t>(r / count), static_cast<std::uint8_t>(g / count),
          static_cast<std::uint8_t>(b / count)};
}

}  // namespace

Image<FilmPatch> PatchesOf(const FilmFacts& facts, const Camera& camera, const PixelFit& fit, int side) {
  const Intrinsics small = ReducedCamera(camera, side).intrinsics;
  const double reduction = ReductionOf(camera.intrinsics, side);
  const glm::dvec2 half = 0.5 * reduction * fit.scale;
  Image<FilmPatch> patches(small.width, small.height);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      const auto seen = DistortPixel(camera, reduction * glm::dvec2(x + 0.5, y + 0.5));
      if (!seen) continue;
      const glm::dvec2 low = fit.ToFilm(*seen) - half, high = low + 2.0 * half;
      const auto within = [](double value, int size) {
        return static_cast<int>(std::lround(std::clamp<double>(value, 0, size)));
      };
      patches.At(x, y) = {within(low.x, facts.width), within(low.y, facts.height), within(high.x, facts.width),
                          within(high.y, facts.height)};
    }
  }
  return patches;
}

Camera ReducedCamera(const Camera& camera, int side) {
  Camera small = camera;
  small.distortion = {};
  const double reduction = ReductionOf(camera.intrinsics, side);
  Intrinsics& in = small.intrinsics;
  in.width = static_cast<int>(std::lround(in.width / reduction));
  in.height = static_cast<int>(std::lround(in.height / reduction));
  for (double* length : {&in.fx, &in.fy, &in.cx, &in.cy, &in.skew}) *length /= reduction;
  return small;
}

Result<std::vector<ColourImage>> ReadReduced(const std::filesystem::path& path, const FilmFacts& facts,
                                             const Camera& camera, const PixelFit& fit, int side,
                                             std::size_t max_pictures) {
  const Image<FilmPatch> patches = PatchesOf(facts, camera, fit, side);
  ASSIGN_OR_RETURN(Decoder decoder, Decoder::Start(path, facts));
  std::vector<ColourImage> pictures;
  ColourImage frame;
  while (pictures.size() < max_pictures) {
    ASSIGN_OR_RETURN(const bool is_there, decoder.Next(frame));
    if (!is_there) break;
    ColourImage& picture = pictures.emplace_back(patches.width, patches.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = MeanOf(frame, patches.pixels[i]);
  }
  return pictures;
}

}  // namespace etude

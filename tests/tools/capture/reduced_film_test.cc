#include "tools/capture/reduced_film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns a lens with barrel distortion, in pictures of 400 × 300.
Camera Lens() {
  Camera camera =
      LookAt({.width = 400, .height = 300, .fx = 380, .fy = 380, .cx = 205, .cy = 148}, {0.3, 1.5, 4}, {0, 1, 0});
  camera.distortion = {.k1 = -0.15, .p1 = 0.002};
  return camera;
}

/// Writes the film as one picture: black, with a white square of 9 pixels where the lens shows a point.
std::filesystem::path Filmed(const glm::dvec2& pixel, int width, int height) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("etude-reduced-" + std::to_string(width) + "-" + std::to_string(std::lround(pixel.x)) + ".ppm");
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << width << ' ' << height << "\n255\n";
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_set = std::max(std::abs(x + 0.5 - pixel.x), std::abs(y + 0.5 - pixel.y)) < 4.5;
      for (int k = 0; k < 3; ++k) file.put(static_cast<char>(is_set ? 255 : 0));
    }
  }
  return path;
}

glm::dvec2 MiddleOfLight(const ColourImage& picture) {
  glm::dvec2 sum(0);
  double light = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double weight = picture.At(x, y).g;
      sum += weight * glm::dvec2(x + 0.5, y + 0.5);
      light += weight;
    }
  }
  return sum / light;
}

TEST(ReadReduced, ShowsPlacesWhereAPinholeOfItsSizeWould) {
  const Camera camera = Lens();
  const Camera small = ReducedCamera(camera, 100);
  EXPECT_EQ(small.intrinsics.width, 100);
  EXPECT_EQ(small.intrinsics.height, 75);
  EXPECT_TRUE(small.distortion.IsNone());
  const PixelFit letterbox = *FitPictures(FitMode::kLetterbox, {400, 300}, {400, 320});
  for (const glm::dvec3 place : {glm::dvec3(0, 1, 0), glm::dvec3(1.2, 1.9, 0.3), glm::dvec3(-1.3, 0.4, -0.5)}) {
    const glm::dvec2 shown = letterbox.ToFilm(*Project(camera, place));
    const auto path = Filmed(shown, 400, 320);
    const FilmFacts facts = *ProbeFilm(path);
    ASSERT_OK(pictures, ReadReduced(path, facts, camera, letterbox, 100, 10));
    ASSERT_EQ(pictures->size(), 1u);
    const glm::dvec2 wanted = *Project(MatrixOf(small), place);
    EXPECT_LT(glm::distance(MiddleOfLight(pictures->front()), wanted), 0.35)
        << place.x << ": the square and what a pixel covers are whole pixels of the film, a quarter each";
    // The control: a pinhole that ignores the film's distortion.
    const auto wrong = ReadReduced(path, facts, camera, {}, 100, 10);
    EXPECT_GT(glm::distance(MiddleOfLight(wrong->front()), wanted), 1.5);
    std::filesystem::remove(path);
  }
}

TEST(ReadReduced, NeverEnlarges) {
  const Camera camera = Lens();
  EXPECT_EQ(ReducedCamera(camera, 1000).intrinsics.width, 400);
  EXPECT_EQ(ReducedCamera(camera, 1000).intrinsics.fx, 380);
}

}  // namespace
}  // namespace etude

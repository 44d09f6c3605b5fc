// The messages about films and rigs that do not fit together.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/keypoints/guess_session.h"
#include "engine/keypoints/rig_warnings.h"
#include "tests/engine/keypoints/crowd.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

/// Returns one walker in films whose pixels went through `change`.
template <typename Change>
std::vector<PictureOfFilm> Films(testing::Dice& dice, std::size_t count, double noise_px, const Change& change) {
  const Crowd crowd(dice, 30, noise_px, 0.02, 15);
  std::vector<PictureOfFilm> films;
  for (std::size_t c = 0; c < count; ++c) {
    films.push_back({.camera = crowd.cameras[c], .fit = {}, .film_px = {1280, 720}, .people = crowd.people[c]});
    for (auto& frame : films.back().people) {
      for (SeenPerson& person : frame) {
        for (Keypoint& keypoint : person.keypoints) keypoint.pixel = change(c, keypoint.pixel);
      }
    }
  }
  return films;
}

TEST(GuessSession, SaysWhatItSaid) {
  testing::Dice dice(6);
  std::vector<std::string> lines;
  const std::vector<std::string> names = {"a", "b", "c", "d"};
  for (int k = 0; k < 13; ++k) {
    const std::size_t count = k == 11 ? 2 : k % 4 == 3 ? 2 : 3 + k % 2;
    const double noise_px = k % 3 == 2 ? 6 : 0.5;
    auto films = Films(dice, count, noise_px, [&](std::size_t c, const glm::dvec2& p) {
      if (k == 1 && c == 1) return glm::dvec2(720 - p.y, p.x);
      if (k == 2 && c == 2) return glm::dvec2(1280 - p.x, p.y);
      if (k == 3 && c == 0) return glm::dvec2(1280, 720) - p;
      if (k == 4) return glm::dvec2(p.x, 720 - p.y);
      if (k == 5) return p * glm::dvec2(1, 720 / 1280.0);
      if (k == 6) return 1.5 * p;
      if (k == 7 || k > 10) return p / 1.5;
      return p;
    });
    if (k == 1) films[1].film_px = {720, 1280};
    if (k == 7 || k == 6 || k > 10) {
      for (PictureOfFilm& film : films)
        film.fit = PixelFit{.scale = glm::dvec2(k == 7   ? 0.7
                                                : k == 6 ? 1.5
                                                         : 1 / 1.5),
                            .shift = {k > 10 ? 0 : k, k > 10 ? 0 : 3}};
    }
    if (k == 6) films[1].fit = {}, films[2].is_sized = noise_px > 1;
    if (k == 8) std::swap(films[0].camera, films[2].camera);
    if (k == 9) films[1].camera.intrinsics.fx *= 0.93, films[1].camera.intrinsics.fy *= 0.93;
    lines.push_back(fmt::format("session {}, off by {:.4f} px", k, EpipolarDistanceOf(films, 0.3)));
    for (const PictureGuess& guess : GuessPictures(films, 0.1)) {
      if (!guess.told.empty()) lines.push_back("  picture: " + guess.told);
    }
    const SessionGuess session =
        GuessSession(films, std::span(names).first(count), glm::dmat3(0, 0, 1, 1, 0, 0, 0, 1, 0), 0.1);
    if (!session.mended.empty()) lines.push_back("  session: " + session.mended);
  }
  EXPECT_TRUE(testing::AreKept(lines, "tests/engine/keypoints/sessions.txt"));
}

TEST(RigWarnings, SaysWhatItSaid) {
  testing::Dice dice(7);
  std::vector<std::string> lines;
  const std::vector<std::string> names = {"a", "b", "c", "d"};
  for (int k = 0; k < 16; ++k) {
    const std::size_t count = k % 3 == 0 || k > 11 ? 2 : 4;
    auto films = Films(dice, count, 0.5 + k % 4, [&](std::size_t, const glm::dvec2& p) {
      if (k == 4 || k == 5) return p * glm::dvec2(1, 720 / 1280.0) + glm::dvec2(0, k == 4 ? 157 : 0);
      return k == 6 ? glm::dvec2(p.x, 1.15 * p.y) : p;
    });
    std::vector<Camera> cameras;
    MatchedPerson person{.seen = {}, .cameras = count};
    for (PictureOfFilm& film : films) {
      const bool is_off = k == 8 || k == 9 || (cameras.size() == 1 && (k % 2 == 1 || k > 11));
      const double gain = is_off ? 1 + 0.02 * (k % 5) - (k > 11 ? 0.1 : 0.03) : 1;
      film.camera.intrinsics.fx *= gain, film.camera.intrinsics.fy *= gain;
      cameras.push_back(film.camera);
      auto& seen = person.seen.emplace_back();
      for (const auto& frame : film.people) seen.push_back(frame.empty() ? std::nullopt : std::optional(frame[0]));
    }
    lines.push_back(fmt::format("rig {}", k));
    // Some identities are wrong, which does not change the median.
    for (const std::string& doubt : RigWarnings(cameras, std::span(names).first(count), person, k % 2 ? 0.1 : 0.5))
      lines.push_back("  " + doubt);
  }
  EXPECT_TRUE(testing::AreKept(lines, "tests/engine/keypoints/doubts.txt"));
}

}  // namespace
}  // namespace etude

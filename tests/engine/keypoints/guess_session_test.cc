#include "engine/keypoints/guess_session.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>

#include "engine/keypoints/rig_warnings.h"
#include "tests/engine/keypoints/walkers.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const glm::dvec2 kPicture(1280, 720);
const std::vector<std::string> kFilms = {"cam1", "cam2", "cam3", "cam4"};

/// Returns a walker in the pictures of some of four cameras whose principal points are not the pictures' centres. With
/// `lean`, the walker leans by this slope, seen by the first two cameras to the right.
std::vector<PictureOfFilm> FilmedWalker(std::size_t count = 4, double sigma_px = 0.2, double lean = 0) {
  RandomStream dice = WalkersDice("pictures");
  std::vector<PictureOfFilm> films;
  for (Camera camera : Pinholes()) {
    camera.intrinsics.cx += 12;
    camera.intrinsics.cy -= 9;
    PictureOfFilm film{.camera = camera, .fit = {}, .film_px = kPicture, .people = {}};
    for (std::size_t k = 0; k < 45; ++k) {
      LandmarkPositions walker = Walker(-0.2, 0.1, static_cast<double>(k) / 15);
      for (auto& mark : walker) {
        if (mark) *mark += lean * mark->y * glm::dvec3(0.9, 0, -0.45);
      }
      film.people.push_back({Seen(camera, walker, sigma_px, dice)});
    }
    if (films.size() < count) films.push_back(film);
  }
  return films;
}

void ChangePixels(PictureOfFilm& film, const std::function<glm::dvec2(const glm::dvec2&)>& change) {
  for (auto& frame : film.people) {
    for (SeenPerson& person : frame) {
      for (Keypoint& keypoint : person.keypoints) keypoint.pixel = change(keypoint.pixel);
    }
  }
}

/// Returns the largest distance, pixels, between a keypoint of `people` and the same keypoint of `truth`.
double FurthestPx(const std::vector<SeenPeople>& people, const std::vector<PictureOfFilm>& truth) {
  double furthest = 0;
  for (std::size_t c = 0; c < truth.size(); ++c) {
    for (std::size_t k = 0; k < truth[c].people.size(); ++k) {
      for (std::size_t i = 0; i < kLandmarkCount; ++i) {
        const Keypoint &a = people[c][k][0].keypoints[i], &b = truth[c].people[k][0].keypoints[i];
        if (b.confidence > 0) furthest = std::max(furthest, glm::distance(a.pixel, b.pixel));
      }
    }
  }
  return furthest;
}

/// Returns the doubts about the rig from the only person in these films.
std::vector<std::string> Doubts(const std::vector<PictureOfFilm>& films) {
  MatchedPerson person{.seen = {}, .cameras = films.size()};
  std::vector<Camera> cameras;
  for (const PictureOfFilm& film : films) {
    cameras.push_back(film.camera);
    auto& seen = person.seen.emplace_back();
    for (const auto& frame : film.people) seen.emplace_back(frame.at(0));
  }
  return RigWarnings(cameras, std::span(kFilms).first(films.size()), person, 0.1);
}

/// Returns films of two cameras side by side with parallel axes, so that epipolar lines are picture rows.
std::vector<PictureOfFilm> SideBySide() {
  std::vector<PictureOfFilm> films = FilmedWalker(2, 0);
  RandomStream dice = WalkersDice("rows");
  for (std::size_t c = 0; c < 2; ++c) {
    films[c].camera.R_CW = glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, -1);
    films[c].camera.p_WC = glm::dvec3(static_cast<double>(c), 1, 4);
    for (auto& frame : films[c].people) frame = {Seen(films[c].camera, Walker(0.3, 0, 0.1), 0, dice)};
  }
  return films;
}

TEST(EpipolarDistanceOf, IsTheSampsonDistanceOfAPairAsAShareOfTheHeight) {
  std::vector<PictureOfFilm> films = SideBySide();
  EXPECT_LT(EpipolarDistanceOf(films, 0.1), 1e-12);
  ChangePixels(films[1], [](glm::dvec2 p) { return p + glm::dvec2(5, 8); });
  const double height = std::max(HeightPx(films[0].people[0][0]), HeightPx(films[1].people[0][0]));
  EXPECT_NEAR(EpipolarDistanceOf(films, 0.1), 4 / height, 1e-9) << "8 px too low are 4 px off in each picture";
  EXPECT_EQ(EpipolarDistanceOf(films, 0.9), 1) << "nobody is as sure as that: nothing can be said";
}

TEST(GuessPictures, LeavesPicturesThatAreAsSaid) {
  for (const double sigma_px : {0.0, 8.0}) {
    const auto films = FilmedWalker(4, sigma_px);
    for (const PictureGuess& guess : GuessPictures(films, 0.1)) {
      EXPECT_TRUE(guess.fit.IsNone());
      EXPECT_EQ(guess.told, "");
    }
  }
}

TEST(GuessPictures, FindsWhichFilmWasTurnedOrMirrored) {
  for (int turns = 0; turns < 4; ++turns) {
    for (const bool is_mirrored : {false, true}) {
      if (turns == 0 && !is_mirrored) continue;
      auto films = FilmedWalker();
      const PixelFit truth{.quarter_turns = turns, .is_mirrored = is_mirrored, .size = kPicture};
      ChangePixels(films[2], [&](glm::dvec2 p) { return truth.ToFilm(p); });
      const auto guesses = GuessPictures(films, 0.1);
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(guesses[c].fit, c == 2 ? truth : PixelFit{}) << turns << is_mirrored << c;
        EXPECT_EQ(guesses[c].told.empty(), c != 2);
      }
      const std::string turned = turns == 0 ? "" : fmt::format("turned by {}° clockwise", 90 * turns);
      const std::string words = !is_mirrored ? turned : turns == 0 ? "mirrored" : "mirrored and " + turned;
      EXPECT_THAT(guesses[2].told,
                  StartsWith("pictures " + words + ": rays to the same keypoint miss each other by 0.0"));
    }
  }
}

TEST(GuessPictures, OfTwoFilmsSaysThatItMayBeTheOther) {
  auto films = SideBySide();
  ChangePixels(films[1], [](glm::dvec2 p) { return kPicture - p; });
  const auto guesses = GuessPictures(films, 0.1);
  const std::string told = guesses[0].told + guesses[1].told;
  EXPECT_THAT(told, HasSubstr("turned by 180° clockwise"));
  EXPECT_THAT(told, HasSubstr("(or film ")) << "one of two";
}

TEST(GuessPictures, ReadsPixelsOfTheRigsPicturesWhereFilmsWereFitted) {
  const auto truth = FilmedWalker();
  const PixelFit fit = *FitPictures(FitMode::kLetterbox, kPicture, {800, 800});
  for (const bool is_stored : {false, true}) {
    auto films = truth;
    for (PictureOfFilm& film : films) {
      film.fit = fit;
      film.film_px = {800, 800};
      if (!is_stored) ChangePixels(film, [&](glm::dvec2 p) { return fit.ToFilm(p); });
    }
    for (const PictureGuess& guess : GuessPictures(films, 0.1)) {
      EXPECT_EQ(guess.fit, is_stored ? PixelFit{} : fit);
      EXPECT_EQ(guess.told.empty(), !is_stored);
    }
  }
}

TEST(GuessSession, LeavesASessionThatIsAsSaid) {
  for (const double sigma_px : {0.0, 3.0}) {
    const auto films = FilmedWalker(4, sigma_px);
    const SessionGuess guess = GuessSession(films, kFilms, glm::dmat3(1), 0.1);
    EXPECT_EQ(guess.mended, "");
    EXPECT_EQ(guess.doubt, "");
    EXPECT_EQ(guess.turns, 0);
    EXPECT_THAT(Doubts(films), IsEmpty());
    EXPECT_EQ(FurthestPx(guess.people, films), 0);
  }
}

TEST(GuessSession, ReadsKeypointsAsTheyWereMeant) {
  const double side = 1280, bar = 0.5 * (1280 - 720);
  const std::vector<std::pair<std::string, std::function<glm::dvec2(glm::dvec2)>>> mistakes = {
      {"keypoints have their origin at the bottom of the picture",
       [](glm::dvec2 p) { return glm::dvec2(p.x, 720 - p.y); }},
      {"keypoints have x and y exchanged", [](glm::dvec2 p) { return glm::dvec2(p.y, p.x); }},
      {"keypoints of all films are mirrored", [](glm::dvec2 p) { return glm::dvec2(1280 - p.x, p.y); }},
      {"keypoint coordinates are fractions of the side of a square around the picture",
       [&](glm::dvec2 p) { return (p + glm::dvec2(0, bar)) / side * kPicture; }},
      {"keypoint coordinates are fractions of the longer side of the picture",
       [&](glm::dvec2 p) { return p / side * kPicture; }},
      {"keypoints belong to pictures 0.5 times as large", [](glm::dvec2 p) { return 0.5 * p; }},
      {"keypoints belong to pictures 1.5 times as large", [](glm::dvec2 p) { return 1.5 * p; }},
      {"keypoints belong to pictures 3 times as large", [](glm::dvec2 p) { return 3.0 * p; }}};
  const auto truth = FilmedWalker();
  for (const auto& [told, mistake] : mistakes) {
    auto films = truth;
    for (PictureOfFilm& film : films) ChangePixels(film, mistake);
    const SessionGuess guess = GuessSession(films, kFilms, glm::dmat3(1), 0.1);
    EXPECT_THAT(guess.mended, StartsWith(told + ": rays to the same keypoint miss each other by 0.0")) << told;
    EXPECT_LT(FurthestPx(guess.people, truth), 1e-9) << told;
  }
}

TEST(GuessSession, FindsHowAllFilmsAreTurned) {
  const auto truth = FilmedWalker();
  for (const int declared : {0, 1}) {  // films of the rig's size, or films that are shown turned
    for (int turns = 0; turns < 4; ++turns) {
      auto films = truth;
      const PixelFit fit{.quarter_turns = turns, .size = kPicture};
      for (PictureOfFilm& film : films) {
        ChangePixels(film, [&](glm::dvec2 p) { return fit.ToFilm(p); });
        if (declared == 0) continue;
        film.fit = {.quarter_turns = declared, .size = kPicture};
        film.film_px = {kPicture.y, kPicture.x};
      }
      const SessionGuess guess = GuessSession(films, kFilms, glm::dmat3(1), 0.1);
      EXPECT_EQ((declared + guess.turns) % 4, turns);
      EXPECT_EQ(guess.mended.empty(), turns == declared) << guess.mended;
      EXPECT_EQ(guess.doubt, "");
      auto read = guess.people;
      for (std::size_t c = 0; c < films.size(); ++c) {
        PictureOfFilm film{.people = read[c]};
        ChangePixels(film, [&](glm::dvec2 p) { return guess.fits[c].ToRig(p); });
        read[c] = film.people;
      }
      EXPECT_LT(FurthestPx(read, truth), 1e-9) << declared << turns;
    }
  }
}

// If a person leans, pictures turned by 90° can show the shoulders below the ankles. This must not count as evidence of
// a turn by 180°, because 90° fits exactly.
TEST(GuessSession, FindsTheTurnOfAPersonWhoLeans) {
  for (const double lean : {-0.25, 0.25}) {
    const auto truth = FilmedWalker(2, 0, lean);
    for (const int turns : {1, 2, 3}) {
      auto films = truth;
      const PixelFit fit{.quarter_turns = turns, .size = kPicture};
      for (PictureOfFilm& film : films) ChangePixels(film, [&](glm::dvec2 p) { return fit.ToFilm(p); });
      const SessionGuess guess = GuessSession(films, kFilms, glm::dmat3(1), 0.1);
      EXPECT_EQ(guess.turns, turns) << lean << ": " << guess.mended;
    }
  }
}

TEST(GuessSession, DoubtsAnUnknownScaleOrCropAndLeavesIt) {
  struct Mistake {
    glm::dvec2 scale, shift;  ///< from the keypoints to the rig's picture
  };
  const auto truth = FilmedWalker(3);
  for (const Mistake& mistake : {Mistake{glm::dvec2(1 / 0.7667), glm::dvec2(0)},
                                 {kPicture / glm::dvec2(256, 256), glm::dvec2(0)},
                                 {glm::dvec2(1), glm::dvec2(160, 60)}}) {
    auto films = truth;
    for (PictureOfFilm& film : films) {
      ChangePixels(film, [&](glm::dvec2 p) { return (p - mistake.shift) / mistake.scale; });
    }
    const SessionGuess guess = GuessSession(films, kFilms, glm::dmat3(1), 0.1);
    EXPECT_EQ(guess.mended, "");
    EXPECT_EQ(FurthestPx(guess.people, films), 0);
    // The doubt states the fitted scale and shift; the fit is not exact.
    glm::dvec2 scale(0), shift(0);
    const std::size_t at = std::min(guess.doubt.find("scaled by"), guess.doubt.size());
    ASSERT_EQ(std::sscanf(guess.doubt.c_str() + at, "scaled by %lf and %lf, then shifted by %lf and %lf px", &scale.x,
                          &scale.y, &shift.x, &shift.y),
              4)
        << guess.doubt;
    EXPECT_LT(glm::length(scale / mistake.scale - 1.0), 0.005) << guess.doubt;
    EXPECT_LT(glm::length(shift - mistake.shift), 3) << guess.doubt;
  }
}

TEST(GuessSession, FindsWhichFilmsWereExchanged) {
  auto films = FilmedWalker();
  std::swap(films[1].camera, films[3].camera);
  const SessionGuess guess = GuessSession(films, kFilms, glm::dmat3(1), 0.1);
  EXPECT_THAT(guess.mended, StartsWith("the films or the keypoints of cam2 and cam4 are exchanged: "));
  EXPECT_EQ(guess.cameras[1].p_WC, Pinholes()[1].p_WC);
  EXPECT_EQ(guess.cameras[3].p_WC, Pinholes()[3].p_WC);
}

TEST(GuessSession, ReadsPosesOfOtherConventions) {
  const glm::dmat3 R_WF(0, 0, 1, 1, 0, 0, 0, 1, 0);  // Z up in the file
  const glm::dmat3 opengl(1, 0, 0, 0, -1, 0, 0, 0, -1);
  for (const auto& [is_inverse, is_opengl, told] :
       {std::tuple(true, false, "the poses in the rig file are from camera to world: "),
        {false, true, "the rig's cameras look along -z, with y up: "},
        {true, true,
         "the poses in the rig file are from camera to world, and the cameras look along -z, with y up: "}}) {
    auto films = FilmedWalker();
    for (PictureOfFilm& film : films) {
      Camera& camera = film.camera;  // the other convention, p_C = R p_F + t
      glm::dmat3 R = camera.R_CW * R_WF;
      glm::dvec3 t = -(camera.R_CW * camera.p_WC);
      if (is_opengl) R = opengl * R, t = opengl * t;
      if (is_inverse) t = -(glm::transpose(R) * t), R = glm::transpose(R);
      camera.R_CW = R * glm::transpose(R_WF);
      camera.p_WC = -(glm::transpose(camera.R_CW) * t);
    }
    const SessionGuess guess = GuessSession(films, kFilms, R_WF, 0.1);
    EXPECT_THAT(guess.mended, StartsWith(told));
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_LT(glm::distance(guess.cameras[c].p_WC, Pinholes()[c].p_WC), 1e-9) << told;
      for (int i = 0; i < 3; ++i) {
        EXPECT_LT(glm::distance(guess.cameras[c].R_CW[i], Pinholes()[c].R_CW[i]), 1e-9) << told;
      }
    }
  }
}

TEST(GuessSession, TellsOfAFocalLengthAndLeavesIt) {
  auto films = FilmedWalker();
  films[2].camera.intrinsics.fx /= 1.1;
  films[2].camera.intrinsics.fy /= 1.1;
  const SessionGuess guess = GuessSession(films, kFilms, glm::dmat3(1), 0.1);
  EXPECT_EQ(guess.mended, "");
  EXPECT_THAT(Doubts(films), ElementsAre(HasSubstr(": a focal length multiplied by 1.10")));
  EXPECT_EQ(guess.cameras[2].intrinsics.fx, films[2].camera.intrinsics.fx);
}

}  // namespace
}  // namespace etude

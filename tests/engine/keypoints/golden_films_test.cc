// Golden values of what keypoints tell of films, rigs and clocks: see golden_test.cc.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/base/angles.h"
#include "engine/keypoints/doubt_rig.h"
#include "engine/keypoints/guess_session.h"
#include "engine/keypoints/place_rig.h"
#include "engine/keypoints/synchronise_people.h"
#include "engine/vision/strokes.h"
#include "tests/engine/keypoints/crowd.h"

namespace etude {
namespace {

using testing::Fingerprint;

/// One walker in films whose pixels went through `change`.
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

TEST(FilmsGolden, WhatIsFoundWrongWithFilmsAndSessions) {
  testing::Dice dice(6);
  Fingerprint print;
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
    for (const PictureGuess& guess : GuessPictures(films, 0.1)) {
      print.Add(guess.told).Add(guess.fit.scale).Add(guess.fit.shift).Add(guess.fit.quarter_turns);
      print.Add(guess.fit.is_mirrored).Add(guess.fit.size);
    }
    print.Add(MissOfPictures(films, 0.3));
    const SessionGuess session =
        GuessSession(films, std::span(names).first(count), glm::dmat3(0, 0, 1, 1, 0, 0, 0, 1, 0), 0.1);
    print.Add(session.mended);
    for (const Camera& camera : session.cameras) print.Add(camera.p_WC).Add(camera.R_CW[0]);
    for (const SeenPeople& people : session.people) {
      for (const SeenPerson& person : people[7]) AddSeen(print, person);
    }
  }
  EXPECT_TRUE(print.Is(7670, 14027.4507431));
}

TEST(FilmsGolden, DoubtsAboutTheRig) {
  testing::Dice dice(7);
  Fingerprint print;
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
    // Who is who is not always right, which leaves the median as it is.
    for (const std::string& doubt : DoubtRig(cameras, std::span(names).first(count), person, k % 2 ? 0.1 : 0.5))
      print.Add(doubt);
    print.Add(k);
  }
  EXPECT_TRUE(print.Is(1052, 1234.30777476));
}

TEST(FilmsGolden, ClocksOfFilms) {
  testing::Dice dice(8);
  Fingerprint print;
  for (int k = 0; k < 6; ++k) {
    Crowd crowd(dice, 36, k < 3 ? 0.5 + k : 4 * k - 8);
    crowd.people[1].erase(crowd.people[1].begin(), crowd.people[1].begin() + 2);
    crowd.people[2].insert(crowd.people[2].begin(), {});
    if (k == 1) crowd.people[3] = PeopleInTime(crowd.people[3], FilmClock{0.4, 0.02}, 34);
    const std::size_t count = 2 + k % 3;
    const auto matrices = std::span(crowd.matrices).first(count);
    const auto people = std::span(crowd.people).first(count);
    for (const ClockOffset& offset :
         EstimateOffsets(matrices, people, {.clocks = {.most_frames = 4, .most_px = 30.0 + k}, .follow = {}}))
      print.Add(offset.frames).Add(offset.is_told);
    const std::vector<FilmClock> given(count, FilmClock{k == 1 ? 0.5 : 0, 0});
    for (const FoundClock& found : FindClocks(matrices, people, given, 3, {})) {
      for (const FilmClock& clock : {found.clock, found.nearest}) print.Add(clock.offset).Add(100 * clock.drift);
      print.Add(found.before).Add(found.after).Add(found.is_mended);
    }
    for (const SeenPeople& shown :
         {PeopleInTime(crowd.people[0], 1.25, 30), PeopleInTime(crowd.people[1], FilmClock{-0.5, 0.01}, 40)}) {
      for (const auto& frame : shown) {
        print.Add(frame.size());
        for (const SeenPerson& person : frame) AddSeen(print, person);
      }
    }
  }
  EXPECT_TRUE(print.Is(52998, 50767.2626029));
}

/// Stands on several places of a floor that is tilted, leans, and is so many times as large as in metres.
std::vector<LandmarkPlaces> StandsAbout(testing::Dice& dice, double size, double tilt_deg, double lean, bool has_toes) {
  using enum Landmark;
  const glm::dmat3 R = glm::mat3_cast(glm::angleAxis(
      Radians(tilt_deg), glm::normalize(tilt_deg == 91 ? glm::dvec3(0.1, 0.2, 1) : glm::dvec3(1, 0.1, 0.3))));
  std::vector<LandmarkPlaces> frames;
  for (int k = 0; k < 60; ++k) {
    LandmarkPlaces& places = frames.emplace_back();
    const glm::dvec3 at(0.7 * std::cos(k / 12), 0, 0.6 * std::sin(2 * (k / 12)));
    for (const double side : {1.0, -1.0}) {
      const auto set = [&](Landmark left, Landmark right, double x, double y, double z) {
        const glm::dvec3 p = at + glm::dvec3(side * x, y, z) + 0.004 * dice.Vector();
        if (dice.Below(9)) places[Index(side > 0 ? left : right)] = size * (R * (p + glm::dvec3(0, 0.2, 0)));
      };
      set(kLeftAnkle, kRightAnkle, 0.1, 0.08 + (k % 12 < 3 ? 0.2 : 0), 0);
      if (has_toes)
        set(kLeftBigToe, kRightBigToe, 0.1, 0.02, 0.15), set(kLeftSmallToe, kRightSmallToe, 0.13, 0.02, 0.13);
      if (has_toes) set(kLeftHeel, kRightHeel, 0.1, 0.03, -0.05);
      set(kLeftKnee, kRightKnee, 0.1, 0.5, 0.4 * lean);
      set(kLeftHip, kRightHip, 0.1, 0.93, 0.85 * lean);
      set(kLeftShoulder, kRightShoulder, 0.18, 1.4, 1.3 * lean);
    }
  }
  return frames;
}

TEST(FilmsGolden, PlacesOfRigs) {
  testing::Dice dice(9);
  Fingerprint print;
  const auto add = [&](const Result<RigPlace>& place) {
    print.Add(place.has_value());
    if (!place) {
      print.Add(place.error().message);
      return;
    }
    print.Add(place->scale).Add(place->shift).Add(place->stature_m).Add(place->told).Add(place->IsNone());
    for (int i = 0; i < 3; ++i) print.Add(place->R[i]);
    const Camera camera = Placed(*place, LookAt({}, {1, 2, 3}, {0, 1, 0}));
    print.Add(camera.p_WC).Add(camera.R_CW[0]);
  };
  for (const double size : {1.0, 100.0, 12.0, 1.35, 0.2}) {
    for (const double tilt_deg : {0.0, 7.0, 9.0, 33.0, 36.0, 91.0, 178.0}) {
      const double lean = 0.1 * dice.Below(3);
      const bool has_toes = dice.Below(2) == 0;
      const auto points = StandsAbout(dice, size, tilt_deg, lean, has_toes);
      RigFile rig{.cameras = {{"left", LookAt({}, {1, 2, 3}, {0, 1, 0})}}, .format = "Pose2Sim"};
      rig.unit_m = size == 100 ? 0.01 : 1;
      if (size == 12) rig.R_WF = glm::dmat3(0, 0, 1, 1, 0, 0, 0, 1, 0);
      if (size == 1.35) rig.format = "Caliscope";
      if (tilt_deg == 33) rig.cameras.push_back({"eye", Camera{}});
      rig.has_unit = tilt_deg != 36;
      for (const PlaceOptions& options : {PlaceOptions(),
                                          {.up = "floor", .floor = "keep"},
                                          {.unit = "cm", .up = "-z", .floor = "feet"},
                                          {.unit = "foot", .floor = "0.3"}}) {
        add(PlaceRig(rig, points, 25, options));
        add(PlaceRig(rig, options));
      }
    }
  }
  EXPECT_TRUE(print.Is(22148, -5631.25066721));
}

TEST(FilmsGolden, NamesLayoutsMarksAndFits) {
  Fingerprint print;
  for (const std::string& name : KeypointLayoutNames()) print.Add(name);
  for (const KeypointLayout& layout : KeypointLayouts()) {
    print.Add(layout.name).Add(layout.landmarks).Add(layout.more).Add(FindKeypointLayout(layout.name) == &layout);
  }
  print.Add(FindKeypointLayout("coco_") == nullptr);
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    const std::string name(LandmarkName(static_cast<Landmark>(i)));
    print.Add(name).Add(OtherSide(static_cast<Landmark>(i)));
    for (const std::string& other : {"A" + name, "left" + name, name + "RIGHT", name + "z", "r " + name})
      print.Add(LandmarkOfName(other));
  }
  for (const char* name : {"Hip", "root", "Pelvis", "top-head", "lfootindex", "R foot index", "@Z[`z{", "leftleft"})
    print.Add(LandmarkOfName(name));
  testing::Dice dice(10);
  for (int k = 0; k < 20; ++k) {
    Marks marks;
    const auto anywhere = [&] { return 100.0 * glm::dvec2(dice.Vector()); };
    for (auto& stroke : marks.strokes) {
      if (dice.Below(3)) stroke = PixelSegment{anywhere(), anywhere()};
    }
    for (auto& effector : marks.effectors) {
      if (dice.Below(2)) effector = anywhere();
    }
    AddSeen(print, PersonOf(marks));
    for (const FitMode mode : {FitMode::kNone, FitMode::kLetterbox, FitMode::kStretch, FitMode::kCrop}) {
      const glm::dvec2 rig(5 * dice.Below(4), 40 + 10 * (k % 3)), film = k % 4 ? glm::dvec2(10, k % 5 * 25) : rig;
      const auto fit = FitPictures(mode, rig, film);
      if (fit) {
        print.Add(fit->scale).Add(fit->shift).Add(fit->IsNone()).Add(fit->ToFilm({3, 4})).Add(fit->ToRig({3, 4}));
      } else {
        print.Add(fit.error().message);
      }
    }
  }
  EXPECT_TRUE(print.Is(4265, 2427.77683761));
}

}  // namespace
}  // namespace etude

#include "engine/unmarked/recover_unmarked.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/engine/silhouettes/capsule_picture.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr double kStature = 1.80;
constexpr int kUnmarkedFrames = 16;

/// Steps sideways while an arm and a leg swing.
TreeState Moving(const SilhouetteBody& body, int frame) {
  const double phase = 0.3 * frame;
  TreeState state = Bent(body, {{body.limbs[0].upper, 1, -70 + 15 * std::sin(phase)},
                                {body.limbs[1].upper, 0, 50 + 30 * std::sin(phase)},
                                {body.limbs[1].lower, 0, 60},
                                {body.limbs[2].upper, 0, 30 + 15 * std::cos(phase)},
                                {body.limbs[2].lower, 0, -40}});
  state.root_position = {-0.6 + 0.08 * frame, 0.97, 0};
  return state;
}

Rgb8 RoomAt(std::size_t camera, int x, int y) {
  return {static_cast<std::uint8_t>(90 + 3 * (x / 4) % 40), static_cast<std::uint8_t>(100 + (5 * y + 31 * camera) % 50),
          120};
}

/// A film of the body in red before a patterned wall; without `moves` it stands.
struct FilmOfWalker {
  SilhouetteBody body = MakeSilhouetteBody(AdultLengths(kStature));
  std::vector<Camera> cameras = CamerasAround({-40, 40, 150});
  std::vector<std::vector<ColourImage>> pictures;
  std::vector<ColourImage> rooms;
  std::vector<BodyPose> truth;

  explicit FilmOfWalker(bool moves) {
    for (int k = 0; k < kUnmarkedFrames; ++k) truth.push_back(ToBodyPose(body, Moving(body, moves ? k : 0)));
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      ColourImage room(cameras[c].intrinsics.width, cameras[c].intrinsics.height);
      for (int y = 0; y < room.height; ++y) {
        for (int x = 0; x < room.width; ++x) room.At(x, y) = RoomAt(c, x, y);
      }
      rooms.push_back(room);
      pictures.emplace_back();
      Mask mask = RayCast(body, Moving(body, 0), cameras[c]);
      for (int k = 0; k < kUnmarkedFrames; ++k) {
        if (moves && k > 0) mask = RayCast(body, Moving(body, k), cameras[c]);
        ColourImage& picture = pictures.back().emplace_back(room);
        for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
          if (mask.pixels[i]) picture.pixels[i] = {200, 50, 40};
        }
      }
    }
  }
  double MeanError(const BodyMotion& motion) const {
    double sum = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      for (const Role role : AllRoles()) sum += glm::distance(truth[k][role], motion.poses[k][role]);
    }
    return sum / static_cast<double>(truth.size() * kRoleCount);
  }
};

const FilmOfWalker& Walking() {
  static const FilmOfWalker film(true);
  return film;
}

TEST(RecoverUnmarked, FindsThePersonTheStatureAndTheRoomInFilmsAlone) {
  const FilmOfWalker& film = Walking();
  ASSERT_OK(found, RecoverUnmarked({.cameras = film.cameras, .pictures = film.pictures, .rooms = {}, .stature_m = {}},
                                   {.track = {}, .rounds = 3, .samples = 8, .kept = 3}));
  EXPECT_LT(film.MeanError(found->motion), 0.05);
  EXPECT_NEAR(found->stature_m, kStature, 0.05);
  EXPECT_EQ(found->held, 0u);
  int unlike = 0, all = 0;
  for (std::size_t c = 0; c < film.rooms.size(); ++c) {
    for (std::size_t i = 0; i < film.rooms[c].pixels.size(); ++i, ++all) {
      unlike += !(found->rooms[c].pixels[i] == film.rooms[c].pixels[i]);
    }
  }
  EXPECT_LT(unlike, all / 200) << "pixels of the rooms that are not the room's";
  EXPECT_EQ(found->silhouettes[2].size(), static_cast<std::size_t>(kUnmarkedFrames));
  // The clip has as many frames as the films.
  EXPECT_EQ(found->clip.frames.size(), static_cast<std::size_t>(kUnmarkedFrames));
  // `head` is a joint with an end site, as in clips from keypoints, because BVH gives end sites no name.
  EXPECT_TRUE(found->clip.skeleton.Find("head") >= 0);
}

TEST(RecoverUnmarked, IsToldRoomsAndStature) {
  const FilmOfWalker& film = Walking();
  const auto told =
      RecoverUnmarked({.cameras = film.cameras, .pictures = film.pictures, .rooms = film.rooms, .stature_m = kStature});
  ASSERT_TRUE(told) << told.error().message;
  EXPECT_LT(film.MeanError(told->motion), 0.03);
  EXPECT_EQ(told->stature_m, kStature);
  constexpr int kChildFrames = 5;  // five frames are enough
  std::vector<std::vector<ColourImage>> some;
  for (const auto& pictures : film.pictures) some.emplace_back(pictures.begin(), pictures.begin() + kChildFrames);
  const auto child =
      RecoverUnmarked({.cameras = film.cameras, .pictures = some, .rooms = film.rooms, .stature_m = 1.3});
  ASSERT_TRUE(child);
  EXPECT_GT(child->cost, 2 * told->cost) << "the control: nobody of 1.30 m has this outline";
  double apart = 0, apart_of_child = 0;
  for (std::size_t c = 0; c < film.cameras.size(); ++c) {
    for (int k = 0; k < kUnmarkedFrames; ++k) {
      ASSERT_TRUE(told->apart[c][k]);
      apart = std::max(apart, *told->apart[c][k]);
      if (k < kChildFrames) apart_of_child = std::max(apart_of_child, child->apart[c][k].value_or(0));
    }
  }
  EXPECT_LT(apart, 0.2);
  EXPECT_GT(apart_of_child, 2 * apart);
}

TEST(RecoverUnmarked, SeesNobodyWhereNothingMoves) {
  const FilmOfWalker film(false);
  const auto found =
      RecoverUnmarked({.cameras = film.cameras, .pictures = film.pictures, .rooms = {}, .stature_m = {}});
  EXPECT_EQ(testing::Message(found),
            "no frame shows a moving person in two films; Etude cannot distinguish a person who never moves from the "
            "room");
}

}  // namespace
}  // namespace etude

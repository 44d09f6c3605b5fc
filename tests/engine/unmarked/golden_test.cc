// The golden value of capture without marks: short noisy films of which a few frames are tracked. The other tests of
// this folder check that results are right.
#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "engine/unmarked/recover_unmarked.h"
#include "tests/engine/silhouettes/swinging_take.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

/// Films by two small cameras of a two-coloured person who crosses a patterned room; the last frame is empty.
struct SmallFilms {
  std::vector<Camera> cameras;
  std::vector<std::vector<ColourImage>> pictures;
  std::vector<ColourImage> rooms;
  std::vector<std::vector<std::optional<SeenPerson>>> people;

  SmallFilms(testing::Dice& dice, int frames) {
    const SilhouetteBody body = MakeSilhouetteBody(AdultLengths(1.66));
    for (Camera camera : CamerasAround({-40, 50})) {
      camera.intrinsics = {.width = 81, .height = 60, .fx = 75, .fy = 76, .cx = 40, .cy = 29, .skew = 0.5};
      cameras.push_back(camera);
      ColourImage& room = rooms.emplace_back(81, 60);
      for (int i = 0; i < 81 * 60; ++i) {
        const int x = i % 81, y = i / 81;
        const auto level = [&](int base) { return static_cast<std::uint8_t>(base + dice.Below(12)); };
        const std::uint8_t r = level(90 + x / 4 % 9 * 5), g = level(100 + y / 5 % 7 * 6);
        room.pixels[i] = {r, g, level(120)};
      }
      pictures.emplace_back();
      people.emplace_back();
      for (int k = 0; k < frames; ++k) {
        TreeState state = Swinging(body, 0.5 * k);
        state.root_position += glm::dvec3(-0.6 + 0.25 * k, 0, 0.1 * k);
        const Mask mask = RayCast(body, state, camera);
        ColourImage& picture = pictures.back().emplace_back(room);
        for (std::size_t i = 0; i < mask.pixels.size() && k + 1 < frames; ++i) {
          if (mask.pixels[i]) picture.pixels[i] = i < 81 * 30 ? Rgb8{200, 50, 40} : Rgb8{40, 60, 170};
        }
        people.back().emplace_back();
        if (k % 3 == 1) continue;
        SeenPerson& person = people.back().back().emplace();
        const BodyPose pose = ToBodyPose(body, state);
        for (const auto& [landmark, role] : {std::pair(Landmark::kLeftWrist, Role::kLeftWrist),
                                             {Landmark::kRightKnee, Role::kRightKnee},
                                             {Landmark::kRightBigToe, Role::kRightFoot},
                                             {Landmark::kLeftShoulder, Role::kLeftShoulder}}) {
          person[landmark] = {*Project(MatrixOf(camera), pose[role]) + glm::dvec2(dice.Vector()),
                              0.7 + 0.3 * dice.Signed()};
        }
      }
    }
  }
};

void AddRecovered(Fingerprint& print, const Result<UnmarkedMotion>& found) {
  print.Add(found.has_value());
  if (!found) {
    print.Add(found.error().message);
    return;
  }
  print.Add(found->stature_m).Add(found->held).Add(found->cost).Add(found->motion.rate_hz);
  for (const BodyPose& pose : found->motion.poses) print.Add(pose.joints);
  for (const LocalPose& pose : found->clip.frames) {
    // Leave out the last joint: it is the end site of `head`, at the same place.
    for (const LocalTransform& joint : std::span(pose).first(pose.size() - 1))
      print.Add(joint.translation).Add(joint.rotation);
  }
  for (const ColourImage& room : found->rooms) {
    for (const Rgb8& p : room.pixels) print.Add(0.01 * p.r).Add(0.01 * p.g);
  }
  for (const auto& of_camera : found->silhouettes) {
    for (const Mask& mask : of_camera) print.Add(mask.pixels);
  }
  for (const auto& apart : found->apart) print.Add(apart);
}

TEST(UnmarkedGolden, FilmsWithAndWithoutWhatIsKnown) {
  testing::Dice dice(1);
  const SmallFilms films(dice, 8);
  Fingerprint print;
  UnmarkedOptions options;
  options.track.cost = {.sigma_px = 1.5, .outline_reach_px = 8, .inside_reach_px = 20};
  options.track.anchors = 1, options.track.trial_frames = 1, options.track.repairs = 1;
  options.person.min_piece_px = 8, options.person.piece_reach = 5;
  options.rounds = 2, options.samples = 4, options.kept = 2, options.body_reach_px = 3;
  UnmarkedTake take{
      .cameras = films.cameras, .pictures = films.pictures, .rooms = films.rooms, .rate_hz = 20, .stature_m = 1.7};
  AddRecovered(print, RecoverUnmarked(take, options));
  take.people = films.people;
  LimbLengths lengths = AdultLengths(1.6);
  lengths.trunk += 0.05;
  take.lengths = lengths;
  AddRecovered(print, RecoverUnmarked(take, options));
  take.people = {}, take.lengths = {}, take.rooms = {}, take.stature_m = {};
  AddRecovered(print, RecoverUnmarked(take, options));
  EXPECT_TRUE(print.Is(299847, -9076.48121275));
}

}  // namespace
}  // namespace etude

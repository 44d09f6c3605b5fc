// Golden values of whole results, of small films with noise of which little is followed: whatever changes a number is
// noticed. What is right is said by the tests beside.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/unmarked/recover_unmarked.h"
#include "tests/engine/silhouettes/swinging_take.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

/// Somebody in two colours who crosses a patterned room, swinging an arm, before two small cameras; nobody is in the
/// last frame.
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
    for (const LocalTransform& joint : pose) print.Add(joint.translation).Add(joint.rotation);
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
  Fingerprint told, found;
  UnmarkedOptions options;
  options.track.cost = {.sigma_px = 1.5, .outline_reach_px = 8, .inside_reach_px = 20};
  options.track.anchors = 1, options.track.trial_frames = 1, options.track.repairs = 1;
  options.person.smallest_piece = 8, options.person.piece_reach = 5;
  options.rounds = 2, options.samples = 4, options.kept = 2, options.body_reach_px = 3;
  UnmarkedTake take{
      .cameras = films.cameras, .pictures = films.pictures, .rooms = films.rooms, .rate_hz = 20, .stature_m = 1.7};
  AddRecovered(told, RecoverUnmarked(take, options));
  take.people = films.people;
  LimbLengths lengths = AdultLengths(1.6);
  lengths.trunk += 0.05;
  take.lengths = lengths;
  AddRecovered(told, RecoverUnmarked(take, options));
  take.people = {}, take.lengths = {}, take.rooms = {}, take.stature_m = {};
  AddRecovered(found, RecoverUnmarked(take, options));
  EXPECT_TRUE(told.Is(199898, -2023.09949494));
  EXPECT_TRUE(found.Is(99949, 29779.1957273));
}

TEST(UnmarkedGolden, StaturesLengthsAndSeenJoints) {
  testing::Dice dice(2);
  Fingerprint print;
  for (const double stature : {1.3, 1.74, 2.0}) {
    const LimbLengths l = AdultLengths(stature);
    for (const double length :
         {l.foot, l.shank, l.thigh, l.hip_width, l.trunk, l.neck, l.shoulder_width, l.upper_arm, l.forearm, l.hand})
      print.Add(length);
  }
  SeenPerson person;
  for (Keypoint& keypoint : person.keypoints) keypoint = {100.0 * glm::dvec2(dice.Vector()), 0.8 * dice.Signed() + 0.5};
  for (const SeenJoint& joint : SeenJointsOf(person, 2.5)) print.Add(joint.role).Add(joint.pixel).Add(joint.sigma_px);
  const SilhouetteBody body = MakeSilhouetteBody(AdultLengths(1.7));
  for (const double true_m : {1.5, 1.69, 1.95}) {
    const SilhouetteBody filmed = MakeSilhouetteBody(AdultLengths(true_m));
    std::vector<Silhouette> silhouettes;
    std::vector<SilhouetteView> views;
    silhouettes.reserve(2);
    for (Camera camera : CamerasAround({-40, 50})) {
      camera.intrinsics = {.width = 80, .height = 60, .fx = 75, .fy = 75, .cx = 40, .cy = 30};
      silhouettes.push_back(MakeSilhouette(RayCast(filmed, Swinging(filmed, 0.3), camera), {.spacing = 2}));
      views.push_back({MatrixOf(camera), &silhouettes.back()});
    }
    const std::vector<PosedViews> moments = {{views, Swinging(body, 0.3)},
                                             {std::span(views).first(1), Swinging(body, 0.2)}};
    SilhouetteBody thick = body;
    for (FleshCapsule& flesh : thick.flesh) flesh.radius_a *= 1.04;
    print.Add(FitStature(thick, 1.7, moments, {.cost = {.sigma_px = 2, .outline_reach_px = 6}, .max_iterations = 4}));
  }
  EXPECT_TRUE(print.Is(81, -16.7348889385));
}

}  // namespace
}  // namespace etude

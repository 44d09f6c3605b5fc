// The library refuses inputs just beyond each limit, and accepts inputs just within.
#include <etude/cameras.h>
#include <etude/capture.h>
#include <etude/coaching.h>
#include <etude/fuzzy.h>
#include <etude/recognition.h>
#include <etude/silhouettes.h>
#include <etude/transitions.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/formats/trc.h"
#include "tests/engine/coaching/small_dance.h"
#include "tests/engine/keypoints/walkers.h"
#include "tests/support/kept_lines.h"
#include "tests/support/random_clip.h"

namespace etude::engine {
namespace {

/// Returns cameras in front of a walker; no number has its default.
std::vector<NamedCamera> LensedCameras() {
  std::vector<NamedCamera> cameras;
  for (const Camera& camera : FourCameras()) {
    NamedCamera& told = cameras.emplace_back("camera " + std::to_string(cameras.size() + 1), camera);
    told.camera.intrinsics = {.width = 1280, .height = 720, .fx = 900, .fy = 890, .cx = 640, .cy = 365, .skew = 2};
    told.camera.distortion = {.k1 = -0.08, .k2 = 0.02, .p1 = 0.001, .p2 = -0.002, .k3 = 0.004};
  }
  return cameras;
}

/// Collects the message of every refusal; "" if the library accepts the input.
TEST(Api, RefusesJustBeyondEveryLimit) {
  std::vector<std::string> refusals;
  int taken = 0, refused = 0;
  const auto told = [&](const std::function<void()>& act) {
    std::string words;
    try {
      act();
    } catch (const BadInput& error) {
      words = error.what();
    }
    ++(words.empty() ? taken : refused);
    refusals.push_back(words.empty() ? "(taken)" : words);
  };
  const std::vector<NamedCamera> cameras = LensedCameras();
  const std::vector<PointPair> pairs = [&] {
    std::vector<PointPair> made;
    ::etude::testing::Dice dice(4);
    for (int i = 0; i < 30; ++i) {
      const glm::dvec3 p = glm::dvec3(0, 1, 0) + 0.7 * dice.Vector();
      if (const auto pixel = Project(cameras[0].camera, p)) made.push_back({p, *pixel});
    }
    return made;
  }();
  for (const glm::ivec2 side :
       {glm::ivec2(1, 720), {0, 720}, {100000, 720}, {100001, 720}, {720, 1}, {720, 0}, {720, 100000}, {720, 100001}})
    told([&] { Calibrate(pairs, side.x, side.y); });
  const std::vector<SeenPeople> nobody(2, SeenPeople(1));
  for (const CaptureOptions& options : {CaptureOptions{.rate_hz = 1},
                                        {.rate_hz = 0.99},
                                        {.rate_hz = 1000},
                                        {.rate_hz = 1001},
                                        {.rate_hz = NAN},
                                        {.person = -1},
                                        {.smooth_hz = -0.1},
                                        {.smooth_hz = NAN}})
    told([&] { Capture(std::span(cameras).first(2), nobody, options); });
  told([&] { Capture(std::span(cameras).first(1), std::span(nobody).first(1)); });
  told([&] { Capture(std::span(cameras).first(3), nobody); });
  told([&] { Capture(std::span(cameras).first(2), std::vector<SeenPeople>{SeenPeople(1), SeenPeople(2)}); });
  for (const Keypoint& point : {Keypoint{{1, 2}, 0},
                                {{1, 2}, 1},
                                {{1, 2}, -0.01},
                                {{1, 2}, 1.01},
                                {{NAN, 2}, 1},
                                {{1, INFINITY}, 1},
                                {{1, 2}, NAN}}) {
    SeenPerson person;
    person[Landmark::kNose] = point;
    told([&] { Capture(std::span(cameras).first(2), std::vector<SeenPeople>(2, {{person}})); });
  }

  const Motion flap = Flap(20, 50), one{.rate_hz = 30, .poses = {flap.poses[0]}};
  for (const double rate_hz : {1.0, 0.999, 1000.0, 1000.1})
    told([&] { ReadMotion(WriteTrc(Flap(4, 9), "flap"), "flap.trc", rate_hz); });
  told([&] { ComputeFeatures({.rate_hz = 0.5, .poses = flap.poses}); });
  Motion broken = flap;
  broken.poses[3].joints[19].z = NAN;
  told([&] { ComputeFeatures(broken); });
  told([&] { ComputeFeatures({.rate_hz = 30, .poses = {Pose{}}}); });
  told([&] { ComputeFeatures({.rate_hz = 30, .poses = {}}); });
  for (const BridgeOptions& options : {BridgeOptions{.min_clips = 1},
                                       {.min_clips = 0},
                                       {.threshold = 6},
                                       {.threshold = 6.01},
                                       {.threshold = 0},
                                       {.threshold = 1e-9}})
    told([&] { Bridges(std::span(&flap, 1), options); });
  const Bridges bridges(std::span(&flap, 1));
  for (const int clip : {-1, 0, 1}) told([&] { bridges.FramesOf(clip); });
  for (const int frame : {-1, 0, 19, 20}) told([&] { bridges.Find(0, frame, 0); });
  for (const double budget_s : {0.0, -1e-9, 3600.0, 3600.1}) told([&] { bridges.Find(0, 0, 0, budget_s); });

  told([&] { TransitionLibrary(std::span(&one, 1)); });
  told([&] { TransitionLibrary(std::vector<Motion>{{.rate_hz = 60, .poses = flap.poses}}); });
  for (const double hips : {0.1, 0.099, 10.0, 10.1})
    told([&] { TransitionLibrary(std::span(&flap, 1), BodyProportions{flap.poses[0], hips}); });
  told([&] { TransitionLibrary(std::span(&flap, 1), BodyProportions{Pose{}, 1}); });
  const TransitionLibrary library(std::span(&flap, 1));
  for (const int clip : {-1, 0, 1}) {
    told([&] { library.Make(clip, 0, 0); });
    told([&] { library.Make(0, 0, clip); });
  }
  for (const int frame : {-1, 0, 19, 20}) told([&] { library.Make(0, frame, 0); });
  told([&] { library.Make(0, 0, 0, 1, {.choice_settings = {{"unheard", 1}}}); });
  for (const std::string& join : TransitionJoins()) {
    for (const NumberSetting& s : TransitionJoinSettings(join)) {
      for (const double value : {s.lowest, s.largest, s.lowest - 0.01, s.largest + 1, s.lowest + 0.5})
        told([&] { library.Make(0, 0, 0, 1, {.join = join, .join_settings = {{s.key, value}}}); });
    }
  }
  for (const double threshold : {0.0, 1e-9, 6.0, 6.1})
    told([&] { library.Make(0, 0, 0, 1, {.threshold = threshold}); });

  told([] { Recogniser({}); });
  const std::vector<TaughtMove> moves = {{.name = "one", .examples = {StreamOf(flap)}},
                                         {.name = "empty"},
                                         {.name = "none", .examples = {SkeletonStream{}}}};
  told([&] { Recogniser(std::span(moves).first(1), {.kind = "learnt"}); });
  for (const std::size_t count : {1, 2, 3}) told([&] { Recogniser{std::span(moves).first(count)}; });
  const Recogniser recogniser{std::span(moves).first(1)};
  for (const double rate_hz : {0.0, 1e-3, 1000.0, 1000.1, std::nan("")}) told([&] { recogniser.Follow(rate_hz); });
  RecogniserStream stream = recogniser.Follow();
  for (const int move : {-1, 0, 1}) told([&] { stream.Ask(move); });
  SensedFrame sensed = StreamOf(flap).frames[0];
  sensed.joints[7].position.y = INFINITY;
  told([&] { stream.Update(sensed); });

  std::vector<NamedCamera> pinholes(2);
  for (NamedCamera& each : pinholes) each.camera.intrinsics.width = 8, each.camera.intrinsics.height = 6;
  const std::vector<std::vector<Mask>> empty(2, {Mask(4, 3)});
  for (const FollowOptions& options : {FollowOptions{.stature_m = 0.5},
                                       {.stature_m = 0.49},
                                       {.stature_m = 2.5},
                                       {.stature_m = 2.51},
                                       {.rate_hz = 1},
                                       {.rate_hz = 0.9},
                                       {.rate_hz = 1000},
                                       {.rate_hz = 1001}})
    told([&] { TrackSilhouettes(pinholes, empty, options); });
  for (const glm::ivec2 side : {glm::ivec2(8, 6), {4, 6}, {8, 3}, {2, 2}, {9, 6}, {16, 12}})
    told([&] { TrackSilhouettes(pinholes, std::vector<std::vector<Mask>>(2, {Mask(side.x, side.y)})); });
  told([&] { TrackSilhouettes(pinholes, std::vector<std::vector<Mask>>{empty[0], {}}); });
  for (const int side : {8192, 8193}) {
    std::vector<NamedCamera> wide = pinholes;
    for (NamedCamera& each : wide) each.camera.intrinsics.width = side;
    told([&] { TrackSilhouettes(wide, std::vector<std::vector<Mask>>(2, {Mask(side, 6)})); });
  }
  pinholes[1].camera.intrinsics.fx = NAN;
  told([&] { TrackSilhouettes(pinholes, empty); });
  told([&] { TrackSilhouettes(cameras, std::vector<std::vector<Mask>>(4, empty[0])); });
  EXPECT_EQ(taken, 59);
  EXPECT_EQ(refused, 97);
  EXPECT_TRUE(::etude::testing::AreKept(refusals, "tests/engine/api/refusals.txt"));
}

}  // namespace
}  // namespace etude::engine

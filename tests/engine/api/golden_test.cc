// Golden values of the library's answers with options off their defaults, and what it refuses just beyond each limit
// and takes just within. What is right is said by the tests beside.
#include <etude/cameras.h>
#include <etude/capture.h>
#include <etude/coaching.h>
#include <etude/fuzzy.h>
#include <etude/kinematics.h>
#include <etude/recognition.h>
#include <etude/silhouettes.h>
#include <etude/transitions.h>
#include <etude/vision.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/cameras/rig_file.h"
#include "engine/formats/bvh.h"
#include "engine/formats/trc.h"
#include "engine/retargeting/rig.h"
#include "tests/engine/coaching/small_dance.h"
#include "tests/engine/keypoints/walkers.h"
#include "tests/engine/silhouettes/swinging_take.h"
#include "tests/support/fingerprint.h"

namespace etude::engine {
namespace {

using ::etude::testing::Fingerprint;

Motion ToldMotion(const BodyMotion& motion) {
  Motion told{.rate_hz = motion.rate_hz, .poses = {}};
  for (const BodyPose& pose : motion.poses) told.poses.push_back({pose.joints});
  return told;
}

void AddMotion(Fingerprint& print, const Motion& motion) {
  print.Add(motion.rate_hz);
  for (const Pose& pose : motion.poses) print.Add(pose.joints);
}

void AddCamera(Fingerprint& print, const Camera& c) {
  print.Add(c.name).Add(c.width).Add(c.height).Add(c.R_CW[0]).Add(c.R_CW[1]).Add(c.p_WC);
  for (const double number : {c.fx, c.fy, c.cx, c.cy, c.skew, c.k1, c.k2, c.p1, c.p2, c.k3}) print.Add(number);
}

/// Cameras before a walker, all their numbers off the defaults.
std::vector<Camera> LensedCameras() {
  std::vector<Camera> cameras;
  for (const etude::Camera& camera : FourCameras()) {
    Camera& told = cameras.emplace_back();
    told.name = "camera " + std::to_string(cameras.size());
    told.width = 1280, told.height = 720, told.fx = 900, told.fy = 890, told.cx = 640, told.cy = 365, told.skew = 2;
    told.k1 = -0.08, told.k2 = 0.02, told.p1 = 0.001, told.p2 = -0.002, told.k3 = 0.004;
    told.R_CW = camera.R_CW, told.p_WC = camera.p_WC;
  }
  return cameras;
}

TEST(ApiGolden, Cameras) {
  ::etude::testing::Dice dice(1);
  Fingerprint print;
  const std::vector<Camera> cameras = LensedCameras();
  std::vector<PointPair> pairs;
  for (int k = 0; k < 40; ++k) {
    const glm::dvec3 p = glm::dvec3(0, 1, 0) + dice.Vector();
    std::vector<std::optional<glm::dvec2>> pixels;
    for (const Camera& camera : cameras) {
      auto& pixel = pixels.emplace_back(Project(camera, p));
      if (pixel) *pixel += 2.0 * glm::dvec2(dice.Vector());
      print.Add(pixel);
      if (dice.Below(2)) pixel.reset();
    }
    if (const auto pixel = Project(cameras[0], p)) pairs.push_back({p, *pixel + glm::dvec2(dice.Vector())});
    const auto point = Triangulate(cameras, pixels);
    print.Add(point.has_value());
    if (point) print.Add(point->p_WQ).Add(point->residual_px);
  }
  const CalibratedCamera calibrated = Calibrate(pairs, 1280, 720);
  AddCamera(print, calibrated.camera);
  print.Add(calibrated.rms_px);
  EXPECT_TRUE(print.Is(647, 1181.72080252));
}

TEST(ApiGolden, Kinematics) {
  ::etude::testing::Dice dice(2);
  Fingerprint print;
  for (int k = 0; k < 6; ++k) {
    IkOptions options;
    if (k % 2) options.max_iterations = 2 + k;
    if (k > 2) options.position_goal = 0.05, options.axis_goal = 0.3;
    if (k == 4) options.most_change = 0.1;
    Tree tree = AdultBody();
    if (k == 5) tree.limbs[2].p_PJ *= 1.3, tree.effectors.resize(3), tree.limits[4] = {-0.1, 0.2};
    const Kinematics body(tree, options);
    IkBatch batch;
    for (int i = 0; i < 7; ++i) {
      TreePose wanted, start;
      for (const AngleRange& range : body.tree().limits) {
        wanted.angles.push_back(std::lerp(range.lower, range.upper, 0.5 + 0.45 * dice.Signed()));
        start.angles.push_back(std::lerp(range.lower, range.upper, 0.5 + 0.2 * dice.Signed()));
      }
      start.root = {0.1 * dice.Vector(), glm::mat3_cast(dice.Rotation())};
      wanted.root = start.root;
      batch.roots.push_back(start.root);
      batch.starts.insert(batch.starts.end(), start.angles.begin(), start.angles.end());
      std::vector<Target> targets;
      for (const Frame& frame : body.Effectors(wanted)) {
        const glm::dvec3 axes = dice.Below(3) ? glm::dvec3(1) : glm::dvec3(0, 0, 1);
        targets.push_back(
            {{frame.position + (i == 3 ? 1.0 : 0.02) * dice.Vector(), frame.axes}, dice.Below(5) ? 1.0 : 0.5, axes});
      }
      batch.targets.insert(batch.targets.end(), targets.begin(), targets.end());
      const IkAnswer answer = body.Solve(start, targets);
      print.Add(answer.status).Add(answer.angles).Add(answer.iterations);
      for (const Frame& frame : body.Limbs(start)) print.Add(frame.position).Add(frame.axes[0]).Add(frame.axes[2]);
    }
    if (k == 1) batch.targets[0].frame.position.x = NAN;
    for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
      const IkBatchAnswer answer = body.Solve(batch, precision);
      print.Add(answer.statuses).Add(answer.angles).Add(answer.iterations);
    }
  }
  EXPECT_TRUE(print.Is(9654, -1117.43250138));
}

TEST(ApiGolden, MotionsFeaturesBridgesAndTransitions) {
  Fingerprint print;
  const Motion up = ToldMotion(Flap(40, 100)), half = ToldMotion(Flap(33, 60));
  for (const double rate_hz : {30.0, 47.0}) {
    AddMotion(print, ReadMotion(WriteTrc(Flap(12, 70), "flap"), "flap.trc", rate_hz));
    AddMotion(print, ReadMotion(WriteBvh(RigClip(Flap(9, 50), ArmsAt(10), "flap")), "flap.bvh", rate_hz));
    for (const Features& features : ComputeFeatures(up)) print.Add(features);
  }
  for (const double threshold : {0.4, 2.0, 6.0}) {
    const Bridges bridges(std::vector{up, half, up}, {.min_clips = threshold > 1 ? 3 : 1, .threshold = threshold});
    for (int clip = 0; clip < 3; ++clip) {
      print.Add(bridges.FramesOf(clip));
      for (const double budget_s : {0.0, 0.4, 3600.0}) {
        const auto point = bridges.Find(clip, 5 * clip, 1, budget_s);
        print.Add(point.has_value());
        if (point) print.Add(point->from).Add(point->to).Add(point->distance);
      }
    }
  }
  for (const std::string& choice : TransitionChoices()) {
    print.Add(choice);
    for (const TransitionSetting& s : TransitionChoiceSettings(choice))
      print.Add(s.key).Add(s.fallback).Add(s.lowest).Add(s.largest).Add(s.is_whole).Add(s.meaning);
  }
  const TransitionLibrary library(std::vector{up, half}, BodyProportions{up.poses[3], 0.95});
  for (const std::string& join : TransitionJoins()) {
    TransitionOptions options{.join = join, .threshold = 0.9};
    for (const TransitionSetting& s : TransitionJoinSettings(join)) {
      print.Add(s.key).Add(s.fallback).Add(s.lowest).Add(s.largest).Add(s.is_whole);
      options.join_settings[s.key] = s.largest;
    }
    const Transition made = library.Make(0, 7, 1, 0.6, options);
    AddMotion(print, made.motion);
    print.Add(made.points).Add(made.wait_s).Add(made.branch).Add(made.why);
  }
  for (int role = 0; role < 20; ++role) print.Add(RoleName(static_cast<Role>(role)));
  for (const auto& name : FeatureNames()) print.Add(name);
  EXPECT_TRUE(print.Is(23793, 663109.321611));
}

TEST(ApiGolden, RecognitionAndCoaching) {
  Fingerprint print;
  const std::vector<TaughtMove> moves = {{"first", {ToldMotion(Flap(50, 60)), ToldMotion(Flap(45, 70))}},
                                         {"second", {ToldMotion(Flap(60, 30))}}};
  const Motion shown = ToldMotion(Flap(55, 55));
  for (const bool smooths : {false, true}) {
    for (const double rate_hz : {30.0, 25.0}) {
      RecogniserStream stream = Recogniser(moves, {.smooths = smooths}).Follow(rate_hz);
      for (std::size_t k = 0; k < shown.poses.size(); ++k) {
        if (k == 3) stream.Ask(0);
        if (k == 40) stream.Ask(std::nullopt);
        SensedPose frame{.pose = shown.poses[k], .seen = {}, .body_seen = k % 11 != 10};
        if (k % 5 == 1) frame.seen[k % 20] = Seen::kNotTracked;
        if (k % 5 == 2) frame.seen[k % 20] = Seen::kInferred;
        const Evidence evidence = stream.Update(frame);
        print.Add(evidence.asked).Add(evidence.spotted);
      }
    }
  }
  const etude::Dance small = SmallDance();
  Dance dance{.title = small.title, .motion = ToldMotion(small.motion)};
  for (const auto& move : small.moves)
    dance.moves.push_back({move.name, move.hint, {move.key_pose.joints}, ToldMotion(move.slow)});
  for (const auto& each : small.repetitions) dance.repetitions.push_back({each.move, each.first, each.end});
  for (const auto& tag : small.tags) dance.tags.push_back({tag.frame, tag.music_s});
  for (const auto& act : small.acts) dance.acts.push_back({act.name, ToldMotion(act.motion), act.loops});
  CoachOptions options{.policy = CoachPolicies().back(), .choice = "now", .join = "crossfade", .recogniser = "nearest"};
  options.smooths = options.mirrors = true, options.dances_at_once = true, options.sensor_m = {0.2, 1.1, 2.2};
  Coach coach(dance, moves, options);
  const Motion player = ToldMotion(Flap(260, 40));
  for (std::size_t k = 0; k < 260; ++k) {
    SensedPose frame{.pose = player.poses[k], .seen = {}, .body_seen = k < 200};
    frame.pose[Role::kRightHand] += glm::dvec3(0.1, -0.3, 0.2), frame.pose[Role::kRightWrist].y -= 0.2;
    const CoachFrame shown_frame = coach.Step(frame, k > 9 ? std::optional(k / 30.0) : std::nullopt);
    print.Add(shown_frame.mode).Add(shown_frame.body.joints).Add(shown_frame.clip).Add(shown_frame.clip_frame);
    print.Add(shown_frame.in_transition).Add(shown_frame.asked).Add(shown_frame.say).Add(shown_frame.hint);
    print.Add(shown_frame.stand).Add(shown_frame.play_from_s).Add(shown_frame.pause_music);
    for (const CoachDecision& d : shown_frame.decisions)
      print.Add(d.event).Add(d.frame).Add(d.move).Add(d.mistake).Add(d.evidence).Add(d.why);
  }
  EXPECT_TRUE(print.Is(26597, 206.458574112));
}

/// Silhouettes of two cameras, in masks half as wide as their pictures.
TEST(ApiGolden, PeopleInMasksAndPictures) {
  ::etude::testing::Dice dice(3);
  Fingerprint print;
  const SilhouetteBody body = MakeSilhouetteBody({});
  std::vector<Camera> cameras;
  std::vector<std::vector<PersonMask>> masks;
  for (etude::Camera small : CamerasAround({-40, 40})) {
    small.intrinsics = {.width = 80, .height = 60, .fx = 75, .fy = 75, .cx = 40, .cy = 30};
    Camera& camera = cameras.emplace_back();
    camera.width = 160, camera.height = 120, camera.fx = camera.fy = 150, camera.cx = 80, camera.cy = 60;
    camera.R_CW = small.R_CW, camera.p_WC = small.p_WC;
    masks.emplace_back();
    for (int k = 0; k < 2; ++k) {
      const Mask mask = RayCast(body, Swinging(body, k), small);
      masks.back().push_back({80, 60, mask.pixels});
      for (const OutlinePoint& p : Outline(masks.back().back(), {.spacing = 4, .thinnest = 2}))
        print.Add(p.pixel).Add(p.normal);
    }
  }
  const std::vector<Pose> measured = {{ToBodyPose(body, Swinging(body, 0)).joints}};
  for (const SilhouetteOptions& options :
       {SilhouetteOptions{.stature_m = 1.6, .rate_hz = 60}, {.measured = measured, .rate_hz = 15}}) {
    for (const auto& pose : TrackSilhouettes(cameras, masks, options)) {
      print.Add(pose.has_value());
      if (pose) print.Add(pose->joints);
    }
  }
  std::vector<std::uint8_t> room(3 * 45 * 31), picture;
  for (std::uint8_t& level : room) level = static_cast<std::uint8_t>(100 + dice.Below(60));
  picture = room;
  for (int i = 0; i < 900; ++i)
    picture[3 * (i / 25 % 31 * 45 + i % 25) + i % 3] = static_cast<std::uint8_t>(dice.Below(200));
  for (const std::string segmenter : {"rgb", "hue", "hue-gated", "ratio", "likelihood", "running"}) {
    for (const bool all : {false, true}) {
      PersonFinder finder(room, 45, 31, {.segmenter = segmenter, .all_pieces = all});
      print.Add(finder.Find(picture)).Add(finder.Find(room));
    }
  }
  EXPECT_TRUE(print.Is(33896, 1165.81166711));
}

/// Every refusal's words; "" where the library takes what it is told.
TEST(ApiGolden, RefusesJustBeyondEveryLimit) {
  Fingerprint print;
  int taken = 0, refused = 0;
  const auto told = [&](const std::function<void()>& act) {
    std::string words;
    try {
      act();
    } catch (const BadInput& error) {
      words = error.what();
    }
    print.Add(words);
    ++(words.empty() ? taken : refused);
  };
  const std::vector<Camera> cameras = LensedCameras();
  const std::vector<PointPair> pairs = [&] {
    std::vector<PointPair> made;
    ::etude::testing::Dice dice(4);
    for (int i = 0; i < 30; ++i) {
      const glm::dvec3 p = glm::dvec3(0, 1, 0) + 0.7 * dice.Vector();
      if (const auto pixel = Project(cameras[0], p)) made.push_back({p, *pixel});
    }
    return made;
  }();
  for (const glm::ivec2 side :
       {glm::ivec2(1, 720), {0, 720}, {100000, 720}, {100001, 720}, {720, 1}, {720, 0}, {720, 100000}, {720, 100001}})
    told([&] { Calibrate(pairs, side.x, side.y); });
  etude::Camera fisheye = FourCameras()[0];
  fisheye.distortion = {.k1 = 0.01, .is_fisheye = true};
  told([&] { ReadRig(WriteRig(std::vector<NamedCamera>{{"wide", fisheye}}), "rig.yaml"); });
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
                                {{1, 2}, NAN}})
    told([&] { Capture(std::span(cameras).first(2), std::vector<SeenPeople>(2, {{SeenPerson(17, point)}})); });

  const Motion flap = ToldMotion(Flap(20, 50)), one{.rate_hz = 30, .poses = {flap.poses[0]}};
  for (const double rate_hz : {1.0, 0.999, 1000.0, 1000.1})
    told([&] { ReadMotion(WriteTrc(Flap(4, 9), "flap"), "flap.trc", rate_hz); });
  told([&] { ComputeFeatures({.rate_hz = 0.5, .poses = flap.poses}); });
  Motion broken = flap;
  broken.poses[3].joints[19].z = NAN;
  told([&] { ComputeFeatures(broken); });
  told([&] { ComputeFeatures({.rate_hz = 30, .poses = {Pose{}}}); });
  told([&] { ComputeFeatures({.rate_hz = 30, .poses = {}}); });
  told([&] { RoleName(static_cast<Role>(20)); });
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
    for (const TransitionSetting& s : TransitionJoinSettings(join)) {
      for (const double value : {s.lowest, s.largest, s.lowest - 0.01, s.largest + 1, s.lowest + 0.5})
        told([&] { library.Make(0, 0, 0, 1, {.join = join, .join_settings = {{s.key, value}}}); });
    }
  }
  for (const double threshold : {0.0, 1e-9, 6.0, 6.1})
    told([&] { library.Make(0, 0, 0, 1, {.threshold = threshold}); });

  told([] { Recogniser({}); });
  const std::vector<TaughtMove> moves = {{"one", {flap}}, {"empty", {}}, {"none", {Motion{}}}};
  told([&] { Recogniser(std::span(moves).first(1), {.kind = "learnt"}); });
  for (const std::size_t count : {1, 2, 3}) told([&] { Recogniser{std::span(moves).first(count)}; });
  const Recogniser recogniser{std::span(moves).first(1)};
  for (const double rate_hz : {0.0, 1e-3, 1000.0, 1000.1, std::nan("")}) told([&] { recogniser.Follow(rate_hz); });
  RecogniserStream stream = recogniser.Follow();
  for (const int move : {-1, 0, 1}) told([&] { stream.Ask(move); });
  SensedPose sensed{.pose = flap.poses[0], .seen = {}};
  sensed.pose.joints[7].y = INFINITY;
  told([&] { stream.Update(sensed); });

  told([] { Kinematics{Tree{}}; });
  Tree endless = AdultBody();
  endless.effectors.clear();
  told([&] { Kinematics(endless).Solve(IkBatch{}); });
  const Kinematics body(AdultBody());
  for (const IkOptions& options : {IkOptions{0, 0.1, 0.1, 1.0},
                                   {-1, 0.1, 0.1, 1.0},
                                   {1, 0.0, 0.1, 1.0},
                                   {1, -1.0, 0.1, 1.0},
                                   {1, 0.1, -1.0, 1.0},
                                   {1, 0.1, 0.1, -1.0}})
    told([&] { Kinematics(AdultBody(), options); });
  IkBatch batch{.roots = {Frame{}, Frame{}}, .starts = std::vector<double>(29), .targets = std::vector<Target>(5)};
  told([&] { body.Solve(batch); });
  batch.roots.pop_back();
  told([&] { body.Solve(batch); });
  batch.targets.pop_back();
  told([&] { body.Solve(batch); });
  told([&] { body.Solve(TreePose{{}, std::vector<double>(28)}, std::vector<Target>(5)); });

  const PersonMask mask{4, 3, std::vector<std::uint8_t>(12, 1)};
  for (const OutlineOptions& options : {OutlineOptions{.spacing = 0},
                                        {.spacing = 1},
                                        {.spacing = 1000},
                                        {.spacing = 1001},
                                        {.thinnest = -0.1},
                                        {.thinnest = 100},
                                        {.thinnest = 101}})
    told([&] { Outline(mask, options); });
  for (const glm::ivec2 side : {glm::ivec2(0, 1), {1, 0}, {1, 8192}, {1, 8193}, {8193, 1}, {8192, 1}}) {
    told([&] { SignedDistances({side.x, side.y, std::vector<std::uint8_t>(std::size_t(side.x) * side.y)}); });
    told([&] { PersonFinder(std::vector<std::uint8_t>(3 * std::size_t(side.x) * side.y), side.x, side.y); });
  }
  told([] { PersonFinder(std::vector<std::uint8_t>(3), 1, 1, {.segmenter = "red"}); });
  std::vector<Camera> pinholes(2);
  for (Camera& camera : pinholes) camera.width = 8, camera.height = 6;
  const std::vector<std::vector<PersonMask>> empty(2, {{4, 3, std::vector<std::uint8_t>(12)}});
  for (const SilhouetteOptions& options : {SilhouetteOptions{.stature_m = 0.5},
                                           {.stature_m = 0.49},
                                           {.stature_m = 2.5},
                                           {.stature_m = 2.51},
                                           {.rate_hz = 1},
                                           {.rate_hz = 0.9},
                                           {.rate_hz = 1000},
                                           {.rate_hz = 1001}})
    told([&] { TrackSilhouettes(pinholes, empty, options); });
  for (const glm::ivec2 side : {glm::ivec2(8, 6), {4, 6}, {8, 3}, {2, 2}, {9, 6}, {16, 12}})
    told([&] {
      TrackSilhouettes(pinholes, std::vector<std::vector<PersonMask>>(
                                     2, {{side.x, side.y, std::vector<std::uint8_t>(side.x * side.y)}}));
    });
  told([&] { TrackSilhouettes(pinholes, std::vector<std::vector<PersonMask>>{empty[0], {}}); });
  pinholes[1].fx = NAN;
  told([&] { TrackSilhouettes(pinholes, empty); });
  told([&] { TrackSilhouettes(cameras, std::vector<std::vector<PersonMask>>(4, empty[0])); });
  EXPECT_EQ(taken, 63);
  EXPECT_EQ(refused, 115);
  EXPECT_TRUE(print.Is(5860, 3781.6554319));
}

}  // namespace
}  // namespace etude::engine

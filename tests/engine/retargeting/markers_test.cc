#include "engine/retargeting/markers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/retargeting/marker_sets.h"
#include "tests/engine/retargeting/standing_person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t kTakeFrames = 40;

/// Returns a person who stands, faces +Z and sways; metres, Y up.
BodyPose StandingAt(std::size_t frame) {
  BodyPose pose = testing::StandingPerson();
  for (const Role ankle : {Role::kLeftAnkle, Role::kRightAnkle}) pose[ankle].y = 0.07;  // shanks of 0.41 m
  for (glm::dvec3& joint : pose.joints) joint.x += 0.01 * static_cast<double>(frame);
  return pose;
}

/// A marker: its name, and its offset from a role's position.
struct Placed {
  std::string name;
  Role role;
  glm::dvec3 off = glm::dvec3(0);
};

MarkerMotion Take(const std::vector<Placed>& markers) {
  MarkerMotion take{.rate_hz = 50, .names = {}, .frames = decltype(MarkerMotion::frames)(kTakeFrames)};
  for (const auto& [name, role, off] : markers) {
    take.names.push_back(name);
    for (std::size_t t = 0; t < kTakeFrames; ++t) take.frames[t].emplace_back(StandingAt(t)[role] + off);
  }
  return take;
}

/// Returns the take with a right twin, "R…", of every left marker, "L…".
MarkerMotion TakeOfBothSides(std::vector<Placed> markers) {
  for (std::size_t i = 0, count = markers.size(); i < count; ++i) {
    const auto [name, role, off] = markers[i];
    if (name.front() == 'L') markers.push_back({"R" + name.substr(1), Mirrored(role), {-off.x, off.y, off.z}});
  }
  return Take(markers);
}

MarkerMotion OwnJoints() {
  std::vector<Placed> markers;
  for (const Role role : AllRoles()) markers.push_back({std::string(RoleName(role)), role});
  return Take(markers);
}

double FurthestJoint(const BodyMotion& motion, double floor = 0) {
  double furthest = 0;
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    BodyPose wanted = StandingAt(t);
    for (glm::dvec3& joint : wanted.joints) joint.y -= floor;
    for (const Role role : AllRoles())
      furthest = std::max(furthest, glm::distance(motion.poses[t][role], wanted[role]));
  }
  return furthest;
}

/// Returns the note on the first body of the markers, or the reason why there is none.
std::string NoteOf(const MarkerMotion& markers, const MarkerOptions& options = {}) {
  const auto bodies = FindMarkerBodies(markers, "a.trc", options);
  return bodies ? bodies->front().Note() : ToString(bodies.error());
}

/// Returns the take with each position changed.
MarkerMotion Changed(MarkerMotion take, const std::function<glm::dvec3(const glm::dvec3&)>& place_of) {
  for (auto& frame : take.frames) {
    for (auto& place : frame) place = place_of(*place);
  }
  return take;
}

TEST(Markers, OfOurOwnNamesKeepTheirMeaningWithoutOneOfThem) {
  const auto without = [](Role missing) {
    std::vector<Placed> markers;
    for (const Role role : AllRoles()) {
      if (role != missing) markers.push_back({std::string(RoleName(role)), role});
    }
    return FindMarkerBodies(Take(markers), "a.trc");
  };
  // A needed joint is refused: the hand is not taken for the wrist, nor the foot for the ankle.
  EXPECT_THAT(testing::Refusal(without(Role::kLeftWrist)), HasSubstr("nearest: Etude's joints lacks left_wrist"));
  EXPECT_THAT(testing::Refusal(without(Role::kRightAnkle)), HasSubstr("nearest: Etude's joints lacks right_ankle"));
  ASSERT_OK(bodies, without(Role::kHead));
  EXPECT_EQ(bodies->front().Note(), "Etude's joints; placed by rule: head");
}

TEST(Markers, OfOurOwnNamesAreTheJointsAsTheyWereWritten) {
  ASSERT_OK(bodies, FindMarkerBodies(OwnJoints(), "a.trc"));
  ASSERT_EQ(bodies->size(), 1u);
  EXPECT_EQ(bodies->front().motion.rate_hz, 50);
  EXPECT_EQ(bodies->front().motion.poses.size(), kTakeFrames);
  EXPECT_LT(FurthestJoint(bodies->front().motion), 1e-12) << "the floor included";
  EXPECT_EQ(bodies->front().Note(), "Etude's joints");
  // A body half a metre or more above the floor is moved, with a note; --keep-floor keeps it.
  const MarkerMotion take = Changed(OwnJoints(), [](const glm::dvec3& place) { return place + glm::dvec3(0, 0.7, 0); });
  const auto moved = FindMarkerBodies(take, "a.trc"), kept = FindMarkerBodies(take, "a.trc", {.keep_floor = true});
  EXPECT_EQ(moved->front().Note(), "Etude's joints; Etude moved the floor from 72 cm to 0");
  EXPECT_EQ(kept->front().Note(), "Etude's joints");
  EXPECT_NEAR(kept->front().motion.poses[0][Role::kHipCentre].y, 1.6, 1e-12);
}

/// Returns a pose estimator's markers for a motion; `turn` maps Y up to the file's axis.
MarkerMotion Keypoints(
    const std::vector<BodyPose>& poses,
    const std::function<glm::dvec3(glm::dvec3)>& turn = [](glm::dvec3 p) { return p; }) {
  using enum Role;
  const std::vector<std::pair<Role, std::string>> names = {
      {kHipCentre, "MidHip"},       {kShoulderCentre, "Neck"}, {kHead, "LEar"},        {kHead, "REar"},
      {kLeftShoulder, "LShoulder"}, {kLeftElbow, "LElbow"},    {kLeftWrist, "LWrist"}, {kRightShoulder, "RShoulder"},
      {kRightElbow, "RElbow"},      {kRightWrist, "RWrist"},   {kLeftHip, "LHip"},     {kLeftKnee, "LKnee"},
      {kLeftAnkle, "LAnkle"},       {kLeftFoot, "LBigToe"},    {kRightHip, "RHip"},    {kRightKnee, "RKnee"},
      {kRightAnkle, "RAnkle"},      {kRightFoot, "RBigToe"}};
  MarkerMotion take{.rate_hz = 50, .names = {}, .frames = {}};
  for (const auto& [role, name] : names) take.names.push_back(name);
  for (const BodyPose& pose : poses) {
    auto& frame = take.frames.emplace_back();
    for (const auto& [role, name] : names) frame.emplace_back(turn(pose[role]));
  }
  return take;
}

/// Moves joints slightly, as in people at rest.
BodyPose Stirred(BodyPose pose, std::size_t frame) {
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    pose.joints[i].x += 0.01 * std::sin(0.2 * static_cast<double>(frame) + static_cast<double>(i));
  }
  return pose;
}

/// Returns a body that lies on its back, with the head towards −Z, the heels on the floor and the knees slightly
/// bent.
BodyPose Lying(std::size_t frame) {
  BodyPose pose = StandingAt(0);
  for (glm::dvec3& joint : pose.joints) joint = {joint.x, 0.1 + joint.z, -joint.y};
  pose[Role::kLeftKnee].y = pose[Role::kRightKnee].y = 0.25;
  pose[Role::kLeftFoot] += glm::dvec3(0, -0.05, 0.07);
  pose[Role::kRightFoot] += glm::dvec3(0, -0.05, 0.07);
  pose[Role::kHead].y += 0.15;
  return Stirred(pose, frame);
}

BodyPose Crawling(std::size_t frame) {
  using enum Role;
  BodyPose pose;
  const double step = 0.02 * static_cast<double>(frame), swing = 0.1 * std::sin(0.3 * static_cast<double>(frame));
  const auto put = [&](Role role, double x, double y, double z) { pose[role] = {x, y, z + step}; };
  put(kHipCentre, 0, .47, 0);
  put(kSpine, 0, .5, .25);
  put(kShoulderCentre, 0, .5, .5);
  put(kHead, 0, .6, .68);
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    put(of(kLeftShoulder), side * .18, .5, .48);
    put(of(kLeftElbow), side * .18, .28, .5 + side * swing);
    put(of(kLeftWrist), side * .18, .06, .55 + side * swing);
    put(of(kLeftHand), side * .18, .02, .7 + side * swing);
    put(of(kLeftHip), side * .09, .47, 0);
    put(of(kLeftKnee), side * .09, .05, 0 - side * swing);
    put(of(kLeftAnkle), side * .09, .06, -.42 - side * swing);
    put(of(kLeftFoot), side * .09, .02, -.55 - side * swing);
  }
  return pose;
}

/// Upside down on stretched arms.
BodyPose OnHands(std::size_t frame) {
  BodyPose pose = StandingAt(0);
  for (const Role elbow : {Role::kLeftElbow, Role::kRightElbow}) {
    const Role wrist = elbow == Role::kLeftElbow ? Role::kLeftWrist : Role::kRightWrist;
    const Role hand = elbow == Role::kLeftElbow ? Role::kLeftHand : Role::kRightHand;
    pose[elbow].y = 1.7, pose[wrist].y = 1.95, pose[hand].y = 2.05;
  }
  for (glm::dvec3& joint : pose.joints) joint = {-joint.x, 2.1 - joint.y, joint.z};
  return Stirred(pose, frame);
}

BodyPose Walking(std::size_t frame) {
  BodyPose pose = StandingAt(0);
  const double t = 0.05 * static_cast<double>(frame);  // position in the walk, steps
  for (glm::dvec3& joint : pose.joints) joint = {joint.z, joint.y, -joint.x};
  for (glm::dvec3& joint : pose.joints) joint.x += 0.6 * t;
  for (const bool is_left : {true, false}) {
    const double phase = std::fmod(t + (is_left ? 0 : 1), 2), stands = phase < 1 ? 0 : phase - 1;
    const double at = 1.2 * (std::floor((t + (is_left ? 0 : 1)) / 2) + stands) + (is_left ? 0.3 : -0.3);
    const auto of = [&](Role role) { return is_left ? role : Mirrored(role); };
    pose[of(Role::kLeftAnkle)].x = at;
    pose[of(Role::kLeftFoot)].x = at + 0.17;
    pose[of(Role::kLeftKnee)].x = 0.5 * (at + pose[of(Role::kLeftHip)].x);
    pose[of(Role::kLeftAnkle)].y += phase < 1 ? 0 : 0.1 * std::sin(3.14159 * stands);
  }
  return pose;
}

std::vector<BodyPose> Frames(BodyPose (*posture)(std::size_t), std::size_t count = 60) {
  std::vector<BodyPose> poses;
  for (std::size_t t = 0; t < count; ++t) poses.push_back(posture(t));
  return poses;
}

glm::dvec3 ZUp(glm::dvec3 p) { return {p.x, -p.z, p.y}; }
glm::dvec3 YUp(glm::dvec3 p) { return p; }

/// Returns the largest difference, over all frames, between the vectors from hip centre to head.
double OffUp(const MarkerBody& body, const std::vector<BodyPose>& wanted) {
  double off = 0;
  for (std::size_t t = 0; t < wanted.size(); ++t) {
    const auto span = [](const BodyPose& pose) { return pose[Role::kHead] - pose[Role::kHipCentre]; };
    off = std::max(off, glm::distance(span(body.motion.poses[t]), span(wanted[t])));
  }
  return off;
}

TEST(MarkersUp, OfPeopleWhoLieCrawlOrStandOnTheirHandsIsTheFormatsAxis) {
  struct Posture {
    const char* name;
    BodyPose (*pose)(std::size_t);
  };
  for (const auto& [name, posture] : {Posture{"lying", &Lying}, {"crawling", &Crawling}, {"on hands", &OnHands}}) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      std::vector<BodyPose> poses = Frames(posture);
      for (BodyPose& pose : poses) {
        for (glm::dvec3& p : pose.joints) {
          for (int i = 0; i < quarter; ++i) p = {p.z, p.y, -p.x};
        }
      }
      SCOPED_TRACE(fmt::format("{}, turned by {} quarters", name, quarter));
      const auto trc = FindMarkerBodies(Keypoints(poses), "a.trc", {.up = TrcUp()});
      const auto c3d = FindMarkerBodies(Keypoints(poses, ZUp), "a.c3d", {.up = C3dUp(0, false)});
      ASSERT_TRUE(trc && c3d);
      EXPECT_LT(OffUp(trc->front(), poses), 1e-9) << trc->front().Note();
      EXPECT_LT(OffUp(c3d->front(), poses), 1e-9) << c3d->front().Note();
      EXPECT_THAT(trc->front().up.doubt,
                  HasSubstr("Y is the usual axis of TRC files, so Etude assumes this axis; --up sets another axis"));
    }
  }
}

TEST(MarkersUp, OfPeopleWithRaisedArmsInAFileWhoseAxesPointDownIsNotThatOfAHandstand) {
  // The arms wave above the head: if Y were up, nothing would stay on a floor.
  const auto waving = [](std::size_t t) {
    BodyPose pose = StandingAt(t);
    const glm::dvec3 up(0.1 * std::sin(0.3 * static_cast<double>(t)), 0.25, 0);
    for (const Role hand : {Role::kLeftWrist, Role::kRightWrist, Role::kLeftHand, Role::kRightHand}) {
      pose[hand] = pose[Role::kHead] + (1 + std::sin(0.3 * static_cast<double>(t))) * up;
    }
    return pose;
  };
  std::vector<BodyPose> poses = Frames(waving);
  const auto down = [](glm::dvec3 p) { return glm::dvec3(p.x, -p.y, -p.z); };
  ASSERT_OK(trc, FindMarkerBodies(Keypoints(poses, down), "a.trc", {.up = TrcUp()}));
  EXPECT_LT(OffUp(trc->front(), poses), 1e-9) << trc->front().Note();
  EXPECT_THAT(trc->front().up.doubt, HasSubstr("Etude assumes from the posture that −Y is up"));
}

TEST(Markers, WithNumbersForGapsTwiceTheSameNameOrExchangedSidesAreSaid) {
  const std::vector<BodyPose> poses = Frames(StandingAt);
  const auto changes = [](const MarkerMotion& markers) { return NoteOf(markers, {.up = TrcUp()}); };
  MarkerMotion markers = Keypoints(poses);
  const std::string control = changes(markers);
  EXPECT_THAT(control, Not(HasSubstr("as far away")));
  EXPECT_THAT(control, Not(HasSubstr("several")));
  EXPECT_THAT(control, Not(HasSubstr("backwards")));
  // A gap marked by a number such as -9999 must not move the floor.
  MarkerMotion far = markers;
  for (std::size_t t = 10; t < 14; ++t) far.frames[t].front() = glm::dvec3(-9999);
  EXPECT_THAT(changes(far), HasSubstr("Etude treats 4 positions as missing, because they are a hundred times as far "
                                      "away as the others"));
  EXPECT_THAT(changes(far), Not(HasSubstr("Etude moved the floor from -")));
  MarkerMotion twice = markers;
  twice.names.push_back(twice.names.front());
  for (auto& frame : twice.frames) frame.push_back(frame.front());
  EXPECT_THAT(changes(twice), HasSubstr("several markers have the name " + twice.names.front()));
  // If a joint comes from such a marker, it may be another person's: this is a doubt.
  ASSERT_OK(bodies, FindMarkerBodies(twice, "a.trc", {.up = TrcUp()}));
  EXPECT_THAT(bodies->front().doubts, ::testing::Contains(HasSubstr("several markers have the name")));
  MarkerMotion unlabelled = markers;
  for (int i = 0; i < 2; ++i) {
    unlabelled.names.emplace_back("*");
    for (auto& frame : unlabelled.frames) frame.push_back(frame.front());
  }
  ASSERT_OK(same, FindMarkerBodies(unlabelled, "a.trc", {.up = TrcUp()}));
  EXPECT_THAT(same->front().doubts, Not(::testing::Contains(HasSubstr("several markers have the name"))));
  const auto mirrored = [](glm::dvec3 p) { return glm::dvec3(-p.x, p.y, p.z); };
  EXPECT_THAT(changes(Keypoints(poses, mirrored)), HasSubstr("left and right are exchanged, or an axis is mirrored"));
}

TEST(Markers, ThatAreExchangedBetweenLeftAndRightAreNamed) {
  // Arms and legs swing, so that limbs between wrong joints change their lengths.
  std::vector<BodyPose> poses = Frames(StandingAt);
  for (std::size_t t = 0; t < poses.size(); ++t) {
    const double swing = 0.15 * std::sin(0.3 * static_cast<double>(t));
    for (const double side : {1.0, -1.0}) {
      const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
      poses[t][of(Role::kLeftElbow)].z += side * swing;
      poses[t][of(Role::kLeftWrist)].z += 2 * side * swing;
      poses[t][of(Role::kLeftKnee)].z -= side * swing;
      for (const Role role : {Role::kLeftAnkle, Role::kLeftFoot}) poses[t][of(role)].z -= 2 * side * swing;
    }
  }
  const auto note = [](const MarkerMotion& markers) { return NoteOf(markers, {.up = TrcUp()}); };
  const MarkerMotion right = Keypoints(poses);
  EXPECT_THAT(note(right), Not(HasSubstr("exchanged")));
  EXPECT_THAT(note(Keypoints(Frames(StandingAt))), Not(HasSubstr("exchanged")));
  EXPECT_THAT(note(Keypoints(Frames(Crawling))), Not(HasSubstr("exchanged")));
  for (const std::vector<std::string>& exchanged : std::vector<std::vector<std::string>>{
           {"Shoulder"}, {"Elbow"}, {"Wrist"}, {"Hip"}, {"Knee"}, {"Ankle"}, {"Elbow", "Wrist"},
           {"Knee", "Ankle", "BigToe"}, {"Elbow", "Knee"}}) {
    MarkerMotion markers = right;
    std::vector<std::string> pairs;
    for (const std::string& name : exchanged) {
      std::swap(*std::ranges::find(markers.names, "L" + name), *std::ranges::find(markers.names, "R" + name));
      pairs.push_back(fmt::format("L{0} – R{0}", name));
    }
    EXPECT_THAT(note(markers), HasSubstr("left and right are probably exchanged, because limbs cross: " + Join(pairs)));
  }
}

TEST(Markers, ThatAreNotUsedDoNotDecideWhichAreFarAway) {
  // Angles and forces of a gait model, as points near 0; the person stands 4 m from the origin.
  MarkerMotion take = OwnJoints();
  for (auto& frame : take.frames) {
    for (auto& place : frame) *place += glm::dvec3(4, 0, 1);
    for (int i = 0; i < 40; ++i) frame.emplace_back(glm::dvec3(0.001 * i, 0.0005, -0.001 * i));
  }
  for (int i = 0; i < 40; ++i) take.names.push_back("Output" + std::to_string(i));
  EXPECT_EQ(NoteOf(take), "Etude's joints");
  EXPECT_EQ(FindMarkerBodies(take, "a.c3d")->front().motion.poses.size(), kTakeFrames);
  // The control: a used marker that is lost is still a gap.
  for (std::size_t t = 10; t < 14; ++t) take.frames[t].front() = glm::dvec3(0, -9999, 0);
  EXPECT_THAT(NoteOf(take), HasSubstr("Etude treats 4 positions as missing, because they are a hundred times as far "
                                      "away as the others"));
}

TEST(Markers, OfThreeEqualNumbersThatRecurAreGaps) {
  for (const glm::dvec3& gap : {glm::dvec3(-1), glm::dvec3(9.999), glm::dvec3(0.5, -0.5, 0.5)}) {
    MarkerMotion take = OwnJoints();
    for (std::size_t t = 10; t < 14; ++t) take.frames[t][Index(Role::kLeftHand)] = gap;
    ASSERT_OK(bridged, FindMarkerBodies(take, "a.trc"));
    EXPECT_LT(FurthestJoint(bridged->front().motion), 0.1);
    EXPECT_THAT(bridged->front().Note(), HasSubstr("Etude treats 4 repeated positions of three equal numbers as "
                                                   "missing"));
  }
  // A marker may pass such a point once.
  MarkerMotion once = OwnJoints();
  once.frames[10][Index(Role::kLeftHand)] = glm::dvec3(0.5);
  EXPECT_THAT(FindMarkerBodies(once, "a.trc")->front().Note(), Not(HasSubstr("three equal numbers")));
}

TEST(Markers, OfALimbThatAreAlwaysAtZeroAreGaps) {
  MarkerMotion markers = Keypoints(Frames(Walking));
  const auto at_zero = [&](const std::string& name) {
    MarkerMotion changed = markers;
    const auto column = std::ranges::find(markers.names, name) - markers.names.begin();
    for (auto& frame : changed.frames) frame[static_cast<std::size_t>(column)] = glm::dvec3(0);
    return NoteOf(changed, {.up = TrcUp()});
  };
  EXPECT_THAT(at_zero("LBigToe"), HasSubstr("left_foot; Etude treats 60 positions at (0, 0, 0) as missing"));
  EXPECT_THAT(at_zero("LKnee"), HasSubstr("lacks left_knee"));
  EXPECT_THAT(at_zero("LKnee"), HasSubstr("; Etude treats 60 positions at (0, 0, 0) as missing"));
}

TEST(Markers, ThatNoFrameShowsAreAbsent) {
  MarkerMotion markers = Keypoints(Frames(StandingAt));
  const auto index_of = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(markers.names, name) - markers.names.begin());
  };
  const std::size_t toe = index_of("LBigToe"), knee = index_of("LKnee");
  ASSERT_LT(std::max(toe, knee), markers.names.size());
  for (auto& frame : markers.frames) frame[toe].reset();
  ASSERT_OK(bodies, FindMarkerBodies(markers, "a.trc", {.up = TrcUp()}));
  EXPECT_THAT(bodies->front().Note(), HasSubstr("left_foot"));
  for (auto& frame : markers.frames) frame[knee].reset();
  EXPECT_THAT(testing::Refusal(FindMarkerBodies(markers, "a.trc", {.up = TrcUp()})), HasSubstr("lacks left_knee"));
}

TEST(MarkersUp, OfPeopleWhoStandOnTheirHeadsIsSaidToBeTheOther) {
  std::vector<BodyPose> poses = Frames(StandingAt);
  const auto down = [](glm::dvec3 p) { return glm::dvec3(p.x, -p.y, -p.z); };
  ASSERT_OK(motive, FindMarkerBodies(Keypoints(poses, down), "a.csv", {.up = MotiveUp()}));
  EXPECT_EQ(motive->front().up.doubt,
            "the body stands along −Y, but Y is the convention of Motive's exports; --up allows only Y or Z, so rotate "
            "the file first");
}

TEST(MarkersUp, OfPeopleWhoLieAndThenStandIsTheAxisThatKeepsTheFloor) {
  std::vector<BodyPose> poses = Frames(Lying, 80);
  for (std::size_t t = 0; t < 20; ++t) poses.push_back(StandingAt(0));
  const auto trc = FindMarkerBodies(Keypoints(poses), "a.trc", {.up = TrcUp()});
  // With Z up the head lies along −Y, so only the floor shows the axis.
  const auto turned = [](glm::dvec3 p) { return ZUp({-p.x, p.y, -p.z}); };
  const auto zup = FindMarkerBodies(Keypoints(poses, turned), "a.trc", {.up = TrcUp()});
  ASSERT_TRUE(trc && zup);
  EXPECT_LT(OffUp(trc->front(), poses), 1e-9) << trc->front().Note();
  EXPECT_EQ(trc->front().up.doubt, "");
  for (BodyPose& pose : poses) {
    for (glm::dvec3& p : pose.joints) p = {-p.x, p.y, -p.z};
  }
  EXPECT_LT(OffUp(zup->front(), poses), 1e-9) << zup->front().Note();
}

TEST(MarkersUp, OfPeopleWhoStandOrWalkIsTheirAxisAndItsDoubtIsSaid) {
  for (BodyPose (*const posture)(std::size_t) : {&Walking, &StandingAt}) {
    const std::vector<BodyPose> poses = Frames(posture);
    const auto zup = FindMarkerBodies(Keypoints(poses, ZUp), "a.trc", {.up = TrcUp()});
    const auto yup = FindMarkerBodies(Keypoints(poses), "a.c3d", {.up = C3dUp(0, false)});
    ASSERT_TRUE(zup && yup);
    EXPECT_LT(OffUp(zup->front(), poses), 1e-9) << zup->front().Note();
    EXPECT_LT(OffUp(yup->front(), poses), 1e-9) << yup->front().Note();
    EXPECT_EQ(zup->front().up.evidence, UpEvidence::kPosture);
    EXPECT_EQ(zup->front().up.doubt,
              "Etude assumes from the posture that Z is up, although Y is the usual axis of TRC files; --up sets "
              "another axis");
    EXPECT_THAT(zup->front().Note(), HasSubstr("turned upright from Z up (its posture)"));
  }
}

TEST(MarkersUp, IsRankedByTheUserTheFileTheFormatAndThenPosture) {
  const std::vector<BodyPose> poses = Frames(StandingAt);
  const auto axis = [&](UpRule rule) {
    const auto bodies = FindMarkerBodies(Keypoints(poses, YUp), "a.c3d", {.up = std::move(rule)});
    return AxisName(bodies->front().up.axis) + " " + std::string(UpEvidenceName(bodies->front().up.evidence)) +
           (bodies->front().up.doubt.empty() ? "" : " in doubt");
  };
  EXPECT_EQ(axis({.axis = {0, 0, 1}, .evidence = UpEvidence::kTold}), "Z told");
  EXPECT_EQ(axis(C3dUp('Z', false)), "Z file in doubt");
  EXPECT_EQ(axis(C3dUp('Y', true)), "−Y file in doubt");
  EXPECT_EQ(axis(MotiveUp()), "Y format");
  EXPECT_EQ(axis(TrcUp()), "Y posture");
  EXPECT_EQ(axis(C3dUp(0, false)), "Y posture in doubt");
}

TEST(Markers, OfTwoSetsTheBetterCountAndTheOtherCanBeChosen) {
  const std::vector<BodyPose> poses = Frames(StandingAt);
  MarkerMotion take = Keypoints(poses, [](glm::dvec3 p) { return p + glm::dvec3(0.06, 0, 0); });
  using enum Role;
  std::vector<std::pair<Role, std::string>> markers = {{kLeftHip, "LHJC_study"}, {kRightHip, "RHJC_study"}};
  const std::vector<std::pair<Role, std::string>> lefts = {
      {kLeftShoulder, "shoulder"}, {kLeftElbow, "lelbow"}, {kLeftElbow, "melbow"}, {kLeftWrist, "lwrist"},
      {kLeftWrist, "mwrist"},      {kLeftKnee, "knee"},    {kLeftKnee, "mknee"},   {kLeftAnkle, "ankle"},
      {kLeftAnkle, "mankle"},      {kLeftFoot, "toe"}};
  for (const auto& [left, name] : lefts) {
    markers.emplace_back(left, "L_" + name + "_study");
    markers.emplace_back(Mirrored(left), "r_" + name + "_study");
  }
  for (const auto& [role, name] : markers) {
    take.names.emplace_back(name);
    // Shoulder markers are above the joints, by 13.5 % of the length from marker to elbow.
    const double above = role == kLeftShoulder || role == kRightShoulder ? 0.0469 : 0;
    for (std::size_t t = 0; t < poses.size(); ++t)
      take.frames[t].emplace_back(poses[t][role] + glm::dvec3(0, above, 0));
  }
  ASSERT_OK(best, FindMarkerBodies(take, "a.trc"));
  EXPECT_THAT(
      best->front().Note(),
      HasSubstr(
          "OpenCap's augmented markers (the file also contains OpenPose BODY_25; --marker-set body_25 chooses this "
          "set)"));
  EXPECT_THAT(best->front().Note(),
              HasSubstr("Etude placed joint centres under the skin, at these distances from the markers in cm: "
                        "shoulders"));
  for (const Role role : {kLeftShoulder, kLeftElbow, kRightWrist, kLeftKnee, kRightAnkle}) {
    EXPECT_LT(glm::distance(best->front().motion.poses[3][role], poses[3][role] - glm::dvec3(0, 0.02, 0)), 0.002)
        << RoleName(role);
  }
  ASSERT_OK(other, FindMarkerBodies(take, "a.trc", {.set = "body_25"}));
  EXPECT_THAT(other->front().Note(), HasSubstr("OpenPose BODY_25 (the file also contains OpenCap's augmented markers"));
  EXPECT_THAT(testing::Refusal(FindMarkerBodies(take, "a.trc", {.set = "plug-in-gait"})),
              HasSubstr("Plug-in Gait lacks left_shoulder"));
}

TEST(Markers, TakeTheUnitThatIsTold) {
  MarkerMotion take = Keypoints(Frames(StandingAt), [](glm::dvec3 p) { return 0.5 * p; });
  take.metres_per_unit = 0.001;
  ASSERT_OK(told, FindMarkerBodies(take, "a.trc", {.metres_per_unit = 0.002}));
  EXPECT_NEAR(told->front().motion.poses[0][Role::kHipCentre].y, 0.88, 1e-9);
  EXPECT_THAT(told->front().Note(), HasSubstr("1 unit = 0.2 cm (given), instead of 0.1 cm as in the file"));
  EXPECT_THAT(ToString(FindMarkerBodies(take, "a.trc", {.metres_per_unit = 1}).error()),
              HasSubstr("a.trc: with the given unit (1 unit = 100 cm), the body is"));
}

TEST(Markers, AtZeroAreGapsUnlessTheyAreAlwaysThere) {
  MarkerMotion take = OwnJoints();
  for (std::size_t t = 10; t < 14; ++t) take.frames[t][Index(Role::kLeftHip)] = glm::dvec3(0);
  ASSERT_OK(bridged, FindMarkerBodies(take, "a.trc"));
  EXPECT_LT(FurthestJoint(bridged->front().motion), 1e-12);
  EXPECT_EQ(bridged->front().Note(),
            "Etude's joints; 4 positions interpolated in gaps; Etude treats 4 positions at (0, 0, 0) as missing");
  MarkerMotion rooted = OwnJoints();
  for (auto& frame : rooted.frames) {
    const glm::dvec3 root = *frame[Index(Role::kHipCentre)];
    for (auto& place : frame) *place -= root;
  }
  EXPECT_EQ(FindMarkerBodies(rooted, "a.trc", {.keep_floor = true})->front().Note(), "Etude's joints");
}

TEST(Markers, InAWrongUnitAreTakenForAPersonOrRefused) {
  for (const double factor : {1000.0, 10.0, 0.1, 0.001}) {
    const MarkerMotion take = Changed(OwnJoints(), [&](const glm::dvec3& place) { return factor * place; });
    ASSERT_OK(bodies, FindMarkerBodies(take, "a.trc"));
    EXPECT_LT(FurthestJoint(bodies->front().motion), 1e-12);
    EXPECT_THAT(bodies->front().Note(),
                HasSubstr(fmt::format("m tall, so Etude multiplies all lengths by {:g}", 1 / factor)));
  }
  const MarkerMotion take = Changed(OwnJoints(), [](const glm::dvec3& place) { return 4.0 * place; });
  EXPECT_THAT(testing::Refusal(FindMarkerBodies(take, "a.trc")),
              HasSubstr("a.trc: the markers show a body 6.65 m tall"));
}

TEST(Markers, InAUnitThatMakesADwarfOrAGiantAreSaidWithTheLikelyUnit) {
  const auto note = [](double factor, double metres_per_unit) {
    MarkerMotion take = Changed(OwnJoints(), [&](const glm::dvec3& place) { return factor * place; });
    take.metres_per_unit = metres_per_unit;
    return NoteOf(take);
  };
  EXPECT_EQ(note(1, .01), "Etude's joints");
  EXPECT_THAT(note(.01 / .0254, .01), HasSubstr("Etude uses 1 unit = 1 cm; with 1 unit = 2.54 cm (inch), the body "
                                                "would be 1.66 m tall"));
  EXPECT_THAT(note(2.4, .0254), HasSubstr("Etude uses 1 unit = 2.54 cm; with 1 unit = 1 cm (centimetre), the body "
                                          "would be 1.57 m tall"));
}

TEST(Markers, OfPlugInGaitGiveJointsInsideTheLimbs) {
  // The pelvis has front markers at (±a, h, back + f) from the hip centre, and back markers at (±0.05, h, back − f).
  // The expected hip joint is Harrington's regression, computed by hand.
  using enum Role;
  const double a = 0.12, f = 0.07, h = 0.0829, back = -0.0265;
  MarkerMotion take = TakeOfBothSides({{"LFHD", kHead, {0.07, 0, 0.09}},
                                       {"LBHD", kHead, {0.07, 0, -0.09}},
                                       {"C7", kShoulderCentre, {0, 0, -0.06}},
                                       {"T10", kSpine, {0, 0, -0.1}},
                                       {"STRN", kSpine, {0, 0, 0.1}},
                                       {"LSHO", kLeftShoulder, {0, 0.045, 0}},
                                       {"LELB", kLeftElbow, {0.048, 0, 0}},
                                       {"LWRA", kLeftWrist, {0, 0, 0.03}},
                                       {"LWRB", kLeftWrist, {0, 0, -0.03}},
                                       {"LFIN", kLeftHand},
                                       {"LASI", kHipCentre, {a, h, back + f}},
                                       {"LPSI", kHipCentre, {0.05, h, back - f}},
                                       {"LKNE", kLeftKnee, {0.05, 0, 0}},
                                       {"LANK", kLeftAnkle, {0.035, 0, 0}},
                                       {"LTOE", kLeftFoot},
                                       {"CLAV", kShoulderCentre, {0, 0, 0.06}}});
  for (std::string& name : take.names) name = "Me:" + name;
  ASSERT_OK(bodies, FindMarkerBodies(take, "a.c3d"));
  const MarkerBody& body = bodies->front();
  EXPECT_EQ(body.name, "Me");
  EXPECT_THAT(
      body.Note(),
      HasSubstr("Plug-in Gait; Etude placed joint centres under the skin, at these distances from the markers in cm: "
                "knees "));
  EXPECT_THAT(body.Note(), HasSubstr("by the lengths of the limbs; placed by rule: hip_centre"));
  EXPECT_THAT(body.Note(), HasSubstr("Etude moved the floor from 2 cm to 0"));
  const BodyPose& pose = body.motion.poses.front();
  const double depth = 2 * f, width = 2 * a;
  const glm::dvec3 hip = pose[Role::kLeftHip];
  EXPECT_NEAR(hip.x, 0.33 * width + 0.0073, 1e-9);
  EXPECT_NEAR(hip.y + 0.02, 0.9 + 0.0829 - 0.30 * width - 0.0109, 1e-9);
  EXPECT_NEAR(hip.z, -0.0265 + f - 0.24 * depth - 0.0099, 1e-9);
  BodyPose wanted = StandingAt(0);
  for (const Role role : AllRoles()) {
    EXPECT_LT(glm::distance(pose[role], wanted[role] - glm::dvec3(0, 0.02, 0)), 0.015) << RoleName(role);
  }
  // Without one marker, the refusal names its joint, not all joints of another set.
  const auto column = std::ranges::find(take.names, "Me:LKNE") - take.names.begin();
  take.names.erase(take.names.begin() + column);
  for (auto& frame : take.frames) frame.erase(frame.begin() + column);
  EXPECT_THAT(testing::Refusal(FindMarkerBodies(take, "a.c3d")), HasSubstr("nearest: Plug-in Gait lacks left_knee)"));
}

TEST(Markers, OfASacrumStandForTheBackOfThePelvis) {
  using enum Role;
  std::vector<Placed> markers = {{"LSHO", kLeftShoulder}, {"RSHO", kRightShoulder}, {"LELB", kLeftElbow},
                                 {"RELB", kRightElbow},   {"LKNE", kLeftKnee},      {"RKNE", kRightKnee},
                                 {"LANK", kLeftAnkle},    {"RANK", kRightAnkle},    {"LWRA", kLeftWrist},
                                 {"LWRB", kLeftWrist},    {"RWRA", kRightWrist},    {"RWRB", kRightWrist}};
  markers.push_back({"LASI", kHipCentre, {0.12, 0.08, 0.07}});
  markers.push_back({"RASI", kHipCentre, {-0.12, 0.08, 0.07}});
  std::vector<Placed> with_sacrum = markers;
  markers.push_back({"LPSI", kHipCentre, {0.05, 0.08, -0.07}});
  markers.push_back({"RPSI", kHipCentre, {-0.05, 0.08, -0.07}});
  with_sacrum.push_back({"SACR", kHipCentre, {0, 0.08, -0.07}});
  ASSERT_OK(four, FindMarkerBodies(Take(markers), "a.trc"));
  ASSERT_OK(three, FindMarkerBodies(Take(with_sacrum), "a.trc"));
  for (const Role role : AllRoles()) {
    EXPECT_LT(glm::distance(three->front().motion.poses[0][role], four->front().motion.poses[0][role]), 1e-12);
  }
}

TEST(Markers, OfPoseEstimatorsAreTakenAndWhatTheyLackIsPlacedByRule) {
  using enum Role;
  const MarkerMotion take = TakeOfBothSides({{"Nose", kHead, {0, 0, 0.1}},
                                             {"Neck", kShoulderCentre},
                                             {"MidHip", kHipCentre},
                                             {"LShoulder", kLeftShoulder},
                                             {"LElbow", kLeftElbow},
                                             {"LWrist", kLeftWrist},
                                             {"LHip", kLeftHip},
                                             {"LKnee", kLeftKnee},
                                             {"LAnkle", kLeftAnkle},
                                             {"LEar", kHead, {0.07, 0, 0}},
                                             {"LBigToe", kLeftFoot}});
  ASSERT_OK(bodies, FindMarkerBodies(take, "a.trc"));
  EXPECT_THAT(bodies->front().Note(), HasSubstr("OpenPose BODY_25; placed by rule: spine, left_hand, right_hand"));
  EXPECT_LT(FurthestJoint(bodies->front().motion, 0.02), 0.03);
}

TEST(Markers, GapsAreBridgedAndLongOnesCutOff) {
  MarkerMotion take = OwnJoints();
  take.rate_hz = 10;  // ten frames are a second
  const std::size_t wrist = Index(Role::kLeftWrist), knee = Index(Role::kRightKnee);
  for (std::size_t t = 5; t < 9; ++t) take.frames[t][wrist].reset();
  for (std::size_t t = 25; t < 38; ++t) take.frames[t][knee].reset();
  ASSERT_OK(bodies, FindMarkerBodies(take, "a.trc"));
  EXPECT_EQ(bodies->front().motion.poses.size(), 25u);
  EXPECT_LT(FurthestJoint(bodies->front().motion), 1e-12) << "the sway is straight";
  EXPECT_EQ(
      bodies->front().Note(),
      "Etude's joints; 4 positions interpolated in gaps, the longest from 0.50 to 0.80 s; Etude uses only frames 1 "
      "to 25 of 40, because joints are missing in other frames for over 1 s");
  EXPECT_THAT(bodies->front().doubts,
              ::testing::ElementsAre(HasSubstr("interpolated in gaps"), HasSubstr("frames 1 to 25")));
  // Short gaps of different joints that follow each other are not one long gap.
  MarkerMotion flickering = OwnJoints();
  flickering.rate_hz = 10;
  for (std::size_t t = 5; t < 20; ++t) flickering.frames[t][t % 2 == 0 ? wrist : knee].reset();
  ASSERT_OK(short_gaps, FindMarkerBodies(flickering, "a.trc"));
  EXPECT_EQ(short_gaps->front().Note(), "Etude's joints; 15 positions interpolated in gaps");
  // A caller who also gets the positions in the file needs no doubt about the others.
  ASSERT_OK(shown, FindMarkerBodies(take, "a.trc", {.keeps_shown = true}));
  EXPECT_THAT(shown->front().doubts, ::testing::IsEmpty());
}

TEST(Markers, LostAtTheBeginningAndTheEndAreNotSaidToBeLostForLong) {
  MarkerMotion take = OwnJoints();
  for (const std::size_t t : {0, 1, 39}) take.frames[t][Index(Role::kLeftWrist)].reset();
  EXPECT_EQ(FindMarkerBodies(take, "a.trc")->front().Note(),
            "Etude's joints; Etude uses only frames 3 to 39 of 40, because joints are missing before and after these "
            "frames");
}

TEST(Markers, ThatTwoPeopleExchangeAreNamedInBothBodies) {
  std::vector<Placed> placed;
  for (const char* name : {"Ann:", "Bob:"}) {
    for (const Role role : AllRoles()) {
      placed.push_back({name + std::string(RoleName(role)), role, glm::dvec3(name[0] == 'B' ? 1.5 : 0, 0, 0)});
    }
  }
  const MarkerMotion honest = Take(placed);
  const std::size_t wrist = Index(Role::kLeftWrist);
  const auto bodies_of = [&](bool is_whole, bool is_exchanged) {
    MarkerMotion take = honest;
    for (std::size_t t = 5; is_exchanged && t < take.frames.size(); ++t) {
      for (std::size_t j = 0; j < kRoleCount; ++j) {
        if (is_whole || j == wrist) std::swap(take.frames[t][j], take.frames[t][kRoleCount + j]);
      }
    }
    auto bodies = FindMarkerBodies(take, "two.trc");
    EXPECT_TRUE(bodies);
    return *bodies;
  };
  for (const MarkerBody& body : bodies_of(false, true)) {
    EXPECT_THAT(body.Note(), HasSubstr("markers of two people exchange positions from one frame to the next, once "
                                       "(first at 0.10 s): "));
    EXPECT_THAT(body.Note(), HasSubstr("Ann:left_wrist"));
    EXPECT_THAT(body.Note(), HasSubstr("Bob:left_wrist"));
  }
  for (const MarkerBody& body : bodies_of(true, true)) EXPECT_THAT(body.Note(), HasSubstr(", once (first at 0.10 s)"));
  for (const MarkerBody& body : bodies_of(true, false)) EXPECT_THAT(body.Note(), Not(HasSubstr("exchange")));
}

TEST(Markers, OfTwoPeopleAreTwoBodies) {
  MarkerMotion take = OwnJoints();
  for (std::string& name : take.names) name = "Ann:" + name;
  const MarkerMotion other = OwnJoints();
  for (const std::string& name : other.names) take.names.push_back("Bob:" + name);
  for (std::size_t t = 0; t < kTakeFrames; ++t) {
    take.frames[t].insert(take.frames[t].end(), other.frames[t].begin(), other.frames[t].end());
  }
  ASSERT_OK(bodies, FindMarkerBodies(take, "a.c3d"));
  ASSERT_EQ(bodies->size(), 2u);
  EXPECT_EQ((*bodies)[0].name, "Ann");
  EXPECT_EQ((*bodies)[1].name, "Bob");
}

TEST(Markers, OfNoKnownSetAreRefusedWithWhatIsLacking) {
  MarkerMotion take = OwnJoints();
  take.names[Index(Role::kLeftKnee)] = "knee";
  const auto refused = FindMarkerBodies(take, "a.c3d");
  EXPECT_THAT(testing::Refusal(refused), HasSubstr("a.c3d: the markers (hip_centre, "));
  EXPECT_THAT(testing::Refusal(refused),
              HasSubstr("belong to no known marker set (nearest: Etude's joints lacks left_knee); allowed: "));
}

/// Markers with the joint names of Bandai-Namco's skeleton. The neck is not one of the needed joints, but has a clear
/// name.
const std::vector<Placed> kOfASkeleton = {
    {"UpperArm_L", Role::kLeftShoulder},  {"LowerArm_L", Role::kLeftElbow},  {"Hand_L", Role::kLeftWrist},
    {"UpperLeg_L", Role::kLeftHip},       {"LowerLeg_L", Role::kLeftKnee},   {"Foot_L", Role::kLeftAnkle},
    {"UpperArm_R", Role::kRightShoulder}, {"LowerArm_R", Role::kRightElbow}, {"Hand_R", Role::kRightWrist},
    {"UpperLeg_R", Role::kRightHip},      {"LowerLeg_R", Role::kRightKnee},  {"Foot_R", Role::kRightAnkle},
    {"Neck", Role::kShoulderCentre}};

TEST(Markers, WithTheNamesOfASkeletonsJointsAreABody) {
  ASSERT_OK(bodies, FindMarkerBodies(Take(kOfASkeleton), "a.trc", {.keeps_shown = true}));
  const MarkerBody& body = bodies->front();
  EXPECT_THAT(body.Note(), HasSubstr("joint names of a skeleton; placed by rule: hip_centre, spine, head"));
  for (const Role role : kNeededJoints) {
    EXPECT_NEAR(body.motion.poses[7][role].x, StandingAt(7)[role].x, 1e-12);
    EXPECT_EQ(body.shown.At(7, body.shown.roles[Index(role)]), StandingAt(7)[role]);
  }
  EXPECT_EQ(body.shown.joints[body.shown.roles[Index(Role::kLeftElbow)]], "LowerArm_L") << "its own name";
  EXPECT_EQ(body.shown.At(7, body.shown.roles[Index(Role::kShoulderCentre)]), StandingAt(7)[Role::kShoulderCentre]);
  // A name that two markers have is not clear.
  std::vector<Placed> twice = kOfASkeleton;
  twice.push_back({"Neck1", Role::kHead});
  ASSERT_OK(unclear, FindMarkerBodies(Take(twice), "a.trc", {.keeps_shown = true}));
  EXPECT_EQ(unclear->front().shown.roles[Index(Role::kShoulderCentre)], -1);
}

/// The names of SMPL's joints, of MediaPipe's keypoints and of Etude's own joints begin alike. Only the middle of the
/// body tells that a file is Etude's, which has Y up.
TEST(Markers, OfOtherProgramsWithNamesLikeEtudesAreNotEtudes) {
  std::vector<Placed> limbs;
  for (const Role role : kNeededJoints) limbs.push_back({std::string(RoleName(role)), role});
  const auto with = [&](std::vector<Placed> more) {
    more.insert(more.begin(), limbs.begin(), limbs.end());
    const auto bodies = FindMarkerBodies(Take(more), "a.c3d");
    EXPECT_TRUE(bodies) << ToString(bodies.error());
    return bodies->front();
  };
  const MarkerBody keypoints = with({{"nose", Role::kHead}, {"left_ear", Role::kHead}, {"right_ear", Role::kHead}});
  EXPECT_THAT(keypoints.Note(), ::testing::StartsWith("COCO; "));
  EXPECT_EQ(keypoints.up.evidence, UpEvidence::kPosture);
  const MarkerBody joints = with({{"pelvis", Role::kHipCentre},
                                  {"neck", Role::kShoulderCentre},
                                  {"head", Role::kHead},
                                  {"left_foot", Role::kLeftFoot},
                                  {"right_foot", Role::kRightFoot}});
  EXPECT_EQ(joints.up.evidence, UpEvidence::kPosture);
  EXPECT_THAT(joints.Note(), HasSubstr("placed by rule: spine, left_hand, right_hand"));
  const MarkerBody own = with({{"hip_centre", Role::kHipCentre}});
  EXPECT_THAT(own.Note(), ::testing::StartsWith("Etude's joints; "));
  EXPECT_NE(own.up.evidence, UpEvidence::kPosture);
}

TEST(Markers, PlayTheRolesThatTheUserGives) {
  std::vector<Placed> odd = kOfASkeleton;
  MarkerOptions options{.keeps_shown = true};
  for (Placed& one : odd) {
    one.name = "Q" + std::to_string(options.roles.size());
    options.roles[one.role] = one.name;
  }
  EXPECT_THAT(testing::Refusal(FindMarkerBodies(Take(odd), "a.trc")),
              HasSubstr("use a joint map (--joint-map) to state which"));
  ASSERT_OK(bodies, FindMarkerBodies(Take(odd), "a.trc", options));
  EXPECT_THAT(bodies->front().Note(), HasSubstr("the joint map; placed by rule: hip_centre, spine, head"));
  EXPECT_EQ(bodies->front().shown.At(7, bodies->front().shown.roles[Index(Role::kShoulderCentre)]),
            StandingAt(7)[Role::kShoulderCentre]);
  // The user's marker for a role replaces the known set's rule for this role; the set's other rules remain. Markers
  // that the file lacks are ignored.
  ASSERT_OK(known, FindMarkerBodies(Take(kOfASkeleton), "a.trc",
                                    {.roles = {{Role::kLeftWrist, "LowerArm_L"}, {Role::kHead, "no such"}}}));
  EXPECT_THAT(known->front().Note(), HasSubstr("the joint map, and joint names of a skeleton"));
  EXPECT_EQ(known->front().motion.poses[7][Role::kLeftWrist], known->front().motion.poses[7][Role::kLeftElbow]);
  // The refusal of an incomplete map names the role that the map lacks.
  options.roles.erase(Role::kLeftKnee);
  EXPECT_THAT(testing::Refusal(FindMarkerBodies(Take(odd), "a.trc", options)),
              HasSubstr("(nearest: the joint map lacks left_knee)"));
}

TEST(Markers, ThatLieOnEachOtherGiveNoNumberThatIsNone) {
  auto take = OwnJoints();
  for (auto& frame : take.frames) {
    for (auto& place : frame) place = glm::dvec3(0);
  }
  const auto bodies = FindMarkerBodies(take, "a.trc");
  if (!bodies) return;
  for (const BodyPose& pose : bodies->front().motion.poses) {
    for (const glm::dvec3& joint : pose.joints) EXPECT_TRUE(std::isfinite(joint.x + joint.y + joint.z));
  }
}

}  // namespace
}  // namespace etude

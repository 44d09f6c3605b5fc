#include "engine/retargeting/marker_people.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "engine/retargeting/markers.h"
#include "tests/support/results.h"

namespace etude::marker_people {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t kFrames = 10;

/// The joints of a standing person, metres, named as in HumanIK. `x` is the person's place.
std::vector<std::pair<std::string, glm::dvec3>> Joints(double x) {
  std::vector<std::pair<std::string, glm::dvec3>> joints = {{"Neck", {x, 1.4, 0}}, {"Head", {x, 1.6, 0}}};
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "Left" : "Right";
    const auto add = [&](const char* bone, double out, double y, double z) {
      joints.emplace_back(name + bone, glm::dvec3(x + side * out, y, z));
    };
    add("Arm", .18, 1.4, 0);
    add("ForeArm", .2, 1.1, 0);
    add("Hand", .2, .85, 0);
    add("UpLeg", .09, .9, 0);
    add("Leg", .09, .48, 0);
    add("Foot", .09, .07, 0);
    add("ToeBase", .09, .02, .17);
  }
  return joints;
}

using Rename = std::function<std::string(const std::string&)>;

Rename Before(const std::string& prefix) {
  return [prefix](const std::string& name) { return prefix + name; };
}

Rename After(const std::string& suffix) {
  return [suffix](const std::string& name) { return name + suffix; };
}

/// Adds a person's first `count` markers.
void Add(MarkerMotion& take, double x, const Rename& rename, std::size_t count = 100) {
  take.frames.resize(kFrames);
  for (const auto& [name, place] : Joints(x)) {
    if (count-- == 0) return;
    take.names.push_back(rename(name));
    for (auto& frame : take.frames) frame.emplace_back(place);
  }
}

/// Reads a file; returns each person's name with the x coordinate of the hips, or the error.
std::vector<std::string> PeopleIn(const MarkerMotion& take) {
  const auto bodies = FindMarkerBodies(take, "a.trc");
  if (!bodies) return {ToString(bodies.error())};
  std::vector<std::string> people;
  for (const MarkerBody& body : *bodies) {
    people.push_back(fmt::format("{} at {:.1f}", body.name, body.motion.poses[0][Role::kHipCentre].x));
    for (const BodyPose& pose : body.motion.poses) {
      for (const Role role : kNeededJoints) EXPECT_LT(std::abs(pose[role].x - pose[Role::kHipCentre].x), .3) << "mixed";
    }
  }
  return people;
}

TEST(MarkerPeople, AreSeveralWhereNamesBeginOrEndDifferently) {
  struct Naming {
    Rename first, second;
    std::vector<std::string> people;
  };
  const Rename none = Before("");
  for (const auto& [first, second, people] :
       {Naming{Before("Ann:"), Before("Bob:"), {"Ann at 0.0", "Bob at 2.0"}},
        Naming{Before("Ann_"), Before("Bob_"), {"Ann at 0.0", "Bob at 2.0"}},
        Naming{Before("p1_"), Before("p2_"), {"p1 at 0.0", "p2 at 2.0"}},
        Naming{Before("1_"), Before("2_"), {"1 at 0.0", "2 at 2.0"}},
        Naming{Before("Ann."), Before("Bob."), {"Ann at 0.0", "Bob at 2.0"}},
        Naming{Before("Ann "), Before("Bob "), {"Ann at 0.0", "Bob at 2.0"}},
        Naming{Before("S1-"), Before("S2-"), {"S1 at 0.0", "S2 at 2.0"}},
        Naming{Before("a/"), Before("b/"), {"a at 0.0", "b at 2.0"}},
        Naming{Before("Subject_1_"), Before("Subject_2_"), {"Subject_1 at 0.0", "Subject_2 at 2.0"}},
        Naming{none, Before("p2_"), {"unnamed at 0.0", "p2 at 2.0"}},
        Naming{none, After("_2"), {"unnamed at 0.0", "2 at 2.0"}},
        Naming{none, After("2"), {"unnamed at 0.0", "2 at 2.0"}},
        Naming{Before(":"), Before("B:"), {"unnamed at 0.0", "B at 2.0"}},
        Naming{none, Before(":"), {"unnamed at 0.0", ": at 2.0"}},
        Naming{none, Before("_"), {"unnamed at 0.0", "_ at 2.0"}},
        Naming{After("_1"), Before("_"), {"1 at 0.0", "_ at 2.0"}},
        Naming{After("_"), Before("B_"), {"B at 2.0", "_ at 0.0"}},
        Naming{After(".1"), After(".2"), {"1 at 0.0", "2 at 2.0"}},
        Naming{Before("take:p1_"), Before("take:p2_"), {"take_p1 at 0.0", "take_p2 at 2.0"}}}) {
    MarkerMotion take;
    Add(take, 0, first);
    Add(take, 2, second);
    EXPECT_EQ(PeopleIn(take), people) << take.names.front() << ", " << take.names.back();
    // One of them alone is one person.
    MarkerMotion alone;
    Add(alone, 0, first);
    EXPECT_EQ(PeopleIn(alone).size(), 1u) << alone.names.front();
  }
}

TEST(MarkerPeople, ShareNoFrameOrder) {
  MarkerMotion one, take{.names = {}, .frames = {}};
  Add(one, 0, Before("Ann_"));
  Add(one, 2, Before("Bob_"));
  // Ann's and Bob's columns alternate.
  take.frames.resize(kFrames);
  const std::size_t half = one.names.size() / 2;
  for (std::size_t i = 0; i < one.names.size(); ++i) {
    const std::size_t from = i / 2 + (i % 2) * half;
    take.names.push_back(one.names[from]);
    for (std::size_t t = 0; t < kFrames; ++t) take.frames[t].push_back(one.frames[t][from]);
  }
  EXPECT_THAT(PeopleIn(take), ElementsAre("Ann at 0.0", "Bob at 2.0"));
}

TEST(MarkerPeople, WhoLackMarkersAreSaid) {
  for (const Rename& second : {Before("Bob_"), After("_2"), Before("Bob:")}) {
    for (const Rename& first : {Before(""), Before("Ann_")}) {
      const bool is_other_way = first("") == "Ann_" && second("") == "Bob:";  // names of different kinds
      if (is_other_way) continue;
      MarkerMotion take;
      Add(take, 0, first);
      Add(take, 2, second, 12);
      ASSERT_OK(bodies, FindMarkerBodies(take, "a.trc"));
      ASSERT_EQ(bodies->size(), 1u);
      EXPECT_THAT(bodies->front().Note(), HasSubstr("more markers with the same names (" + second("Head") +
                                                    ", …), because they may belong to another person"));
      EXPECT_NEAR(bodies->front().motion.poses[0][Role::kRightAnkle].x, -.09, 1e-9) << "not mixed";
    }
  }
}

TEST(MarkerPeople, AreOneWhereAProgramAddsTheSameMarkersAgainOrOthers) {
  // Smoothed markers of the same person, at nearly the same places.
  MarkerMotion smoothed;
  Add(smoothed, 0, Before(""));
  Add(smoothed, .01, Before("smooth_"));
  ASSERT_OK(one, FindMarkerBodies(smoothed, "a.trc"));
  EXPECT_EQ(one->size(), 1u);
  EXPECT_THAT(one->front().Note(), Not(HasSubstr("another person")));
  // A few further markers.
  MarkerMotion more;
  Add(more, 0, Before(""));
  Add(more, 2, Before("ball_"), 4);
  EXPECT_THAT(FindMarkerBodies(more, "a.trc")->front().Note(), Not(HasSubstr("another person")));
}

}  // namespace
}  // namespace etude::marker_people

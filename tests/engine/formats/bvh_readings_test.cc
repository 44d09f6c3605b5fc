// Programs interpret OFFSET together with position channels in two ways. Two small readers, which share no code with
// ours, must agree with it.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "engine/formats/bvh.h"
#include "engine/retargeting/rig.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/support/random_clip.h"
#include "tests/support/results.h"

namespace etude {
namespace {

enum class Positions { kReplaceOffset, kAreAddedToOffset };

/// Returns the positions of all joints in all frames, in the file's order. `text` is valid.
std::vector<glm::dvec3> PlacesIn(const std::string& text, Positions positions) {
  struct ReadJoint {
    int parent = -1;
    glm::dvec3 offset{0};
    std::vector<std::string> channels = {};
  };
  std::istringstream in(text);
  std::vector<ReadJoint> joints;
  std::vector<int> open;
  std::string word;
  // The hierarchy.
  while (in >> word && word != "Frames:") {
    if (word == "{") {
      joints.push_back({.parent = open.empty() ? -1 : open.back()});
      open.push_back(static_cast<int>(joints.size()) - 1);
    }
    if (word == "}") open.pop_back();
    if (word == "OFFSET") in >> joints.back().offset.x >> joints.back().offset.y >> joints.back().offset.z;
    if (word == "CHANNELS") {
      std::size_t count = 0;
      in >> count;
      joints.back().channels.resize(count);
      for (std::string& channel : joints.back().channels) in >> channel;
    }
  }
  std::size_t frames = 0;
  double period = 0;
  in >> frames >> word >> word >> period;
  // The frames.
  std::vector<glm::dvec3> places;
  for (std::size_t f = 0; f < frames; ++f) {
    std::vector<glm::dmat4> globals;
    for (const ReadJoint& joint : joints) {
      const bool replaces = positions == Positions::kReplaceOffset && joint.channels.size() == 6;
      glm::dvec3 place = replaces ? glm::dvec3(0) : joint.offset;
      glm::dmat4 local(1);
      for (const std::string& channel : joint.channels) {
        double value = 0;
        in >> value;
        const int axis = channel[0] - 'X', next = (axis + 1) % 3, last = (axis + 2) % 3;
        if (channel.ends_with("position")) {
          place[axis] += value;
          continue;
        }
        const double angle = value * std::acos(-1.0) / 180;
        glm::dmat4 about(1);
        about[next][next] = about[last][last] = std::cos(angle);
        about[next][last] = std::sin(angle);
        about[last][next] = -std::sin(angle);
        local = local * about;
      }
      local[3] = glm::dvec4(place, 1);
      globals.push_back(joint.parent < 0 ? local : globals[static_cast<std::size_t>(joint.parent)] * local);
      places.emplace_back(globals.back()[3]);
    }
  }
  return places;
}

double ReadingsApart(const std::string& text) {
  const auto one = PlacesIn(text, Positions::kReplaceOffset), other = PlacesIn(text, Positions::kAreAddedToOffset);
  double worst = one.size() == other.size() && !one.empty() ? 0 : 1e9;
  for (std::size_t i = 0; i < one.size() && worst < 1e9; ++i) worst = std::max(worst, glm::distance(one[i], other[i]));
  return worst;
}

TEST(BvhReadings, AgreeOnWhateverIsWritten) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Clip clip = testing::RandomClip(seed, {.roots = 1 + static_cast<int>(seed % 2),
                                                 .rest_rotations = true,
                                                 .moving_offsets = seed % 3 != 0,
                                                 .scales = seed % 4 == 3});
    EXPECT_EQ(ReadingsApart(WriteBvh(clip)), 0) << seed;
  }
  ASSERT_OK(boxing, LoadBuiltinMove("boxing"));
  EXPECT_EQ(ReadingsApart(WriteBvh(RigClip(boxing->motion, StandingPose(), "boxing"))), 0);
}

TEST(BvhReadings, AreThatOfOurReader) {
  const std::string text = WriteBvh(testing::RandomClip(4, {.moving_offsets = true}));
  ASSERT_OK(again, ReadBvh(text, "again.bvh"));
  const auto places = PlacesIn(text, Positions::kAreAddedToOffset);
  ASSERT_EQ(places.size(), again->frames.size() * again->skeleton.joints.size());
  std::vector<GlobalTransform> globals;
  for (std::size_t f = 0; f < again->frames.size(); ++f) {
    ComputeGlobals(again->skeleton, again->frames[f], globals);
    for (std::size_t i = 0; i < globals.size(); ++i) {
      EXPECT_LT(glm::distance(places[f * globals.size() + i], globals[i].position), 1e-9);
    }
  }
}

TEST(BvhReadings, DifferWhereOffsetsStandBesidePositions) {
  std::string text = WriteBvh(testing::RandomClip(4, {.moving_offsets = true}));
  const std::string none = "OFFSET 0.000000 0.000000 0.000000";
  const std::size_t at = text.rfind(none);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, none.size(), "OFFSET 0.500000 0.000000 0.000000");
  EXPECT_NEAR(ReadingsApart(text), 0.5, 1e-9) << "the control";
}

}  // namespace
}  // namespace etude

#include "engine/teaching/equal_streams.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/teaching/arms.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// The motion of another file: turned about the vertical axis, moved, and rounded to a tenth of a millimetre.
SkeletonStream Exported(SkeletonStream stream) {
  const double c = std::cos(1.1), s = std::sin(1.1);
  for (SensedFrame& frame : stream.frames) {
    for (SensedJoint& joint : frame.joints) {
      const glm::dvec3 p = joint.position;
      joint.position = 1e-4 * glm::round(1e4 * glm::dvec3(c * p.x + s * p.z + 2, p.y, c * p.z - s * p.x + 3));
    }
  }
  return stream;
}

NamedStream Take(const std::string& file, const SkeletonStream& stream, const std::string& person = "") {
  return {.name = file.substr(0, file.find('.')), .source = file, .person = person, .stream = stream};
}

class EqualStreams : public ::testing::Test {
 protected:
  /// Leaves out the copies. Returns the message about each copy, or the error.
  std::string LeaveOut() {
    const auto copies = LeaveOutCopies(streams_, parts_);
    if (!copies) return "refused: " + ToString(copies.error());
    std::string all;
    for (const Error& copy : *copies) all += ToString(copy) + "\n";
    return all;
  }

  const SkeletonStream raise_ = testing::Raise(10, 100), lower_ = testing::Raise(100, 20);
  std::vector<NamedStream> streams_;
  std::vector<LabelledPart> parts_;
};

TEST_F(EqualStreams, OneMotionCountsOnce) {
  streams_ = {Take("a.csv", raise_), Take("b.csv", lower_), Take("a.trc", Exported(raise_)), Take("c.csv", lower_)};
  streams_[3].stream.frames[40].joints[3].position.y += 0.02;  // another motion, by one joint in one frame
  parts_ = WholeStreams(streams_);
  EXPECT_EQ(LeaveOut(), "a.trc: shows the same motion as a.csv\n");
  ASSERT_EQ(streams_.size(), 3u);
  ASSERT_EQ(parts_.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(parts_[i].stream, i);
    EXPECT_EQ(parts_[i].move, streams_[i].name);
  }
  EXPECT_EQ(LeaveOut(), "");
}

TEST_F(EqualStreams, TheRecordingWithLabelsRemains) {
  streams_ = {Take("a.csv", raise_), Take("b.csv", lower_), Take("copy.csv", raise_), Take("again.csv", raise_)};
  parts_ = {{.stream = 2, .move = "m", .fault = "", .person = "Ann", .begin = 5, .end = 50}};
  EXPECT_EQ(LeaveOut(), "a.csv: shows the same motion as copy.csv\nagain.csv: shows the same motion as copy.csv\n");
  ASSERT_EQ(streams_.size(), 2u);
  EXPECT_EQ(streams_[1].name, "copy");
  EXPECT_EQ(parts_.front().stream, 1u);
}

TEST_F(EqualStreams, TwoPeopleOrOtherPerformancesAreRefused) {
  streams_ = {Take("a.csv", raise_, "Ann"), Take("b.csv", raise_, "Bo")};
  EXPECT_EQ(LeaveOut(),
            "refused: b.csv: shows the same motion as a.csv, but names the person Bo instead of Ann; allowed: each "
            "motion once");
  streams_[1].person = "ann ";
  parts_ = {{.stream = 0, .move = "m", .fault = "", .person = "", .begin = 5, .end = 50},
            {.stream = 1, .move = "m", .fault = "half", .person = "", .begin = 5, .end = 50}};
  EXPECT_EQ(LeaveOut(),
            "refused: b.csv: shows the same motion as a.csv, but the labels (without labels, the files' names) state "
            "other performances; allowed: each motion once");
  parts_[1].fault = "";
  EXPECT_EQ(LeaveOut(), "b.csv: shows the same motion as a.csv\n");
}

TEST_F(EqualStreams, PerformancesThatTaughtTheMovesAreCounted) {
  streams_ = {Take("a.csv", raise_), Take("b.csv", Exported(lower_))};
  parts_ = {{.stream = 0, .move = "m", .fault = "", .person = "", .begin = 5, .end = 50},
            {.stream = 0, .move = "m", .fault = "", .person = "", .begin = 6, .end = 50},
            {.stream = 1, .move = "m", .fault = "half", .person = "", .begin = 5, .end = 60}};
  TaughtMove move{.name = "m"};
  EXPECT_EQ(CountTaught(streams_, parts_, {{move}}), 0u);
  move.examples = {PartOf(raise_, 5, 50)};
  EXPECT_EQ(CountTaught(streams_, parts_, {{move}}), 1u);
  move.counter_examples = {PartOf(lower_, 5, 60)};
  EXPECT_EQ(CountTaught(streams_, parts_, {{move}}), 2u);
}

}  // namespace
}  // namespace etude

#include "bench/tasks/detection/run.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

/// Returns an event from 0.5 s to 2 s. The window in which it is judged ends half a second later.
DetectionEvent AskedFor(const char* move, const char* danced) {
  DetectionEvent event{.move = move, .danced = danced, .start_s = 0.5};
  event.end_s = 2;
  event.performed = {15, 60};
  event.window = {15, 75};
  return event;
}

/// Returns a body that holds its right arm down for a second, up for a second, and down again; the sensor is perfect.
DetectionWorld ArmRaised() {
  DetectionWorld world;
  world.stream.frames.resize(90);
  for (std::size_t t = 0; t < 90; ++t) {
    SensedFrame& frame = world.stream.frames[t];
    frame.body_seen = true;
    for (SensedJoint& joint : frame.joints) joint.state = TrackingState::kTracked;
    frame[Role::kLeftShoulder].position = {0.2, 1.4, 0};
    frame[Role::kRightShoulder].position = {-0.2, 1.4, 0};
    frame[Role::kLeftHip].position = {0.1, 0.9, 0};
    frame[Role::kRightHip].position = {-0.1, 0.9, 0};
    const bool raised = t >= 30 && t < 60;
    frame[Role::kRightElbow].position = {-0.2, raised ? 1.7 : 1.1, 0};
  }
  world.motion.poses.resize(90);
  return world;
}

TEST(JudgeSession, CountsAnAlarmOnlyWhereTheMoveWasNeitherAskedForNorDanced) {
  Repertoire repertoire;
  repertoire.taught = {{.name = "clap", .poses = {{{{Feature::kRH, 90, 20}}}}, .span_s = 2},
                       {.name = "raise", .poses = {{{{Feature::kRH, 180, 20}}}}, .span_s = 2}};
  const auto alarms = [&](const std::vector<DetectionEvent>& events) {
    DetectionWorld world = ArmRaised();
    world.events = events;
    const DetectionMethod method;
    const auto recogniser = *MakeRecogniser(method.recogniser, repertoire.taught);
    return JudgeSession(world, SeeSession(world, method), repertoire, *recogniser, method.Decision()).alarms.size();
  };
  EXPECT_EQ(alarms({}), 1u);
  EXPECT_EQ(alarms({AskedFor("raise", "raise")}), 0u);
  EXPECT_EQ(alarms({AskedFor("raise", "")}), 0u);
  EXPECT_EQ(alarms({AskedFor("clap", "raise")}), 0u);
  EXPECT_EQ(alarms({AskedFor("clap", "clap")}), 1u);
}

}  // namespace
}  // namespace etude

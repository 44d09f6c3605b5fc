#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "io/streams/load.h"
#include "sim/performer/session.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {

/// Recordings of different people by a Kinect, one per person, with labels of their performances.
struct Recorded {
  std::vector<NamedStream> streams;
  std::vector<LabelledPart> parts;
};

inline Recorded Record(int people, const std::vector<std::string>& names, int events) {
  std::vector<Move> moves;
  for (const std::string& name : names) moves.push_back(*LoadBuiltinMove(name));
  Recorded recorded;
  for (int i = 0; i < people; ++i) {
    const WorldKey key{.suite_seed = 5, .scenario = "left-out", .trial = i};
    RandomStream plan_dice(key, "session-plan"), dance_dice(key, "session-dance");
    const Person person = DrawPerson(key, People::kAdult);
    const SessionOptions options{.people = People::kAdult, .events = events, .fault_share = 0};
    const Performance session = Perform(dance_dice, moves, person, PlanSession(plan_dice, moves, person, options));
    const SkeletonSensorOptions errors = SensorV2();
    NamedStream& stream = recorded.streams.emplace_back();
    stream.name = "person-" + std::to_string(i);
    stream.stream = SenseSkeleton(session.motion, SkeletonSensorAt(SensorPlacement{}, errors.view), {}, errors, key);
    for (const SessionEvent& event : session.events) {
      LabelledPart& part = recorded.parts.emplace_back();
      part.stream = static_cast<std::size_t>(i);
      part.move = event.move;
      part.person = stream.name;
      part.begin = static_cast<int>(event.start_s * 30);
      part.end = std::min(static_cast<int>(event.end_s * 30), static_cast<int>(stream.stream.frames.size()));
    }
  }
  return recorded;
}

}  // namespace etude

#pragma once

#include <etude/coaching.h>
#include <etude/motion.h>
#include <etude/recognition.h>

#include <cstdint>
#include <string>
#include <vector>

/// Worlds whose truth is known, for programs that use libetude's types. No part of libetude: the Python module has it.
namespace etude::sim {

/// A skeleton sensor that looks at a performer from the front: the performer is at the origin and faces +Z.
struct SensorOptions {
  /// "v1" (Kinect v1, published ranges), "v2" (Kinect v2, fitted to a recording with an optical twin), or the text of a
  /// sensor file (docs/sensor.md).
  std::string sensor = "v2";
  double strength = 1;  ///< a factor on all errors, 0 to 10; 0: hidden joints are inferred correctly, all else true
  double distance_m = 2.75;  ///< on the floor, 0.4 to 20
  double turn_rad = 0;       ///< the performer is seen turned by so much
  double height_m = 1;       ///< above the floor, 0 to 10; it looks at the performer a metre above the floor
  std::uint64_t seed = 1;    ///< of the dice: the same seed errs the same
};

/// Returns what such a sensor would report of a motion, frame by frame, in the world. Throws engine::BadInput for
/// options out of range and a motion that is not finite.
std::vector<engine::SensedPose> Sense(const engine::Motion& motion, const SensorOptions& options = {});

/// Returns the names of the songs that come with Etude.
std::vector<std::string> SongNames();

/// A dance that comes with Etude, and its moves as they look when they are right.
struct BuiltinDance {
  engine::Dance dance;
  std::vector<engine::TaughtMove> moves;
};
/// Throws engine::BadInput for a song that there is not.
BuiltinDance DanceOfSong(const std::string& song);

}  // namespace etude::sim

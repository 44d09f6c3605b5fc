#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "sim/choreography/move_curves.h"

namespace etude {

/// A pose for which a recogniser searches. The pose is reached when all of its angles are within their tolerances at
/// the same time.
struct KeyPose {
  struct Target {
    std::string feature;  ///< one of paper A's ten features: "RH", "LHE", … (engine/fuzzy)
    double degrees;       ///< Posture has its own scale: standing = 80
    double tolerance_deg;
  };
  double beat = 0;  ///< time of the pose, in beats from the move's first beat
  std::vector<Target> targets;
};

/// A built-in move, authored as key poses in scenarios/choreography/moves/*.yaml, or an act of the coach (acts/*.yaml).
struct Move {
  std::string name;  ///< the move's name: "clap"
  double tempo_bpm = 120;
  double slowest_bpm = 120;  ///< range of song tempos that suit the move (`tempo_range_bpm`); default: the move's tempo
  double fastest_bpm = 120;
  double beats = 8;   ///< length of one performance
  bool loops = true;  ///< true if the last frame leads back to the first, as in all moves and in acts that can repeat
  std::vector<KeyPose> key_poses;
  std::vector<PoseKey> poses;  ///< as authored, including a mirrored half; empty in a slow demonstration
  MoveCurves curves;           ///< the same performance as curves of controls, over `beats` beats
  BodyMotion motion;           ///< one performance at `tempo_bpm`, 30 Hz, performed by the canonical body
};

/// Returns the names of all built-in moves (choreography/moves), sorted.
std::vector<std::string> BuiltinMoveNames();
/// Returns the names of the coach's acts (choreography/acts), sorted.
std::vector<std::string> BuiltinActNames();
/// Loads the built-in move or act with this name, or a move's slow demonstration, such as "slow_clap"
/// (slow_demonstration.h). The error for an unknown name lists the known names.
Result<Move> LoadBuiltinMove(const std::string& name);
/// Loads the move or act with this name without its `motion`, which is the slowest part to compute. Names of slow
/// demonstrations are not allowed.
Result<Move> LoadBuiltinCurves(const std::string& name);
/// Returns the move at another tempo. The poses stay at the same beats. Flights keep their duration in seconds, because
/// gravity determines it. Fails at `place` if a flight no longer fits between the beats. `move` must have poses.
Result<Move> AtTempo(const Move& move, double tempo_bpm, const Place& place);
/// Returns the move at another tempo without its `motion`.
Result<Move> CurvesAtTempo(const Move& move, double tempo_bpm, const Place& place);
/// Samples one performance at 30 Hz, as in `Move::motion`.
BodyMotion MotionOf(const Move& move);
/// Reads one move or act from the text of a choreography file.
Result<Move> ParseMove(std::string_view yaml, const std::string& file);

}  // namespace etude

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "sim/choreography/move_curves.h"

namespace etude {

/// A target that a recogniser looks for: the move is right when these angles are reached together.
struct KeyPose {
  struct Target {
    std::string feature;  ///< one of paper A's ten features: "RH", "LHE", … (engine/fuzzy)
    double degrees;       ///< for Posture: its scale, standing = 80
    double tolerance_deg;
  };
  double beat = 0;  ///< when it is reached, counted from the move's first beat
  std::vector<Target> targets;
};

/// A built-in move, authored as key poses in scenarios/choreography/moves/*.yaml, or an act of the coach (acts/*.yaml).
struct Move {
  std::string name;  ///< "clap"
  double tempo_bpm = 120;
  double slowest_bpm = 120;  ///< `tempo_range_bpm`: the songs that the move suits; its own tempo alone unless given
  double fastest_bpm = 120;
  double beats = 8;   ///< length of one performance
  bool loops = true;  ///< the end joins the start: true of every move, and of acts that can go on for ever
  std::vector<KeyPose> key_poses;
  std::vector<PoseKey> poses;  ///< as authored, a mirrored half included; empty of a slow demonstration
  MoveCurves curves;           ///< the same performance before joints were made of it, over `beats` beats
  BodyMotion motion;           ///< one performance at `tempo_bpm`, 30 Hz, performed by the canonical body
};

/// Returns the names of all built-in moves (choreography/moves), sorted.
std::vector<std::string> BuiltinMoveNames();
/// Returns the names of the coach's acts (choreography/acts), sorted.
std::vector<std::string> BuiltinActNames();
/// Loads the built-in move or act of that name, or a move's slow demonstration, "slow_clap" (slow_demonstration.h); the
/// error lists the known ones.
Result<Move> LoadBuiltinMove(const std::string& name);
/// Loads the move or act of that name without its `motion`, which takes longer to make than all else. Knows no slow
/// demonstrations.
Result<Move> LoadBuiltinCurves(const std::string& name);
/// Returns the move at another tempo: the beats are the same, while flights take as long as gravity has them. Fails at
/// `place` when they do not fit into the beats any more. `move` has poses.
Result<Move> AtTempo(const Move& move, double tempo_bpm, const Place& place);
/// Returns the move at another tempo without its `motion`.
Result<Move> CurvesAtTempo(const Move& move, double tempo_bpm, const Place& place);
/// Samples one performance at 30 Hz: the value of `Move::motion`.
BodyMotion MotionOf(const Move& move);
/// Reads one move or act from the text of a choreography file.
Result<Move> ParseMove(std::string_view yaml, const std::string& file);

}  // namespace etude

#pragma once

#include <vector>

#include "bench/tasks/evaluation/run.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// Returns foot contacts in the form of RawMotion::contacts, found by height and speed (Etude's own rule). A joint (an
/// ankle below 12 cm, toes below 5 cm) is in contact while its speed along the floor, measured over 0.13 s, is below
/// 0.2 m/s. A motion that lacks one of the four joints has no contacts.
std::vector<bool> ContactsByMotion(const RawMotion& motion);

/// Returns `given`. Values that it lacks are computed from the truth's own motion: the beats (MotionBeats), and the
/// mean and standard deviation (at least 1 cm) of each judged joint's coordinates.
EvaluationSideData SideDataOf(const MatchedMotions& matched, EvaluationSideData given);

/// Hides `percent` per cent of all positions of the answer (joints × frames): those that are farthest from the truth.
/// Both motions must have the same joints and frames.
void HideWorst(RawMotion& answer, const RawMotion& truth, double percent);

}  // namespace etude

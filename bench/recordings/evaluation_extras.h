#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// The extras of task `evaluation`, whose recordings have no tracks of the twenty joints: both motions on the joints
/// judged, at the truth's rate.
///
/// As JSON (the content of `Recording::extras_json`):
///
///     {"rate_hz": 30, "joints": [names], "parents": [indices; −1: none],
///      "truth": [[x, y, z of each joint; null where it is not seen], …], "answer": the same}
struct EvaluationExtras {
  RawMotion truth, answer;  ///< of the same joints, and as long
};

std::string WriteEvaluationExtras(const EvaluationExtras& extras);
/// Reads what WriteEvaluationExtras writes. Fails, naming what is wrong, if `json` is anything else.
Result<EvaluationExtras> ReadEvaluationExtras(std::string_view json);

}  // namespace etude

#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// The extras of task `evaluation`: the truth and the answer with the judged joints only, at the truth's rate.
/// Recordings of this task have no tracks of the twenty joints.
///
/// As JSON (the content of `Recording::extras_json`):
///
///     {"rate_hz": 30, "joints": [names], "parents": [indices; −1: none],
///      "truth": [[x, y, z of each joint; null where it is not seen], …], "answer": the same}
struct EvaluationExtras {
  RawMotion truth, answer;  ///< both have the same joints and number of frames
};

std::string WriteEvaluationExtras(const EvaluationExtras& extras);
/// Reads the text that WriteEvaluationExtras returns. For any other text, fails and names what is wrong.
Result<EvaluationExtras> ReadEvaluationExtras(std::string_view json);

}  // namespace etude

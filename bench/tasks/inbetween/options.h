#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/keys/field_table.h"
#include "engine/transitions/fillers/filler.h"

namespace etude {

/// A condition of task inbetween. The defaults are LAFAN1's protocol.
struct InbetweenOptions {
  std::vector<std::string> truth;     ///< files whose windows are judged
  std::vector<std::string> training;  ///< files that give statistics, offsets and nearest-gap's library
  std::string people;                 ///< a pattern for names; "" = each file counts for itself
  int window = 65, offset = 40;       ///< frames of a window, and from one window's first to the next one's
  int training_window = 50, training_offset = 20;
  int past = 10;
  int gap = 30;
  int future = 10;                ///< behind the gap in the window; they fix no window, and one of them is given
  int given = 1;                  ///< of the future frames
  std::optional<double> rate_hz;  ///< to which motions are sampled; nothing: each file's own
  glm::dvec3 facing{0, 1, 0};     ///< the root's axis that is turned to X in the last past frame
  bool own_offsets = false;       ///< false: the first training file's
};

const FieldTable<InbetweenOptions>& InbetweenConditionFields();

struct InbetweenMethod {
  std::string name;
  const Filler* filler = nullptr;  ///< one of TaskFillers
  std::vector<double> settings;
};

/// Returns all fillers, and `hidden`, which has no function: the truth itself.
const std::vector<Filler>& TaskFillers();
const FieldTable<InbetweenMethod>& InbetweenMethodFields();

}  // namespace etude

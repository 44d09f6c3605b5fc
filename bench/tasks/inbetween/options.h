#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/keys/field_table.h"
#include "engine/transitions/fillers/filler.h"

namespace etude {

/// A condition of task inbetween. The defaults are those of LAFAN1's protocol.
struct InbetweenOptions {
  std::vector<std::string> truth;     ///< files whose windows are judged
  std::vector<std::string> training;  ///< files for the deviations of L2P, the offsets, and the library of fillers
  std::string people;                 ///< pattern for the person in a file's name, e.g. *_{person}; "" = each file is a
                                      ///< unit
  int window = 65, offset = 40;       ///< length of a window, and distance of successive windows, frames
  int training_window = 50, training_offset = 20;
  int past = 10;                  ///< number of frames before the gap; methods receive all of them
  int gap = 30;                   ///< number of hidden frames
  int future = 10;                ///< number of frames that a window must have after the gap
  int given = 1;                  ///< number of frames after the gap that methods receive
  std::optional<double> rate_hz;  ///< rate to which motions are sampled; nullopt = each file's own
  glm::dvec3 facing{0, 1, 0};     ///< the root's axis that points along X in the last frame before the gap
  /// True: a window has the bone offsets of its own file; false: the bone offsets of the first training file.
  bool own_offsets = false;
};

const FieldTable<InbetweenOptions>& InbetweenConditionFields();

struct InbetweenMethod {
  std::string name;
  const Filler* filler = nullptr;  ///< the method that fills gaps; null: the truth itself (`oracle: [frames]`)
  std::vector<double> settings;
  bool knows_frames = false;
};

const FieldTable<InbetweenMethod>& InbetweenMethodFields();

}  // namespace etude

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/recordings/blind_files.h"
#include "engine/base/result.h"
#include "io/drawing/film.h"

namespace etude {

/// A page on which people compare transitions without knowing the methods, and a key that names the method of each
/// side.
struct BlindTrial {
  std::string page_html;
  BlindKey key;
};

struct BlindOptions {
  std::vector<std::string> methods;  ///< at least two; each world shows one pair of them; all pairs are used in turn
  int pairs = 40;                    ///< maximum number of filmed pairs; fewer if the run recorded fewer worlds
  std::uint64_t seed = 1;            ///< seed of the random order of the worlds, and of the methods' sides
  FilmWatch watch = {};
};

/// Makes the page from a run's recorded transitions. One film shows the two methods of a pair side by side, aligned at
/// the request. A side is empty while its motion is not recorded. The page needs no other file, and neither its text
/// nor its films name a method, a metric or the seed. Returns nullopt if `watch` stopped the filming. Fails if no
/// recorded world shows two of the methods, or if films cannot be encoded.
Result<std::optional<BlindTrial>> MakeBlindTrial(const RunData& run, const BlindOptions& options);

}  // namespace etude

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

/// A page on which people compare transitions without knowing the methods, and the key that says which is which.
struct BlindTrial {
  std::string page_html;
  BlindKey key;
};

struct BlindOptions {
  std::vector<std::string> methods;  ///< at least two; each world shows two of them, every two in turn
  int pairs = 40;                    ///< maximum; fewer if the run recorded fewer worlds
  std::uint64_t seed = 1;            ///< of the dice that draw worlds, order and sides
  FilmWatch watch = {};
};

/// Makes the page from a run's recorded transitions. Both films of a pair are one film, aligned at the request, so that
/// they play together; a side is empty while its motion is not recorded. The page needs no other file, and neither its
/// text nor its films name a method, a metric or the seed. Returns nullopt if `watch` stopped it. Fails if no recorded
/// world shows two of the methods, or if films cannot be encoded.
Result<std::optional<BlindTrial>> MakeBlindTrial(const RunData& run, const BlindOptions& options);

}  // namespace etude

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The key of a page on which people compare films without knowing the methods. It says which side shows which method,
/// and is kept apart from the page.
struct BlindKey {
  /// The values of one metric in the two cells of a pair. Metrics without a direction are left out.
  struct Metric {
    std::string id;
    bool higher_is_better = false;
    std::optional<double> left, right;
  };
  struct Pair {
    std::string scenario, world;  ///< the scenario's name and, for example, "trial 3"
    std::string left, right;      ///< the methods shown on the left and on the right
    std::vector<Metric> metrics;
  };

  std::string page;  ///< digest of the page's content; every file of answers repeats it
  std::string seed;  ///< seed of the random order of worlds and sides
  int worlds = 0;    ///< number of worlds from which the pairs were drawn
  int left_out = 0;  ///< number of worlds in which a method made no transition that a film can show
  std::vector<Pair> pairs;
};

/// The answers of one person, as the page saves them.
struct BlindAnswers {
  std::string page, rater;
  std::vector<std::string> preferred;  ///< the answer for each pair: "left", "right", "same", or "" = no answer
};

std::string WriteBlindKey(const BlindKey& key);

/// The keys and the answers that were read from several files.
struct BlindFiles {
  std::vector<BlindKey> keys;
  std::vector<BlindAnswers> answers;
};

/// Reads a key or answers into `files`. Fails, naming `file` and the position in it, if the text is neither a key nor
/// answers, or is damaged. Fails also if the same key, or answers of the same rater to the same page, were read before.
Result<void> AddBlindFile(const std::string& text, const std::string& file, BlindFiles& files);

/// Fails if there are no answers, if the key of an answered page is missing, or if a person did not give one answer for
/// each pair.
Result<void> CheckBlindFiles(const BlindFiles& files);

}  // namespace etude

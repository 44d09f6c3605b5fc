#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The key of a page of film pairs that people judge without knowing the methods: which method each film shows. It is
/// kept apart from the page.
struct BlindKey {
  /// One metric of the two cells of a pair; only metrics with a better direction.
  struct Metric {
    std::string id;
    bool higher_is_better = false;
    std::optional<double> left, right;
  };
  struct Pair {
    std::string scenario, world;  ///< "trial 3"
    std::string left, right;      ///< methods
    std::vector<Metric> metrics;
  };

  std::string page;  ///< digest of the page's content, which every file of answers repeats
  std::string seed;  ///< of the dice that drew worlds, order and sides
  int worlds = 0;    ///< worlds from which the pairs were drawn
  int left_out = 0;  ///< recorded worlds in which a method made no transition that can be shown
  std::vector<Pair> pairs;
};

/// The answers of one person, as the page saves them.
struct BlindAnswers {
  std::string page, rater;
  std::vector<std::string> preferred;  ///< by pair: "left", "right", "same", or "" without an answer
};

std::string WriteBlindKey(const BlindKey& key);

/// The keys and the answers in several files.
struct BlindFiles {
  std::vector<BlindKey> keys;
  std::vector<BlindAnswers> answers;
};

/// Reads a key or answers into `files`. Fails, naming `file` and the position in it, if the text is neither or is
/// damaged, and if the same key, or answers of the same rater to the same page, were read before.
Result<void> AddBlindFile(const std::string& text, const std::string& file, BlindFiles& files);

/// Fails if there are no answers, if the key of an answered page is missing, or if a person did not give one answer for
/// each pair.
Result<void> CheckBlindFiles(const BlindFiles& files);

}  // namespace etude

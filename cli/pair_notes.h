#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/base/result.h"

namespace etude {

/// Notes by their kind (KindOfReason).
class NoteKinds {
 public:
  /// Adds the note "`head`: `reason`". Notes of two methods never have the same kind.
  void Add(const std::string& method, const std::string& head, const std::string& reason);
  /// Returns the first note of each kind as "METHOD, PAIR: reason", with the number of the others.
  std::vector<std::string> Lines() const;

 private:
  std::vector<std::pair<std::string, std::size_t>> kinds_;
  std::map<std::string, std::size_t> places_;  ///< the index in `kinds_` of each kind
};

/// The doubts about judged files, each once: "METHOD, CLIP: the answer: DOUBT", or "CLIP: the truth: DOUBT".
class DoubtList {
 public:
  void Add(const Row& row);
  const std::vector<std::string>& lines() const { return lines_; }
  /// Returns the first doubt of each kind.
  std::vector<std::string> Kinds() const { return kinds_.Lines(); }
  /// Prints the doubts on stderr: the first of each kind, at most twenty kinds.
  void Tell() const;

 private:
  std::vector<std::string> lines_;
  std::set<std::string> known_;
  NoteKinds kinds_;
};

/// Collects the doubts of all rows of a run whose tasks judge files.
DoubtList DoubtsOf(const RunData& run);

/// The notes about pairs of files, from the rows of a run.
struct PairNotes {
  NoteKinds judged;                           ///< what was judged, and how answers were changed
  NoteKinds not_judged;                       ///< why pairs could not be judged
  std::vector<std::string> every_not_judged;  ///< one line "METHOD, PAIR: reason" for each such pair
  DoubtList doubts;                           ///< what looks wrong in the files
};

/// Collects the notes of a run, row by row.
Result<PairNotes> ReadPairNotes(const std::filesystem::path& folder);
/// Prints the notes on judged pairs, then the notes on pairs that were not judged: at most ten kinds of each.
void PrintPairNotes(const PairNotes& notes);

}  // namespace etude

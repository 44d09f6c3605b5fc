#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/model/row.h"

namespace etude {

/// The beginning of a cell's reason if its program answered `no_answer`; such a cell has the status unsolved.
inline constexpr std::string_view kGaveNoAnswer = "gave no answer: ";

/// The beginning of a doubt about the truth. All methods of a world share such a doubt.
inline constexpr std::string_view kDoubtedTruth = "the truth: ";

/// Returns the notes on a file that are not doubts.
std::vector<std::string> NotesWithoutDoubts(const std::vector<std::string>& notes,
                                            const std::vector<std::string>& doubts);
/// Returns the end of a reason that states doubts about a file: " · doubtful: WHO DOUBT" for each; "" without doubts.
std::string DoubtfulPart(std::string_view who, const std::vector<std::string>& doubts);
/// Returns a reason without its DoubtfulParts.
std::string_view WithoutDoubts(std::string_view reason);
/// Returns the doubts in a reason, each with the file that it is about: "the answer: …".
std::vector<std::string> DoubtsIn(std::string_view reason);

/// Returns true if the cell's method gave an answer: its status is ok, or it is unsolved because the answer missed the
/// goal.
bool HasAnswer(const CellResult& result);

/// A kind of reason for the status of cells, and the number of cells with such a reason.
struct CountedReason {
  std::string reason = {};  ///< the reason of the first cell that was counted
  int cells = 0;
  /// True: all cells have exactly this reason; false: some reasons have other numbers or file names.
  bool is_one = true;

  /// Returns the reason, e.g. "solve failed". If the counted cells' reasons differ, returns the first one as an
  /// example: "for example: 3 of 20 effectors missed".
  std::string Words() const { return is_one ? reason : "for example: " + reason; }
};

/// Returns a reason without numbers and without the place at its beginning, so that reasons of one kind become equal. A
/// reason with a place is for instance "t/walk.bvh:3:1: found 'x'".
std::string KindOfReason(std::string_view reason);

/// Counts reasons by kind. Reasons are of one kind if they differ only in their numbers, or in the file name at their
/// beginning.
class ReasonCounts {
 public:
  /// Counts a reason. `label` is put before the reason; reasons with different labels are never of one kind.
  void Add(std::string_view reason, std::string_view label = "");
  std::size_t size() const { return counts_.size(); }
  std::vector<CountedReason> MostFrequentFirst() const;

 private:
  std::map<std::string, CountedReason> counts_;
};

}  // namespace etude

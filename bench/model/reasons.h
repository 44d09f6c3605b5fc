#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// One kind of reason why cells ended as they did, and the number of these cells.
struct CountedReason {
  std::string reason = {};  ///< the reason of the first cell
  int cells = 0;
  bool is_one = true;  ///< false: the reasons of other cells have other numbers, or name other files

  /// Returns the reason, e.g. "solve failed". If the cells' reasons differ, returns one of them as an example: "for
  /// example: 3 of 20 effectors missed".
  std::string Words() const { return is_one ? reason : "for example: " + reason; }
};

/// Counts reasons by kind. Reasons are of one kind if they differ only in their numbers, or in the file name at their
/// beginning.
class ReasonCounts {
 public:
  /// `label` is put before the reason. Reasons with different labels are never of one kind.
  void Add(std::string_view reason, std::string_view label = "");
  std::size_t size() const { return counts_.size(); }
  std::vector<CountedReason> MostFrequentFirst() const;

 private:
  std::map<std::string, CountedReason> counts_;
};

}  // namespace etude

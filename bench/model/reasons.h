#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// Why cells ended as they did, and how many of them.
struct CountedReason {
  std::string reason = {};  ///< of the first cell
  int cells = 0;
  bool is_one = true;  ///< false: the reasons of other cells have other numbers, or name other files

  /// Returns "solve failed", or, if the reasons differ, "for example: 3 of 20 effectors missed".
  std::string Words() const { return is_one ? reason : "for example: " + reason; }
};

/// Counts reasons. Those that differ only in their numbers, or in the file that they begin with, count as one.
class ReasonCounts {
 public:
  /// `label` stands before the reason; reasons of different labels are never one.
  void Add(std::string_view reason, std::string_view label = "");
  std::size_t size() const { return counts_.size(); }
  std::vector<CountedReason> MostFrequentFirst() const;

 private:
  std::map<std::string, CountedReason> counts_;
};

}  // namespace etude

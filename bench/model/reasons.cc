#include "bench/model/reasons.h"

#include <algorithm>
#include <functional>

namespace etude {

bool HasAnswer(const CellResult& result) {
  if (result.status == Status::kUnsolved) return !result.reason.starts_with(kGaveNoAnswer);
  return result.status == Status::kOk;
}

std::string KindOfReason(std::string_view reason) {
  const std::size_t colon = reason.find(": ");
  if (colon != std::string_view::npos && reason.substr(0, colon).find(' ') == std::string_view::npos) {
    reason.remove_prefix(colon);
  }
  std::string kind(reason);
  std::erase_if(kind, [](char c) { return ('0' <= c && c <= '9') || c == '.' || c == '-'; });
  return kind;
}

void ReasonCounts::Add(std::string_view reason, std::string_view label) {
  CountedReason& count = counts_[std::string(label) + KindOfReason(reason)];
  std::string whole = std::string(label) + std::string(reason);
  if (count.cells++ == 0) {
    count.reason = std::move(whole);
  } else {
    count.is_one &= count.reason == whole;
  }
}

std::vector<CountedReason> ReasonCounts::MostFrequentFirst() const {
  std::vector<CountedReason> all;
  for (const auto& [kind, count] : counts_) all.push_back(count);
  std::ranges::stable_sort(all, std::greater(), &CountedReason::cells);
  return all;
}

}  // namespace etude

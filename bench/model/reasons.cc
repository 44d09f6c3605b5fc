#include "bench/model/reasons.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace etude {
namespace {

constexpr std::string_view kDoubtful = " · doubtful: ";

}  // namespace

std::vector<std::string> NotesWithoutDoubts(const std::vector<std::string>& notes,
                                            const std::vector<std::string>& doubts) {
  std::vector<std::string> others;
  std::ranges::copy_if(notes, std::back_inserter(others),
                       [&](const std::string& note) { return std::ranges::find(doubts, note) == doubts.end(); });
  return others;
}

std::string DoubtfulPart(std::string_view who, const std::vector<std::string>& doubts) {
  std::string part;
  for (const std::string& doubt : doubts) part.append(kDoubtful).append(who).append(doubt);
  return part;
}

std::string_view WithoutDoubts(std::string_view reason) { return reason.substr(0, reason.find(kDoubtful)); }

std::vector<std::string> DoubtsIn(std::string_view reason) {
  std::vector<std::string> doubts;
  for (std::size_t at = reason.find(kDoubtful); at != std::string_view::npos;) {
    const std::size_t begin = at + kDoubtful.size();
    at = reason.find(kDoubtful, begin);
    doubts.emplace_back(reason.substr(begin, at == std::string_view::npos ? at : at - begin));
  }
  return doubts;
}

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

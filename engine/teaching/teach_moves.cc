#include "engine/teaching/teach_moves.h"

#include <algorithm>
#include <map>

#include "engine/teaching/teach_move.h"

namespace etude {
namespace {

constexpr double kBefore = 2, kAfter = 1;

struct Performances {
  std::vector<SkeletonStream> right, wrong;
};

bool CanBeLearntFrom(const SkeletonStream& stream) { return TeachMove("a", {stream}).has_value(); }

}  // namespace

std::vector<LabelledPart> PerformancesOf(const std::vector<LabelledPart>& parts,
                                         const std::vector<NamedStream>& streams) {
  std::vector<LabelledPart> performances = parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].is_action_point) continue;
    const SkeletonStream& stream = streams[parts[i].stream].stream;
    const auto count = static_cast<int>(stream.frames.size());
    const int point = parts[i].begin;
    int begin = std::max(0, point - static_cast<int>(kBefore * stream.rate_hz));
    int end = std::min(count, point + static_cast<int>(kAfter * stream.rate_hz) + 1);
    const bool has_before = i > 0 && parts[i - 1].stream == parts[i].stream;
    const bool has_after = i + 1 < parts.size() && parts[i + 1].stream == parts[i].stream;
    if (has_before) begin = std::max(begin, (parts[i - 1].begin + point) / 2);
    if (has_after) end = std::min(end, (point + parts[i + 1].begin) / 2 + 1);
    performances[i].begin = begin;
    performances[i].end = std::max(end, begin + 1);
    performances[i].is_action_point = false;
  }
  return performances;
}

std::vector<LabelledPart> PerformancesToLearn(const std::vector<NamedStream>& streams,
                                              const std::vector<LabelledPart>& parts,
                                              const std::function<bool(const LabelledPart&)>& takes, bool is_strict) {
  std::vector<LabelledPart> learnt;
  const std::vector<LabelledPart> performances = PerformancesOf(parts, streams);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const LabelledPart& part = performances[i];
    if (!takes(parts[i])) continue;
    if (!is_strict && !CanBeLearntFrom(PartOf(streams[part.stream].stream, part.begin, part.end))) continue;
    learnt.push_back(part);
  }
  return learnt;
}

Result<std::vector<TaughtMove>> TeachMoves(const std::vector<NamedStream>& streams,
                                           const std::vector<LabelledPart>& parts,
                                           const std::function<bool(const LabelledPart&)>& takes, bool is_strict) {
  std::map<std::string, Performances> by_move;
  for (const LabelledPart& part : PerformancesToLearn(streams, parts, takes, is_strict)) {
    Performances& move = by_move[part.move];
    (part.IsRight() ? move.right : move.wrong).push_back(PartOf(streams[part.stream].stream, part.begin, part.end));
  }
  std::vector<TaughtMove> taught;
  for (auto& [name, performance] : by_move) {
    if (performance.right.empty() && !is_strict) continue;
    ASSIGN_OR_RETURN(taught.emplace_back(),
                     TeachMove(name, std::move(performance.right), std::move(performance.wrong)));
  }
  if (taught.empty()) return Fail({}, "no recording shows a right performance, so Etude cannot learn any move");
  return taught;
}

}  // namespace etude

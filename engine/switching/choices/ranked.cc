#include "engine/switching/choices/ranked.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "engine/switching/choices/direct.h"
#include "engine/switching/choices/explain.h"
#include "engine/switching/choices/fuzzy_rows.h"
#include "engine/switching/choices/through_in_between.h"

namespace etude {
namespace {

bool IsBetter(const RankedPair& a, const RankedPair& b) {
  return std::tuple(!a.matches, a.rank) < std::tuple(!b.matches, b.rank);
}

/// Which pairs of a row may be switched at.
class Gate {
 public:
  Gate(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules, int columns)
      : playing_(library.tagged[request.from]),
        next_(library.tagged[request.to]),
        rules_(rules),
        rows_(std::span(next_.grades).first(columns), rules.weights),
        squares_(columns) {}

  void Open(int from) {
    from_ = from;
    rows_.Compute(playing_.grades[from], squares_);
  }
  bool Compares(int to) const { return !rules_.within_class || playing_.tags[from_] == next_.tags[to]; }
  bool LetsThrough(int to) const { return Compares(to) && squares_[to] < rules_.threshold * rules_.threshold; }
  double SquareOf(int to) const { return squares_[to]; }

 private:
  const TaggedClip &playing_, &next_;
  const SwitchRules& rules_;
  FuzzyRows rows_;
  std::vector<double> squares_;
  int from_ = 0;
};

/// The best pair of each row, and how many matched on the way.
struct Survey {
  std::vector<RankedPair> best;
  std::int64_t pairs = 0, matching = 0;
};

Survey SurveyUngated(const PairRange& range, PairRows& costs) {
  Survey survey;
  std::vector<double> row(range.enter_end);
  for (int from = range.leave.first; from <= range.leave.last; ++from) {
    costs.Compute(from, row);
    const auto best = std::min_element(row.begin(), row.end());
    survey.best.push_back({from, static_cast<int>(best - row.begin()), true, *best, *best});
    survey.pairs += range.enter_end;
  }
  survey.matching = survey.pairs;
  return survey;
}

Survey SurveyGated(const PairRange& range, Gate& gate, PairRows& costs) {
  Survey survey;
  std::vector<double> row(range.enter_end);
  std::vector<int> passing;
  for (int from = range.leave.first; from <= range.leave.last; ++from) {
    gate.Open(from);
    passing.clear();
    std::optional<RankedPair> best;
    for (int to = 0; to < range.enter_end; ++to) {
      const double square = gate.SquareOf(to);
      if (gate.LetsThrough(to)) {
        passing.push_back(to);
      } else if (gate.Compares(to) && (!best || square < best->rank)) {
        best = {from, to, false, square, std::nullopt};
      }
    }
    if (!passing.empty()) costs.Compute(from, row);
    for (int to : passing) {
      const RankedPair pair{from, to, true, row[to], row[to]};
      if (!best || IsBetter(pair, *best)) best = pair;
    }
    if (best) survey.best.push_back(*best);
    survey.pairs += range.enter_end;
    survey.matching += static_cast<std::int64_t>(passing.size());
  }
  return survey;
}

/// Why none was taken, `nearest` being the end of all when none could be compared.
std::string WhyNone(std::vector<RankedPair>::const_iterator nearest, const Survey& survey, const SwitchRules& rules) {
  if (nearest == survey.best.end()) return fmt::format("no two of {} pairs of frames have the same tags", survey.pairs);
  return fmt::format("no match among {} pairs of frames: the nearest has d = {:.2f}, not below {:g}", survey.pairs,
                     std::sqrt(nearest->rank), rules.threshold);
}

}  // namespace

SwitchRecord PlanRanked(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules,
                        const Ranking& ranking, PairRows& costs) {
  const PairRange range = AllowedPairs(library, request, rules);
  Survey survey;
  if (ranking.gated) {
    Gate gate(library, request, rules, range.enter_end);
    survey = SurveyGated(range, gate, costs);
  } else {
    survey = SurveyUngated(range, costs);
  }
  const auto best = std::min_element(survey.best.begin(), survey.best.end(), IsBetter);
  if (best == survey.best.end() || !best->matches) {
    return ThroughInBetween(library, request, rules, WhyNone(best, survey, rules), survey.pairs);
  }
  const RankedPair taken = *best;
  survey.best.erase(best);

  SwitchRecord record = DirectSwitch(library, request, taken.from, taken.to, rules);
  record.pairs_seen = survey.pairs;
  record.pairs_matched = survey.matching;
  record.cost_unit = ranking.unit;
  record.candidates = ListCandidates(library, request, rules, taken, std::move(survey.best), Fate::kWorse);
  const std::string among =
      ranking.gated ? fmt::format("{} pairs with d < {:g}, of {}", survey.matching, rules.threshold, survey.pairs)
                    : fmt::format("{} pairs", survey.pairs);
  record.why = fmt::format("smallest {} of {}: {}, {:.2f} {}, d = {:.2f}", ranking.name, among,
                           DescribePair(library, request, taken.from, taken.to), *taken.cost, ranking.unit,
                           record.meetings.front().value);
  return record;
}

}  // namespace etude

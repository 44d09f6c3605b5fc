#include "bench/metrics/coach.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/metrics/transition_smoothness.h"
#include "bench/statistics/curves/curves.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

using enum PerformanceTruth;

/// Returns the last performance whose window had closed when the correction was decided; null if no window had closed.
const CoachedPerformance* CauseOf(const GivenCorrection& correction, const CoachedSession& session) {
  const CoachedPerformance* cause = nullptr;
  for (const CoachedPerformance& performance : session.performances) {
    if (performance.end_frame <= correction.decided_frame) cause = &performance;
  }
  return cause;
}

/// Returns true if a correction was decided after the window of performance `i` ended and before the window of the next
/// performance ended. If there is no next performance, the limit is the end of the session.
bool IsAnswered(const CoachedSession& session, std::size_t i) {
  const bool is_last = i + 1 == session.performances.size();
  const int first = session.performances[i].end_frame;
  const int last = is_last ? session.frames : session.performances[i + 1].end_frame;
  return std::ranges::any_of(session.corrections, [&](const GivenCorrection& correction) {
    return correction.decided_frame >= first && correction.decided_frame <= last;
  });
}

/// Returns the time from each decision to correct until the correcting act begins. The time is censored if the session
/// ends first.
std::vector<Wait> FeedbackWaits(const CoachedSession& session) {
  std::vector<Wait> waits;
  for (const GivenCorrection& correction : session.corrections) {
    const int until = correction.act_frame.value_or(session.frames);
    waits.push_back({(until - correction.decided_frame) / session.rate_hz, correction.act_frame.has_value()});
  }
  return waits;
}

}  // namespace

CorrectionTally TallyCorrections(const CoachedSession& session) {
  CorrectionTally tally{.given = static_cast<int>(session.corrections.size())};
  for (std::size_t i = 0; i < session.performances.size(); ++i) {
    const CoachedPerformance& performance = session.performances[i];
    if (performance.truth != kWrong) continue;
    ++tally.due;
    tally.missed += !IsAnswered(session, i);
    tally.wrong_praise += performance.called_right;
  }
  for (const GivenCorrection& correction : session.corrections) {
    const CoachedPerformance* cause = CauseOf(correction, session);
    tally.unneeded += cause == nullptr || cause->truth == kRight;
  }
  return tally;
}

std::optional<double> AnsweredShare(const CorrectionTally& tally) { return Share(tally.due - tally.missed, tally.due); }

std::optional<double> DecisionDelaySeconds(const CoachedSession& session) {
  std::vector<Wait> waits;
  for (const CoachedPerformance& performance : session.performances) {
    if (performance.truth != kWrong) continue;
    const int until = performance.called_wrong.value_or(performance.end_frame);
    waits.push_back({(until - performance.begin_frame) / session.rate_hz, performance.called_wrong.has_value()});
  }
  return KaplanMeierMedian(waits);
}

std::optional<double> FeedbackDelaySeconds(const CoachedSession& session) {
  return KaplanMeierMedian(FeedbackWaits(session));
}

std::optional<double> MaxFeedbackDelaySeconds(const CoachedSession& session) {
  std::optional<double> longest;
  for (const Wait& wait : FeedbackWaits(session)) {
    if (wait.happened) longest = std::max(longest.value_or(0), wait.seconds);
  }
  return longest;
}

std::optional<double> RepetitionsUntilRight(std::span<const std::vector<PerformanceTruth>> moves) {
  std::vector<Wait> waits;
  for (const std::vector<PerformanceTruth>& performances : moves) {
    if (performances.empty() || performances.front() != kWrong) continue;
    const auto right = std::ranges::find(performances, kRight);
    const bool happened = right != performances.end();
    const auto repetitions = static_cast<double>(right - performances.begin()) + (happened ? 1 : 0);
    waits.push_back({repetitions, happened});
  }
  return KaplanMeierMedian(waits);
}

std::optional<double> Retention(std::span<const double> chances) {
  if (chances.empty()) return std::nullopt;
  return std::accumulate(chances.begin(), chances.end(), 0.0) / static_cast<double>(chances.size());
}

std::optional<double> BeatErrorMs(std::span<const double> errors_s) {
  if (errors_s.empty()) return std::nullopt;
  std::vector<double> sizes;
  for (const double error : errors_s) sizes.push_back(1000 * std::abs(error));
  return Quantile(sizes, 0.95);
}

std::optional<double> MedianOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  return Median(std::move(values));
}

std::optional<double> NaturalShare(std::span<const double> jumps_cm, const std::vector<double>& natural_jumps_cm) {
  const auto natural = std::ranges::count_if(jumps_cm, [&](double jump) { return IsNatural(jump, natural_jumps_cm); });
  return Share(natural, static_cast<std::int64_t>(jumps_cm.size()));
}

}  // namespace etude

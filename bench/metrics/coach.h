#pragma once

#include <optional>
#include <span>
#include <vector>

namespace etude {

/// The truth about a performance.
enum class PerformanceTruth { kRight, kGrey, kWrong };

/// One performance that a coach asked for and judged in its window; one whose window was cut off is none.
struct CoachedPerformance {
  int begin_frame = 0;  ///< of its window
  int end_frame = 0;    ///< the first after it
  PerformanceTruth truth = PerformanceTruth::kRight;
  std::optional<int> called_wrong;  ///< the frame in which the coach took it for a mistake
  bool called_right = false;
};

/// A corrective act that the coach decided on.
struct GivenCorrection {
  int decided_frame = 0;
  std::optional<int> act_frame;  ///< the act's first frame, way there excluded; empty: the session ended before
};

/// A coached session (docs/reference/metrics.md, Coach). Performances and corrections in order of time.
struct CoachedSession {
  double rate_hz = 30;  ///< > 0
  int frames = 0;       ///< > 0
  std::vector<CoachedPerformance> performances;
  std::vector<GivenCorrection> corrections;

  double Minutes() const { return frames / rate_hz / 60; }
};

/// Counts of the corrections that were due, given and missed.
struct CorrectionTally {
  int due = 0;           ///< performances that were wrong
  int given = 0;         ///< corrections
  int missed = 0;        ///< of those due, without a correction until the next performance's window has closed
  int unneeded = 0;      ///< of those given, after a performance that was right, or before any
  int wrong_praise = 0;  ///< performances that were wrong and called right
};
CorrectionTally TallyCorrections(const CoachedSession& session);

/// The share of mistakes that was answered by a correction within one repetition. Empty without mistakes.
std::optional<double> AnsweredShare(const CorrectionTally& tally);

/// `decision_delay_s`: from a wrong performance's first frame until it is called wrong; one that is not was waited for
/// until its window closed. Kaplan–Meier median; empty when it is never reached.
std::optional<double> DecisionDelaySeconds(const CoachedSession& session);
/// `feedback_delay_s`: from the decision to correct to the act's first frame, given up at the session's end. Likewise.
std::optional<double> FeedbackDelaySeconds(const CoachedSession& session);
/// `feedback_delay_max_s`: the longest of those waits, of the acts that began. Empty when none did.
std::optional<double> LongestFeedbackDelaySeconds(const CoachedSession& session);

/// `repetitions_until_right`: `moves` holds, per move, what its performances were, in order of time. Of the moves whose
/// first performance was wrong: how many performances until the first right one, it included; Kaplan–Meier median,
/// given up after the last one.
std::optional<double> RepetitionsUntilRight(std::span<const std::vector<PerformanceTruth>> moves);

/// `retention`: the mean of the chances to be right in a test. Empty when there are none.
std::optional<double> Retention(std::span<const double> chances);

/// `beat_error_ms`: the 95th percentile of the errors' sizes, seconds in, milliseconds out. Empty without any.
std::optional<double> BeatErrorMs(std::span<const double> errors_s);

/// `switch_jump_cm`: the middle value, or the mean of the middle two. Empty without any.
std::optional<double> MedianOf(std::vector<double> values);
/// `switch_natural_share`: of the transitions with these jumps, the share that is natural (IsNatural) beside the
/// windows of the unbroken song, of which it needs one. Empty without transitions.
std::optional<double> NaturalShare(std::span<const double> jumps_cm, const std::vector<double>& natural_jumps_cm);

}  // namespace etude

#pragma once

#include <optional>
#include <span>
#include <vector>

namespace etude {

/// The truth about a performance.
enum class PerformanceTruth { kRight, kGrey, kWrong };

/// One performance that the coach asked for and judged in its window. A performance whose window was cut off is not
/// counted.
struct CoachedPerformance {
  int begin_frame = 0;  ///< of its window
  int end_frame = 0;    ///< the first after it
  PerformanceTruth truth = PerformanceTruth::kRight;
  std::optional<int> called_wrong;  ///< the frame in which the coach called it wrong
  bool called_right = false;
};

/// A correction that the coach decided to give.
struct GivenCorrection {
  int decided_frame = 0;
  std::optional<int> act_frame;  ///< the first frame of the act, without the transition to it; empty if the session
                                 ///< ended before
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
  int missed = 0;        ///< due corrections that were not given before the window of the next performance closed
  int unneeded = 0;      ///< corrections given after a right performance, or before any performance
  int wrong_praise = 0;  ///< wrong performances that were called right
};
CorrectionTally TallyCorrections(const CoachedSession& session);

/// Returns the share of mistakes that were answered by a correction within one repetition. Empty without mistakes.
std::optional<double> AnsweredShare(const CorrectionTally& tally);

/// Returns `decision_delay_s`: the time from a wrong performance's first frame until it is called wrong; a performance
/// never called wrong is censored when its window closes. Kaplan–Meier median; empty if it is never reached.
std::optional<double> DecisionDelaySeconds(const CoachedSession& session);
/// Returns `feedback_delay_s`: the time from the decision to correct until the act's first frame, censored at the
/// session's end. Kaplan–Meier median; empty if it is never reached.
std::optional<double> FeedbackDelaySeconds(const CoachedSession& session);
/// Returns `feedback_delay_max_s`: the longest such time among the acts that began. Empty if none began.
std::optional<double> MaxFeedbackDelaySeconds(const CoachedSession& session);

/// Returns `repetitions_until_right`. `moves` holds, per move, the truth of its performances in order of time. For each
/// move whose first performance was wrong, it counts the performances up to and including the first right one; if none
/// is right, the count is censored after the last performance. Kaplan–Meier median; empty if it is never reached.
std::optional<double> RepetitionsUntilRight(std::span<const std::vector<PerformanceTruth>> moves);

/// Returns `retention`: the mean probability of a right performance in a test. Empty without tests.
std::optional<double> Retention(std::span<const double> chances);

/// Returns `beat_error_ms`: the 95th percentile of the absolute errors; input in seconds, result in milliseconds. Empty
/// without errors.
std::optional<double> BeatErrorMs(std::span<const double> errors_s);

/// Returns the median, used by `transition_jump_cm`. Empty without values.
std::optional<double> MedianOf(std::vector<double> values);
/// Returns `transition_natural_share`: the share of transitions whose jumps are natural (IsNatural) compared with the
/// windows of the unbroken song, of which at least one is required. Empty without transitions.
std::optional<double> NaturalShare(std::span<const double> jumps_cm, const std::vector<double>& natural_jumps_cm);

}  // namespace etude

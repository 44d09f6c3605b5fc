#pragma once

#include <optional>
#include <span>
#include <vector>

namespace etude {

/// The truth about a performance. Grey means neither right nor wrong.
enum class PerformanceTruth { kRight, kGrey, kWrong };

/// One performance that the coach asked for and judged at the end of its window. A performance is left out if the
/// session ended before its window.
struct CoachedPerformance {
  int begin_frame = 0;  ///< first frame of the performance's window
  int end_frame = 0;    ///< the frame after the performance's window
  PerformanceTruth truth = PerformanceTruth::kRight;
  std::optional<int> called_wrong;  ///< the frame in which the coach called the performance wrong
  bool called_right = false;
};

/// A correction that the coach decided to give.
struct GivenCorrection {
  int decided_frame = 0;
  std::optional<int> act_frame;  ///< first frame of the correcting act, without its transition; empty if the session
                                 ///< ended first
};

/// A coached session (docs/reference/metrics.md, Coach). Performances and corrections are in order of time.
struct CoachedSession {
  double rate_hz = 30;  ///< frame rate, above 0
  int frames = 0;       ///< length of the session, frames, above 0
  std::vector<CoachedPerformance> performances;
  std::vector<GivenCorrection> corrections;

  double Minutes() const { return frames / rate_hz / 60; }
};

/// Counts of the corrections that were due, given and missed.
struct CorrectionTally {
  int due = 0;           ///< number of performances that were wrong
  int given = 0;         ///< number of corrections that the coach gave
  int missed = 0;        ///< number of due corrections not given before the window of the next performance closed
  int unneeded = 0;      ///< number of corrections given after a right performance, or before any performance
  int wrong_praise = 0;  ///< number of wrong performances that were called right
};
CorrectionTally TallyCorrections(const CoachedSession& session);

/// Returns the share of wrong performances to which the coach reacted with a correction within one repetition. Empty if
/// no performance was wrong.
std::optional<double> AnsweredShare(const CorrectionTally& tally);

/// Returns `decision_delay_s`: the Kaplan–Meier median of the time from the first frame of a wrong performance until
/// the coach judges the performance wrong. If the coach never does, the time is censored at the end of the window. The
/// result is empty if the survival curve never falls to one half.
std::optional<double> DecisionDelaySeconds(const CoachedSession& session);
/// Returns `feedback_delay_s`: the Kaplan–Meier median of the time from the decision to correct until the first frame
/// of the correcting act, censored at the session's end. Empty if the survival curve never falls to one half.
std::optional<double> FeedbackDelaySeconds(const CoachedSession& session);
/// Returns `feedback_delay_max_s`: the longest time from a decision to correct until the first frame of the
/// correcting act. Decisions whose act never began are left out. Empty if no act began.
std::optional<double> MaxFeedbackDelaySeconds(const CoachedSession& session);

/// Returns `repetitions_until_right`. `moves` holds, for each move, the truth of its performances in order of time. For
/// each move whose first performance was wrong, the performances are counted up to and including the first right one.
/// If none is right, the count is censored after the last performance. The result is the Kaplan–Meier median of these
/// counts. It is empty if the survival curve never falls to one half.
std::optional<double> RepetitionsUntilRight(std::span<const std::vector<PerformanceTruth>> moves);

/// Returns `retention`: the mean of `chances`, the probabilities of a right performance in a test. The result is empty
/// if there are no tests.
std::optional<double> Retention(std::span<const double> chances);

/// Returns `beat_error_ms`: the 95th percentile of the absolute times by which the dance is early or late. The input is
/// in seconds, the result in milliseconds. The result is empty if `errors_s` is empty.
std::optional<double> BeatErrorMs(std::span<const double> errors_s);

/// Returns the median of `values`; `transition_jump_cm` uses it. The result is empty if there are no values.
std::optional<double> MedianOf(std::vector<double> values);
/// Returns `transition_natural_share`: the share of transitions with a natural jump (IsNatural). Jumps are compared
/// with the natural jumps of the unbroken song, of which at least one is required. The result is empty if there are no
/// transitions.
std::optional<double> NaturalShare(std::span<const double> jumps_cm, const std::vector<double>& natural_jumps_cm);

}  // namespace etude

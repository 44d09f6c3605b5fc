#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// A join as it was shown, together with the two clips that it joins (docs/reference/metrics.md, Transitions). All
/// motions have the rate at which joins are judged and are in metres.
struct JoinView {
  std::span<const BodyPose> shown;  ///< the spliced motion
  /// The old clip, continued. left[f] is the old clip's frame at the time of shown[f]; the first index is 0.
  std::span<const BodyPose> left;
  /// The wanted clip, placed where it is shown. The frame wanted[k] belongs to shown[last + k].
  std::span<const BodyPose> wanted;
  int request = 0;  ///< the frame shown when the wanted clip was requested
  int first = 0;    ///< the frame of the first transition point
  int last = 0;     ///< the frame of the last transition point
  double rate_hz = kJudgedRateHz;
  std::vector<SupportingClip> between = {};  ///< the clips in between, placed where they are shown
};

/// A frame has arrived at the wanted clip if every joint is at most this far from its position in the clip, metres.
constexpr double kArrived = 0.05;

/// Returns the first frame, at or after the last transition point, from which all frames up to the motion's end have
/// arrived. Returns nothing if the motion's last frame has not arrived.
std::optional<int> SettledFrame(const JoinView& view);

/// Returns `settle_s`, the time from the request to SettledFrame; nothing if the join never settles.
std::optional<double> SettleSeconds(const JoinView& view);

/// Returns the last frame of the join: SettledFrame, or the motion's last frame if it never settles. It is at least
/// five frames after the last transition point, if the motion is that long.
int JoinEnd(const JoinView& view);

/// Returns `join_slide_cmps`: FootSlideCmps from the first transition point to the join's end, or to one second after
/// the last transition point if that is later. A frame after the first point is required.
double JoinSlideCmps(const JoinView& view);

/// Returns true if the transition counts for `calm_natural_share`. At every frame from the first transition point to
/// the join's end, the jump must be at most the largest of `limit_cm` (the smaller NaturalLimitCm of the two clips), 1
/// cm, and 1.25 times the larger jump of the two clips at that frame.
bool IsCalmlyNatural(const JoinView& view, double limit_cm);

/// Returns `live`: the mean joint speed in the slowest ten successive frames of the join, divided by the mean joint
/// speed in the slowest ten successive frames of a clip. The divisor is the smaller of the values in the second before
/// and in the second after the join. The result is at most 1. It is 1 if the divisor is below 5 cm/s, or if there are
/// too few frames.
double Liveness(const JoinView& view);

/// All frames of a library's clips. Finds the distance from a given frame to the nearest frame of the library.
class RealFrames {
 public:
  RealFrames() = default;
  explicit RealFrames(std::span<const BodyMotion> clips);

  /// Returns the distance to the nearest frame, centimetres: √(mean over joints of d² + (0.1 s · v)²). d and v are the
  /// differences of the joint's position and velocity, after both bodies are turned to the same heading and moved to
  /// the same point of the floor. `before` is the frame before `now`. The library must contain at least one frame that
  /// is not the first of its clip. The search begins at frame `nearest` and stores the index of the nearest frame
  /// there. The result does not depend on the frame at which the search begins.
  double DistanceCm(const BodyPose& before, const BodyPose& now, double rate_hz, std::size_t& nearest) const;

 private:
  static constexpr std::size_t kNumbers = 6 * kRoleCount;
  using Row = std::array<float, kNumbers>;
  static Row RowOf(const BodyPose& before, const BodyPose& now, double rate_hz);

  std::vector<Row> rows_;
};

/// Returns `strange_cm_s`: the distance to the nearest real frame, integrated over the join's frames after the first
/// transition point, centimetre seconds.
double StrangeCmSeconds(const JoinView& view, const RealFrames& real);

/// Returns the support of the body in each frame from the first transition point to the join's end, but for at least
/// 1.2 s if the motion is that long. Support is found from the clips, never from the shown frames (FindSupport).
std::vector<Support> JoinSupport(const JoinView& view);

/// A transition counts as floating if the body is unsupported for at least this many frames in a row. Shorter gaps are
/// not visible.
constexpr int kFloatingFrames = 4;
/// Returns `unsupported_frames`: the largest number of unsupported frames in a row.
int UnsupportedFrames(std::span<const Support> support);
/// Returns true if the transition counts for `supported_share`: the body is unsupported in fewer than kFloatingFrames
/// frames in a row.
bool IsSupported(std::span<const Support> support);

/// Returns `balance_cm`: the mean of BalanceOffset, the horizontal distance from the centre of mass to the supporting
/// joints. The mean is over the frames of `support` that have a supporting joint. Returns nothing if there is no such
/// frame. `support` is the result of JoinSupport.
std::optional<double> BalanceCm(const JoinView& view, std::span<const Support> support);

/// The start of the wanted clip, which the transition skips. If the motion continues without a transition, no clip is
/// entered.
struct SkippedStart {
  std::optional<int> entered_frame;  ///< the frame at which the wanted clip is entered
  int frames = 1;                    ///< number of frames of the wanted clip
  double rate_hz = kJudgedRateHz;
};
/// Returns `skipped_s`: the duration of the skipped start, seconds.
constexpr double SkippedSeconds(const SkippedStart& start) { return start.entered_frame.value_or(0) / start.rate_hz; }
/// Returns `skipped_share`: the length of the skipped start as a share of the clip's frames.
constexpr double SkippedShare(const SkippedStart& start) {
  return static_cast<double>(start.entered_frame.value_or(0)) / start.frames;
}

/// The measures of a transition that `clean_share` depends on.
struct CleanMeasures {
  bool natural = false, calmly_natural = false, supported = false;
  double slide_cmps = 0, strange_cm_s = 0, live = 0;
  double own_slide_cmps = 0;  ///< foot slide of the clip that slides more, measured over the whole clip
  double skipped_share = 0;
  std::optional<double> settle_s;
  bool possible = false;  ///< all measures of the shown body are within their limits (transition_body.h)
};
/// Returns true if the transition is clean by `clean_share_v3`: `natural`, `calmly_natural` and `supported` are true;
/// `slide_cmps` is at most 6 or at most `own_slide_cmps`; the motion settles within 1.5 s; `strange_cm_s` is at most 10
/// and `live` at least 0.5; at most a third of the wanted clip is skipped. `possible` is ignored.
bool IsCleanByVersion3(const CleanMeasures& measures);
/// Returns true if the transition is clean by `clean_share`: clean by version 3, and possible for a human body.
inline bool IsClean(const CleanMeasures& measures) { return IsCleanByVersion3(measures) && measures.possible; }

}  // namespace etude

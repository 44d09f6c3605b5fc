#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// A join as it was shown, beside the clips it joins (docs/reference/metrics.md, Transitions). All at the judged rate,
/// metres.
struct JoinView {
  std::span<const BodyPose> shown;   ///< the spliced motion
  std::span<const BodyPose> left;    ///< the old clip: left[f] is its own frame where shown[f] stands, from 0 on
  std::span<const BodyPose> wanted;  ///< the wanted clip in its place: wanted[k] where shown[last + k] stands
  int request = 0;                   ///< the frame shown when the wanted clip was asked for
  int first = 0;                     ///< the frame of the first transition point
  int last = 0;                      ///< of the last one
  double rate_hz = kJudgedRateHz;
  std::vector<SupportingClip> between = {};  ///< clips on the way, in their places
};

/// A frame has arrived when its worst joint is this close to the wanted clip's own frame. Metres.
constexpr double kArrived = 0.05;

/// The first frame from the last transition point on, from which to the motion's end every frame has arrived; none when
/// the last frame has not.
std::optional<int> SettledFrame(const JoinView& view);

/// `settle_s`: from the request to SettledFrame.
std::optional<double> SettleSeconds(const JoinView& view);

/// The last frame that belongs to the join: SettledFrame, or the motion's last frame when it never settles; five frames
/// after the last transition point at least, as far as the motion goes.
int JoinEnd(const JoinView& view);

/// `join_slide_cmps`: as FootSlideCmps, from the first transition point to the join's end, a second after the last
/// point at least. Needs a frame after the first point.
double JoinSlideCmps(const JoinView& view);

/// `calm_natural_share` of one transition: no frame from the first transition point to the join's end jumps more than
/// `limit_cm`, the calmer clip's own limit (1 cm at least), or by a quarter more than one of the two clips itself does
/// at that very frame.
bool IsCalmlyNatural(const JoinView& view, double limit_cm);

/// `live`: the slowest ten frames of the join, by mean joint speed, over the slowest ten in the second before it and in
/// the second after it, whichever is slower; at most 1. 1 where these are slower than 5 cm/s, or too short to tell.
double Liveness(const JoinView& view);

/// The frames of a library's clips, to be asked how far a frame is from all of them.
class RealFrames {
 public:
  RealFrames() = default;
  explicit RealFrames(std::span<const BodyMotion> clips);

  /// The distance to the nearest of them, centimetres: the root of the mean over joints of the squared distance of
  /// positions plus that of velocities × 0.1 s, both bodies turned to one heading with their hip centres above one
  /// point of the floor. `before` is the frame before `now`. Needs a frame: a clip's first has no velocity, and is
  /// none. The search begins at frame `nearest`, and leaves the nearest there: the answer is the same wherever it
  /// begins.
  double DistanceCm(const BodyPose& before, const BodyPose& now, double rate_hz, std::size_t& nearest) const;

 private:
  static constexpr std::size_t kNumbers = 6 * kRoleCount;
  using Row = std::array<float, kNumbers>;
  static Row RowOf(const BodyPose& before, const BodyPose& now, double rate_hz);

  std::vector<Row> rows_;
};

/// `strange_cm_s`: the sum over the join's frames after the first transition point of their distance to the nearest
/// real frame, times the duration of a frame.
double StrangeCmSeconds(const JoinView& view, const RealFrames& real);

/// Finds what holds the body up from the first transition point to the join's end, 1.2 s after that point at least, as
/// far as the motion goes: FindSupport, asked of the clips, never of the frames shown.
std::vector<Support> JoinSupport(const JoinView& view);

/// A transition floats when nothing holds the body for so many frames in a row. Fewer are not seen.
constexpr int kFloatingFrames = 4;
/// `unsupported_frames`: the most frames in a row that nothing holds up.
int UnsupportedFrames(std::span<const Support> support);
/// `supported_share` of one transition.
bool IsSupported(std::span<const Support> support);

/// `balance_cm`: how far the ground point of the mass centre is from the joints that bear the body (BalanceOffset),
/// mean over the frames of `support` that have such joints; none where the body only flies or floats. `support` is
/// JoinSupport's.
std::optional<double> BalanceCm(const JoinView& view, std::span<const Support> support);

/// The start of the wanted clip that is left out, before the frame at which it is entered; nothing of a motion that
/// goes on unbroken, which enters no clip.
struct SkippedStart {
  std::optional<int> entered_frame;  ///< of the wanted clip
  int frames = 1;                    ///< of the wanted clip
  double rate_hz = kJudgedRateHz;
};
/// `skipped_s`: as a time.
constexpr double SkippedSeconds(const SkippedStart& start) { return start.entered_frame.value_or(0) / start.rate_hz; }
/// `skipped_share`: as a share of the clip's frames.
constexpr double SkippedShare(const SkippedStart& start) {
  return static_cast<double>(start.entered_frame.value_or(0)) / start.frames;
}

/// The demands of `clean_share` on a transition.
struct CleanMeasures {
  bool natural = false, calmly_natural = false, supported = false;
  double slide_cmps = 0, strange_cm_s = 0, live = 0;
  double own_slide_cmps = 0;  ///< foot slide of the clip that slides more, over all of it
  double skipped_share = 0;
  std::optional<double> settle_s;
};
/// `clean_share_v1`: both kinds of natural, slide ≤ 6 cm/s or what a clip slides itself, settled within 1.5 s,
/// strange ≤ 10 cm·s, live ≥ 0.5. Neither `supported` nor `skipped_share` is asked for.
bool IsCleanByVersion1(const CleanMeasures& measures);
/// `clean_share`: all of these, supported, and no more than a third of the wanted clip skipped.
bool IsClean(const CleanMeasures& measures);

}  // namespace etude

#include "engine/transitions/choices/pair_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/motion/pendulum.h"
#include "engine/transitions/joins/limbs.h"
#include "engine/transitions/joins/placing.h"
#include "engine/transitions/joins/splice.h"

namespace etude {
namespace {

/// Returns `count` + 1 frames of a clip from frame `first` on. After the clip's end, the last frame is repeated.
std::vector<BodyPose> FramesFrom(const BodyMotion& clip, int first, int count) {
  std::vector<BodyPose> frames;
  const int last = static_cast<int>(clip.poses.size()) - 1;
  for (int f = first; f <= first + count; ++f) frames.push_back(clip.poses[std::min(f, last)]);
  return frames;
}

BodyPose FrameBeforeIn(const BodyMotion& clip, int frame) {
  if (frame > 0) return clip.poses[frame - 1];
  return clip.poses.size() > 1 ? FrameBefore(clip.poses[0], clip.poses[1]) : clip.poses[0];
}

/// Returns the floor move by which the join planted-feet aligns the wanted clip at this pair.
FloorMove FloorMoveOf(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair) {
  const std::size_t aligned = static_cast<std::size_t>(kAlignedSeconds * playing.rate_hz) + 1;
  const auto head = [&](const BodyMotion& clip, int first) {
    return std::span(clip.poses).subspan(first).first(std::min(aligned, clip.poses.size() - first));
  };
  return AlignOnPlantedFeet(head(playing, pair.leave), head(wanted, pair.enter), playing.rate_hz);
}

/// Returns the window that the join planted-feet would use at this pair. `last` is the last frame of the wanted clip
/// that is used.
JoinWindow WindowOfPair(const BodyMotion& playing, const BodyMotion& wanted, const FramePair& pair,
                        const FloorMove& floor_move, int last, int frames) {
  JoinWindow window{.shown = {FrameBeforeIn(playing, pair.leave), playing.poses[pair.leave]},
                    .target_before = FrameBeforeIn(wanted, pair.enter),
                    .old = FramesFrom(playing, pair.leave, frames),
                    .next = FramesFrom(wanted, pair.enter, frames),
                    .old_frames = std::min(static_cast<int>(playing.poses.size()) - 1 - pair.leave, frames),
                    .next_frames = std::min(last - pair.enter, frames),
                    .rate_hz = playing.rate_hz};
  window.target_before = floor_move.Apply(window.target_before);
  for (BodyPose& pose : window.next) pose = floor_move.Apply(pose);
  return window;
}

glm::dvec3 SecondDifferenceOf(const BodyPose& before, const BodyPose& here, const BodyPose& after, std::size_t joint) {
  return after.joints[joint] - 2.0 * here.joints[joint] + before.joints[joint];
}

OwnAccelerations OwnOf(const JoinWindow& window) {
  OwnAccelerations own(window.next.size());
  for (int f = 0; f < window.Frames(); ++f) {
    const BodyPose& old_before = f > 0 ? window.old[f - 1] : window.shown.before;
    const BodyPose& next_before = f > 0 ? window.next[f - 1] : window.target_before;
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const auto size = [&](const BodyPose& before, const BodyPose& here, const BodyPose& after) {
        return glm::length(SecondDifferenceOf(before, here, after, j));
      };
      own[f][j] = std::max(f < window.old_frames ? size(old_before, window.old[f], window.old[f + 1]) : 0,
                           f < window.next_frames ? size(next_before, window.next[f], window.next[f + 1]) : 0);
    }
  }
  return own;
}

double SquaredOff(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    const glm::dvec3 off = a.joints[j] - b.joints[j];
    sum += glm::dot(off, off);
  }
  return sum / kRoleCount;
}

/// The number of frames before and after a join in which support contacts are searched, as in FindSupport.
constexpr int kAround = 30;

double FloorLength(const glm::dvec3& v) { return std::hypot(v.x, v.z); }

/// Returns the largest of a clip's `values` (one per frame) within two frames of `frame`; 0 outside of the clip.
double LargestNear(std::span<const double> values, int frame) {
  constexpr int kReach = 2;
  double largest = 0;
  const int last = std::min(frame + kReach, static_cast<int>(values.size()) - 1);
  for (int f = std::max(frame - kReach, 0); f <= last; ++f) largest = std::max(largest, values[f]);
  return largest;
}

}  // namespace

void CostMeter::Add(const BodyPose& shown) {
  if (count_ > 0) {
    const std::size_t f = count_ - 1;  // the frame of `here_`; both neighbours of this frame are known now
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const glm::dvec3 jump = SecondDifferenceOf(before_, here_, shown, j);
      const double least = std::max(own_[f][j], usual_) + worst_excess_, squared = glm::dot(jump, jump);
      if (squared > least * least) worst_excess_ += std::sqrt(squared) - least;
    }
    if (f > 0) off_ += std::sqrt(std::min(SquaredOff(here_, window_.old[f]), SquaredOff(here_, window_.next[f])));
    before_ = here_;
  }
  here_ = shown;
  ++count_;
}

double CostMeter::Seconds() const {
  constexpr double kCm = 100;
  return kCm * (worst_excess_ / rates_.excess_per_s + off_ / window_.rate_hz / rates_.invented_per_s);
}

double SlideOf(std::span<const BodyPose> played) {
  constexpr double kHeight = 0.025;
  double slid = 0;
  for (std::size_t f = 0; f + 1 < played.size(); ++f) {
    for (const LegRoles& leg : kLegs) {
      const double height = played[f][leg.foot].y;
      if (height >= kHeight) continue;
      const double way = FloorLength(played[f + 1][leg.foot] - played[f][leg.foot]);
      slid += way * std::clamp(2 - std::exp2(height / kHeight), 0.0, 1.0);
    }
  }
  return slid;
}

PairStage::PairStage(const MotionLibrary& library, const TransitionRequest& request, const FramePair& pair, int last,
                     int frames)
    : PairStage(library, request, pair, FloorMoveOf(library.motions[request.from], library.motions[request.to], pair),
                last, frames) {}

PairStage::PairStage(const MotionLibrary& library, const TransitionRequest& request, const FramePair& pair,
                     const FloorMove& floor_move, int last, int frames)
    : window_(WindowOfPair(library.motions[request.from], library.motions[request.to], pair, floor_move, last, frames)),
      own_(OwnOf(window_)),
      turns_(window_),
      pair_(pair),
      playing_beside_(library.beside_feet[request.from]),
      wanted_beside_(library.beside_feet[request.to]),
      before_(std::min(pair.leave, kAround)) {
  const BodyMotion &playing = library.motions[request.from], &wanted = library.motions[request.to];
  const auto around = [&](const BodyMotion& clip, int first, int count) {
    const std::size_t begin = static_cast<std::size_t>(first), most = clip.poses.size() - begin;
    return std::span(clip.poses).subspan(begin, std::min(static_cast<std::size_t>(count), most));
  };
  // Prepare the search for support on both clips around the join. Shifting the wanted clip on the floor does not change
  // its support.
  playing_ = around(playing, pair.leave - before_, before_ + frames + kAround);
  for (const BodyPose& pose : around(wanted, pair.enter, frames + kAround)) wanted_.push_back(floor_move.Apply(pose));
  const std::array clips = {SupportingClip{.poses = playing_, .begin = 0, .left_at = before_},
                            SupportingClip{.poses = wanted_, .begin = before_}};
  support_finder_.emplace(clips, playing.rate_hz);
}

glm::dvec3 PairStage::ShiftFor(int frames) const {
  const PosePair leaving = window_.old_frames > 0 ? PosePair{window_.old[0], window_.old[1]} : window_.shown;
  return CarriedShift(leaving, window_.old[0], {window_.next[frames - 1], window_.next[frames]}, frames);
}

JoinWindow PairStage::WindowFor(int frames, const glm::dvec3& shift) const {
  JoinWindow window{.shown = window_.shown,
                    .target_before = window_.target_before,
                    .old = {window_.old.begin(), window_.old.begin() + frames + 1},
                    .next = {window_.next.begin(), window_.next.begin() + frames + 1},
                    .old_frames = std::min(window_.old_frames, frames),
                    .next_frames = std::min(window_.next_frames, frames),
                    .rate_hz = window_.rate_hz};
  Shift(shift, window.target_before);
  for (BodyPose& pose : window.next) Shift(shift, pose);
  return window;
}

const BodyPose& PairStage::LimbsAt(std::size_t length, int frames, JoinStyle way, int frame) {
  Limbs& limbs = limbs_[length][way == JoinStyle::kFades ? 1 : 0];
  if (!limbs.play) limbs.play.emplace(window_, turns_, frames, way);
  while (static_cast<int>(limbs.poses.size()) <= frame) {
    limbs.poses.push_back(limbs.play->At(static_cast<int>(limbs.poses.size())));
  }
  return limbs.poses[frame];
}

const FootPlan& PairStage::StepsIn(const JoinWindow& window, std::size_t length, bool carried) {
  std::optional<FootPlan>& steps = steps_[length][carried ? 1 : 0];
  if (!steps) steps = PlanSteps(window);
  return *steps;
}

Burden PairStage::Rate(std::span<const BodyPose> played, const glm::dvec3& shift) const {
  // Compose the motion: the playing clip, the join, then the wanted clip.
  std::vector<BodyPose> shown(playing_.begin(), playing_.begin() + before_);
  shown.insert(shown.end(), played.begin(), played.end());
  for (std::size_t f = played.size(); f < wanted_.size(); ++f) Shift(shift, shown.emplace_back(wanted_[f]));
  const int end = static_cast<int>(shown.size()) - 1, last = std::min(before_ + window_.Frames(), end);
  // Compute the centres of mass from which the accelerations in the join are computed.
  constexpr int kReach = 3;
  std::vector<glm::dvec3> centres(shown.size());
  for (int f = std::max(before_ - kReach, 0); f <= std::min(last + kReach, end); ++f) centres[f] = MassCentre(shown[f]);
  // Find the longest run of frames without support. Add up, over the frames, the zero-moment point's excess distance
  // and the gliding.
  constexpr double kFoot = 0.1;
  Burden burden;
  int run = 0;
  const std::vector<Support> supports = support_finder_->Find(shown, before_, last);
  for (int f = before_; f <= last; ++f) {
    const Support& support = supports[f - before_];
    run = support.Holds() ? 0 : run + 1;
    burden.unsupported = std::max(burden.unsupported, run);
    if (support.flight) continue;
    const auto off = ZeroMomentOffset(centres, f, window_.rate_hz, shown[f], support.joints);
    if (off) burden.beside += std::max(*off - std::max(kFoot, OwnBeside(f - before_)), 0.0) / window_.rate_hz;
    if (f > before_) burden.glide += GlideAt(shown, f, support.joints);
  }
  burden.turn = LargestTurn(shown, supports);
  return burden;
}

/// Returns how far the zero-moment point is from the supports in the clips themselves near a frame of the join, metres:
/// the larger of the two clips' distances.
double PairStage::OwnBeside(int frame) const {
  return std::max(LargestNear(playing_beside_, pair_.leave + frame), LargestNear(wanted_beside_, pair_.enter + frame));
}

/// Returns the smallest distance that a joint of `supports` moves along the floor from frame `frame` − 1 to `frame`,
/// metres. The distance is measured in the world and relative to the same joint in each clip; the smallest counts. If
/// `supports` is empty, the joints are the ankles and toes.
double PairStage::GlideAt(std::span<const BodyPose> shown, int frame, JointSet supports) const {
  if (supports.none()) {
    for (const LegRoles& leg : kLegs) supports.set(Index(leg.ankle)).set(Index(leg.foot));
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    if (!supports[j]) continue;
    const glm::dvec3 way = shown[frame].joints[j] - shown[frame - 1].joints[j];
    least = std::min(least, FloorLength(way));
    const auto beside = [&](std::span<const BodyPose> clip, int f) {
      if (f < 1 || f >= static_cast<int>(clip.size())) return;
      least = std::min(least, FloorLength(way - (clip[f].joints[j] - clip[f - 1].joints[j])));
    };
    beside(playing_, frame);
    beside(wanted_, frame - before_);
  }
  return least;
}

/// Returns the largest turn of the hips against a foot, radians, in a run of frames of the join in which this foot
/// supports the body and rests. If a clip itself contains a part of a frame's turn, that part does not count: the frame
/// counts with the smallest of its turn and the differences between its turn and each clip's turn. `supports` begins
/// with the join's first frame.
double PairStage::LargestTurn(std::span<const BodyPose> shown, std::span<const Support> supports) const {
  double largest = 0;
  for (const LegRoles& leg : kLegs) {
    const auto turn = [&](std::span<const BodyPose> poses, int f) {
      const auto line = [&](int frame, Role from, Role to) { return poses[frame][to] - poses[frame][from]; };
      const Role other = Mirrored(leg.hip);
      return TurnOnFloor(line(f - 1, other, leg.hip), line(f, other, leg.hip)) -
             TurnOnFloor(line(f - 1, leg.ankle, leg.foot), line(f, leg.ankle, leg.foot));
    };
    TurnMeter meter;
    for (int i = 1; i < static_cast<int>(supports.size()); ++i) {
      const int f = before_ + i;
      const auto speed = [&](Role role) { return glm::distance(shown[f][role], shown[f - 1][role]) * window_.rate_hz; };
      const bool supports_body = supports[i].joints[Index(leg.ankle)] || supports[i].joints[Index(leg.foot)];
      if (!supports_body || std::max(speed(leg.ankle), speed(leg.foot)) > kFootRules.rest_speed) {
        meter.End();
        continue;
      }
      const double whole = turn(shown, f);
      double added = whole;  // the smallest of `whole` and its differences from the clips' own turns
      const auto compare = [&](std::span<const BodyPose> clip, int frame) {
        if (frame < 1 || frame >= static_cast<int>(clip.size())) return;
        const double rest = whole - turn(clip, frame);
        if (std::abs(rest) < std::abs(added)) added = rest;
      };
      compare(playing_, f);
      compare(wanted_, i);
      meter.Add(added);
    }
    largest = std::max(largest, meter.largest());
  }
  return largest;
}

}  // namespace etude

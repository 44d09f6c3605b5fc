#include "io/clips/body_in_place.h"

#include <algorithm>
#include <utility>

namespace etude {
namespace {

/// Returns, for each of `frames` frames from the file's frame `first` on, the joints that the reader placed by a rule
/// because the file does not show them; empty if the file shows every joint in every frame.
std::vector<JointSet> UnseenIn(const OpenedClip& opened, std::size_t first, std::size_t frames) {
  std::vector<JointSet> unseen(frames);
  for (const Role role : opened.map.composed) {
    for (JointSet& joints : unseen) joints.set(Index(role));
  }
  const RawMotion* shown = opened.source.shown.get();
  if (shown != nullptr && shown->FrameCount() >= first + frames) {
    for (const Role role : AllRoles()) {
      const int at = shown->roles[Index(role)];
      for (std::size_t f = 0; f < frames; ++f) {
        if (at < 0 || !IsSeen(shown->At(first + f, static_cast<std::size_t>(at)))) unseen[f].set(Index(role));
      }
    }
  }
  const bool shows_all = std::ranges::none_of(unseen, [](const JointSet& joints) { return joints.any(); });
  return shows_all ? std::vector<JointSet>() : unseen;
}

/// Returns the joints that no frame of any stretch shows.
JointSet NeverSeen(const BodyInPlace& body) {
  JointSet never;
  never.set();
  const auto keep = [&](const std::vector<JointSet>& unseen) {
    if (unseen.empty()) never.reset();
    for (const JointSet& joints : unseen) never &= joints;
  };
  keep(body.unseen);
  for (const OtherStretch& other : body.others) keep(other.unseen);
  return never;
}

void Lift(std::vector<BodyPose>& poses, double by_m) {
  for (BodyPose& pose : poses) {
    for (glm::dvec3& joint : pose.joints) joint.y += by_m;
  }
}

}  // namespace

Result<BodyInPlace> BodyInPlaceOf(SourceClip clip, const OpenOptions& options) {
  OpenOptions own = options;
  own.body.rate_hz = clip.clip.rate_hz;
  own.body.keep_floor = true;
  ASSIGN_OR_RETURN(auto opened, UnderstandClip(std::move(clip), own));
  // UnderstandClip may have moved the floor of a body of markers to height 0: move the body back.
  BodyConversion& body = opened.body;
  const double floor_m = body.floor * body.metres_per_unit;
  Lift(body.motion.poses, floor_m);
  const std::size_t before = opened.source.made ? opened.source.made->first_frame : 0;
  const double begin_s = static_cast<double>(body.dropped_frames + before) / body.motion.rate_hz;
  std::vector<JointSet> unseen = UnseenIn(opened, before, body.motion.poses.size());
  const ClipFormat format = opened.source.format;
  const bool is_of_markers = format == ClipFormat::kC3d || format == ClipFormat::kTrc || format == ClipFormat::kMotive;
  const RawMotion* shown = opened.source.shown.get();
  const std::size_t frames = body.motion.poses.size() + before;
  const std::size_t behind = shown == nullptr || shown->FrameCount() < frames ? 0 : shown->FrameCount() - frames;
  const double lost_after_s = static_cast<double>(behind) / body.motion.rate_hz;
  const double lost_before_s = static_cast<double>(before) / body.motion.rate_hz;
  std::vector<OtherStretch> others;
  for (BodyStretch& other : opened.source.made ? opened.source.made->others : std::vector<BodyStretch>()) {
    Lift(other.poses, floor_m);
    auto unseen_there = UnseenIn(opened, other.first_frame, other.poses.size());
    others.push_back({static_cast<double>(other.first_frame) / body.motion.rate_hz,
                      {body.motion.rate_hz, std::move(other.poses)},
                      std::move(unseen_there)});
  }
  return BodyInPlace{.motion = std::move(body.motion),
                     .begin_s = begin_s,
                     .lost_after_s = lost_after_s,
                     .lost_before_s = lost_before_s,
                     .unseen = std::move(unseen),
                     .is_of_markers = is_of_markers,
                     .notes = std::move(body.changes),
                     .doubts = std::move(body.doubts),
                     .is_floor_known = !opened.source.made || opened.source.made->is_floor_known,
                     .others = std::move(others)};
}

FaultsInPlace FindFaultsInPlace(const BodyInPlace& body, std::optional<double> floor_m) {
  const auto end_of = [](double begin_s, const BodyMotion& motion) {
    return begin_s + static_cast<double>(motion.poses.size()) / motion.rate_hz;
  };
  const double file_begin_s = body.begin_s - body.lost_before_s;
  const double file_end_s = end_of(body.begin_s, body.motion) + body.lost_after_s, step_s = 1 / body.motion.rate_hz;
  FaultsInPlace all{.found = {}, .file_s = file_end_s - file_begin_s - step_s};
  FaultOptions options{
      .floor_m = floor_m, .is_floor_known = body.is_floor_known, .is_of_markers = body.is_of_markers};
  if (!body.others.empty()) options.never = NeverSeen(body);
  // Judge the longest stretch first, because it determines the floor of the others. Its gaps end at its neighbours.
  const auto judge = [&](double begin_s, const BodyMotion& motion, const std::vector<JointSet>& unseen) {
    double from_s = file_begin_s, to_s = file_end_s;
    const auto limit = [&](double other_begin_s, const BodyMotion& other) {
      if (other_begin_s < begin_s) from_s = std::max(from_s, end_of(other_begin_s, other));
      if (other_begin_s > begin_s) to_s = std::min(to_s, other_begin_s);
    };
    limit(body.begin_s, body.motion);
    for (const OtherStretch& other : body.others) limit(other.begin_s, other.motion);
    options.begin_s = begin_s;
    options.unseen = unseen;
    // A gap between two stretches is reported with the stretch before it.
    options.lost_before_s = from_s == file_begin_s ? begin_s - from_s : 0;
    options.lost_after_s = to_s - end_of(begin_s, motion);
    MotionFaults part = FindMotionFaults(motion, options);
    if (motion.poses.size() >= kMinFramesForFaults) {
      all.frames += motion.poses.size();
      all.judged_s += static_cast<double>(motion.poses.size() - 1) * step_s;
    } else {
      all.not_judged_s.emplace_back(begin_s, end_of(begin_s, motion));
    }
    if (options.lost_before_s > 0) all.not_judged_s.emplace_back(from_s, begin_s);
    if (options.lost_after_s > 0) all.not_judged_s.emplace_back(end_of(begin_s, motion), to_s);
    return part;
  };
  all.found = judge(body.begin_s, body.motion, body.unseen);
  if (all.found.is_floor_found) options.floor_m = all.found.floor_m;
  for (const OtherStretch& other : body.others) {
    const MotionFaults part = judge(other.begin_s, other.motion, other.unseen);
    all.found.faults.insert(all.found.faults.end(), part.faults.begin(), part.faults.end());
  }
  SortFaults(all.found.faults);
  // Join the times that are not judged.
  std::ranges::sort(all.not_judged_s);
  std::vector<std::pair<double, double>> joined;
  for (const auto& [from, to] : all.not_judged_s) {
    if (!joined.empty() && from - joined.back().second < 0.5 * step_s) {
      joined.back().second = to;
    } else {
      joined.emplace_back(from, to);
    }
  }
  all.not_judged_s = std::move(joined);
  return all;
}

Result<BodyInPlace> OpenBodyInPlace(const std::string& reference, const OpenOptions& options) {
  OpenOptions own = options;
  own.body.keep_floor = true;
  own.keeps_shown = true;
  own.keeps_others = true;
  ASSIGN_OR_RETURN(auto clip, ReadOneClip(reference, own));
  return BodyInPlaceOf(std::move(clip), options);
}

}  // namespace etude

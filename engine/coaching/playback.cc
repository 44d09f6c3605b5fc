#include "engine/coaching/playback.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "engine/motion/body.h"
#include "engine/transitions/joins/crossfade.h"

namespace etude {
namespace {

/// Returns the record's segments with new clip indices: the playing clip, shortened by its first `skipped` frames, is
/// clip 0, and the wanted clip is clip 1. Other clips on the way are appended to `clips`.
std::vector<Segment> Renumbered(const TransitionRecord& record, int skipped, const std::vector<BodyMotion>& motions,
                                std::vector<BodyMotion>& clips) {
  std::vector<Segment> segments = record.segments;
  segments.front().clip = 0;
  segments.front().first -= skipped;
  segments.front().last -= skipped;
  for (std::size_t i = 1; i + 1 < segments.size(); ++i) {
    if (segments[i].clip == Segment::kOwnFrames) continue;
    clips.push_back(motions[segments[i].clip]);
    segments[i].clip = static_cast<int>(clips.size()) - 1;
  }
  segments.back().clip = 1;
  return segments;
}

ShownPath CutTo(const BodyPose& left, const BodyMotion& wanted, bool home) {
  ShownPath path;
  path.place = home ? FloorMove{} : AlignOnFloor(wanted.poses.front(), left);
  for (const BodyPose& pose : wanted.poses) path.frames.push_back(path.place.Apply(pose));
  return path;
}

/// Returns the move that applies `inner` first, then `outer`.
FloorMove After(const FloorMove& outer, const FloorMove& inner) {
  const glm::dvec3 shift = outer.Apply(glm::dvec3(inner.x, 0, inner.z));
  return {.yaw = outer.yaw + inner.yaw, .x = shift.x, .z = shift.z};
}

/// Returns the floor move of the path's clip in the world.
FloorMove ClipPlace(const Playback& playback) { return After(playback.place, playback.path->place); }

BodyPose DancePose(const Dance& dance, double frame) {
  const auto& poses = dance.motion.poses;
  const auto last = static_cast<double>(poses.size() - 1);
  const double at = std::clamp(frame, 0.0, last);
  const auto before = static_cast<std::size_t>(at);
  return PoseBetween(poses[before], poses[std::min(before + 1, poses.size() - 1)], at - std::floor(at));
}

/// Returns a frame of a path. After the path's last frame, its clip continues: a loop is repeated; any other clip keeps
/// its last pose.
BodyPose PathPose(const Playback& playback, const DanceLibrary& library, std::size_t frame) {
  const ShownPath& path = *playback.path;
  if (frame < path.frames.size()) return playback.place.Apply(path.frames[frame]);
  const std::vector<BodyPose>& clip = library.library().motions[path.clip].poses;
  const std::size_t since = static_cast<std::size_t>(path.clip_frame) + frame - path.entered;
  const std::size_t index = library.IsLoop(path.clip) ? since % clip.size() : std::min(since, clip.size() - 1);
  return ClipPlace(playback).Apply(clip[index]);
}

/// The point at which a transition leaves the playing clip: the clip, the last whole frame that was shown, the fraction
/// of a frame that was shown after this frame, and the place of the clip on the floor.
struct Leaving {
  int clip = 0;
  int frame = 0;
  double beyond = 0;
  FloorMove place;
};

Leaving LeavingOf(const Playback& playback, const DanceLibrary& library) {
  Leaving leaving;
  double frame = 0;
  if (playback.path) {
    const PlayedClip played = PlayedOf(playback, library);
    leaving.clip = played.clip;
    leaving.place = ClipPlace(playback);
    frame = played.frame;
  } else {
    leaving.clip = library.ClipLeaving(library.RepetitionAt(playback.dance_frame));
    frame = playback.dance_frame - static_cast<double>(library.DanceFrameOf(leaving.clip));
  }
  const auto last = static_cast<double>(library.library().motions[leaving.clip].poses.size() - 1);
  frame = std::clamp(frame, 0.0, last);
  leaving.frame = static_cast<int>(frame);
  leaving.beyond = frame - std::floor(frame);
  return leaving;
}

}  // namespace

DanceTransitions::DanceTransitions(const DanceLibrary& library, TransitionWay way)
    : library_(library), way_(std::move(way)) {}

std::shared_ptr<const TransitionRecord> DanceTransitions::Plan(int from, int frame, int to) const {
  auto& plan = plans_[{from, frame, to}];
  if (!plan) {
    const TransitionRequest request{.from = from, .request_frame = frame, .to = to};
    plan = std::make_shared<const TransitionRecord>(
        way_.choice->plan(library_.library(), request, way_.rules, way_.choice_settings));
  }
  return plan;
}

std::shared_ptr<const ShownPath> DanceTransitions::Alone(int clip) const {
  auto path = std::make_shared<ShownPath>();
  path->clip = clip;
  return path;
}

std::shared_ptr<const ShownPath> DanceTransitions::Find(int from, int frame, int to) const {
  auto& path = paths_[{from, frame, to}];
  if (!path) path = Splice(from, frame, nullptr, to);
  return path;
}

std::shared_ptr<const ShownPath> DanceTransitions::FindHome(int from, int frame, const FloorMove& place, int to) const {
  return Splice(from, frame, &place, to);
}

std::shared_ptr<const ShownPath> DanceTransitions::Splice(int from, int frame, const FloorMove* home_from,
                                                          int to) const {
  const std::vector<BodyMotion>& motions = library_.library().motions;
  // Drop the frames of the playing clip that lie more than one frame before the request; the join needs no earlier
  // frames.
  const int skipped = std::max(frame - 1, 0);
  std::vector<BodyMotion> clips(2);
  clips[0].rate_hz = motions[from].rate_hz;
  clips[0].poses.assign(motions[from].poses.begin() + skipped, motions[from].poses.end());
  clips[1] = motions[to];
  // If the wanted clip keeps its authored place on the floor, move the playing clip to the place where the playing clip
  // is shown now.
  if (home_from != nullptr) {
    for (BodyPose& pose : clips[0].poses) pose = home_from->Apply(pose);
  }

  auto path = std::make_shared<ShownPath>();
  // Plan the transition. If the method finds none, cut to the wanted clip.
  const auto record = Plan(from, frame, to);
  const bool arrives = !record->segments.empty() && record->segments.back().clip == to;
  if (!arrives) {
    *path = CutTo(clips[0].poses[frame - skipped], clips[1], home_from != nullptr);
  } else {
    // Join the clips and keep the frames after the requested frame.
    std::vector<Segment> segments = Renumbered(*record, skipped, motions, clips);
    segments.back().in_place = home_from != nullptr;
    const etude::Splice splice = SpliceSegments(clips, segments, *way_.join, way_.join_settings);
    const std::size_t asked = frame - skipped;
    path->frames.assign(splice.motion.poses.begin() + static_cast<std::ptrdiff_t>(asked) + 1,
                        splice.motion.poses.end());
    path->entered = splice.points.back().frame - asked;
    path->clip_frame = segments.back().first + 1;
    if (home_from == nullptr) {
      path->place = AlignOnFloor(clips[1].poses[segments.back().first], splice.wanted.front());
    }
  }
  path->clip = library_.WholeOf(to);
  path->record = record;
  return path;
}

PlayedClip PlayedOf(const Playback& playback, const DanceLibrary& library) {
  const ShownPath& path = *playback.path;
  PlayedClip played{.clip = path.clip, .frame = static_cast<double>(path.clip_frame), .in_transition = true};
  const double since = playback.path_frame - static_cast<double>(path.entered);
  if (since < 0) return played;
  const auto size = static_cast<double>(library.library().motions[path.clip].poses.size());
  const double frame = played.frame + since;
  return {.clip = path.clip,
          .frame = library.IsLoop(path.clip) ? std::fmod(frame, size) : std::min(frame, size - 1),
          .in_transition = false};
}

double DanceFrame(const Playback& playback, const DanceLibrary& library) {
  if (!playback.path) return playback.dance_frame;
  if (!library.IsReturning(playback.path->clip)) return -1;
  const PlayedClip played = PlayedOf(playback, library);
  return played.in_transition ? -1 : static_cast<double>(library.DanceFrameOf(played.clip)) + played.frame;
}

BodyPose ShownPose(const Playback& playback, const DanceLibrary& library) {
  if (!playback.path) return DancePose(library.dance(), playback.dance_frame);
  const auto frame = static_cast<std::size_t>(playback.path_frame);
  const double beyond = playback.path_frame - std::floor(playback.path_frame);
  const BodyPose pose = PathPose(playback, library, frame);
  return beyond > 0 ? PoseBetween(pose, PathPose(playback, library, frame + 1), beyond) : pose;
}

bool IsOver(const Playback& playback, const DanceLibrary& library, double before) {
  if (!playback.path) {
    constexpr double kRounding = 1e-6;  // tolerance for rounding errors that accumulate in `dance_frame`
    return playback.dance_frame + before + kRounding >= static_cast<double>(library.dance().motion.poses.size() - 1);
  }
  if (library.IsLoop(playback.path->clip)) return false;
  const PlayedClip played = PlayedOf(playback, library);
  const auto last = static_cast<double>(library.library().motions[played.clip].poses.size() - 1);
  return !played.in_transition && played.frame + before >= last;
}

bool IsSettled(const Playback& playback) {
  constexpr double kMaxJoinFrames = 30;
  if (!playback.path || playback.path->frames.empty()) return true;
  return playback.path_frame >= static_cast<double>(playback.path->entered) + kMaxJoinFrames;
}

void Advance(Playback& playback, const DanceLibrary& library, double rate) {
  if (!playback.path) {
    const auto last = static_cast<double>(library.dance().motion.poses.size() - 1);
    playback.dance_frame = std::min(playback.dance_frame + rate, last);
    return;
  }
  playback.path_frame += 1;
  if (!library.IsReturning(playback.path->clip) || !IsOver(playback, library, 1)) return;
  playback.dance_frame = DanceFrame(playback, library);
  playback.path = nullptr;
}

void LeaveFor(int clip, Playback& playback, const DanceTransitions& transitions) {
  const Leaving leaving = LeavingOf(playback, transitions.library());
  playback.path = transitions.Find(leaving.clip, leaving.frame, clip);
  // Frame 0 of the path is shown one frame after the last whole frame of the old clip. Subtract 1, because
  // Advance adds 1 before the next frame is shown.
  playback.path_frame = leaving.beyond - 1;
  playback.place = leaving.place;
}

void LeaveForHome(int clip, Playback& playback, const DanceTransitions& transitions) {
  const Leaving leaving = LeavingOf(playback, transitions.library());
  playback.path = transitions.FindHome(leaving.clip, leaving.frame, leaving.place, clip);
  playback.path_frame = leaving.beyond - 1;
  playback.place = {};
}

}  // namespace etude

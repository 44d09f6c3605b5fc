#include "engine/coaching/dance_transitions.h"

#include <algorithm>
#include <utility>

#include "engine/transitions/base/alignment.h"

namespace etude {
namespace {

/// The record's segments with the playing clip as clip 0, begun `skipped` frames later, and the wanted one as clip 1.
std::vector<Segment> Renumbered(const TransitionRecord& record, int from, int to, int skipped) {
  std::vector<Segment> segments = record.segments;
  for (Segment& segment : segments) {
    if (segment.clip == from) {
      segment.clip = 0;
      segment.first -= skipped;
      segment.last -= skipped;
    } else if (segment.clip == to) {
      segment.clip = 1;
    }
  }
  return segments;
}

ShownPath CutTo(const BodyPose& left, const BodyMotion& wanted, bool home) {
  ShownPath path;
  path.place = home ? FloorMove{} : AlignOnFloor(wanted.poses.front(), left);
  for (const BodyPose& pose : wanted.poses) path.frames.push_back(path.place.Apply(pose));
  return path;
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
  // All that a join looks back on is the frame before the request's.
  const int skipped = std::max(frame - 1, 0);
  std::vector<BodyMotion> clips(2);
  clips[0].rate_hz = motions[from].rate_hz;
  clips[0].poses.assign(motions[from].poses.begin() + skipped, motions[from].poses.end());
  clips[1] = motions[to];
  if (home_from != nullptr) {
    for (BodyPose& pose : clips[0].poses) pose = home_from->Apply(pose);
  }

  auto path = std::make_shared<ShownPath>();
  const auto record = Plan(from, frame, to);
  const bool arrives = !record->segments.empty() && record->segments.back().clip == to;
  if (!arrives) {
    *path = CutTo(clips[0].poses[frame - skipped], clips[1], home_from != nullptr);
  } else {
    std::vector<Segment> segments = Renumbered(*record, from, to, skipped);
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

}  // namespace etude

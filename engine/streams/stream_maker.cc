#include "engine/streams/stream_maker.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

using enum Role;

constexpr double kLongestGap = 0.2, kLongestLoss = 600, kSameTime = 5e-4;

bool ShowsBody(const RecordedFrame& frame) {
  return std::ranges::any_of(frame.places, [](const auto& place) { return place.has_value(); });
}

/// The frame `part` of the way between two; a joint that one of them lacks is missing.
RecordedFrame Between(const RecordedFrame& a, const RecordedFrame& b, double part) {
  RecordedFrame frame;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (!a.places[i] || !b.places[i]) continue;
    frame.places[i] = glm::mix(*a.places[i], *b.places[i], part);
    frame.states[i] = std::max(a.states[i], b.states[i]);
  }
  return frame;
}

}  // namespace

StreamMaker::StreamMaker(const StreamLevel& level, const StreamOptions& options, std::string file)
    : level_(level), options_(options), file_(std::move(file)) {}

SensedFrame StreamMaker::Sensed(const RecordedFrame& frame) {
  SensedFrame sensed;
  sensed.body_seen = ShowsBody(frame);
  for (const Role role : AllRoles()) {  // parents before their children
    SensedJoint& joint = sensed[role];
    auto& last = last_[Index(role)];
    if (const auto& place = frame.places[Index(role)]) {
      last = level_.Apply(*place);
      if (options_.reflects) last->x = -last->x;
      joint = {*last, frame.states[Index(role)]};
    } else if (last) {
      joint.position = *last;
    } else if (const auto parent = ParentOf(role)) {
      joint.position = sensed[*parent].position;
    }
  }
  return sensed;
}

Result<void> StreamMaker::Add(const RecordedFrame& frame, std::vector<SensedFrame>& stream) {
  if (!before_) {
    start_s_ = frame.time_s;
  } else if (frame.time_s <= before_->time_s || frame.time_s - before_->time_s > kLongestLoss) {
    return Fail({file_, frame.line},
                "time {:.6g} s after {:.6g} s; allowed: a clock that goes on, at most {} s at once", frame.time_s,
                before_->time_s, kLongestLoss);
  }
  for (;; ++next_) {
    const double time = start_s_ + static_cast<double>(next_) / options_.rate_hz;
    if (time > frame.time_s + kSameTime) break;
    if (time >= frame.time_s - kSameTime) {
      stream.push_back(Sensed(frame));
    } else if (before_ && time <= before_->time_s + kSameTime) {
      stream.push_back(Sensed(*before_));
    } else if (before_ && frame.time_s - before_->time_s <= kLongestGap) {
      const double part = (time - before_->time_s) / (frame.time_s - before_->time_s);
      stream.push_back(Sensed(Between(*before_, frame, part)));
    } else {
      stream.push_back(Sensed({}));
    }
  }
  before_ = frame;
  return {};
}

Result<MadeStream> MakeStream(const StreamRecording& recording, const std::string& file, const StreamOptions& options) {
  MadeStream made;
  made.stream.rate_hz = options.rate_hz;
  made.start_s = recording.frames.front().time_s;
  if (options.levels && !recording.is_level) made.level = EstimateLevel(recording.frames, recording.rate_hz);
  StreamMaker maker(made.level, options, file);
  for (const RecordedFrame& frame : recording.frames) RETURN_IF_ERROR(maker.Add(frame, made.stream.frames));
  made.lost_frames = static_cast<std::size_t>(
      std::ranges::count_if(made.stream.frames, [](const SensedFrame& frame) { return !frame.body_seen; }));
  return made;
}

std::optional<double> FeetForward(const SkeletonStream& stream) {
  double sum = 0;
  int feet = 0;
  for (const SensedFrame& frame : stream.frames) {
    if (!frame.body_seen) continue;
    const glm::dvec3 across = frame[kLeftHip].position - frame[kRightHip].position;
    const glm::dvec3 up = frame[kShoulderCentre].position - frame[kHipCentre].position;
    const glm::dvec3 forward = glm::cross(across, up);
    if (glm::length(forward) < 1e-6) continue;
    for (const auto& [ankle, toe] : {std::pair{kLeftAnkle, kLeftFoot}, std::pair{kRightAnkle, kRightFoot}}) {
      const glm::dvec3 foot = frame[toe].position - frame[ankle].position;
      const bool is_seen = frame[toe].state == TrackingState::kTracked && frame[ankle].state == TrackingState::kTracked;
      if (!is_seen || glm::length(foot) < 1e-6) continue;
      sum += glm::dot(glm::normalize(forward), glm::normalize(foot));
      ++feet;
    }
  }
  return feet > 0 ? std::optional(sum / feet) : std::nullopt;
}

}  // namespace etude

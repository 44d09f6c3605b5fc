#include "bench/tasks/sensing/camera_stream.h"

#include <algorithm>
#include <cassert>

#include "bench/tasks/capture/run.h"

namespace etude {
namespace {

CaptureWorld WorldOf(const CameraSensing& sensing, const BodyMotion& motion, const WorldKey& key) {
  assert(motion.rate_hz == kJudgedRateHz);
  const std::vector<BodyPose> places = PlacesAround(motion.poses.front());
  CaptureWorld world = MakeStudio(sensing.studio, MakeFilmedPerson(places, motion.poses.front(), motion.poses.size()), key);
  world.truth = motion.poses;
  world.in_view = FramesInView(world.cameras, world.truth);
  return world;
}

}  // namespace

std::vector<BodyPose> PlacesAround(const BodyPose& first) {
  constexpr double kAside = 0.5, kUp = 0.4;  // metres (Etude's choice): a step aside, and an arm raised above the head
  std::vector<BodyPose> places = {first};
  for (const glm::dvec3& way : {glm::dvec3(kAside, 0, 0), glm::dvec3(-kAside, 0, 0), glm::dvec3(0, 0, kAside),
                                glm::dvec3(0, 0, -kAside), glm::dvec3(0, kUp, 0)}) {
    BodyPose& place = places.emplace_back(first);
    for (glm::dvec3& joint : place.joints) joint += way;
  }
  return places;
}

FilmedPerson MakeFilmedPerson(std::span<const BodyPose> places, const BodyPose& first, std::size_t frames) {
  return {
      .poses = places, .body = RestBodyOf({&first, 1}), .lengths = MeasureLimbLengths({&first, 1}), .frames = frames};
}

SensedFrame SensedOf(const std::optional<RecoveredFrame>& recovered, const SensedFrame& last) {
  SensedFrame frame = last;
  frame.body_seen = recovered.has_value();
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (recovered) frame.joints[i].position = recovered->pose.joints[i];
    frame.joints[i].state = recovered ? TrackingState::kTracked : TrackingState::kNotTracked;
  }
  return frame;
}

CameraTake::CameraTake(const CameraSensing& sensing, const BodyMotion& motion, const WorldKey& key)
    : stages_(sensing.studio, WorldOf(sensing, motion, key), key, sensing.sources, /*keeps_masks=*/false) {}

const Result<SkeletonStream>& CameraTake::See(const CaptureMethod& method) {
  const auto known = std::ranges::find(seen_, method, [](const auto& seen) { return seen.first; });
  if (known != seen_.end()) return known->second;
  const auto run = RunCapture(stages_, method);
  if (!run) return seen_.emplace_back(method, tl::unexpected(run.error())).second;
  SkeletonStream stream;
  for (const auto& frame : run->frames) {
    stream.frames.push_back(SensedOf(frame, stream.frames.empty() ? SensedFrame{} : stream.frames.back()));
  }
  return seen_.emplace_back(method, std::move(stream)).second;
}

Result<std::unique_ptr<LiveSensor>> CameraSensor::Make(const StudioOptions& studio, const CaptureMethod& method,
                                                       const BodyPose& first, std::size_t frames, const WorldKey& key) {
  const std::vector<BodyPose> places = PlacesAround(first);
  ASSIGN_OR_RETURN(auto capture, LiveCapture::Begin(studio, method, MakeFilmedPerson(places, first, frames), key));
  return std::unique_ptr<LiveSensor>(new CameraSensor(std::move(capture)));
}

std::optional<SensedFrame> CameraSensor::Update(const BodyPose& pose) {
  capture_->Add(pose);
  if (++poses_ <= kAhead) return std::nullopt;
  last_ = SensedOf(capture_->Next(), last_);
  return last_;
}

}  // namespace etude

#include "bench/tasks/sensing/camera_sensor.h"

#include <utility>

#include "bench/tasks/sensing/camera_stream.h"

namespace etude {

Result<std::unique_ptr<LiveSensor>> CameraSensor::Make(const StudioOptions& studio, const CaptureMethod& method,
                                                       const BodyPose& first, std::size_t frames, const WorldKey& key) {
  const std::vector<BodyPose> places = PlacesAround(first);
  ASSIGN_OR_RETURN(auto capture, LiveCapture::Begin(studio, method, BookFor(places, first, frames), key));
  return std::unique_ptr<LiveSensor>(new CameraSensor(std::move(capture)));
}

std::optional<SensedFrame> CameraSensor::Update(const BodyPose& pose) {
  capture_->Add(pose);
  if (++poses_ <= kAhead) return std::nullopt;
  last_ = SensedOf(capture_->Next(), last_);
  return last_;
}

}  // namespace etude

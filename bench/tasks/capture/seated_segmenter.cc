#include "bench/tasks/capture/seated_segmenter.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/capture/coco.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

Result<Mask> ReadDetected(const Json& answer, const ColourImage& picture) {
  AnswerFields fields(answer);
  const Json* mask = fields.Raw("mask");
  RETURN_IF_ERROR(fields.Finish());
  if (mask == nullptr) return Fail({}, "mask: it is missing");
  return ReadCocoMask(*mask, "mask", picture.width, picture.height);
}

}  // namespace

void SeatedSegmenter::Begin(std::size_t camera, const ColourImage& background) {
  camera_ = camera + 1;
  frame_ = 0;
  const std::string name = fmt::format("camera-{}-background.ppm", camera_);
  Json session = {{"seat", "segmenter"}, {"camera", camera_}, {"background", name}};
  if (goes_on_) goes_on_ = program_.Begin(PayloadOf(std::move(session), {{name, EncodePpm(background)}}));
}

Mask SeatedSegmenter::Detect(const ColourImage& picture) {
  Mask changed(picture.width, picture.height);
  if (!goes_on_) return changed;
  const std::string name = fmt::format("camera-{}-{:04}.ppm", camera_, frame_++);
  const JsonPtr answer = program_.Step(PayloadOf({{"picture", name}}, {{name, EncodePpm(picture)}}));
  goes_on_ = answer != nullptr;
  if (!goes_on_) return changed;
  Result<Mask> detected = ReadDetected(*answer, picture);
  if (detected) return std::move(*detected);
  complaint_ = Fail({}, "of {}: {}", name, detected.error().message);
  goes_on_ = false;
  return changed;
}

}  // namespace etude

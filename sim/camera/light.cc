#include "sim/camera/light.h"

#include <algorithm>

#include "engine/base/image.h"

namespace etude {

const std::array<float, 256>& LightOfCodes() {
  static const std::array<float, 256> kLight = [] {
    std::array<float, 256> light;
    for (int code = 0; code < 256; ++code) {
      light[static_cast<std::size_t>(code)] = static_cast<float>(LinearOfSrgb(static_cast<std::uint8_t>(code)));
    }
    return light;
  }();
  return kLight;
}

CodeTable::CodeTable() {
  for (int i = 0; i < kSteps; ++i) {
    codes_[static_cast<std::size_t>(i)] = SrgbOfLinear(static_cast<double>(i) / (kSteps - 1));
  }
}

const CodeTable& CodeTable::Get() {
  static const CodeTable kTable;
  return kTable;
}

void DecodeRow(const Rgb8* codes, int pixels, Light* out) {
  const float* light = LightOfCodes().data();
  for (int x = 0; x < pixels; ++x) out[x] = {light[codes[x].r], light[codes[x].g], light[codes[x].b], 0};
}

void AddDecodedRow(const Rgb8* codes, int pixels, float share, Light* out) {
  const float* light = LightOfCodes().data();
  for (int x = 0; x < pixels; ++x) {
    out[x].r += share * light[codes[x].r];
    out[x].g += share * light[codes[x].g];
    out[x].b += share * light[codes[x].b];
  }
}

void EncodeRow(const Light* light, int pixels, Rgb8* out) {
  const CodeTable& codes = CodeTable::Get();
  // Convert block by block: first compute all indices with vector instructions, then look up the values.
  constexpr int kBlock = 64;
  std::array<std::int32_t, 4 * kBlock> steps;
  for (int first = 0; first < pixels; first += kBlock) {
    const int count = std::min(kBlock, pixels - first);
    const float* values = &light[first].r;
    for (int i = 0; i < 4 * count; ++i) steps[static_cast<std::size_t>(i)] = CodeTable::StepOf(values[i]);
    for (int x = 0; x < count; ++x) {
      const std::int32_t* step = steps.data() + 4 * x;
      out[first + x] = {codes.At(step[0]), codes.At(step[1]), codes.At(step[2])};
    }
  }
}

}  // namespace etude

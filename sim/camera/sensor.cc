#include "sim/camera/sensor.h"

namespace etude {
namespace {

void Disturb(const SensorNoise& noise, const float* normals, std::size_t count, float* values) {
  for (std::size_t i = 0; i < count; ++i) values[i] = Disturbed(noise, values[i], normals[i]);
}

}  // namespace

void Sensor::ReadColours(RandomStream& random, LightImage& light) const {
  const std::size_t width = static_cast<std::size_t>(light.width);
  const float* table = NormalRows::Table();
  NormalRows throws(random);
  std::vector<float> normals(4 * width);  // as light lies: the fourth of a pixel is nothing
  const float gains[] = {toning.red, toning.green, toning.blue, 1};
  for (int y = 0; y < light.height; ++y) {
    float* values = &light.At(0, y).r;
    if (transmission == nullptr) {
      for (std::size_t i = 0; i < 4 * width; ++i) values[i] *= toning.exposure;
    } else {
      const float* passes = &transmission->At(0, y);
      for (std::size_t x = 0; x < width; ++x) {
        for (std::size_t c = 0; c < 4; ++c) values[4 * x + c] *= toning.exposure * passes[x];
      }
    }
    if (!noise.IsNone()) {
      const std::uint16_t* places = throws.NextPlaces(3 * width);
      for (std::size_t x = 0; x < width; ++x) {
        for (std::size_t c = 0; c < 3; ++c) normals[4 * x + c] = table[places[3 * x + c]];
      }
      Disturb(noise, normals.data(), 4 * width, values);
    }
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 4; ++c) values[4 * x + c] *= gains[c];
    }
  }
}

void Sensor::ReadMosaic(const LightImage& light, RandomStream& random, Mosaic& out) const {
  const std::size_t width = static_cast<std::size_t>(light.width);
  const float* table = NormalRows::Table();
  NormalRows throws(random);
  std::vector<float> normals(width);
  for (int y = 0; y < light.height; ++y) {
    const Light* row = &light.At(0, y);
    float* values = &out.At(0, y);
    // The two colours of this row: in its even pixels, and in its odd ones.
    const bool red_row = (y & 1) == 0;
    for (std::size_t x = 0; x + 1 < width; x += 2) {
      values[x] = red_row ? row[x].r : row[x].g;
      values[x + 1] = red_row ? row[x + 1].g : row[x + 1].b;
    }
    if (width % 2 == 1) values[width - 1] = red_row ? row[width - 1].r : row[width - 1].g;
    if (transmission == nullptr) {
      for (std::size_t x = 0; x < width; ++x) values[x] *= toning.exposure;
    } else {
      const float* passes = &transmission->At(0, y);
      for (std::size_t x = 0; x < width; ++x) values[x] *= toning.exposure * passes[x];
    }
    if (!noise.IsNone()) {
      const std::uint16_t* places = throws.NextPlaces(3 * width);
      for (std::size_t x = 0; x < width; ++x) {
        normals[x] = table[places[3 * x + static_cast<std::size_t>(BayerColour(static_cast<int>(x), y))]];
      }
      Disturb(noise, normals.data(), width, values);
    }
    const float gains[] = {red_row ? toning.red : toning.green, red_row ? toning.green : toning.blue};
    if (gains[0] == 1 && gains[1] == 1) continue;
    for (std::size_t x = 0; x < width; ++x) values[x] *= gains[x & 1];
  }
}

}  // namespace etude

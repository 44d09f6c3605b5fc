#include "sim/camera/sensor.h"

namespace etude {
namespace {

void Disturb(const SensorNoise& noise, const float* normals, std::size_t count, float* values) {
  for (std::size_t i = 0; i < count; ++i) values[i] = Disturbed(noise, values[i], normals[i]);
}

}  // namespace

void Sensor::ReadColours(RandomStream& random, LightImage& light) const {
  const std::size_t width = static_cast<std::size_t>(light.width);
  NormalRows normals(random);
  std::vector<float> values(3 * width);
  for (int y = 0; y < light.height; ++y) {
    Light* row = &light.At(0, y);
    for (std::size_t x = 0; x < width; ++x) {
      const float share =
          transmission == nullptr ? toning.exposure : toning.exposure * transmission->At(static_cast<int>(x), y);
      values[3 * x] = row[x].r * share;
      values[3 * x + 1] = row[x].g * share;
      values[3 * x + 2] = row[x].b * share;
    }
    if (!noise.IsNone()) Disturb(noise, normals.Next(3 * width), 3 * width, values.data());
    for (std::size_t x = 0; x < width; ++x) {
      row[x] = {values[3 * x] * toning.red, values[3 * x + 1] * toning.green, values[3 * x + 2] * toning.blue, 0};
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

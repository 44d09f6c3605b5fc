#include "sim/camera/sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr int kTableBits = 10;
constexpr int kTableSize = 1 << kTableBits;
constexpr std::size_t kDrawsPerWord = 64 / kTableBits;
using NormalTable = std::array<float, kTableSize>;

// Returns the quantile of the standard normal distribution for a probability 0 < p < 1/2, by Newton's method. From the
// start value 0, the iteration descends the convex half of the distribution without overshooting.
double LowerQuantile(double probability) {
  double x = 0;
  for (int i = 0; i < 40; ++i) {
    const double below = 0.5 * std::erfc(-x / std::numbers::sqrt2);
    const double density = std::exp(-0.5 * x * x) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    x -= (below - probability) / density;
  }
  return x;
}

// Returns the medians of 1024 equally likely intervals of the standard normal distribution in ascending order, scaled
// up by 0.06 % to variance 1.
const NormalTable& Normals() {
  static const NormalTable kNormals = [] {
    std::array<double, kTableSize / 2> lower;
    double squares = 0;
    for (std::size_t i = 0; i < lower.size(); ++i) {
      lower[i] = LowerQuantile((static_cast<double>(i) + 0.5) / kTableSize);
      squares += lower[i] * lower[i];
    }
    const double stretch = 1 / std::sqrt(squares / lower.size());
    NormalTable table;
    for (std::size_t i = 0; i < lower.size(); ++i) {
      table[i] = static_cast<float>(stretch * lower[i]);
      table[kTableSize - 1 - i] = -table[i];
    }
    return table;
  }();
  return kNormals;
}

/// Copies a row and adds one mirrored pixel at either end: the pixel at index −1 equals the pixel at index 1.
void Pad(const float* row, int width, float* padded) {
  padded[0] = row[1];
  for (int x = 0; x < width; ++x) padded[x + 1] = row[x];
  padded[width + 1] = row[width - 2];
}

/// Three colours at a pixel: the row's own colour (red or blue), green, and the colour of the neighbouring rows.
struct Colours {
  float own, green, other;
};

/// Interpolates the three colours at a pixel that senses the row's own colour.
Colours AtOwn(const float* above, const float* here, const float* below) {
  return {here[0], 0.25f * ((here[-1] + here[1]) + (above[0] + below[0])),
          0.25f * ((above[-1] + above[1]) + (below[-1] + below[1]))};
}

/// Interpolates the three colours at a pixel that senses green.
Colours AtGreen(const float* above, const float* here, const float* below) {
  return {0.5f * (here[-1] + here[1]), here[0], 0.5f * (above[0] + below[0])};
}

template <bool kRedRow>
Light InOrder(const Colours& c) {
  return kRedRow ? Light{c.own, c.green, c.other, 0} : Light{c.other, c.green, c.own, 0};
}

template <bool kRedRow>
void DemosaicRow(const float* above, const float* here, const float* below, int width, Light* out) {
  // In a red row, the first pixel has the row's own colour; in a blue row, the first pixel is green.
  constexpr int kOwn = kRedRow ? 0 : 1;
  for (int x = kOwn; x < width; x += 2) out[x] = InOrder<kRedRow>(AtOwn(above + x, here + x, below + x));
  for (int x = 1 - kOwn; x < width; x += 2) out[x] = InOrder<kRedRow>(AtGreen(above + x, here + x, below + x));
}

void Disturb(const SensorNoise& noise, const float* normals, std::size_t count, float* values) {
  for (std::size_t i = 0; i < count; ++i) values[i] = Disturbed(noise, values[i], normals[i]);
}

}  // namespace

double AutomaticToning::Swing::At(double seconds) const { return std::sin(2 * kPi * seconds / period_s + phase); }

AutomaticToning::Swing AutomaticToning::DrawSwing(RandomStream& random) {
  const double period_s = random.Uniform(4, 10);
  return {period_s, random.Uniform(0, 2 * kPi)};
}

AutomaticToning::AutomaticToning(const CameraEffects& effects, RandomStream& exposure, RandomStream& white_balance)
    : effects_(effects), exposure_(DrawSwing(exposure)), white_balance_(DrawSwing(white_balance)) {}

Toning AutomaticToning::At(double seconds) const {
  const double stops = effects_.exposure_ev + effects_.exposure_drift_ev * exposure_.At(seconds);
  const double warmth = effects_.white_balance_ev + effects_.white_balance_drift_ev * white_balance_.At(seconds);
  return {.exposure = static_cast<float>(std::exp2(stops)),
          .red = static_cast<float>(std::exp2(warmth / 2)),
          .green = 1,
          .blue = static_cast<float>(std::exp2(-warmth / 2))};
}

SensorNoise WebcamNoise(double strength, double gain_db) {
  constexpr double kFullWellElectrons = 3000, kReadElectrons = 3;
  const double gain = std::pow(10.0, gain_db / 20);
  return {static_cast<float>(strength * gain * kReadElectrons / kFullWellElectrons),
          static_cast<float>(strength * std::sqrt(gain / kFullWellElectrons))};
}

const std::uint16_t* NormalRows::NextIndices(std::size_t count) {
  bits_.resize((count + kDrawsPerWord - 1) / kDrawsPerWord);
  indices_.resize(bits_.size() * kDrawsPerWord);
  random_.FillBits(bits_);
  std::uint16_t* out = indices_.data();
  for (const std::uint64_t bits : bits_) {
    for (std::size_t j = 0; j < kDrawsPerWord; ++j) {
      out[j] = static_cast<std::uint16_t>((bits >> (kTableBits * j)) & (kTableSize - 1));
    }
    out += kDrawsPerWord;
  }
  return indices_.data();
}

const float* NormalRows::Table() { return Normals().data(); }

const float* NormalRows::Next(std::size_t count) {
  const std::uint16_t* indices = NextIndices(count);
  const float* table = Normals().data();
  normals_.resize(count);
  for (std::size_t i = 0; i < count; ++i) normals_[i] = table[indices[i]];
  return normals_.data();
}

CodeNoise::CodeNoise(const SensorNoise& noise) : outcomes_(std::size_t{256} * kTableSize) {
  const CodeTable& code_of = CodeTable::Get();
  // For each of the 256 codes, tabulate the noisy code for every normal number.
  for (int code = 0; code < 256; ++code) {
    const float light = LightOfCodes()[static_cast<std::size_t>(code)];
    std::uint8_t* outcome = outcomes_.data() + static_cast<std::size_t>(code) * kTableSize;
    const auto at = [&](float normal) { return code_of(Disturbed(noise, light, normal)); };
    // Outcomes increase with the normal number, so fill whole runs of equal values at once.
    const NormalTable& table = Normals();
    for (auto from = table.begin(); from != table.end();) {
      const std::uint8_t value = at(*from);
      const auto to = std::partition_point(from, table.end(), [&](float normal) { return at(normal) <= value; });
      std::fill(outcome + (from - table.begin()), outcome + (to - table.begin()), value);
      from = to;
    }
  }
}

void CodeNoise::Apply(RandomStream& random, ColourImage& picture) const {
  static_assert(sizeof(Rgb8) == 3, "a picture is written as bytes of its colours");
  NormalRows normals(random);
  const std::size_t values = 3 * static_cast<std::size_t>(picture.width);
  std::uint8_t* code = reinterpret_cast<std::uint8_t*>(picture.pixels.data());
  for (int y = 0; y < picture.height; ++y) {
    const std::uint16_t* index = normals.NextIndices(values);
    for (std::size_t i = 0; i < values; ++i) code[i] = outcomes_[std::size_t{code[i]} * kTableSize + index[i]];
    code += values;
  }
}

void Demosaic(const Mosaic& mosaic, LightImage& out) {
  // Keep three padded rows of the mosaic in a ring.
  const int width = mosaic.width, height = mosaic.height;
  const std::size_t stride = static_cast<std::size_t>(width) + 2;
  std::vector<float> rows(3 * stride);
  const auto padded = [&](int y) { return rows.data() + static_cast<std::size_t>((y + 3) % 3) * stride; };
  const auto mirrored = [&](int y) { return y < 0 ? 1 : y >= height ? height - 2 : y; };
  for (const int y : {-1, 0}) Pad(&mosaic.At(0, mirrored(y)), width, padded(y));
  for (int y = 0; y < height; ++y) {
    Pad(&mosaic.At(0, mirrored(y + 1)), width, padded(y + 1));
    const float *above = padded(y - 1) + 1, *here = padded(y) + 1, *below = padded(y + 1) + 1;
    if (y % 2 == 0) {
      DemosaicRow<true>(above, here, below, width, &out.At(0, y));
    } else {
      DemosaicRow<false>(above, here, below, width, &out.At(0, y));
    }
  }
}

void Sensor::ReadColours(RandomStream& random, LightImage& light) const {
  const std::size_t width = static_cast<std::size_t>(light.width);
  const float* table = NormalRows::Table();
  NormalRows numbers(random);
  std::vector<float> normals(4 * width);  // four numbers per pixel, like the light; the fourth is unused
  const float gains[] = {toning.red, toning.green, toning.blue, 1};
  for (int y = 0; y < light.height; ++y) {
    // Compute the light that reaches the sensor.
    float* values = &light.At(0, y).r;
    if (transmission == nullptr) {
      for (std::size_t i = 0; i < 4 * width; ++i) values[i] *= toning.exposure;
    } else {
      const float* passes = &transmission->At(0, y);
      for (std::size_t x = 0; x < width; ++x) {
        for (std::size_t c = 0; c < 4; ++c) values[4 * x + c] *= toning.exposure * passes[x];
      }
    }
    // Add noise.
    if (!noise.IsNone()) {
      const std::uint16_t* indices = numbers.NextIndices(3 * width);
      for (std::size_t x = 0; x < width; ++x) {
        for (std::size_t c = 0; c < 3; ++c) normals[4 * x + c] = table[indices[3 * x + c]];
      }
      Disturb(noise, normals.data(), 4 * width, values);
    }
    // Apply the gains of the white balance.
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 4; ++c) values[4 * x + c] *= gains[c];
    }
  }
}

void Sensor::ReadMosaic(const LightImage& light, RandomStream& random, Mosaic& out) const {
  const std::size_t width = static_cast<std::size_t>(light.width);
  const float* table = NormalRows::Table();
  NormalRows numbers(random);
  std::vector<float> normals(width);
  for (int y = 0; y < light.height; ++y) {
    const Light* row = &light.At(0, y);
    float* values = &out.At(0, y);
    // Take the row's two colours, from its even and its odd pixels.
    const bool red_row = (y & 1) == 0;
    for (std::size_t x = 0; x + 1 < width; x += 2) {
      values[x] = red_row ? row[x].r : row[x].g;
      values[x + 1] = red_row ? row[x + 1].g : row[x + 1].b;
    }
    if (width % 2 == 1) values[width - 1] = red_row ? row[width - 1].r : row[width - 1].g;
    // Compute the light that reaches the sensor.
    if (transmission == nullptr) {
      for (std::size_t x = 0; x < width; ++x) values[x] *= toning.exposure;
    } else {
      const float* passes = &transmission->At(0, y);
      for (std::size_t x = 0; x < width; ++x) values[x] *= toning.exposure * passes[x];
    }
    // Add noise.
    if (!noise.IsNone()) {
      const std::uint16_t* indices = numbers.NextIndices(3 * width);
      for (std::size_t x = 0; x < width; ++x) {
        normals[x] = table[indices[3 * x + static_cast<std::size_t>(BayerColour(static_cast<int>(x), y))]];
      }
      Disturb(noise, normals.data(), width, values);
    }
    // Apply the gains of the white balance.
    const float gains[] = {red_row ? toning.red : toning.green, red_row ? toning.green : toning.blue};
    if (gains[0] == 1 && gains[1] == 1) continue;
    for (std::size_t x = 0; x < width; ++x) values[x] *= gains[x & 1];
  }
}

}  // namespace etude

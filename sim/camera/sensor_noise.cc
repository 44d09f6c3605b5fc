#include "sim/camera/sensor_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace etude {
namespace {

constexpr int kTableBits = 10;
constexpr int kTableSize = 1 << kTableBits;
constexpr std::size_t kDrawsPerWord = 64 / kTableBits;
using NormalTable = std::array<float, kTableSize>;

// The x below which a standard normal falls with this probability (0 < p < 1/2): Newton's method, which
// from 0 walks down the convex half of the distribution without overshooting.
double LowerQuantile(double probability) {
  double x = 0;
  for (int i = 0; i < 40; ++i) {
    const double below = 0.5 * std::erfc(-x / std::numbers::sqrt2);
    const double density = std::exp(-0.5 * x * x) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    x -= (below - probability) / density;
  }
  return x;
}

// The middle of each of 1024 equally likely slices of the standard normal, in rising order, stretched by 0.06 % so that
// their variance is 1.
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

}  // namespace

SensorNoise WebcamNoise(double strength, double gain_db) {
  constexpr double kFullWellElectrons = 3000, kReadElectrons = 3;
  const double gain = std::pow(10.0, gain_db / 20);
  return {static_cast<float>(strength * gain * kReadElectrons / kFullWellElectrons),
          static_cast<float>(strength * std::sqrt(gain / kFullWellElectrons))};
}

const std::uint16_t* NormalRows::NextPlaces(std::size_t count) {
  bits_.resize((count + kDrawsPerWord - 1) / kDrawsPerWord);
  places_.resize(bits_.size() * kDrawsPerWord);
  random_.FillBits(bits_);
  std::uint16_t* out = places_.data();
  for (const std::uint64_t bits : bits_) {
    for (std::size_t j = 0; j < kDrawsPerWord; ++j) {
      out[j] = static_cast<std::uint16_t>((bits >> (kTableBits * j)) & (kTableSize - 1));
    }
    out += kDrawsPerWord;
  }
  return places_.data();
}

const float* NormalRows::Table() { return Normals().data(); }

const float* NormalRows::Next(std::size_t count) {
  const std::uint16_t* places = NextPlaces(count);
  const float* table = Normals().data();
  normals_.resize(count);
  for (std::size_t i = 0; i < count; ++i) normals_[i] = table[places[i]];
  return normals_.data();
}

CodeNoise::CodeNoise(const SensorNoise& noise) : outcomes_(std::size_t{256} * kTableSize) {
  const CodeTable& code_of = CodeTable::Get();
  for (int code = 0; code < 256; ++code) {
    const float light = LightOfCodes()[static_cast<std::size_t>(code)];
    std::uint8_t* outcome = outcomes_.data() + static_cast<std::size_t>(code) * kTableSize;
    const auto at = [&](float normal) { return code_of(Disturbed(noise, light, normal)); };
    // Outcomes rise with the normal: whole runs are filled at once.
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
  static_assert(sizeof(Rgb8) == 3, "a picture's bytes are its colours");
  NormalRows normals(random);
  const std::size_t values = 3 * static_cast<std::size_t>(picture.width);
  std::uint8_t* code = reinterpret_cast<std::uint8_t*>(picture.pixels.data());
  for (int y = 0; y < picture.height; ++y) {
    const std::uint16_t* place = normals.NextPlaces(values);
    for (std::size_t i = 0; i < values; ++i) code[i] = outcomes_[std::size_t{code[i]} * kTableSize + place[i]];
    code += values;
  }
}

}  // namespace etude

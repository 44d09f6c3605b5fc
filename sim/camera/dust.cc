#include "sim/camera/dust.h"

#include <algorithm>

namespace etude {

std::vector<Speck> ThrowSpecks(int width, int height, RandomStream& random) {
  constexpr int kSpecks = 10;
  std::vector<Speck> specks;
  for (int i = 0; i < kSpecks; ++i) {
    const double x = random.Uniform(0, width), y = random.Uniform(0, height);
    specks.push_back({x, y, random.Uniform(2, 6)});
  }
  return specks;
}

void AddDust(const std::vector<Speck>& specks, double strength, Transmission& transmission) {
  constexpr double kReach = 6;  // radii, beyond which a shadow is below a thousandth
  for (const Speck& speck : specks) {
    const int left = std::max(0, static_cast<int>(speck.x - kReach * speck.radius));
    const int top = std::max(0, static_cast<int>(speck.y - kReach * speck.radius));
    const int right = std::min(transmission.width, static_cast<int>(speck.x + kReach * speck.radius) + 1);
    const int bottom = std::min(transmission.height, static_cast<int>(speck.y + kReach * speck.radius) + 1);
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const double dx = x + 0.5 - speck.x, dy = y + 0.5 - speck.y;
        const double share = (dx * dx + dy * dy) / (speck.radius * speck.radius);
        transmission.At(x, y) *= static_cast<float>(1 - strength / (1 + share * share));
      }
    }
  }
}

}  // namespace etude

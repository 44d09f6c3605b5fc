#include "engine/capture/clock_search.h"

#include <algorithm>
#include <cstdlib>

namespace etude {
namespace {

/// Where the parabola is lowest that fits the misfits about a whole frame best, and by how much lower than there.
struct Lowest {
  double shift = 0;  ///< from that frame
  double gain = 0;
};

std::optional<Lowest> LowestAbout(const std::function<std::optional<double>(int offset)>& misfit, int frame) {
  constexpr int kReach = 2;  // frames: further away misfits are no parabola any more, nearer errors weigh more
  double count = 0, x2 = 0, x4 = 0, f = 0, xf = 0, x2f = 0;
  for (int x = -kReach; x <= kReach; ++x) {
    const std::optional<double> here = misfit(frame + x);
    if (!here) return std::nullopt;
    count += 1, x2 += x * x, x4 += x * x * x * x;
    f += *here, xf += x * *here, x2f += x * x * *here;
  }
  const double bend = (count * x2f - x2 * f) / (count * x4 - x2 * x2), slope = xf / x2;
  if (!(bend > 0)) return std::nullopt;
  const double shift = std::clamp(-0.5 * slope / bend, -1.0, 1.0);
  return Lowest{shift, bend * shift * shift};
}

}  // namespace

ClockOffset FindOffset(const std::function<std::optional<double>(int offset)>& misfit, int most_frames) {
  const std::optional<double> assumed = misfit(0);
  if (!assumed) return {};
  int best = 0, asked = 0;
  double least = *assumed, sum = 0;
  for (int offset = -most_frames; offset <= most_frames; ++offset) {
    const std::optional<double> here = misfit(offset);
    if (!here) continue;
    sum += *here;
    ++asked;
    if (*here >= least) continue;
    least = *here;
    best = offset;
  }
  const Lowest lowest = LowestAbout(misfit, best).value_or(Lowest{});
  // As good as none: nobody moved.
  constexpr double kNoBetter = 0.001, kNothing = 1e-4;  // a share; pixels squared
  constexpr double kTold = 1.25;                        // noise alone stays below, where 300 distances or more are had
  const bool is_better = *assumed - least + lowest.gain > kNothing + kNoBetter * *assumed;
  const bool is_told = std::abs(best) < most_frames && sum / asked > kNothing + kTold * (least - lowest.gain);
  return {is_better ? best + lowest.shift : 0, is_told};
}

SomePixel PixelBetween(const SomePixel& a, const SomePixel& b, const SomePixel& c, const SomePixel& d, double share) {
  if (!b || (share > 0 && !c)) return std::nullopt;
  if (share == 0) return b;
  if (!a || !d) return (1 - share) * *b + share * *c;
  const double t = share, u = 1 - t;
  return u * u * (1 + 2 * t) * *b + t * t * (3 - 2 * t) * *c + 0.5 * t * u * u * (*c - *a) -
         0.5 * t * t * u * (*d - *b);
}

}  // namespace etude

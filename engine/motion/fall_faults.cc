#include <algorithm>
#include <vector>

#include "engine/motion/fault_limits.h"
#include "engine/motion/ground_faults.h"
#include "engine/motion/parabola.h"
#include "engine/motion/support.h"

namespace etude {
namespace {

/// A flight: the downward acceleration of the centre of mass, metres per second², and the height of its arc, metres.
struct Flight {
  FrameRange frames;
  double fall = 0, sag = 0;
};

/// Returns the flights that take off, land and follow a parabola.
std::vector<Flight> FindFlights(const GroundView& ground) {
  constexpr double kClear = 0.03, kMinClearance = 0.04, kMaxSeconds = 2, kMinSag = 0.02;
  constexpr double kMaxStray = 0.1, kMinFall = 1.2, kMinUpright = 0.5;
  constexpr int kMinFrames = 3, kEnoughFrames = 5;
  // Mark frames in which all feet have left the floor and no other joint is near the floor.
  std::vector<bool> is_clear(ground.frames());
  for (int f = 0; f < ground.frames(); ++f) is_clear[f] = ground.FootHeight(f) > kClear && ground.IsOnFeet(f);
  // Fit the height of the centre of mass in each flight.
  std::vector<Flight> flights;
  for (const FrameRange& span : RangesOf(is_clear)) {
    const int count = span.last - span.first + 1;
    if (span.first == 0 || span.last == ground.frames() - 1 || count < kMinFrames) continue;
    if (ground.Seconds(span) > kMaxSeconds || ground.UprightShare(span) < kMinUpright) continue;
    const int more = count < kEnoughFrames ? 1 : 0;
    std::vector<double> heights;
    double clearance = 0;
    for (int f = span.first - more; f <= span.last + more; ++f) {
      heights.push_back(MassCentre(ground.motion().poses[f]).y - ground.Offset(f).y);
      clearance = std::max(clearance, ground.FootHeight(f));
    }
    const Parabola fit = FitParabola(heights, ground.motion().rate_hz);
    const double sag = fit.fall * ground.Seconds(span) * ground.Seconds(span) / 8;
    if (sag < kMinSag || fit.stray > kMaxStray * sag || clearance < kMinClearance || fit.fall < kMinFall) continue;
    flights.push_back({span, fit.fall, sag});
  }
  return flights;
}

}  // namespace

void FindFalls(const GroundView& ground, std::vector<MotionFault>& faults) {
  constexpr double kHalf = 0.5;
  std::vector<Flight> flights = FindFlights(ground);
  if (flights.empty()) return;
  // Take the weighted median of the accelerations. A flight's weight is the height of its arc, because long flights are
  // measured best.
  std::ranges::stable_sort(flights, {}, &Flight::fall);
  double whole = 0, sum = 0;
  for (const Flight& flight : flights) whole += flight.sag;
  const auto middle = std::ranges::find_if(flights, [&](const Flight& flight) {
    sum += flight.sag;
    return sum >= kHalf * whole;
  });
  if (middle->fall < fault_limits::kGravity * fault_limits::kGravityFactor &&
      middle->fall > fault_limits::kGravity / fault_limits::kGravityFactor)
    return;
  faults.push_back(ground.FaultOf(FaultKind::kRate, middle->frames, middle->fall));
}

}  // namespace etude

#include "engine/kinematics/solvers/hinge_gain.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {

double HingeGain::At(double phi) const {
  const double c = std::cos(phi);
  return k1 * (1 - c) + k2 * c + k3 * std::sin(phi);
}

double HingeGain::Optimum() const {
  if (k3 == 0 && k2 == k1) return 0;
  return std::atan2(k3, k2 - k1);
}

double HingeGain::OptimumWithin(const AngleRange& range) const {
  if (k3 == 0 && k2 == k1) return 0;
  const double best = Optimum();
  for (const double phi : {best, best - 2 * kPi, best + 2 * kPi}) {
    if (phi >= range.lower && phi <= range.upper) return phi;
  }
  return At(range.upper) > At(range.lower) ? range.upper : range.lower;
}

}  // namespace etude

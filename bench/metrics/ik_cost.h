#pragma once

namespace etude {

/// What a solver's work on one world counts for (`iterations_par2`, `fk_evaluations_par2`): what it spent where it
/// solved the world within the limit, else twice the limit. The mean over worlds is PAR-2, the penalised average of
/// solver competitions: it sees unsolved worlds, which a mean over solved ones would reward.
constexpr double PenalisedCost(double spent, double limit, bool solved) {
  return solved && spent <= limit ? spent : 2 * limit;
}

}  // namespace etude

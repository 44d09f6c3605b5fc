#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct CcdAndersonOptions {
  /// How many former sweeps the extrapolation uses. Five: of 200 starts off by 15° (poses of the joints' whole ranges)
  /// it solves 97 % to 10⁻³ cm and 10⁻³° in 186 sweeps on average; one solves 55 % in 707, three 96.5 % in 198, twelve
  /// 98 % in 154. Raise it where a sweep costs much more than mixing, which grows with its square.
  int memory = 5;
};

/// *Ours*: the sweeps of `ccd-hinges`, extrapolated (anderson_mixing.h) from the last of them. Paper B settles one
/// joint after the other, so that errors creep along the limbs, which can be extrapolated. An angle enters
/// as x = tan((q − middle of its range) / 2), which costs no trigonometry. An extrapolation that raises
/// Σ w_p e² + Σ w_o |u_c − u_d|², by the weights of its sweep, is dropped for what the sweep itself found. One
/// iteration is one sweep; it costs one forward-kinematics pass, or two when its extrapolation was dropped.
IkSolution SolveCcdAnderson(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const CcdAndersonOptions& own = {});

}  // namespace etude

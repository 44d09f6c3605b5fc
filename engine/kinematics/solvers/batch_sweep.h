#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

enum class Precision { kFloat, kDouble };

/// What an iteration in floats may still move when it has arrived, radians: the last bit of an angle.
inline constexpr double kFloatStall = 2e-7;

/// Solves many problems on the same tree at once, one in each lane of the CPU's vectors, by the sweeps of `ccd-hinges`.
/// Lanes whose problem is done take the next one. What comes out does not depend on the width of the CPU's vectors, nor
/// on the other problems (into lanes and out of them angles go through the C library, whose sines are the same on all
/// CPUs in the environment that `etude` gives itself):
/// - `kDouble`: every solution is that of `SolveCcdHinges`, to the last bit.
/// - `kFloat`: twice as many lanes. Whether goals are met is judged in double all the same. Goals of 10⁻³ cm and 10⁻³
///   degrees are met in as many sweeps as in double; 10⁻⁴ often are not. Stalled when no angle moves further than
///   floats can tell, 2·10⁻⁷ radians.
/// A bad problem answers kBadInput for itself; so does every problem when the options are bad or
/// `MomentSweep::CanServe` says no (weights `wang-chen`, or adaptive ones refreshed within a sweep).
std::vector<IkSolution> SolveCcdBatch(const KinematicTree& tree, std::span<const IkProblem> problems,
                                      const IkOptions& options, Precision precision);

/// The kinds of vectors that batches can use on this CPU, the widest first. For tests and benchmarks.
std::vector<std::string> BatchTargets();
/// From now on batches use this one of `BatchTargets`; the empty name: the widest. For tests and benchmarks: results
/// are the same.
void SetBatchTarget(std::string_view name);

}  // namespace etude

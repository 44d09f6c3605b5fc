#pragma once

#include "bench/training/genetic_search.h"
#include "engine/fuzzy/membership.h"

namespace etude {

/// How far a breakpoint may move from where it was, as a share of its feature's universe.
constexpr double kBreakpointReach = 0.2;

/// How many genes the memberships have: one per breakpoint within the universe of the triangular and trapezoidal
/// shapes. Breakpoints at its ends stay there, so that shoulders stay shoulders; left and right limbs share theirs;
/// Gaussian and singleton shapes stay as they are.
std::size_t CountMembershipGenes(const Memberships& start);

/// The memberships that genes in [0, 1] stand for: every breakpoint of `start` moved by (2 gene − 1) reaches, and each
/// shape's put back into rising order. All genes ½ is `start`.
Memberships MembershipsOfGenes(const Memberships& start, std::span<const double> genes);

}  // namespace etude

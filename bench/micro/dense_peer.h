#pragma once

#include <memory>

#include "bench/micro/ik_peer.h"

namespace etude {

/// Levenberg–Marquardt as `levenberg-marquardt` does it, with an active set and the same restarts, but written for
/// speed alone: lists of fixed sizes, no check of its input, no record of its way, and compiled with flags of its own
/// (`DensePeerFlags`). For trees of at most 32 angles and 4 effectors whose axes weigh alike.
std::unique_ptr<IkPeer> MakeDensePeer(const KinematicTree& tree);

const char* DensePeerFlags();

}  // namespace etude

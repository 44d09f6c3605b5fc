#pragma once

#include <memory>

#include "bench/micro/ik_peer.h"
#include "bench/micro/simbody_model.h"

namespace etude {

/// Simbody's Assembler with a marker and an orientation sensor at every effector, limits by `restrictQ`.
std::unique_ptr<IkPeer> MakeSimbodyAssembler(const KinematicTree& tree, const SimbodySettings& settings);

}  // namespace etude

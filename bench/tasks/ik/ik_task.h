#pragma once

#include "bench/tasks/base/task.h"

namespace etude {

/// Inverse kinematics on paper B's body: how near do the end effectors come to their targets, and how far do the hidden
/// angles stray, from a disturbed pose (paper B, chapter 5)?
TaskKind MakeIkTaskKind();

}  // namespace etude

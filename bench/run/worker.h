#pragma once

#include <iosfwd>

namespace etude {

/// What a worker says once its set-up is done, and before it is given a world.
constexpr const char* kWorkerReady = "ready";

/// The whole life of a worker process (`etude worker`): one line of set-up, answered by kWorkerReady, then
/// one line per world, `[scenario, condition, trial]`, each answered by one line
/// `{"world": […], "cells": […], "wall_s": …, "cpu_s": …}`. Ends when `in` does. Returns the exit code;
/// 2 when it is told something that it cannot understand.
int RunWorker(std::istream& in, std::ostream& out);

}  // namespace etude

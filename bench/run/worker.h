#pragma once

#include <iosfwd>

namespace etude {

/// The whole life of a worker process (`etude worker`): one line of set-up, then one line per world,
/// `[scenario, condition, trial]`, each answered by one line
/// `{"world": […], "cells": […], "wall_s": …, "cpu_s": …}`. Ends when `in` does. Returns the exit code;
/// 2 when the set-up cannot be understood.
int RunWorker(std::istream& in, std::ostream& out);

}  // namespace etude

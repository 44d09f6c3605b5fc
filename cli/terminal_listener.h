#pragma once

#include "tools/listener.h"

namespace etude {

/// Returns a listener that prints to standard output and shows progress on standard error. With this listener, Ctrl-C
/// stops the writing of a film.
Listener TerminalListener();

}  // namespace etude

#pragma once

#include "tools/listener.h"

namespace etude {

/// Returns a listener that prints to standard output, shows progress on standard error, and lets Ctrl-C stop a film.
Listener TerminalListener();

}  // namespace etude

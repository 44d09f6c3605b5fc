#include "cli/terminal_listener.h"

#include <fmt/core.h>

#include "cli/interrupt.h"
#include "cli/progress_bar.h"

namespace etude {

Listener TerminalListener() {
  Listener listener;
  listener.print = [](const std::string& text) { fmt::print("{}", text); };
  listener.progress = [](std::string what) { return ProgressOf(std::move(what)); };
  listener.film = [](const std::function<Result<bool>(const FilmWatch& watch)>& write) {
    const Interrupt interrupt;
    return UnlessInterrupted(write(WatchFilms(interrupt)), interrupt);
  };
  return listener;
}

}  // namespace etude

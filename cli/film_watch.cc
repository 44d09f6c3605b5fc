#include "cli/film_watch.h"

#include "cli/progress_bar.h"

namespace etude {

FilmWatch WatchFilms(const Interrupt& interrupt) {
  const auto tell = [of = std::string(), tell = OnProgress()](const std::string& file, std::size_t done,
                                                              std::size_t frames) mutable {
    if (file != of) tell = TellOf("frames of " + file);
    of = file;
    tell(done, frames);
  };
  return {.progress = tell, .stop = interrupt.requested()};
}

}  // namespace etude

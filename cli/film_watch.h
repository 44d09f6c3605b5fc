#pragma once

#include "cli/interrupt.h"
#include "reports/films/film.h"

namespace etude {

/// Tells of each film how many of its frames are drawn; Ctrl-C ends them.
FilmWatch WatchFilms(const Interrupt& interrupt);

}  // namespace etude

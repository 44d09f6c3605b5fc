#pragma once

#include <string>

#include "reports/films/media.h"

namespace etude {

/// <img> with the picture inside the page.
std::string ImageElement(const Picture& picture);

/// A <figure> with the still and its caption.
std::string StillElement(const Still& still);

/// A film inside the page with its caption: a <figure> with <video>, else its poster and why there is no film, else
/// that reason alone, if there is any.
std::string FilmElement(const Film& film, bool plays_at_once);

}  // namespace etude

#include "engine/coaching/coach_record.h"

#include <array>

namespace etude {

std::string_view EventName(CoachEvent event) {
  constexpr std::array<std::string_view, 15> kNames = {"woken",    "song begins", "right",     "wrong",    "unjudged",
                                                       "corrects", "shows",       "returns",   "goes on",  "praises",
                                                       "tag",      "transition",  "song ends", "attracts", "dozes"};
  return kNames[static_cast<std::size_t>(event)];
}

std::string_view MistakeName(Mistake mistake) {
  constexpr std::array<std::string_view, 4> kNames = {"none", "not reached", "stood still", "wrong side"};
  return kNames[static_cast<std::size_t>(mistake)];
}

}  // namespace etude

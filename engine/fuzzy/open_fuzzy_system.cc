#include "engine/fuzzy/open_fuzzy_system.h"

namespace etude {

Result<FuzzySystem> OpenFuzzySystem(const std::string& reference, const Place& asked_at, const FuzzyTextOf& text_of) {
  if (reference.starts_with(kBuiltinFuzzySystem)) {
    return LoadBuiltinFuzzySystem(reference.substr(kBuiltinFuzzySystem.size()), asked_at);
  }
  ASSIGN_OR_RETURN(const auto text, text_of(reference));
  return ReadFuzzySystem(text, reference);
}

}  // namespace etude

#include "bench/training/training_clips.h"

#include <algorithm>

#include "sim/choreography/move.h"

namespace etude {

std::string MoveIdentity(const std::string& move) { return "builtin:" + move; }

Result<TrainingClips> GatherTrainingClips(const MotionLibrary& library, const std::vector<std::string>& identities,
                                          const TagRules& rules) {
  TrainingClips training;
  std::vector<BodyMotion> clips;
  for (const std::string& name : BuiltinMoveNames()) {
    auto move = LoadBuiltinMove(name);
    if (!move) return tl::unexpected(move.error());
    training.identities.push_back(MoveIdentity(name));
    clips.push_back(std::move(move->motion));
  }
  for (std::size_t i = 0; i < identities.size(); ++i) {
    const auto& known = training.identities;
    if (std::find(known.begin(), known.end(), identities[i]) != known.end()) continue;
    training.identities.push_back(identities[i]);
    clips.push_back(library.motions[i]);
  }
  training.library = MakeLibrary(training.identities, clips, library.physique, rules);
  return training;
}

}  // namespace etude

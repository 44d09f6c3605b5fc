#include "bench/clips/builtin_clip.h"

#include <algorithm>
#include <vector>

#include "engine/base/names.h"
#include "sim/choreography/song.h"

namespace etude {

Result<BuiltinClip> LoadBuiltinClip(const std::string& name, const Place& place) {
  const std::vector<std::string> songs = BuiltinSongNames();
  if (std::ranges::find(songs, name) != songs.end()) {
    auto song = LoadBuiltinSong(name);
    if (!song) return Fail(place, "{}", song.error().message);
    return BuiltinClip{std::move(song->motion), std::nullopt};
  }
  auto move = LoadBuiltinMove(name);
  if (!move) {
    // It knows moves and acts, and their near misses; a song's name may have been meant as well.
    const std::string nearest = NearestName(name, songs);
    return Fail(place, "{}; songs: {}{}", move.error().message, Join(songs),
                nearest.empty() ? "" : " (did you mean '" + nearest + "'?)");
  }
  BuiltinClip clip{move->motion, std::nullopt};
  if (!move->key_poses.empty()) clip.move = std::move(*move);
  return clip;
}

}  // namespace etude

#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace etude {

/// How whoever waits for films hears of them, and says that they are not wanted any more.
struct FilmWatch {
  std::function<void(const std::string& file, std::size_t done, std::size_t frames)> progress = {};
  const std::atomic<bool>* stop = nullptr;

  void Tell(const std::filesystem::path& film, std::size_t done, std::size_t frames) const {
    if (progress) progress(film.filename().string(), done, frames);
  }
  bool IsStopped() const { return stop != nullptr && *stop; }
};

}  // namespace etude

#include "bench/dataset/take_films.h"

#include <algorithm>
#include <optional>
#include <string>

#include "io/films/encoder.h"
#include "io/images/image_files.h"
#include "sim/render/scene.h"

namespace etude {
namespace {

/// Returns the take to which a picture's file belongs: "camera-1" for "camera-1-0042.png". Returns "" for other names.
std::string_view TakeOf(std::string_view name) {
  constexpr std::string_view kForm = "-0000.png";
  if (name.size() <= kForm.size()) return {};
  const std::string_view end = name.substr(name.size() - kForm.size());
  const auto fits = [](char form, char c) { return form == '0' ? c >= '0' && c <= '9' : form == c; };
  return std::ranges::equal(kForm, end, fits) ? name.substr(0, name.size() - kForm.size()) : std::string_view{};
}

}  // namespace

bool IsPictureOfTake(std::string_view name) { return !TakeOf(name).empty(); }

Result<void> SaveTakeFilms(std::span<const Attachment> files, double rate_hz, const FilePath& folder) {
  std::optional<Encoder> film;
  std::string_view filmed;
  for (const Attachment& file : files) {
    const std::string_view take = TakeOf(file.name);
    if (take.empty()) continue;
    constexpr std::size_t kMaxPixels = std::size_t{kMaxPictureSide} * kMaxPictureSide;
    ASSIGN_OR_RETURN(const auto picture, DecodeColourPng(file.bytes, kMaxPixels));
    if (!film || take != filmed) {
      if (film) RETURN_IF_ERROR(film->Finish());
      const FilePath path = folder / (std::string(take) + ".mkv");
      ASSIGN_OR_RETURN(auto started,
                       Encoder::Start(path, picture.width, picture.height, rate_hz, {}, Encoder::Form::kExactRgb));
      film.emplace(std::move(started));
      filmed = take;
    }
    RETURN_IF_ERROR(film->Add(picture));
  }
  return film ? film->Finish() : Result<void>{};
}

}  // namespace etude

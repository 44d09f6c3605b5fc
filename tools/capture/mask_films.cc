#include "tools/capture/mask_films.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <span>

#include "engine/base/names.h"
#include "engine/vision/components.h"
#include "io/films/decoder.h"
#include "io/images/image_files.h"
#include "io/keypoints/read_people.h"
#include "tools/capture/reduced_film.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxNumber = 16;  // if no grey value exceeds this number, the values are region numbers, not shades

/// The callback of VisitFolder and VisitFilm. It receives each mask of a film in order, and the file's name for error
/// messages.
using MaskVisit = std::function<Result<void>(const MaskPicture& mask, const std::string& file)>;

Result<void> VisitFolder(const fs::path& folder, const MaskVisit& visit) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".png" || entry.path().extension() == ".PNG") files.push_back(entry.path());
  }
  if (error) return Fail({folder.string()}, "{}", error.message());
  // Sort shorter names first, so that 9.png comes before 10.png.
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    const std::string one = a.filename().string(), other = b.filename().string();
    return std::pair(one.size(), one) < std::pair(other.size(), other);
  });
  for (const fs::path& file : files) {
    ASSIGN_OR_RETURN(const MaskPicture mask, LoadMaskPng(file.string()));
    RETURN_IF_ERROR(visit(mask, file.string()));
  }
  return {};
}

Result<void> VisitFilm(const fs::path& path, const MaskVisit& visit) {
  ASSIGN_OR_RETURN(const FilmFacts facts, ProbeFilm(path));
  ASSIGN_OR_RETURN(Decoder decoder, Decoder::Start(path, facts));
  ColourImage frame;
  MaskPicture mask{.values = {facts.width, facts.height}};
  while (true) {
    ASSIGN_OR_RETURN(const bool is_there, decoder.Next(frame));
    if (!is_there) return {};
    std::ranges::transform(frame.pixels, mask.values.pixels.begin(), [](const Rgb8& pixel) { return pixel.g; });
    RETURN_IF_ERROR(visit(mask, path.string()));
  }
}

/// Returns a reduced mask, in which a pixel is set if at least half of the film's pixels in the pixel's patch show the
/// person.
template <typename Value, typename IsPerson>
Mask Reduced(const Image<Value>& values, const Image<FilmPatch>& patches, const IsPerson& is_person) {
  Mask mask(patches.width, patches.height);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    const FilmPatch& patch = patches.pixels[i];
    int count = 0;
    for (int y = patch.top; y < patch.bottom; ++y) {
      for (int x = patch.left; x < patch.right; ++x) count += is_person(values.At(x, y));
    }
    const int pixels = (patch.right - patch.left) * (patch.bottom - patch.top);
    mask.pixels[i] = pixels > 0 && 2 * count >= pixels;
  }
  return mask;
}

bool IsEmpty(const Mask& mask) { return std::ranges::find(mask.pixels, 1) == mask.pixels.end(); }

/// Returns true if the person covers more than half of the picture.
bool CoversMost(const Mask& mask) {
  return 2 * std::ranges::count(mask.pixels, 1) > static_cast<std::ptrdiff_t>(mask.pixels.size());
}

/// Returns true if the second largest region is more than a quarter of the largest.
bool HasSeveral(const Mask& mask) {
  std::array<int, 2> largest{};
  for (const Components::Piece& piece : LabelComponents(mask).pieces) {
    if (!piece.set || piece.size <= largest[1]) continue;
    largest[1] = piece.size;
    if (largest[1] > largest[0]) std::swap(largest[0], largest[1]);
  }
  return 4 * largest[1] > largest[0];
}

/// Returns true if there are few values and the second most frequent one is frequent, too: they number several people
/// or things. Shades at a person's rim are rare. @param pixels the number of pixels with each value
bool AreFew(std::vector<std::size_t> pixels) {
  constexpr std::size_t kMaxValues = 8, kMinShare = 4;
  std::erase(pixels, std::size_t{0});
  std::ranges::sort(pixels, std::greater());
  return pixels.size() > 1 && pixels.size() <= kMaxValues && kMinShare * pixels[1] > pixels[0];
}

/// Lists values for a message.
std::string ListOf(const std::vector<std::string>& values) {
  constexpr std::size_t kListed = 20;
  return Join(std::span(values).first(std::min(values.size(), kListed))) + (values.size() > kListed ? ", …" : "");
}

}  // namespace

Result<std::vector<Mask>> ReadMasks(const std::string& folder, std::optional<int> id, const FilmedView& view,
                                    MessageLog& told) {
  ASSIGN_OR_RETURN(const fs::path entry, EntryOfFilm(folder, view.path.stem().string()));
  const Image<FilmPatch> patches = PatchesOf(view.facts, view.camera.camera, view.fit, UnmarkedTake::kPictureSide);
  const auto frames = static_cast<std::size_t>(view.facts.frames);
  // Values are shades (from half of the brightest on is the person), shades of 8 bits in a picture of 16, or region
  // numbers. Transparent pictures are cut-outs, whose opacity shows the person. Keep all interpretations until all
  // values are known.
  std::vector<Mask> shades, shades_of_8_bits, numbers, cut_outs;
  std::vector<std::size_t> found(std::size_t{1} << 16);  // number of pixels with each value
  bool is_indexed = false, has_16_bits = false, has_alpha = false;
  const MaskVisit visit = [&](const MaskPicture& mask, const std::string& file) -> Result<void> {
    const Image<std::uint16_t>& values = mask.values;
    if (values.width != view.facts.width || values.height != view.facts.height) {
      return Fail({file}, "the mask has {} x {} pixels, but the film {} has {} x {}", values.width, values.height,
                  view.path.string(), view.facts.width, view.facts.height);
    }
    if (numbers.size() == frames) {
      return Fail({entry.string()}, "found more masks than the film {} has frames ({})", view.path.string(), frames);
    }
    is_indexed |= mask.is_indexed;
    has_16_bits |= mask.has_16_bits;
    has_alpha |= !mask.alpha.pixels.empty();
    for (const std::uint16_t value : values.pixels) ++found[value];
    numbers.push_back(Reduced(values, patches, [&](std::uint16_t value) { return id ? value == *id : value != 0; }));
    if (id) return {};
    const auto from = [&](int least) {
      return Reduced(values, patches, [least](std::uint16_t value) { return value >= least; });
    };
    shades.push_back(from(mask.has_16_bits ? 32768 : 128));
    if (mask.has_16_bits) shades_of_8_bits.push_back(from(128));
    const auto is_opaque = [](std::uint8_t alpha) { return alpha >= 128; };
    cut_outs.push_back(mask.alpha.pixels.empty() ? from(0) : Reduced(mask.alpha, patches, is_opaque));
    return {};
  };
  RETURN_IF_ERROR(fs::is_directory(entry) ? VisitFolder(entry, visit) : VisitFilm(entry, visit));
  if (numbers.size() < frames) {
    return Fail({entry.string()},
                "the film {} has {} frames, but the number of masks is {}; allowed: a mask for each frame (PNG)",
                view.path.string(), frames, numbers.size());
  }
  // Choose the interpretation.
  std::vector<std::string> ids;
  int largest = 0;
  for (int value = 1; value < static_cast<int>(found.size()); ++value) {
    if (found[value] == 0) continue;
    ids.push_back(std::to_string(value));
    largest = value;
  }
  const bool are_numbers = id || is_indexed || largest <= kMaxNumber || AreFew({found.begin() + 1, found.end()});
  const bool are_cut_outs = has_alpha && !id;
  if (!id && !are_cut_outs && are_numbers && ids.size() > 1) {
    return Fail({entry.string()}, "the masks have several values: {}; use --mask-id to select the value of the person",
                ListOf(ids));
  }
  const bool has_8_bits = has_16_bits && largest < 256 && shades_of_8_bits.size() == shades.size();
  std::vector<Mask>& masks = are_cut_outs ? cut_outs : are_numbers ? numbers : has_8_bits ? shades_of_8_bits : shades;
  if (has_alpha) {
    told.Tell(fmt::format("masks of {}: the pictures have transparent pixels; {}", view.camera.name,
                          id ? "Etude ignores the transparency, because --mask-id selects the person by pixel value"
                             : "Etude takes all opaque pixels as the person, whatever their colour"));
  }
  const auto empty = std::ranges::count_if(masks, IsEmpty);
  if (static_cast<std::size_t>(empty) == masks.size()) {
    return Fail({entry.string()}, "no mask shows a person: {}",
                are_cut_outs  ? "all pixels are transparent"
                : ids.empty() ? "all pixels are 0"
                : id          ? fmt::format("no pixel has the value {} of --mask-id; found: {}", *id, ListOf(ids))
                              : fmt::format("the largest value is {}; allowed: 1, 255, shades from 128 on{}", largest,
                                   has_16_bits ? ", in pictures of 16 bits from 32768 on" : ""));
  }
  // Report suspicious masks.
  if (empty > 0) {
    told.Tell(fmt::format("masks of {}: {} of {} masks are empty", view.camera.name, empty, masks.size()));
  }
  const auto covering = std::ranges::count_if(masks, CoversMost);
  if (2 * static_cast<std::size_t>(covering) > masks.size()) {
    told.Tell(fmt::format(
        "doubtful: masks of {}: {} of {} masks cover most of the picture; the person may be black instead of white",
        view.camera.name, covering, masks.size()));
  }
  const auto several = std::ranges::count_if(masks, HasSeveral);
  if (several > 0) {
    told.Tell(fmt::format(
        "doubtful: masks of {}: {} of {} masks have several large regions, and may show more than one person",
        view.camera.name, several, masks.size()));
  }
  return std::move(masks);
}

}  // namespace etude

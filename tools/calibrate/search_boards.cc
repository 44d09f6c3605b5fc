#include "tools/calibrate/search_boards.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "engine/base/text.h"
#include "io/files/files.h"
#include "io/films/decoder.h"
#include "io/images/image_files.h"
#include "sim/camera/jpeg.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

Result<std::vector<Board>> ReadBoards(const std::vector<std::string>& texts) {
  std::vector<Board> boards;
  for (const std::string& text : texts) {
    ASSIGN_OR_RETURN(const Board board, ReadCodedBoard(text));
    for (const Board& other : boards) {
      if (board.first_code < other.first_code + CountCodes(other) &&
          other.first_code < board.first_code + CountCodes(board)) {
        return Fail({}, "--board {}: another board uses the same codes; allowed: @{} or a larger first code", text,
                    other.first_code + CountCodes(other));
      }
    }
    boards.push_back(board);
  }
  return boards;
}

/// Lists the pictures of a folder, sorted by name.
Result<std::vector<fs::path>> PicturesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string ending = InLowerCase(entry.path().extension().string());
    if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") files.push_back(entry.path());
  }
  if (error) return Fail({folder.string()}, "{}", error.message());
  if (files.empty()) return Fail({folder.string()}, "the folder contains no picture; allowed: PNG and JPG");
  std::ranges::sort(files);
  return files;
}

Result<ColourImage> ReadPicture(const fs::path& path) {
  constexpr std::size_t kMaxPixels = 100'000'000;
  ASSIGN_OR_RETURN(const std::string bytes, ReadWholeFile(path));
  if (bytes.starts_with("\x89PNG")) return LoadColourPng(path.string());
  auto picture = ReadJpeg(bytes, kMaxPixels);
  if (!picture) return Fail({path.string()}, "{}", picture.error().message);
  return picture;
}

Result<void> AddPicture(std::size_t camera, const std::string& moment, const ColourImage& picture, int look,
                        const std::string& file, BoardViews& views, CameraBoards& seen) {
  const auto corners = views.Add(camera, moment, picture, look);
  if (!corners) return Fail({file}, "{}", corners.error().message);
  ++seen.looked;
  seen.with_board += *corners > 0 ? 1 : 0;
  seen.corners += *corners;
  if (seen.best.pixels.empty() || *corners > seen.most_corners) {
    seen.best = picture;
    seen.most_corners = *corners;
  }
  return {};
}

Result<void> AddFolder(std::size_t camera, const fs::path& folder, const CalibrateOptions& options, BoardViews& views,
                       CameraBoards& seen) {
  ASSIGN_OR_RETURN(const auto files, PicturesIn(folder));
  const OnProgress progress = options.listener.progress(fmt::format("pictures of {}", seen.name));
  for (const fs::path& file : files) {
    ASSIGN_OR_RETURN(const ColourImage picture, ReadPicture(file));
    RETURN_IF_ERROR(AddPicture(camera, file.stem().string(), picture, -1, file.string(), views, seen));
    progress(seen.looked, files.size());
  }
  return {};
}

/// Searches every n-th frame of a film, of evenly spaced frames. The frame's number becomes the view's moment (views of
/// one moment show the same board position).
Result<void> AddFilm(std::size_t camera, const fs::path& film, const CalibrateOptions& options, BoardViews& views,
                     CameraBoards& seen) {
  ASSIGN_OR_RETURN(const FilmFacts facts, ProbeFilm(film));
  constexpr int kUsual = 30, kPictures = 200;
  const bool is_printed = ReadPrintedBoard(options.boards.front()).has_value();
  seen.every = options.every > 0 ? options.every
               : is_printed      ? std::max(1, (static_cast<int>(facts.frames) + kPictures - 1) / kPictures)
                                 : kUsual;
  seen.period_s = seen.every / (facts.rate_hz > 0 ? facts.rate_hz : 1.0);
  if (!facts.remark.empty()) options.listener.print(fmt::format("{}: {}\n", seen.name, facts.remark));
  const std::vector<int> moments = facts.FramesOfPictures();
  const OnProgress progress = options.listener.progress(fmt::format("frames of {}", seen.name));
  ASSIGN_OR_RETURN(Decoder decoder, Decoder::Start(film, facts));
  ColourImage frame;
  for (int i = 0;; ++i) {
    ASSIGN_OR_RETURN(const bool is_there, decoder.Next(frame));
    if (!is_there) return {};
    progress(static_cast<std::size_t>(i), static_cast<std::size_t>(facts.frames));
    const int moment = i < facts.frames ? moments[static_cast<std::size_t>(i)] : i;
    if (moment < 0 || moment % seen.every != 0) continue;
    RETURN_IF_ERROR(
        AddPicture(camera, fmt::format("{:08}", moment), frame, moment / seen.every, film.string(), views, seen));
  }
}

}  // namespace

Result<BoardViews> SearchFor(const CalibrateOptions& options) {
  const auto printed = ReadPrintedBoard(options.boards.front());
  if (!printed) {
    ASSIGN_OR_RETURN(const auto boards, ReadBoards(options.boards));
    return BoardViews(boards);
  }
  ASSIGN_OR_RETURN(const PrintedBoard board, *printed);
  if (options.boards.size() > 1)
    return Fail({}, "--board: found {} boards; allowed: only one board, if a board is a chessboard or ChArUco board",
                options.boards.size());
  if (!board.is_charuco && (board.columns + board.rows) % 2 == 0 && options.inputs.size() > 1) {
    return Fail({},
                "--board {}: this board looks the same after a rotation by 180°, so the poses of two cameras would be "
                "ambiguous; allowed: an odd sum of columns and rows",
                options.boards.front());
  }
  ASSIGN_OR_RETURN(auto finder, MakePrintedBoardFinder(board));
  return BoardViews(board, std::move(finder));
}

Result<CameraBoards> SearchInput(std::size_t camera, const CalibrateOptions& options, BoardViews& views) {
  fs::path input = options.inputs[camera];
  if (!input.has_filename()) input = input.parent_path();
  CameraBoards own;
  own.name = input.stem().string();
  RETURN_IF_ERROR(fs::is_directory(input) ? AddFolder(camera, input, options, views, own)
                                          : AddFilm(camera, input, options, views, own));
  return own;
}

}  // namespace etude

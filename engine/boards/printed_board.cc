#include "engine/boards/printed_board.h"

#include <dlfcn.h>

#include <array>
#include <cmath>

#include "engine/base/text.h"

namespace etude {
namespace {

constexpr const char* kModule = "etude_boards_opencv.so";  // dlopen finds it by the program's run path

Result<OpenCvBoards> OpenBoardModule() {
  void* module = ::dlopen(kModule, RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    return Fail({}, "OpenCV's board detectors are missing ({}); run `scripts/setup --boards` and build Etude again",
                ::dlerror());
  }
  const void* symbol = ::dlsym(module, "etude_boards_opencv");
  if (symbol == nullptr) return Fail({}, "{} is a module of another program or version", kModule);
  return *static_cast<const OpenCvBoards*>(symbol);
}

const Result<OpenCvBoards>& BoardModule() {
  static const Result<OpenCvBoards> module = OpenBoardModule();
  return module;
}

}  // namespace

std::optional<Result<PrintedBoard>> ReadPrintedBoard(std::string_view text) {
  // The prefix names the kind of board.
  PrintedBoard board;
  constexpr std::string_view kChess = "chess:", kCharuco = "charuco:";
  std::string_view rest = text;
  if (rest.starts_with(kChess)) {
    rest.remove_prefix(kChess.size());
  } else if (rest.starts_with(kCharuco)) {
    board.is_charuco = true;
    rest.remove_prefix(kCharuco.size());
  } else {
    return std::nullopt;
  }
  // Parse three numbers, separated by x.
  std::array<double, 3> numbers{};
  const std::vector<std::string_view> words = SplitAt(rest, 'x');
  bool is_read = words.size() == numbers.size();
  for (std::size_t i = 0; i < numbers.size() && is_read; ++i) {
    const auto number = ParseNumber<double>(words[i]);
    is_read = number.has_value();
    numbers[i] = number.value_or(0);
  }
  // Check the ranges: whole numbers of squares, and a side of 1 mm to 10 m.
  constexpr double kMaxPerSide = 64;
  const double min_squares = board.is_charuco ? 3 : 4;  // OpenCV does not find chessboards with two corners per side
  const auto is_side = [&](double n) { return n == std::floor(n) && n >= min_squares && n <= kMaxPerSide; };
  if (!is_read || !is_side(numbers[0]) || !is_side(numbers[1]) || !(numbers[2] >= 0.001) || !(numbers[2] <= 10)) {
    return Result<PrintedBoard>(Fail({},
                                     "--board {} does not describe a board; allowed: {} to 64 squares along each side, "
                                     "and the side of a square in metres, such as chess:9x6x0.025",
                                     text, min_squares));
  }
  board.columns = static_cast<int>(numbers[0]);
  board.rows = static_cast<int>(numbers[1]);
  board.square = numbers[2];
  return Result<PrintedBoard>(board);
}

Result<std::unique_ptr<PrintedBoardFinder>> MakePrintedBoardFinder(const PrintedBoard& board) {
  ASSIGN_OR_RETURN(const OpenCvBoards module, BoardModule());
  return module.make_finder(board);
}

Result<OpenCvCalibration> CalibrateByOpenCv(std::span<const TargetView> views, const PictureSize& size,
                                            LensModel lens) {
  ASSIGN_OR_RETURN(const OpenCvBoards module, BoardModule());
  return module.calibrate(views, size, lens);
}

}  // namespace etude

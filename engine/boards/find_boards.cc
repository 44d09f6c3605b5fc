#include "engine/boards/find_boards.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "engine/boards/corner_grid.h"
#include "engine/boards/saddles.h"

namespace etude {
namespace {

constexpr int kFewestCodes = 3;         // that must agree about a board
constexpr int kMostMisread = 1;         // modules of a code, and of its margin
constexpr double kFaintestModule = 20;  // counts between a black and a white module
constexpr std::size_t kFewestCorners = 6;

// Twice the place of a point of a grid or board in squares, so that the middles of squares are whole numbers, too.
struct Halves {
  int x, y;
  auto operator<=>(const Halves&) const = default;
};

// How a grid lies on a board: turned by quarters, then moved.
struct Fit {
  std::size_t board;
  int quarters;   // clockwise, from the board to the grid
  Halves origin;  // where the grid's (0, 0) lies on the board
  auto operator<=>(const Fit&) const = default;
};

// From the grid's directions to the board's.
Halves TurnedBack(Halves v, int quarters) {
  for (int i = 0; i < quarters; ++i) v = {v.y, -v.x};
  return v;
}

class Reader {
 public:
  Reader(const GreyImage& picture, const std::vector<Saddle>& saddles, std::span<const Board> boards)
      : picture_(picture), saddles_(saddles), boards_(boards) {}

  // How the grid lies on one of the boards, if enough of its codes agree.
  std::optional<Fit> FitOf(const CornerGrid& grid) const {
    std::map<Fit, int> votes;
    for (const auto& [place, corner] : grid) {
      const auto code = ReadCode(grid, place);
      if (!code) continue;
      for (std::size_t board = 0; board < boards_.size(); ++board) Vote(*code, place, board, votes);
    }
    const auto most =
        std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == votes.end() || most->second < kFewestCodes) return std::nullopt;
    return most->first;
  }

 private:
  // The code in the square below right of `place`; nothing where its corners are not all known, or it is no code.
  std::optional<std::uint16_t> ReadCode(const CornerGrid& grid, const GridPlace& place) const {
    const auto [i, j] = place;
    if ((i + j) % 2 != 0) return std::nullopt;  // a black square
    std::array<glm::dvec2, 4> corners;
    for (int k = 0; k < 4; ++k) {
      const auto found = grid.find({i + k % 2, j + k / 2});
      if (found == grid.end()) return std::nullopt;
      corners[static_cast<std::size_t>(k)] = saddles_[found->second].pixel;
    }
    std::array<double, kModules * kModules> modules;
    for (int m = 0; m < kModules * kModules; ++m) {
      const double s = (m % kModules + 0.5) / kModules, t = (m / kModules + 0.5) / kModules;
      const glm::dvec2 top = glm::mix(corners[0], corners[1], s), bottom = glm::mix(corners[2], corners[3], s);
      modules[static_cast<std::size_t>(m)] = BrightnessAt(picture_, glm::mix(top, bottom, t));
    }
    return CodeIn(modules);
  }

  static std::optional<std::uint16_t> CodeIn(const std::array<double, kModules * kModules>& modules) {
    const auto [dark, bright] = std::minmax_element(modules.begin(), modules.end());
    if (*bright - *dark < kFaintestModule) return std::nullopt;
    const double middle = 0.5 * (*dark + *bright);
    std::uint16_t code = 0;
    int dark_margin = 0;
    for (int m = 0; m < kModules * kModules; ++m) {
      const int x = m % kModules - 1, y = m / kModules - 1;
      const bool is_margin = x < 0 || y < 0 || x >= kCodeSide || y >= kCodeSide;
      const bool is_black = modules[static_cast<std::size_t>(m)] < middle;
      dark_margin += is_margin && is_black;
      if (!is_margin) code = static_cast<std::uint16_t>(code << 1 | (is_black ? 1 : 0));
    }
    return dark_margin > kMostMisread ? std::nullopt : std::optional(code);
  }

  // Where on the board the code stands, and how the grid must lie for it to be read so.
  void Vote(std::uint16_t read, const GridPlace& place, std::size_t board, std::map<Fit, int>& votes) const {
    const Board& pattern = boards_[board];
    for (int row = 0; row < pattern.rows; ++row) {
      for (int column = 0; column < pattern.columns; ++column) {
        if (IsBlackSquare(column, row)) continue;
        std::uint16_t code = CodeOf(CodeNumberOf(pattern, column, row));
        for (int quarters = 0; quarters < 4; ++quarters, code = Turned(code)) {
          if (std::popcount(static_cast<std::uint16_t>(code ^ read)) > kMostMisread) continue;
          const Halves to_origin = TurnedBack({-2 * place.first - 1, -2 * place.second - 1}, quarters);
          ++votes[{board, quarters, {2 * column + 1 + to_origin.x, 2 * row + 1 + to_origin.y}}];
        }
      }
    }
  }

  const GreyImage& picture_;
  const std::vector<Saddle>& saddles_;
  std::span<const Board> boards_;
};

// The grid's corners by their names on the board; what lies beyond the board is left out.
void Name(const CornerGrid& grid, const std::vector<Saddle>& saddles, const Fit& fit, const Board& board,
          std::vector<SeenCorner>& seen) {
  for (const auto& [place, saddle] : grid) {
    const Halves from_origin = TurnedBack({2 * place.first, 2 * place.second}, fit.quarters);
    const BoardCorner corner{(fit.origin.x + from_origin.x) / 2 - 1, (fit.origin.y + from_origin.y) / 2 - 1};
    if (corner.column < 0 || corner.row < 0 || corner.column > board.columns - 2 || corner.row > board.rows - 2)
      continue;
    seen.push_back({fit.board, corner, saddles[saddle].pixel});
  }
}

}  // namespace

std::vector<SeenCorner> FindBoards(const ColourImage& picture, std::span<const Board> boards) {
  const GreyImage grey = ToGrey(picture);
  const std::vector<Saddle> saddles = FindSaddles(grey);
  const Reader reader(grey, saddles, boards);
  std::vector<bool> taken(saddles.size());
  std::vector<SeenCorner> seen;
  for (std::size_t seed = 0; seed < saddles.size(); ++seed) {
    if (taken[seed]) continue;
    const CornerGrid grid = GrowGrid(grey, saddles, seed, taken);
    if (grid.size() < kFewestCorners) continue;
    const auto fit = reader.FitOf(grid);
    if (!fit) continue;
    for (const auto& [place, saddle] : grid) taken[saddle] = true;
    Name(grid, saddles, *fit, boards[fit->board], seen);
  }
  const auto order = [](const SeenCorner& s) { return std::tuple(s.board, s.corner.row, s.corner.column); };
  std::stable_sort(seen.begin(), seen.end(),
                   [&](const SeenCorner& a, const SeenCorner& b) { return order(a) < order(b); });
  // Of two grids on one board, the one around the stronger corner was found first.
  const auto is_same = [&](const SeenCorner& a, const SeenCorner& b) { return order(a) == order(b); };
  seen.erase(std::unique(seen.begin(), seen.end(), is_same), seen.end());
  return seen;
}

}  // namespace etude

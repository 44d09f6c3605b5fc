#include "engine/boards/find_boards.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "engine/boards/saddles.h"

namespace etude {
namespace {

/// Column and row of a corner in a grid of its own: i to the right, j down, as the picture shows them, from the corner
/// that it was begun with.
using GridPlace = std::pair<int, int>;
/// Corners that form a chessboard, as numbers of saddles.
using CornerGrid = std::map<GridPlace, std::size_t>;

constexpr double kLargestSpacing = 150;  // pixels
constexpr double kAlong = 0.97;          // cosine of 14°: how straight an edge leads to the next corner
constexpr double kAlike = 0.9;           // cosine of 26°: how far edges turn from a corner to the next
constexpr double kNear = 0.25;           // of the last step: how well two corners foretell the third
constexpr double kLongestStep = 2.2;     // of the last step, along another line

struct Axes {
  glm::dvec2 right, down;
};

// The saddle's edges as the axes of a corner with a bright or a dark square below right; of the two ways to name them
// the one like `expected`, or nothing.
std::optional<Axes> AxesLike(const Saddle& saddle, bool is_bright, const Axes& expected) {
  Axes axes = is_bright ? Axes{saddle.edges[0], saddle.edges[1]} : Axes{-saddle.edges[1], saddle.edges[0]};
  if (glm::dot(axes.right, expected.right) < 0) axes = {-axes.right, -axes.down};
  if (glm::dot(axes.right, expected.right) < kAlike || glm::dot(axes.down, expected.down) < kAlike) return {};
  return axes;
}

// Returns whether the picture is bright on one side of the line from a to b and dark on the other, all along.
bool IsEdge(const GreyImage& picture, const glm::dvec2& a, const glm::dvec2& b) {
  constexpr double kAside = 1.5;  // pixels
  constexpr double kFaintest = 15;
  const glm::dvec2 along = b - a;
  const glm::dvec2 aside = kAside / glm::length(along) * glm::dvec2(-along.y, along.x);
  int brighter = 0, darker = 0;
  constexpr int kSamples = 7;
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec2 point = a + (0.2 + 0.6 * i / (kSamples - 1)) * along;
    const double step = BrightnessAt(picture, point + aside) - BrightnessAt(picture, point - aside);
    brighter += step > kFaintest;
    darker += step < -kFaintest;
  }
  return brighter == kSamples || darker == kSamples;
}

class Grower {
 public:
  Grower(const GreyImage& picture, const std::vector<Saddle>& saddles, const std::vector<bool>& taken)
      : picture_(picture), saddles_(saddles), used_(taken) {}

  CornerGrid Grow(std::size_t seed) {
    Put({0, 0}, seed, {saddles_[seed].edges[0], saddles_[seed].edges[1]});
    while (!open_.empty()) {
      const GridPlace place = open_.front();
      open_.pop_front();
      for (const auto& [di, dj] : {GridPlace{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) Step(place, di, dj);
    }
    return grid_;
  }

 private:
  void Put(const GridPlace& place, std::size_t saddle, const Axes& axes) {
    grid_[place] = saddle;
    axes_[place] = axes;
    used_[saddle] = true;
    open_.push_back(place);
  }

  std::optional<glm::dvec2> PixelAt(int i, int j) const {
    const auto found = grid_.find({i, j});
    return found == grid_.end() ? std::nullopt : std::optional(saddles_[found->second].pixel);
  }

  // The nearest unused saddle that looks like the corner at `to` and that `may_be` it.
  template <typename MayBe>
  void PutNearest(const GridPlace& to, const Axes& expected, const glm::dvec2& from, MayBe may_be) {
    std::optional<std::size_t> best;
    Axes best_axes{};
    double least = std::numeric_limits<double>::infinity();
    const bool is_bright = (to.first + to.second) % 2 == 0;
    for (std::size_t k = 0; k < saddles_.size(); ++k) {
      const double distance = glm::distance(saddles_[k].pixel, from);
      if (used_[k] || distance >= least || !may_be(saddles_[k].pixel)) continue;
      const auto axes = AxesLike(saddles_[k], is_bright, expected);
      if (!axes) continue;
      best = k;
      best_axes = *axes;
      least = distance;
    }
    if (best) Put(to, *best, best_axes);
  }

  void Step(const GridPlace& place, int di, int dj) {
    const auto [i, j] = place;
    const GridPlace to{i + di, j + dj};
    if (grid_.contains(to)) return;
    const glm::dvec2 pixel = *PixelAt(i, j);
    const Axes axes = axes_.at(place);
    if (const auto behind = PixelAt(i - di, j - dj)) {
      const glm::dvec2 foretold = 2.0 * pixel - *behind;
      const double near = kNear * glm::distance(pixel, *behind);
      PutNearest(to, axes, foretold,
                 [&](const glm::dvec2& p) { return glm::distance(p, foretold) < near && IsEdge(picture_, pixel, p); });
      return;
    }
    const glm::dvec2 along = di != 0 ? static_cast<double>(di) * axes.right : static_cast<double>(dj) * axes.down;
    const double farthest = LongestStepFrom(i, j);
    PutNearest(to, axes, pixel, [&](const glm::dvec2& p) {
      const double distance = glm::distance(p, pixel);
      return distance < farthest && glm::dot(p - pixel, along) > kAlong * distance && IsEdge(picture_, pixel, p);
    });
  }

  double LongestStepFrom(int i, int j) const {
    for (const auto& [di, dj] : {GridPlace{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      if (const auto other = PixelAt(i + di, j + dj)) return kLongestStep * glm::distance(*PixelAt(i, j), *other);
    }
    return kLargestSpacing;
  }

  const GreyImage& picture_;
  const std::vector<Saddle>& saddles_;
  std::vector<bool> used_;
  CornerGrid grid_;
  std::map<GridPlace, Axes> axes_;
  std::deque<GridPlace> open_;
};

/// The chessboard around saddle `seed`, grown from corner to corner along the edges; the square below right of (0, 0)
/// is bright. Saddles that are `taken` belong to other boards. It may be wrong, or the seed alone: codes tell.
CornerGrid GrowGrid(const GreyImage& picture, const std::vector<Saddle>& saddles, std::size_t seed,
                    const std::vector<bool>& taken) {
  return Grower(picture, saddles, taken).Grow(seed);
}

constexpr int kFewestCodes = 3;         // that must agree about a board
constexpr int kMostMisread = 1;         // modules of a code, and of its margin
constexpr double kFaintestModule = 20;  // counts between a black and a white module

// Twice the place of a point of a grid or board in squares, so that the middles of squares are whole numbers, too.
struct Halves {
  int x, y;
  auto operator<=>(const Halves&) const = default;
};

// The placement of a grid on a board: turned by quarters, then moved.
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

  // Returns the placement of the grid on one of the boards, if enough of its codes agree.
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

  // Adds a vote for every placement of the grid on the board under which the code is read so.
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

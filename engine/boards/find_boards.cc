#include "engine/boards/find_boards.h"

#include <algorithm>
#include <bit>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "engine/boards/saddles.h"

namespace etude {
namespace {

/// Column and row of a corner relative to the seed of its grid: i counts to the right, j downwards, in the picture.
using GridIndex = std::pair<int, int>;
/// The corners of one chessboard: the index of the saddle at each grid index.
using CornerGrid = std::map<GridIndex, std::size_t>;

constexpr double kMaxSpacingPx = 150;  // maximum distance between the first two corners of a grid
// Cosine of the maximum angle, 14°, between an edge and the direction to the next corner.
constexpr double kMinAlignment = 0.97;
// Cosine of the maximum angle, 26°, between the edges at neighbouring corners.
constexpr double kMinSimilarity = 0.9;
// Maximum error of a corner predicted from two neighbouring corners, as a share of the distance between these two.
constexpr double kMaxPredictionError = 0.25;
// Maximum distance to the next corner in a new direction, as a multiple of the known distance to another neighbour.
constexpr double kMaxStepRatio = 2.2;

struct Axes {
  glm::dvec2 right, down;
};

// Returns the saddle's edges as the axes of a grid corner; `is_bright` states whether the corner's lower right square
// is bright. The edges determine the axes up to sign: the axes near `expected` are returned, or nullopt if neither sign
// is near.
std::optional<Axes> AxesLike(const Saddle& saddle, bool is_bright, const Axes& expected) {
  Axes axes = is_bright ? Axes{saddle.edges[0], saddle.edges[1]} : Axes{-saddle.edges[1], saddle.edges[0]};
  if (glm::dot(axes.right, expected.right) < 0) axes = {-axes.right, -axes.down};
  if (glm::dot(axes.right, expected.right) < kMinSimilarity || glm::dot(axes.down, expected.down) < kMinSimilarity)
    return {};
  return axes;
}

// Returns true if the picture is bright on one side of the line from a to b and dark on the other, along the whole
// line.
bool IsEdge(const GreyImage& picture, const glm::dvec2& a, const glm::dvec2& b) {
  constexpr double kOffsetPx = 1.5;
  constexpr double kMinStep = 15;  // minimum difference of brightness, grey levels (of 255)
  const glm::dvec2 along = b - a;
  const glm::dvec2 offset = kOffsetPx / glm::length(along) * glm::dvec2(-along.y, along.x);
  int brighter = 0, darker = 0;
  constexpr int kSamples = 7;
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec2 point = a + (0.2 + 0.6 * i / (kSamples - 1)) * along;
    const double step = BrightnessAt(picture, point + offset) - BrightnessAt(picture, point - offset);
    brighter += step > kMinStep;
    darker += step < -kMinStep;
  }
  return brighter == kSamples || darker == kSamples;
}

// Grows the grid of a chessboard from one saddle, corner by corner along the edges.
class Grower {
 public:
  Grower(const GreyImage& picture, const std::vector<Saddle>& saddles, const std::vector<bool>& taken)
      : picture_(picture), saddles_(saddles), used_(taken) {}

  CornerGrid Grow(std::size_t seed) {
    Insert({0, 0}, seed, {saddles_[seed].edges[0], saddles_[seed].edges[1]});
    while (!open_.empty()) {
      const GridIndex place = open_.front();
      open_.pop_front();
      for (const auto& [di, dj] : {GridIndex{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) Step(place, di, dj);
    }
    return grid_;
  }

 private:
  void Insert(const GridIndex& place, std::size_t saddle, const Axes& axes) {
    grid_[place] = saddle;
    axes_[place] = axes;
    used_[saddle] = true;
    open_.push_back(place);
  }

  std::optional<glm::dvec2> PixelAt(int i, int j) const {
    const auto found = grid_.find({i, j});
    return found == grid_.end() ? std::nullopt : std::optional(saddles_[found->second].pixel);
  }

  // Inserts a saddle into the grid at `to`: of the unused saddles with the expected axes for which `may_be` returns
  // true, the one nearest to the pixel `from`.
  template <typename MayBe>
  void InsertNearest(const GridIndex& to, const Axes& expected, const glm::dvec2& from, MayBe may_be) {
    std::optional<std::size_t> best;
    Axes best_axes{};
    double min_distance = std::numeric_limits<double>::infinity();
    const bool is_bright = (to.first + to.second) % 2 == 0;
    for (std::size_t k = 0; k < saddles_.size(); ++k) {
      const double distance = glm::distance(saddles_[k].pixel, from);
      if (used_[k] || distance >= min_distance || !may_be(saddles_[k].pixel)) continue;
      const auto axes = AxesLike(saddles_[k], is_bright, expected);
      if (!axes) continue;
      best = k;
      best_axes = *axes;
      min_distance = distance;
    }
    if (best) Insert(to, *best, best_axes);
  }

  void Step(const GridIndex& place, int di, int dj) {
    const auto [i, j] = place;
    const GridIndex to{i + di, j + dj};
    if (grid_.contains(to)) return;
    const glm::dvec2 pixel = *PixelAt(i, j);
    const Axes axes = axes_.at(place);
    // If there is a corner in the opposite direction, extrapolate from that corner and this one.
    if (const auto behind = PixelAt(i - di, j - dj)) {
      const glm::dvec2 predicted = 2.0 * pixel - *behind;
      const double near = kMaxPredictionError * glm::distance(pixel, *behind);
      InsertNearest(to, axes, predicted, [&](const glm::dvec2& p) {
        return glm::distance(p, predicted) < near && IsEdge(picture_, pixel, p);
      });
      return;
    }
    // Otherwise search along the edge.
    const glm::dvec2 along = di != 0 ? static_cast<double>(di) * axes.right : static_cast<double>(dj) * axes.down;
    const double max_distance = MaxStepFrom(i, j);
    InsertNearest(to, axes, pixel, [&](const glm::dvec2& p) {
      const double distance = glm::distance(p, pixel);
      return distance < max_distance && glm::dot(p - pixel, along) > kMinAlignment * distance &&
             IsEdge(picture_, pixel, p);
    });
  }

  double MaxStepFrom(int i, int j) const {
    for (const auto& [di, dj] : {GridIndex{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      if (const auto other = PixelAt(i + di, j + dj)) return kMaxStepRatio * glm::distance(*PixelAt(i, j), *other);
    }
    return kMaxSpacingPx;
  }

  const GreyImage& picture_;
  const std::vector<Saddle>& saddles_;
  std::vector<bool> used_;
  CornerGrid grid_;
  std::map<GridIndex, Axes> axes_;
  std::deque<GridIndex> open_;
};

/// Returns the corners of the chessboard around saddle `seed`, found one after another along the edges. The seed is
/// corner (0, 0), and the square to its lower right is bright. Saddles that are `taken` belong to other boards. The
/// grid may be wrong, or hold only the seed; Reader later checks the grid by its codes.
CornerGrid GrowGrid(const GreyImage& picture, const std::vector<Saddle>& saddles, std::size_t seed,
                    const std::vector<bool>& taken) {
  return Grower(picture, saddles, taken).Grow(seed);
}

constexpr int kMinCodes = 3;         // minimum number of codes that must agree about the grid's place on a board
constexpr int kMaxMisread = 1;       // maximum number of misread modules in a code, and in its margin
constexpr double kMinContrast = 20;  // minimum difference between black and white modules, grey levels

// The position of a point of a grid or board, in units of half a square, so that the centres of squares are whole
// numbers.
struct Halves {
  int x, y;
  auto operator<=>(const Halves&) const = default;
};

// The placement of a grid on a board: a rotation by quarter turns, then a translation.
struct Fit {
  std::size_t board;
  int quarters;   // quarter turns clockwise from the board to the grid
  Halves origin;  // position of the grid's (0, 0) on the board
  auto operator<=>(const Fit&) const = default;
};

// Rotates a vector from the axes of the grid to the axes of the board.
Halves TurnedBack(Halves v, int quarters) {
  for (int i = 0; i < quarters; ++i) v = {v.y, -v.x};
  return v;
}

// Reads the codes in the squares of a grid. Each code votes for all placements of the grid that put this code where the
// board has it.
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
    if (most == votes.end() || most->second < kMinCodes) return std::nullopt;
    return most->first;
  }

 private:
  // Returns the code in the square to the lower right of corner `place`; nullopt if the square is black, if one of its
  // corners is unknown, or if its margin is not white.
  std::optional<std::uint16_t> ReadCode(const CornerGrid& grid, const GridIndex& place) const {
    const auto [i, j] = place;
    if ((i + j) % 2 != 0) return std::nullopt;  // a black square has no code
    // Collect the corners of the square.
    std::array<glm::dvec2, 4> corners;
    for (int k = 0; k < 4; ++k) {
      const auto found = grid.find({i + k % 2, j + k / 2});
      if (found == grid.end()) return std::nullopt;
      corners[static_cast<std::size_t>(k)] = saddles_[found->second].pixel;
    }
    // Sample the centre of every module, bilinearly between the corners.
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
    if (*bright - *dark < kMinContrast) return std::nullopt;
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
    return dark_margin > kMaxMisread ? std::nullopt : std::optional(code);
  }

  // Adds one vote for every placement of the grid on the board that puts this code into this square.
  void Vote(std::uint16_t read, const GridIndex& place, std::size_t board, std::map<Fit, int>& votes) const {
    const Board& pattern = boards_[board];
    for (int row = 0; row < pattern.rows; ++row) {
      for (int column = 0; column < pattern.columns; ++column) {
        if (IsBlackSquare(column, row)) continue;
        std::uint16_t code = CodeOf(CodeNumberOf(pattern, column, row));
        for (int quarters = 0; quarters < 4; ++quarters, code = Turned(code)) {
          if (std::popcount(static_cast<std::uint16_t>(code ^ read)) > kMaxMisread) continue;
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

// Appends the grid's corners with their indices on the board; corners outside the board are left out.
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
  // Grow a grid from every free saddle, the strongest first, and keep it if its codes agree.
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
  // Sort the corners. If several have the same index, keep the first one, which comes from the grid around the
  // strongest seed.
  const auto order = [](const SeenCorner& s) { return std::tuple(s.board, s.corner.row, s.corner.column); };
  std::stable_sort(seen.begin(), seen.end(),
                   [&](const SeenCorner& a, const SeenCorner& b) { return order(a) < order(b); });
  const auto is_same = [&](const SeenCorner& a, const SeenCorner& b) { return order(a) == order(b); };
  seen.erase(std::unique(seen.begin(), seen.end(), is_same), seen.end());
  return seen;
}

}  // namespace etude

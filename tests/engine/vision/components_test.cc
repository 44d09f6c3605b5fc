#include "engine/vision/components.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace etude {
namespace {

Mask FromRows(const std::vector<std::string>& rows) {
  Mask mask(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) mask.At(x, y) = rows[y][x] == '#';
  }
  return mask;
}

// A second implementation: a flood fill from every unlabelled pixel in scan order.
Image<std::int32_t> FloodFill(const Mask& mask, Connectivity connectivity) {
  Image<std::int32_t> labels(mask.width, mask.height, -1);
  std::int32_t next = 0;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (labels.At(x, y) >= 0) continue;
      const bool set = mask.At(x, y) != 0;
      const bool corners = set == (connectivity == Connectivity::kEight);
      std::vector<std::pair<int, int>> stack = {{x, y}};
      labels.At(x, y) = next;
      while (!stack.empty()) {
        const auto [u, v] = stack.back();
        stack.pop_back();
        for (int dv = -1; dv <= 1; ++dv) {
          for (int du = -1; du <= 1; ++du) {
            if (!corners && du != 0 && dv != 0) continue;
            if (!mask.Contains(u + du, v + dv) || labels.At(u + du, v + dv) >= 0) continue;
            if ((mask.At(u + du, v + dv) != 0) != set) continue;
            labels.At(u + du, v + dv) = next;
            stack.push_back({u + du, v + dv});
          }
        }
      }
      ++next;
    }
  }
  return labels;
}

Image<std::int32_t> ToLabels(const Components& components, const Mask& mask) {
  Image<std::int32_t> labels(mask.width, mask.height, -1);
  for (const Components::Run& run : components.runs) {
    for (int x = run.begin; x < run.end; ++x) labels.At(x, run.row) = static_cast<std::int32_t>(run.piece);
  }
  return labels;
}

TEST(Components, EqualAFloodFillOnManyMasks) {
  std::uint32_t state = 1;
  int checked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Mask mask(3 + trial % 23, 2 + trial % 17);
    const std::uint32_t share = 20 + trial % 60;
    for (auto& pixel : mask.pixels) {
      state = state * 1664525u + 1013904223u;
      pixel = (state >> 16) % 100 < share;
    }
    for (Connectivity connectivity : {Connectivity::kFour, Connectivity::kEight}) {
      const Components components = LabelComponents(mask, connectivity);
      ASSERT_EQ(ToLabels(components, mask).pixels, FloodFill(mask, connectivity).pixels) << "trial " << trial;
      int total = 0;
      for (const auto& piece : components.pieces) total += piece.size;
      ASSERT_EQ(total, mask.width * mask.height);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 400);
}

TEST(Components, KnowOfEveryPieceItsColourItsSizeAndWhetherItTouchesTheBorder) {
  std::uint32_t state = 7;
  int inside = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Mask mask(4 + trial % 9, 4 + trial % 7);
    for (auto& pixel : mask.pixels) {
      state = state * 1664525u + 1013904223u;
      pixel = (state >> 16) % 2;
    }
    const Image<std::int32_t> labels = FloodFill(mask, Connectivity::kEight);
    const Components components = LabelComponents(mask, Connectivity::kEight);
    std::vector<Components::Piece> expected(components.pieces.size());
    for (int y = 0; y < mask.height; ++y) {
      for (int x = 0; x < mask.width; ++x) {
        auto& piece = expected.at(static_cast<std::size_t>(labels.At(x, y)));
        piece.set = mask.At(x, y) != 0;
        ++piece.size;
        piece.touches_border |= x == 0 || y == 0 || x == mask.width - 1 || y == mask.height - 1;
      }
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(components.pieces[i].set, expected[i].set) << trial << ", " << i;
      ASSERT_EQ(components.pieces[i].size, expected[i].size) << trial << ", " << i;
      ASSERT_EQ(components.pieces[i].touches_border, expected[i].touches_border) << trial << ", " << i;
      inside += expected[i].touches_border ? 0 : 1;
    }
  }
  EXPECT_GT(inside, 50);
}

TEST(Components, JoinAtCornersOnlyWithEight) {
  const Mask mask = FromRows({"#.", ".#"});
  auto count_set = [&](Connectivity connectivity) {
    int count = 0;
    for (const auto& piece : LabelComponents(mask, connectivity).pieces) count += piece.set;
    return count;
  };
  EXPECT_EQ(count_set(Connectivity::kEight), 1);
  EXPECT_EQ(count_set(Connectivity::kFour), 2);
}

TEST(LargestComponent, DropsEverythingElse) {
  const Mask mask = FromRows({"##....", "......", "..###.", "..#..#"});
  const Mask expected = FromRows({"......", "......", "..###.", "..#..#"});
  EXPECT_EQ(LargestComponent(mask).pixels, expected.pixels);
  EXPECT_EQ(LargestComponent(FromRows({"...", "..."})).pixels, Mask(3, 2).pixels);
  EXPECT_EQ(LargestComponent(FromRows({"#..", "..#"})).pixels, FromRows({"#..", "..."}).pixels)
      << "the first of equals";
}

TEST(LargeComponents, KeepsTheLargestAndWhatIsLargeAndNear) {
  const Mask mask =
      FromRows({"##........##", "............", "..####......", "..####..#...", "............", "##.........."});
  const Mask expected =
      FromRows({"##..........", "............", "..####......", "..####......", "............", "##.........."});
  EXPECT_EQ(LargeComponents(mask, 2, 2).pixels, expected.pixels) << "one piece is small, one is far away";
  EXPECT_EQ(LargeComponents(mask, 1, 20).pixels, mask.pixels);
  EXPECT_EQ(LargeComponents(mask, 100, 20).pixels, LargestComponent(mask).pixels);
  EXPECT_EQ(LargeComponents(Mask(3, 2), 1, 1).pixels, Mask(3, 2).pixels);
}

TEST(FillHoles, FillsSmallHolesAndLeavesLargeOnesAndOpenBays) {
  const Mask mask = FromRows({
      "#######....",
      "#.##..#.###",
      "####..#.#..",
      "#######.###",
  });
  const Mask expected = FromRows({
      "#######....",
      "####..#.###",
      "####..#.#..",
      "#######.###",
  });
  EXPECT_EQ(FillHoles(mask, 3).pixels, expected.pixels);
}

TEST(FillHoles, TakesADiagonalOutlineForClosed) {
  const Mask mask = FromRows({".#.", "#.#", ".#."});
  EXPECT_EQ(FillHoles(mask, 1).At(1, 1), 1);
  EXPECT_EQ(FillHoles(mask, 0).At(1, 1), 0);
}

}  // namespace
}  // namespace etude

#include "engine/base/named.h"

#include <gtest/gtest.h>

#include <array>
#include <span>

namespace etude {
namespace {

enum class Colour { kRed, kBlue };
constexpr std::array<Named<Colour>, 2> kColours = {{{"red", Colour::kRed}, {"blue", Colour::kBlue}}};
static_assert(FindByName(kColours, "blue")->value == Colour::kBlue);

struct Row {
  std::string id;
};
std::string_view IdOf(const Row& row) { return row.id; }

TEST(FindByName, PointsAtTheFirstRowOfThatNameAndAtNothingElse) {
  EXPECT_EQ(FindByName(kColours, "blue"), &kColours[1]);
  EXPECT_EQ(FindByName(kColours, "blu"), nullptr);
  EXPECT_EQ(FindByName(kColours, ""), nullptr);
  const std::vector<Row> rows = {{"a"}, {"b"}, {"b"}};
  EXPECT_EQ(FindByName(rows, "b", IdOf), &rows[1]);
  EXPECT_EQ(FindByName(std::span(rows).first(1), "b", IdOf), nullptr);
}

TEST(NamesOf, TellsAllNamesInTheirOrder) {
  EXPECT_EQ(NamesOf(kColours), (std::vector<std::string>{"red", "blue"}));
  EXPECT_EQ(NamesOf(std::vector<Row>{{"b"}, {"a"}}, IdOf), (std::vector<std::string>{"b", "a"}));
  EXPECT_TRUE(NamesOf(std::vector<Row>{}, IdOf).empty());
}

}  // namespace
}  // namespace etude

#include "reports/page_check.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/engine/formats/spoilt.h"

namespace etude {
namespace {

using namespace std::string_literals;

const std::string kBare = "<main><h1>best: <!--media--><!--/media-->b</h1><!--media--><!--/media--></main>";

std::string With(const std::string& first, const std::string& second = "") {
  return "<main><h1>best: <!--media-->" + first + "<!--/media-->b</h1><!--media-->" + second + "<!--/media--></main>";
}

const std::string kPicture =
    "<figure class=\"film\"><img width=\"12\" height=\"9\" alt=\"a &lt; b\" src=\"data:image/png;base64,iVBO+/=\">"
    "<figcaption>words, <a href=\"../video/etude.mp4\">video/etude.mp4</a></figcaption></figure>";

TEST(CheckPage, APageIsTheRunsOwnButForPicturesAndFilms) {
  EXPECT_TRUE(CheckPage(kBare, kBare).same);
  EXPECT_FALSE(CheckPage(kBare, kBare).has_media);
  const std::string film =
      "<figure><video controls loop muted playsinline autoplay width=\"1\" height=\"2\" "
      "poster=\"data:image/png;base64,AA==\" src=\"data:video/mp4;base64,AA==\" aria-label=\"x\"></video></figure>";
  for (const std::string& media :
       {kPicture, film, "<details><summary>Film, stills</summary><div class=\"strip\">" + kPicture + "</div></details>",
        "<p class=\"quiet\">There is no film, because this report was made without films.</p>"s}) {
    const PageCheck check = CheckPage(With("", media), kBare);
    EXPECT_TRUE(check.same) << media;
    EXPECT_TRUE(check.has_media) << media;
    EXPECT_FALSE(check.has_takes);
  }
}

TEST(CheckPage, WhateverIsAddedOrAlteredOutsideIsNoticed) {
  const std::string page = With(kPicture, kPicture);
  ASSERT_TRUE(CheckPage(page, kBare).same);
  for (std::size_t at = 0; at < page.size(); ++at) {
    // A caption may have any words, so a letter is added only before the first and after the last media.
    const bool is_outside = at <= page.find("<!--media-->") || at > page.rfind("<!--/media-->");
    std::string more = page;
    more.insert(at, "<style>main{display:none}</style>");
    EXPECT_FALSE(CheckPage(more, kBare).same) << at;
    if (!is_outside) continue;
    more = page;
    more.insert(at, "x");
    EXPECT_FALSE(CheckPage(more, kBare).same) << at;
  }
  EXPECT_FALSE(CheckPage(page + "x", kBare).same);
  EXPECT_FALSE(CheckPage("", kBare).same);
  EXPECT_FALSE(CheckPage(page.substr(0, page.size() / 2), kBare).same);
}

TEST(CheckPage, BetweenMarksNothingReachesBeyondThem) {
  for (const std::string& bad : testing::Parts(
           R"(<style>main{display:none}</style>^<script>x</script>^</h1>^<figure>^<b>better</b>^)"
           R"(<p style="position:fixed">x</p>^<p class="verdict">x</p>^<p class="quiet" class="x">x</p>^)"
           R"(<figure class="film" onclick="x"></figure>^<img src="https://x">^<img src="data:text/html,x">^)"
           R"(<img src="data:image/png;base64,A"" alt="">^<img width="99999">^<img width="1em">^)"
           R"(<a href="javascript:x">x</a>^<a href="../video/../x">x</a>^<a href="../video/x"^)"
           R"(<img alt="<style>x</style>">^<!-- ^<p class="quiet"><figure></p></figure>^<img/alt="x">^)"
           R"(<tr></tr>^<P class="quiet">x</P>^<details open>x</details>)")) {
    EXPECT_FALSE(CheckPage(With("", bad), kBare).same) << bad;
  }
}

TEST(CheckPage, RowsOfTakesAreRowsOfTextAlone) {
  const std::string bare = "<table><!--takes--><!--/takes--><tr><td>simulated</td></tr></table>";
  const auto with = [&](const std::string& rows) {
    return "<table><!--takes-->" + rows + "<!--/takes--><tr><td>simulated</td></tr></table>";
  };
  const PageCheck check = CheckPage(with("<tr><td>real</td><td class=\"n\">3.1</td></tr>"), bare);
  EXPECT_TRUE(check.same && check.has_takes && !check.has_media);
  for (const char* bad : {"<tr><td>real</td>", "</table>", "<tr class=\"quiet\"></tr>", "<img alt=\"x\">"})
    EXPECT_FALSE(CheckPage(with(bad), bare).same) << bad;
}

}  // namespace
}  // namespace etude

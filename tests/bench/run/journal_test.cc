#include "bench/run/journal.h"

#include <gmock/gmock.h>

#include "bench/files/files.h"
#include "bench/files/temporary_folder.h"
#include "bench/results/folder.h"
#include "tests/bench/run/prepared.h"

namespace etude {
namespace {

using testing::HasSubstr;

class JournalTest : public testing::Test {
 protected:
  void SetUp() override {
    auto made = TemporaryFolder::Make("journal-test");
    ASSERT_TRUE(made);
    folder_.emplace(std::move(*made));
  }

  FinishedCell CellWith(std::size_t cell, double error) const {
    FinishedCell finished{plan_.IdentityOf(cell), {.wall_s = 0.25, .cpu_s = 0.125, .peak_mb = 12}};
    finished.row.result = CellResult::Ended(Status::kOk, "");
    finished.row.result.Measure("position_error_cm", error);
    finished.row.result.series.push_back({"position_error_cm", "iteration", {3, 2, error}});
    return finished;
  }

  /// A journal of cells 0 and 3.
  void WriteTwo() {
    auto journal = Journal::Begin(folder(), head_);
    ASSERT_TRUE(journal);
    ASSERT_TRUE(journal->Append(3, CellWith(3, 0.1)));
    ASSERT_TRUE(journal->Append(0, CellWith(0, 0.2)));
  }

  std::string Text() const { return *ReadWholeFile(path()); }
  void Rewrite(const std::string& text) const { ASSERT_TRUE(WriteFileAtomically(path(), text)); }
  const std::filesystem::path& folder() const { return folder_->path(); }
  std::filesystem::path path() const { return folder() / kJournalFile; }
  /// Where the head, which stands there twice, has ended.
  static std::size_t EndOfHead(const std::string& text) { return text.find('\n', text.find('\n') + 1) + 1; }
  Result<JournalContent> Read(CellTable& cells) const {
    cells.assign(plan_.cell_count(), std::nullopt);
    return ReadJournal(folder(), plan_, cells);
  }
  std::string Complaint() const {
    CellTable cells;
    const auto content = Read(cells);
    return content ? "" : ToString(content.error());
  }

  const std::vector<PreparedScenario> scenarios_ = Prepared(SmallSuite());
  const Plan plan_{scenarios_};
  const JournalHead head_{"manifest digest", "build digest", {1, 1}};
  std::optional<TemporaryFolder> folder_;
};

TEST_F(JournalTest, GivesBackWhatWasAppended) {
  WriteTwo();
  CellTable cells;
  const auto content = Read(cells);
  ASSERT_TRUE(content) << ToString(content.error());
  EXPECT_EQ(content->head.manifest, head_.manifest);
  EXPECT_EQ(content->head.build, head_.build);
  EXPECT_EQ(content->head.shard, head_.shard);
  EXPECT_TRUE(content->damaged.empty());
  ASSERT_TRUE(cells[0] && cells[3]);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), std::nullopt), 10);
  EXPECT_EQ(ValueOf(cells[3]->row, "position_error_cm"), 0.1);
  EXPECT_EQ(cells[3]->row.result.series.front().values.size(), 3u);
  EXPECT_EQ(cells[3]->usage.wall_s, 0.25);
}

TEST_F(JournalTest, LosesNothingButATornLastLineWhereverItIsCut) {
  WriteTwo();
  const std::string text = Text();
  const std::size_t head_end = EndOfHead(text), first_end = text.find('\n', head_end) + 1;
  for (std::size_t cut = head_end; cut <= text.size(); ++cut) {
    Rewrite(text.substr(0, cut));
    CellTable cells;
    ASSERT_TRUE(Read(cells)) << cut;
    EXPECT_EQ(cells[3].has_value(), cut >= first_end) << cut;
    EXPECT_EQ(cells[0].has_value(), cut == text.size()) << cut;
  }
}

TEST_F(JournalTest, GoesOnAfterATornLine) {
  WriteTwo();
  Rewrite(Text() + R"({"cell":5,"row":{"scen)");
  {
    auto journal = Journal::Continue(folder());
    ASSERT_TRUE(journal);
    ASSERT_TRUE(journal->Append(7, CellWith(7, 0.3)));
  }
  CellTable cells;
  ASSERT_TRUE(Read(cells));
  EXPECT_TRUE(cells[0] && cells[3] && cells[7]);
  EXPECT_FALSE(cells[5]);
}

// One flipped bit costs the cell whose line it hits, not the run.
TEST_F(JournalTest, LosesACellAloneByAChangedByteOfItsLine) {
  WriteTwo();
  const std::string text = Text();
  const std::size_t begin = EndOfHead(text), end = text.find('\n', begin);
  for (std::size_t at = begin; at < end; ++at) {
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    Rewrite(changed);
    CellTable cells;
    const auto content = Read(cells);
    ASSERT_TRUE(content) << at << ": " << ToString(content.error());
    EXPECT_FALSE(cells[3]) << at;
    EXPECT_TRUE(cells[0]) << at;
    EXPECT_EQ(content->damaged.front(), 3) << at;
  }
}

TEST_F(JournalTest, PassesOverGarbageWithALineEnd) {
  WriteTwo();
  const std::string text = Text();
  Rewrite(text.substr(0, EndOfHead(text)) + std::string("\x00\xff not json\n\n", 13) + text.substr(EndOfHead(text)));
  CellTable cells;
  const auto content = Read(cells);
  ASSERT_TRUE(content) << ToString(content.error());
  EXPECT_TRUE(cells[0] && cells[3]);
  EXPECT_FALSE(content->damaged.empty());
}

TEST_F(JournalTest, KnowsWhatItBelongsToAsLongAsOneCopyOfItsHeadIsGood) {
  WriteTwo();
  const std::string text = Text();
  const std::size_t line = text.find('\n') + 1;
  for (std::size_t at = 0; at + 1 < 2 * line; ++at) {
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    Rewrite(changed);
    CellTable cells;
    const auto content = Read(cells);
    if (at + 1 == line) continue;  // without its end the first line runs on into the second
    ASSERT_TRUE(content) << at << ": " << ToString(content.error());
    EXPECT_EQ(content->head.build, head_.build) << at;
    EXPECT_TRUE(cells[0] && cells[3]) << at;
  }
  std::string changed = text;
  changed[5] = changed[line + 5] = 'x';
  Rewrite(changed);
  EXPECT_THAT(Complaint(), HasSubstr("not the head of a journal, and no copy of it follows"));
}

TEST_F(JournalTest, RefusesACellTwice) {
  WriteTwo();
  const std::string text = Text();
  Rewrite(text + text.substr(EndOfHead(text)));
  EXPECT_THAT(Complaint(), HasSubstr("journal.jsonl:5: cell 3 (small/joint_noise_deg=2/001/least-squares) stands in"));
}

TEST_F(JournalTest, RefusesACellOfAnotherShard) {
  auto journal = Journal::Begin(folder(), {"m", "b", {1, 2}});
  ASSERT_TRUE(journal);
  ASSERT_TRUE(journal->Append(0, CellWith(0, 1)));  // world 0 is the first shard's
  EXPECT_EQ(Complaint(), "");
  ASSERT_TRUE(journal->Append(2, CellWith(2, 1)));  // world 1 is not
  EXPECT_THAT(Complaint(), HasSubstr("is none of this run's shard 1/2"));
}

TEST_F(JournalTest, RefusesACellWhoseNumberIsAnothers) {
  auto journal = Journal::Begin(folder(), head_);
  ASSERT_TRUE(journal);
  ASSERT_TRUE(journal->Append(1, CellWith(0, 1)));
  EXPECT_THAT(Complaint(), HasSubstr("cell 1 (small/joint_noise_deg=2/000/fixed) is none of this run's"));
}

TEST_F(JournalTest, RefusesOneOfAnotherVersionOrWithoutHead) {
  // As an earlier program wrote it: one head, without a sum.
  Rewrite("{\"journal\":1,\"manifest\":\"m\",\"build\":\"b\",\"shard\":\"1/1\"}\n");
  EXPECT_THAT(Complaint(), HasSubstr("journal.jsonl:1: not the head of a journal"));
  Rewrite("");
  EXPECT_THAT(Complaint(), HasSubstr("is empty"));
}

}  // namespace
}  // namespace etude

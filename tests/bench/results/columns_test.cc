#include "bench/results/columns.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "bench/results/seal.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

/// Two scenarios whose cells have every status; the second uses clips.
std::vector<Study> Studies() {
  Study first, second;
  first.scenario = "poses";
  first.task = "ik";
  first.trials = 4;
  first.methods = {{"one", "one", false}, {"two", "one", false}};
  first.conditions = {{{"joint_noise_deg", "5"}, {"noise", "uniform"}}, {{"joint_noise_deg", "0.10"}, {"noise", "x"}}};
  first.metrics = {"position_error_cm"};
  second.scenario = "clips";
  second.task = "transition";
  second.trials = 3;
  second.methods = {{"cut", "cut", false}};
  second.conditions = {{}};
  return {first, second};
}

CellResult ResultOf(std::size_t place) {
  if (place % 5 == 3) {
    CellResult broken = CellResult::Ended(Status::kBadOutput, fmt::format("line {} is \"odd\"", place));
    broken.Missing("position_error_cm", broken.reason);
    broken.Measure("solved_practical", 0);
    return broken;
  }
  CellResult result = CellResult::Ended(place % 5 == 2 ? Status::kUnsolved : Status::kOk, "");
  if (place % 5 == 2) result.reason = "stalled";
  if (place % 4 == 1) result.Missing("hidden_angle_error_deg", "no truth");
  result.Measure("position_error_cm", 0.1 * static_cast<double>(place) + 1e-17);
  if (place > 6) result.Measure("iterations", -0.0);
  result.digests = {{"world", fmt::format("{:016x}", place * 0x123456789abcdefULL)}};
  if (place % 3 == 0) result.digests.emplace_back("solution", "00000000000000ff");
  if (place != 1) {
    result.series.push_back({"position_error_cm", "iteration", std::vector<double>(place % 4, 0.25 * place)});
    if (place % 2 == 0) result.series.back().names = {"clap", "sway, \"slow\""};
  }
  return result;
}

std::vector<Row> RowsOf(const std::vector<Study>& studies) {
  std::vector<Row> rows;
  for (const Study& study : studies) {
    for (const auto& condition : study.conditions) {
      for (int trial = 0; trial < study.trials; ++trial) {
        for (const ComparedMethod& method : study.methods) {
          Row row{study.scenario, study.task, condition, trial, "", {}, method.name, ResultOf(rows.size())};
          if (study.scenario == "clips") {
            row.clip = trial == 1 ? "" : "builtin:clap";
            row.units = {row.clip, "builtin:sway, \"slow\""};
            if (trial == 2) row.result.judged = {{"head", "root pelvis"}, 59.94, {{"error_mm", 0.1 + 0.2}}};
          }
          rows.push_back(std::move(row));
        }
      }
    }
  }
  return rows;
}

class ColumnsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = TemporaryFolder::Make("columns-test");
    ASSERT_TRUE(made);
    folder_.emplace(std::move(*made));
    Write(folder(), 0);
  }

  void Write(const fs::path& to, std::size_t most_as_text) const {
    auto writer = ResultWriter::Begin(to, studies_, most_as_text);
    ASSERT_TRUE(writer);
    for (const Row& row : rows_) {
      ASSERT_OK(added, writer->Add(row, {.wall_s = 1, .cpu_s = 0.5 * row.trial, .peak_mb = 3}));
    }
    std::vector<ScenarioSummary> summaries;
    for (const Study& study : studies_) summaries.emplace_back().name = study.scenario;
    ASSERT_OK(finished, writer->Finish(summaries));
    ASSERT_TRUE(WriteFileAtomically(to / "manifest.json",
                                    fmt::format(R"({{"schema":{},"suite":"s","seed":1,"etude":"0"}})", kResultSchema)));
    ASSERT_TRUE(WriteFileAtomically(to / "host.json", R"({"command_line":"c","host":"h","wall_seconds":1})"));
    ASSERT_TRUE(SealRun(to));
  }

  const fs::path& folder() const { return folder_->path(); }
  std::string Complaint() const { return testing::Refusal(LoadRun(folder(), Sealing::kIgnored)); }

  const std::vector<Study> studies_ = Studies();
  const std::vector<Row> rows_ = RowsOf(studies_);
  std::optional<TemporaryFolder> folder_;
};

TEST_F(ColumnsTest, GiveBackEveryRowToTheByte) {
  std::string text, wanted;
  ASSERT_OK(written, WriteRows(folder(), Sealing::kRequired, [&](std::string_view line) -> Result<void> {
              text += line;
              return {};
            }));
  for (const Row& row : rows_) wanted += *WriteJson(EncodeRow(row)) + "\n";
  EXPECT_EQ(text, wanted);
  // A run stored as text gives the same rows, and the same file.
  const fs::path as_text = folder() / "as-text";
  Write(as_text, rows_.size());
  EXPECT_EQ(*ReadWholeFile(as_text / "cells.jsonl"), wanted);
  EXPECT_FALSE(fs::exists(folder() / "cells.jsonl"));
  EXPECT_FALSE(fs::exists(as_text / "columns"));
}

TEST_F(ColumnsTest, GiveBackCurvesAndTimes) {
  ASSERT_OK(run, LoadRun(folder()));
  ASSERT_EQ(run->source->size(), rows_.size());
  for (std::size_t place = 0; place < rows_.size(); ++place) {
    const auto series = run->source->SeriesOf(place);
    ASSERT_EQ(series.size(), rows_[place].result.series.size()) << place;
    for (std::size_t i = 0; i < series.size(); ++i) {
      EXPECT_EQ(series[i].values, rows_[place].result.series[i].values) << place;
      EXPECT_EQ(series[i].axis, "iteration");
      EXPECT_EQ(series[i].names, rows_[place].result.series[i].names);
    }
    EXPECT_EQ(run->source->CpuSecondsOf(place), 0.5 * rows_[place].trial);
    EXPECT_EQ(RowAt(*run, place).Id(), rows_[place].Id());
    EXPECT_EQ(FindRow(*run, rows_[place].Id()), place);
  }
  EXPECT_FALSE(FindRow(*run, "poses/-/000/one"));
}

TEST_F(ColumnsTest, GiveWholeWorldsAtEqualSteps) {
  ASSERT_OK(run, LoadRun(folder()));
  EXPECT_EQ(run->rows.size(), rows_.size()) << "few rows are all held";
  const auto places = run->source->SampleRowIndices(7);  // every third world
  EXPECT_EQ(places, (std::vector<std::size_t>{0, 1, 6, 7, 12, 13, 16}));
}

TEST_F(ColumnsTest, AreWhatNumPySays) {
  const std::string file = *ReadWholeFile(folder() / "columns" / "poses" / "position_error_cm.npy");
  ASSERT_EQ(file.size(), kNpyHead + 16 * sizeof(double));
  EXPECT_EQ(file.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(static_cast<unsigned char>(file[8]) + 256 * static_cast<unsigned char>(file[9]), kNpyHead - 10);
  EXPECT_THAT(file.substr(10), ::testing::StartsWith("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 4, 2), }"));
  EXPECT_EQ(file[kNpyHead - 1], '\n');
  const std::string flat = *ReadWholeFile(folder() / "columns" / "poses" / "series" / "position_error_cm.npy");
  EXPECT_THAT(flat.substr(10), HasSubstr("'shape': (19,), }"));
}

// A column that was truncated or removed, or that points outside the folder, is refused by name.
TEST_F(ColumnsTest, ThatAreNotAsTheyWereWrittenAreRefused) {
  const fs::path own = folder() / "columns" / "poses";
  const auto with = [&](const fs::path& file, const auto& change) {
    const std::string text = *ReadWholeFile(file);
    std::string changed = text;
    change(changed);
    EXPECT_TRUE(WriteFileAtomically(file, changed));
    EXPECT_THAT(ToString(LoadRun(folder()).error()), HasSubstr("was changed after the run wrote it"));
    const std::string complaint = Complaint();
    EXPECT_TRUE(WriteFileAtomically(file, text));
    return complaint;
  };
  EXPECT_EQ(Complaint(), "accepted");
  EXPECT_THAT(with(own / "status.npy", [](std::string& text) { text.pop_back(); }),
              HasSubstr("status.npy: contains 15 numbers, but the run has 16 rows"));
  EXPECT_THAT(with(own / "status.npy", [](std::string& text) { text.resize(20); }), HasSubstr("it is too short"));
  EXPECT_THAT(with(own / "status.npy", [](std::string& text) { text.back() = 8; }),
              HasSubstr("status.npy contains the index 8, but there are only 8 statuses"));
  EXPECT_THAT(with(own / "kind.npy", [](std::string& text) { text.back() = 1; }), HasSubstr("kind.npy contains"));
  EXPECT_THAT(with(own / "reason.npy", [](std::string& text) { text.back() = 1; }), HasSubstr("reason.npy contains "));
  EXPECT_THAT(with(own / "position_error_cm.npy", [](std::string& text) { text[14] = 'X'; }),
              HasSubstr("is not a column of numbers of type <f8"));
  EXPECT_THAT(with(own / "series" / "position_error_cm.ends.npy", [](std::string& text) { text.back() = 1; }),
              HasSubstr("are not stored one after the other"));
  // With this shape NumPy would read the two methods of a trial as two trials of one method.
  EXPECT_THAT(with(own / "position_error_cm.npy",
                   [](std::string& text) { text.replace(text.find("(2, 4, 2)"), 9, "(2, 2, 4)"); }),
              HasSubstr("does not have the shape (conditions, trials, methods) of the run"));
  EXPECT_THAT(with(own / "index.json", [](std::string& text) { text = "{}"; }), HasSubstr("not an index of columns"));
  const auto with_index = [&](const char* key, const nlohmann::json& value, const char* scenario = "poses") {
    return with(folder() / "columns" / scenario / "index.json", [&](std::string& text) {
      nlohmann::json index = nlohmann::json::parse(text);
      index[nlohmann::json::json_pointer(key)] = value;
      text = index.dump();
    });
  };
  EXPECT_THAT(with_index("/trials", -1), HasSubstr("contains no cells"));
  EXPECT_THAT(with_index("/methods", nlohmann::json::array()), HasSubstr("contains no cells"));
  EXPECT_THAT(with_index("/texts", nlohmann::json::array()), HasSubstr("refers to a text that does not exist"));
  EXPECT_THAT(with_index("/kinds/0/why/0", -2), HasSubstr("refers to a text that does not exist"));
  const auto texts = nlohmann::json::parse(*ReadWholeFile(folder() / "columns" / "clips" / "index.json")).at("texts");
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (!texts[i].get<std::string>().starts_with('[')) continue;
    const std::string key = fmt::format("/texts/{}", i);
    EXPECT_THAT(with_index(key.c_str(), "[1]", "clips"), HasSubstr("'[1]' is not a list of units"));
    EXPECT_THAT(with_index(key.c_str(), "[", "clips"), HasSubstr("clips"));
  }
  fs::remove(own / "digest_world.npy");
  EXPECT_THAT(Complaint(), HasSubstr("digest_world.npy: no such file"));
}

TEST_F(ColumnsTest, AreNotReadThroughLinksNorOutsideOfTheirRun) {
  const fs::path own = folder() / "columns" / "poses", elsewhere = folder() / "elsewhere";
  fs::rename(own, elsewhere);
  fs::create_directory_symlink(elsewhere, own);
  EXPECT_THAT(Complaint(), HasSubstr("poses: this is a link"));
  fs::remove(own);
  fs::rename(elsewhere, own);
  EXPECT_EQ(Complaint(), "accepted");
  fs::rename(own / "status.npy", folder() / "status.npy");
  fs::create_symlink(folder() / "status.npy", own / "status.npy");
  EXPECT_THAT(Complaint(), HasSubstr("status.npy: this is a link"));
  EXPECT_THAT(ToString(OpenColumns(folder(), {"../../columns/poses"}).error()), HasSubstr("leads out of"));
}

TEST_F(ColumnsTest, ListTheFilesThatTheyAreKeptIn) {
  ASSERT_OK(index, ReadColumnIndex(folder() / "columns" / "poses"));
  const std::set<fs::path> files = FilesOfColumns(*index);
  std::size_t found = 0;
  for (const char* part : {"columns/poses", "timings/poses"}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder() / part)) {
      if (entry.is_directory()) continue;
      ++found;
      EXPECT_TRUE(files.contains(entry.path().lexically_relative(folder()))) << entry.path();
    }
  }
  EXPECT_GT(found, 10u);
  EXPECT_LE(found, files.size());
}

TEST_F(ColumnsTest, RefuseADigestThatIsNone) {
  ColumnWriter writer(folder() / "other", studies_.front());
  Row row = rows_.front();
  row.result.digests = {{"world", "happy"}};
  EXPECT_THAT(testing::Message(writer.Add(row, {})), HasSubstr("the digest of world is 'happy'"));
}

TEST_F(ColumnsTest, ThatAreCutShortWhileTheyAreMappedEndTheProcessWithASentence) {
  const fs::path file = folder() / "cut.npy";
  auto writer = NpyWriter::Begin(file, kNpyType<double>);
  for (int i = 0; i < 10'000; ++i) ASSERT_TRUE(writer->Add(1.0 * i));
  ASSERT_TRUE(writer->Finish());
  ASSERT_OK(mapped, NpyFile::Open(file, kNpyType<double>));
  EXPECT_EQ(mapped->Numbers<double>().back(), 9999);
  fs::resize_file(file, kNpyHead);
  EXPECT_EXIT(
      {
        ExitOnTruncatedMapping();
        std::exit(mapped->Numbers<double>().back() > 0 ? 1 : 0);
      },
      ::testing::ExitedWithCode(3), "another program shortened a file of the run");
}

}  // namespace
}  // namespace etude

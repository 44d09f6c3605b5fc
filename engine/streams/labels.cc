#include "engine/streams/labels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
constexpr double kMaxTime_s = 1e12;  // upper bound of a time in seconds; clocks may start at any time
constexpr std::size_t kMaxNameBytes = 200;

/// One cell of a line: its text and its column, from 1.
struct Cell {
  std::string_view text;
  int column = 1;
};

std::vector<Cell> CellsOf(std::string_view line, char separator) {
  std::vector<Cell> cells;
  for (const std::string_view part : SplitAt(line, separator)) {
    const std::string_view word = Trimmed(part);
    cells.push_back({word, static_cast<int>((word.empty() ? part : word).data() - line.data()) + 1});
  }
  return cells;
}

/// Iterates over the lines of a text; empty lines and lines that begin with '#' are skipped.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(WithoutByteOrderMark(text)) {}
  /// Returns the next line; nullopt at the end.
  std::optional<std::string_view> Next() {
    while (!text_.empty()) {
      const std::string_view line = TakeLine(text_);
      ++number_;
      if (const std::string_view words = Trimmed(line); !words.empty() && words.front() != '#') return line;
    }
    return std::nullopt;
  }
  int number() const { return number_; }

 private:
  std::string_view text_;
  int number_ = 0;
};

Result<double> NumberIn(const Cell& cell, const std::string& file, int line, double largest) {
  const auto value = ParseFinite(cell.text);
  if (value && std::abs(*value) <= largest) return *value;
  return Fail({file, line, cell.column}, "found {}; allowed: a number within ±{:g}", Quote(cell.text), largest);
}

Result<std::string> NameIn(const Cell& cell, const std::string& file, int line, std::string_view what) {
  const bool is_name =
      !cell.text.empty() && cell.text.size() <= kMaxNameBytes &&
      std::ranges::none_of(cell.text, [](char c) { return (c >= 0 && c < ' ') || c == ',' || c == '"'; });
  if (is_name) return std::string(cell.text);
  return Fail({file, line, cell.column},
              "found {} for {}; allowed: a name of at most {} bytes, without quotes and commas", Quote(cell.text), what,
              kMaxNameBytes);
}

/// Splits a line of a CSV at its commas. A cell may be in quotes, as R and spreadsheets write every string.
std::vector<Cell> CellsOfCsv(std::string_view line) {
  std::vector<Cell> cells = CellsOf(line, ',');
  for (Cell& cell : cells) {
    if (cell.text.size() < 2 || !cell.text.starts_with('"') || !cell.text.ends_with('"')) continue;
    cell.text = Trimmed(cell.text.substr(1, cell.text.size() - 2));
  }
  return cells;
}

constexpr std::array<std::string_view, 6> kHeadings = {"clip", "from_s", "to_s", "move", "truth", "person"};

/// Finds the column of each heading. A first heading `""` is that of R's row names, which are left out.
Result<std::array<std::optional<std::size_t>, kHeadings.size()>> FindHeadings(std::string_view line,
                                                                              const std::string& file, int number) {
  std::array<std::optional<std::size_t>, kHeadings.size()> found;
  const std::vector<Cell> cells = CellsOfCsv(line);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i == 0 && Trimmed(line).starts_with("\"\",")) continue;
    const auto at = std::ranges::find(kHeadings, cells[i].text);
    if (at == kHeadings.end()) {
      const std::vector<std::string> known(kHeadings.begin(), kHeadings.end());
      return Fail({file, number, cells[i].column}, "{}", UnknownName("heading", cells[i].text, known));
    }
    auto& column = found[static_cast<std::size_t>(at - kHeadings.begin())];
    if (column)
      return Fail({file, number, cells[i].column}, "the heading '{}' is given twice; allowed: each heading once", *at);
    column = i;
  }
  for (std::size_t h = 0; h + 1 < kHeadings.size(); ++h) {
    if (!found[h])
      return Fail({file, number}, "the heading '{}' is missing; allowed: the headings clip,from_s,to_s,move,truth",
                  kHeadings[h]);
  }
  return found;
}

Result<std::vector<Label>> ReadCsv(Lines lines, const std::string& file) {
  std::vector<Label> labels;
  const auto heading = lines.Next();
  if (!heading) return labels;
  ASSIGN_OR_RETURN(const auto columns, FindHeadings(*heading, file, lines.number()));
  // Read one label from each row.
  while (const auto line = lines.Next()) {
    const int number = lines.number();
    const std::vector<Cell> cells = CellsOfCsv(*line);
    const auto cell = [&](std::size_t heading_index) {
      const auto column = columns[heading_index];
      return column && *column < cells.size() ? cells[*column] : Cell{{}, static_cast<int>(line->size()) + 1};
    };
    Label label;
    label.line = number;
    // Read names and truth.
    ASSIGN_OR_RETURN(label.clip, NameIn(cell(0), file, number, "clip"));
    ASSIGN_OR_RETURN(label.move, NameIn(cell(3), file, number, "move"));
    ASSIGN_OR_RETURN(const std::string truth,
                     NameIn(cell(4), file, number, "truth ('right', or the name of the fault)"));
    if (truth != "right") label.fault = truth;
    if (!cell(5).text.empty()) {
      ASSIGN_OR_RETURN(label.person, NameIn(cell(5), file, number, "person"));
    }
    // Read `from_s` and `to_s`. Either only the cell of `to_s` or both cells may be empty.
    for (const std::size_t i : {1, 2}) {
      if (cell(i).text.empty() || cell(i).text == "NA") continue;  // R writes NA for a missing number
      ASSIGN_OR_RETURN((i == 1 ? label.from_s : label.to_s), NumberIn(cell(i), file, number, kMaxTime_s));
    }
    if (label.to_s && !label.from_s)
      return Fail({file, number, cell(2).column},
                  "found 'to_s' without 'from_s'; allowed: both, 'from_s' alone, or neither");
    if (label.to_s && *label.to_s <= *label.from_s) {
      return Fail({file, number, cell(2).column},
                  "the label ends at {} s, before its beginning at {} s; allowed: an end after the beginning",
                  *label.to_s, *label.from_s);
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

/// Reads MSRC-12's tag stream. Times in the stream are ticks of 49.875 MHz; they are converted to the recording's
/// clock, which counts microseconds.
Result<std::vector<Label>> ReadTags(Lines lines, const std::string& file, std::string_view clip) {
  constexpr double kTicksPerSecond = 49'875'000;
  std::vector<Label> labels;
  lines.Next();  // the heading: XQPCTick;Tag
  while (const auto line = lines.Next()) {
    const int number = lines.number();
    const std::vector<Cell> cells = CellsOf(*line, ';');
    if (cells.size() != 2) return Fail({file, number}, "found {} words; allowed: a tick and a tag", cells.size());
    ASSIGN_OR_RETURN(const double tick, NumberIn(cells[0], file, number, 1e19));
    Label label;
    label.clip = clip;
    label.from_s = tick / kTicksPerSecond;
    ASSIGN_OR_RETURN(label.move, NameIn(cells[1], file, number, "tag"));
    label.by_own_clock = true;
    label.line = number;
    labels.push_back(std::move(label));
  }
  return labels;
}

bool IsTakeName(std::string_view line) {
  constexpr std::string_view kPattern = "s00_e00";
  const auto fits = [](char c, char p) { return p == '0' ? c >= '0' && c <= '9' : c == p; };
  return std::ranges::equal(line, kPattern, fits);
}

Result<std::vector<Label>> ReadActionLabels(Lines lines, const std::string& file) {
  std::vector<Label> labels;
  std::string take;
  // A line is either a take's name, or an action with its first and last frame.
  while (const auto line = lines.Next()) {
    const int number = lines.number();
    if (IsTakeName(Trimmed(*line))) {
      take = Trimmed(*line);
      continue;
    }
    const std::size_t colon = line->find(':');
    if (colon == std::string_view::npos)
      return Fail({file, number}, "found {}; allowed: 'walk: 252 390'", Quote(*line));
    std::vector<Cell> cells;
    for (Cell cell : CellsOf(line->substr(colon + 1), ' ')) {
      cell.column += static_cast<int>(colon) + 1;
      if (!cell.text.empty()) cells.push_back(cell);
    }
    if (cells.size() != 2)
      return Fail({file, number}, "found {} numbers; allowed: a first and a last frame", cells.size());
    if (cells[0].text == "NaN" || cells[1].text == "NaN") continue;
    Label label;
    label.clip = take;
    label.by_own_clock = true;
    label.line = number;
    ASSIGN_OR_RETURN(label.move, NameIn({Trimmed(line->substr(0, colon)), 1}, file, number, "action"));
    ASSIGN_OR_RETURN(const double first, NumberIn(cells[0], file, number, 1e9));
    ASSIGN_OR_RETURN(const double last, NumberIn(cells[1], file, number, 1e9));
    if (last <= first) return Fail({file, number, cells[1].column}, "the label's last frame is not after its first");
    label.from_s = first / kJudgedRateHz;
    label.to_s = last / kJudgedRateHz;
    label.person = take.substr(0, take.find('_'));
    labels.push_back(std::move(label));
  }
  return labels;
}

}  // namespace

Result<std::vector<Label>> ReadLabels(std::string_view text, const std::string& file, std::string_view clip) {
  if (text.size() > kMaxBytes) return Fail({file}, "found {} bytes; allowed: at most {}", text.size(), kMaxBytes);
  Lines lines(text);
  const std::string_view first = Trimmed(Lines(text).Next().value_or(""));
  auto labels = first.starts_with("XQPCTick") ? ReadTags(lines, file, clip)
                : IsTakeName(first)           ? ReadActionLabels(lines, file)
                                              : ReadCsv(lines, file);
  if (labels && labels->empty()) return Fail({file}, "no labels");
  return labels;
}

bool NamesManyRecordings(const Label& label) { return IsTakeName(label.clip); }

bool IsLabelOf(const Label& label, std::string_view recording, std::string_view source) {
  if (label.clip == recording) return true;
  if (NamesManyRecordings(label)) return recording.find(label.clip) != std::string_view::npos;
  // Compare with the end of the path, with and without its extension.
  const std::string_view last = std::string_view(label.clip).substr(label.clip.find_last_of("/\\") + 1);
  if (source.find(last) == std::string_view::npos) return false;
  std::string path(source), clip = label.clip;
  std::ranges::replace(path, '\\', '/');
  std::ranges::replace(clip, '\\', '/');
  const auto ends_path = [&](std::string_view whole) {
    return whole == clip || (whole.ends_with(clip) && whole[whole.size() - clip.size() - 1] == '/');
  };
  const std::size_t name = path.find_last_of('/') + 1, dot = path.find_last_of('.');
  const bool has_extension = dot != std::string::npos && dot > name;
  return ends_path(path) || (has_extension && ends_path(std::string_view(path).substr(0, dot)));
}

}  // namespace etude

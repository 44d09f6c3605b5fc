#include "reports/paper/paper_b_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <span>
#include <utility>

#include "reports/paper/paper_b_figures.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

// A cell that keeps one of the errors keeps them all.
constexpr std::string_view kErrorSeries = "position_error_x_cm";

constexpr std::string_view kNoAxis = "a — stands where the joint has no such axis.";

using Rows = std::vector<const Row*>;
/// What several trials' values of one figure become.
using Aggregator = std::function<double(std::vector<double>)>;

double First(const std::vector<double>& values) { return values.front(); }

double MedianSize(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return Median(std::move(values));
}

double RootMeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// A figure over those of `rows` that have it, or nothing.
std::optional<double> Figure(const CellSeriesIndex& series, std::span<const Row* const> rows, const std::string& name,
                             std::size_t index, const Aggregator& aggregate) {
  std::vector<double> values;
  for (const Row* row : rows) {
    const std::vector<double>* found = series.Find(*row, name);
    if (found != nullptr && index < found->size()) values.push_back((*found)[index]);
  }
  return values.empty() ? std::nullopt : std::optional(aggregate(std::move(values)));
}

std::optional<double> MetricOver(std::span<const Row* const> rows, std::string_view metric) {
  std::vector<double> values;
  for (const Row* row : rows) {
    if (const auto value = ValueOf(*row, metric)) values.push_back(*value);
  }
  return values.empty() ? std::nullopt : std::optional(Median(std::move(values)));
}

/// Makes the tables of one condition.
class Study {
 public:
  Study(const CellSeriesIndex& series, const ScenarioSummary& scenario, Rows rows)
      : series_(series), scenario_(scenario), rows_(std::move(rows)), tree_(MakeBodyTree({})) {}

  bool HasErrors(const Row& row) const { return series_.Find(row, kErrorSeries) != nullptr; }

  PaperBSet OneTrial(int trial) const {
    Rows rows;
    for (const Row* row : rows_) {
      if (row->trial == trial) rows.push_back(row);
    }
    PaperBSet set;
    set.title = fmt::format("trial {}", trial);
    set.error_note =
        "Position errors: effector − target along the world’s axes. Orientation errors: between each of the "
        "effector’s own axes and its target.";
    set.replay = fmt::format("etude replay RUN --cell '{}'", rows.front()->Id());
    Fill(rows, First, "", set);
    AddAngles(
        rows, "angle_change_deg", "how far it turned each joint from the start",
        [](std::vector<double> values) { return std::abs(values.front()); }, set);
    if (!set.angles.empty()) {
      set.angle_note =
          fmt::format("Hidden angles: how far each joint was turned from the start, without sign; {}", kNoAxis);
    }
    return set;
  }

  PaperBSet AllTrials() const {
    PaperBSet set;
    set.title = fmt::format("all {}", Plural(TrialCount(), "trial"));
    set.error_note = "Position and orientation errors: the median of their absolute values over the trials.";
    Fill(rows_, MedianSize, ", median", set);
    AddAngles(rows_, "angle_change_deg", "how far it turned each joint from the start, root mean square",
              RootMeanSquare, set);
    AddAngles(rows_, "angle_error_deg", "how far each joint ended from the truth, root mean square", RootMeanSquare,
              set);
    if (!set.angles.empty()) {
      set.angle_note = fmt::format(
          "Hidden angles: root mean square over the trials, as turned from the start and as it differs from the "
          "truth; {}",
          kNoAxis);
    }
    return set;
  }

  long long TrialCount() const {
    return std::ranges::count(rows_, scenario_.methods.front(), [](const Row* row) { return row->method; });
  }

 private:
  PaperTable Errors(std::string caption, std::span<const Row* const> rows, const std::string& prefix,
                    const Aggregator& aggregate) const {
    PaperTable table{std::move(caption), PaperBErrorColumns(), {}};
    for (const PaperBEffector& effector : kPaperBEffectors) {
      const auto found = std::ranges::find(tree_.effectors, effector.name, &Effector::name);
      const auto index = static_cast<std::size_t>(found - tree_.effectors.begin());
      PaperRow row{effector.label, {}};
      for (const auto& [kind, unit] : {std::pair("position", "cm"), std::pair("orientation", "deg")}) {
        for (const char* axis : {"x", "y", "z"}) {
          const std::string name = fmt::format("{}{}_error_{}_{}", prefix, kind, axis, unit);
          row.values.push_back(Figure(series_, rows, name, index, aggregate));
        }
      }
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  PaperTable Angles(std::string caption, std::span<const Row* const> rows, const std::string& name,
                    const Aggregator& aggregate) const {
    PaperTable table{std::move(caption), PaperBAngleColumns(), {}};
    for (const PaperBJoint& entry : kPaperBJoints) {
      const TreeJoint& joint = tree_.joints[entry.joint];
      PaperRow row{entry.label, {}};
      for (int axis = 0; axis < 3; ++axis) {
        row.values.push_back(axis < joint.dof_count ? Figure(series_, rows, name, joint.first_dof + axis, aggregate)
                                                    : std::nullopt);
      }
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  Rows OfMethod(std::span<const Row* const> rows, const std::string& method) const {
    Rows found;
    std::ranges::copy_if(rows, std::back_inserter(found), [&](const Row* row) { return row->method == method; });
    return found;
  }

  // All methods start from the same pose, so the first cell of a trial that records it is enough.
  Rows OnePerTrial(std::span<const Row* const> rows) const {
    Rows found;
    std::set<int> trials;
    for (const Row* row : rows) {
      if (HasErrors(*row) && trials.insert(row->trial).second) found.push_back(row);
    }
    return found;
  }

  void Fill(std::span<const Row* const> rows, const Aggregator& aggregate, const char* how, PaperBSet& set) const {
    set.errors.push_back(
        Errors(fmt::format("{} before{}", PaperLetter(0), how), OnePerTrial(rows), "start_", aggregate));
    for (const std::string& method : scenario_.methods) {
      const Rows of_method = OfMethod(rows, method);
      if (std::ranges::any_of(of_method, [&](const Row* row) { return HasErrors(*row); })) {
        set.errors.push_back(Errors(fmt::format("{} after {}{}", PaperLetter(set.errors.size()), method, how),
                                    of_method, "", aggregate));
      }
      if (!of_method.empty()) set.outcomes.push_back(Outcome(method, of_method));
    }
  }

  void AddAngles(std::span<const Row* const> rows, const std::string& name, const char* caption,
                 const Aggregator& aggregate, PaperBSet& set) const {
    for (const std::string& method : scenario_.methods) {
      const Rows of_method = OfMethod(rows, method);
      if (std::ranges::none_of(of_method, [&](const Row* row) { return series_.Find(*row, name) != nullptr; }))
        continue;
      const std::string letter = PaperLetter(set.errors.size() + set.angles.size());
      set.angles.push_back(Angles(fmt::format("{} {}: {}", letter, method, caption), of_method, name, aggregate));
    }
  }

  std::string Outcome(const std::string& method, const Rows& rows) const {
    std::string text;
    if (rows.size() == 1) {
      const CellResult& result = rows.front()->result;
      text = fmt::format("{}: {}", method, StatusName(result.status));
      if (!result.reason.empty()) text += fmt::format(" ({})", result.reason);
    } else {
      const auto ok = std::ranges::count(rows, Status::kOk, [](const Row* row) { return row->result.status; });
      text = fmt::format("{}: {} of {} ok", method, FormatCount(ok), FormatCount(std::ssize(rows)));
      const auto with = std::ranges::count_if(rows, [&](const Row* row) { return HasErrors(*row); });
      if (with < std::ssize(rows)) text += fmt::format(", figures of {} of them only", FormatCount(with));
    }
    const std::string_view median = rows.size() == 1 ? "" : "median ";
    if (const auto iterations = MetricOver(rows, "iterations")) {
      text += fmt::format("; {}{} iterations", median, FormatNumber(*iterations));
    }
    if (const auto change = MetricOver(rows, "hidden_angle_change_deg")) {
      text += fmt::format("; hidden angles {}{}° from the start", median, FormatNumber(*change));
    }
    if (const auto error = MetricOver(rows, "hidden_angle_error_deg")) {
      text += fmt::format(", {}{}° from the truth", median, FormatNumber(*error));
    }
    return text;
  }

  const CellSeriesIndex& series_;
  const ScenarioSummary& scenario_;
  const Rows rows_;
  const KinematicTree tree_;
};

}  // namespace

bool HasPaperBTables(const RunData& run, const ScenarioSummary& scenario) {
  return scenario.task == "ik" && KeepsSeries(run, scenario, kErrorSeries);
}

std::vector<PaperBCondition> PaperBTables(const RunData& run, const ScenarioSummary& scenario) {
  if (!HasPaperBTables(run, scenario)) return {};
  const CellSeriesIndex series(run);
  std::vector<PaperBCondition> conditions;
  for (const ConditionSummary& summary : scenario.conditions) {
    const Rows rows = RowsUnder(run, scenario, summary.condition);
    const Study study(series, scenario, rows);
    const auto first = std::ranges::find_if(rows, [&](const Row* row) { return study.HasErrors(*row); });
    if (first == rows.end()) continue;
    PaperBCondition condition{summary.condition, {study.OneTrial((*first)->trial)}};
    if (study.TrialCount() > 1) condition.sets.push_back(study.AllTrials());
    conditions.push_back(std::move(condition));
  }
  return conditions;
}

}  // namespace etude

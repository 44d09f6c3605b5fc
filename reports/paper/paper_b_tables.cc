#include "reports/paper/paper_b_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <span>
#include <utility>

#include "engine/base/order_statistics.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"

namespace etude {

std::string PaperLetter(std::size_t index) {
  return index < 26 ? fmt::format("({})", static_cast<char>('a' + index)) : fmt::format("({})", index + 1);
}

Table TableOf(const PaperTable& table) {
  constexpr int kDecimals = 6;  // the number of decimals that paper B prints
  Table shown{.label = table.caption, .style = "printed", .caption = table.caption, .columns = {{.is_row_head = true}}};
  for (const PaperColumns& group : table.columns) {
    for (const std::string& name : group.names) {
      shown.columns.push_back({.head = name, .is_number = true, .over = group.head});
    }
  }
  for (const PaperRow& row : table.rows) {
    TableRow& added = shown.rows.emplace_back(TableRow{{row.label}});
    for (const auto& value : row.values) {
      added.cells.push_back({value ? FormatFixed(*value, kDecimals) : std::string(kNoValue), value});
    }
  }
  return shown;
}

namespace {

using ErrorFigures = std::array<std::array<double, 6>, kPaperBEffectors.size()>;
using AngleFigures = std::array<std::array<double, 3>, kPaperBJoints.size()>;

// clang-format off
constexpr ErrorFigures kBefore{{
    {28.292493, -4.427365, -3.938767, 17.809257, 19.458058, 9.723260},
    {57.308943, 14.950596, 7.224642, 17.268648, 52.827193, 55.006472},
    {53.508804, 14.694903, 13.463555, 9.729935, 49.280210, 50.304584},
    {61.728708, 21.893489, -11.385678, 18.896609, 34.220754, 38.819361},
}};
constexpr ErrorFigures kFixed{{
    {-0.010400, 0.011438, -0.046322, 14.535262, 21.339514, 16.403145},
    {-0.007486, -0.004247, 0.006663, 2.910135, 2.874537, 0.601138},
    {-0.012744, -0.003156, 0.003091, 1.391934, 1.524529, 0.900296},
    {0.030394, 0.595016, -2.183021, 4.359893, 0.635652, 4.406011},
}};
constexpr ErrorFigures kUpdated{{
    {0.476309, 0.137951, -0.583270, 3.376447, 7.307588, 6.717927},
    {0.030684, 0.007300, -0.024493, 0.000172, 0.000888, 0.000872},
    {0.032817, 0.007655, -0.017395, 0.001616, 0.001982, 0.001192},
    {-0.046843, 0.634962, -1.794233, 0.000848, 0.007454, 0.007421},
}};
constexpr ErrorFigures kFree{{
    {0.194973, -0.130546, -0.081912, 3.499468, 2.218099, 3.880775},
    {-0.087773, -0.206583, -0.084807, 0.488538, 0.414206, 0.259697},
    {0.110021, -0.137182, 0.015583, 0.203689, 0.203479, 0.084310},
    {-0.010669, 0.516356, -1.461465, 0.117631, 0.117882, 0.007709},
}};
constexpr AngleFigures kFreeAngles{{
    {11.159300, 2.110779, 28.154774},
    {5.775356, 0.000000, 0.000000},
    {5.775356, 4.832303, 0.000000},
    {9.758395, 10.877118, 20.558036},
    {11.033809, 0.000000, 0.000000},
    {0.429275, 4.422612, 0.000000},
    {4.030913, 0.294248, 23.764240},
    {9.020453, 11.776628, 10.000000},
    {14.786718, 0.087431, 0.000000},
    {12.422164, 0.000000, 0.000000},
    {3.000000, 24.895279, 31.813163},
    {34.202308, 14.365972, 1.497364},
    {0.377350, 0.000000, 0.000000},
    {0.089097, 0.000000, 0.000000},
}};
constexpr AngleFigures kBoundAngles{{
    {1.254728, 0.929658, 5.717352},
    {5.108931, 0.000000, 0.000000},
    {5.798829, 0.456462, 0.000000},
    {4.230219, 2.250052, 5.087495},
    {0.943912, 0.000000, 0.000000},
    {4.123393, 1.405526, 0.000000},
    {1.927801, 0.145870, 5.440050},
    {3.880050, 13.513374, 4.095942},
    {12.000000, 0.025434, 0.000000},
    {6.059808, 0.000000, 0.000000},
    {3.000000, 4.279869, 15.000000},
    {10.000000, 14.178224, 0.290439},
    {5.974182, 0.000000, 0.000000},
    {3.807206, 0.000000, 0.000000},
}};
// clang-format on

/// Returns the headings of the six error columns of an end effector.
std::vector<PaperColumns> PaperBErrorColumns() {
  return {{"position error (cm)", {"X", "Y", "Z"}}, {"orientation error (degrees)", {"X", "Y", "Z"}}};
}

std::vector<PaperColumns> PaperBAngleColumns() { return {{"rotation difference (degrees)", {"X", "Y", "Z"}}}; }

PaperTable ErrorTable(const char* caption, const ErrorFigures& figures) {
  PaperTable table{caption, PaperBErrorColumns(), {}};
  for (std::size_t i = 0; i < figures.size(); ++i) {
    table.rows.push_back({kPaperBEffectors[i].label, {figures[i].begin(), figures[i].end()}});
  }
  return table;
}

PaperTable AngleTable(const char* caption, const AngleFigures& figures) {
  PaperTable table{caption, PaperBAngleColumns(), {}};
  for (std::size_t i = 0; i < figures.size(); ++i) {
    table.rows.push_back({kPaperBJoints[i].label, {figures[i].begin(), figures[i].end()}});
  }
  return table;
}

// If a cell has this series, the cell recorded the errors of its end effectors, so it also has the series of all other
// errors.
constexpr std::string_view kErrorSeries = "position_error_x_cm";

constexpr std::string_view kNoAxis = "a dash means that the joint has no such axis.";

using Rows = std::vector<const Row*>;
/// Reduces one number's values in several trials to a single value, for example their median.
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

/// Aggregates one entry of the tables over the rows that have a value for this entry; returns nullopt if no row has a
/// value.
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

/// Makes the tables of one condition from the rows of its cells.
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
        "Position errors: end effector − target, along the world’s axes. Orientation errors: the angle between each "
        "axis of the end effector and the target of this axis.";
    set.replay = fmt::format("etude replay RUN --cell '{}'", rows.front()->Id());
    Fill(rows, First, "", set);
    AddAngles(
        rows, "angle_change_deg", "the rotation of each joint since the start",
        [](std::vector<double> values) { return std::abs(values.front()); }, set);
    if (!set.angles.empty()) {
      set.angle_note = fmt::format("Hidden angles: the absolute rotation of each joint since the start; {}", kNoAxis);
    }
    return set;
  }

  PaperBSet AllTrials() const {
    PaperBSet set;
    set.title = fmt::format("all {}", Plural(TrialCount(), "trial"));
    set.error_note = "Position and orientation errors: the median of the absolute values over the trials.";
    Fill(rows_, MedianSize, ", median", set);
    AddAngles(rows_, "angle_change_deg", "the rotation of each joint since the start, root mean square", RootMeanSquare,
              set);
    AddAngles(rows_, "angle_error_deg", "the final difference of each joint from the truth, root mean square",
              RootMeanSquare, set);
    if (!set.angles.empty()) {
      set.angle_note = fmt::format(
          "Hidden angles: the rotation since the start, and the difference from the truth, as root mean squares over "
          "the trials; {}",
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

  // All methods start from the same pose, so one recorded cell per trial is enough.
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
      if (with < std::ssize(rows)) text += fmt::format("; only {} of them have results", FormatCount(with));
    }
    const std::string_view median = rows.size() == 1 ? "" : "median ";
    if (const auto iterations = MetricOver(rows, "iterations")) {
      text += fmt::format("; {}{} iterations", median, FormatNumber(*iterations));
    }
    if (const auto change = MetricOver(rows, "hidden_angle_change_deg")) {
      text += fmt::format("; hidden angles rotated by {}{}° since the start", median, FormatNumber(*change));
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

std::vector<PaperTable> PaperBPrintedErrors() {
  return {ErrorTable("Table 5.1 (a), 5.2 (a): before", kBefore),
          ErrorTable("Table 5.1 (b): after, fixed weights", kFixed),
          ErrorTable("Table 5.1 (c), 5.2 (c): after, weights updated all the time, angle-change tolerance", kUpdated),
          ErrorTable("Table 5.2 (b): after, no angle-change tolerance", kFree)};
}

std::vector<PaperTable> PaperBPrintedAngles() {
  return {AngleTable("Table 5.2 (d): hidden angles, no angle-change tolerance", kFreeAngles),
          AngleTable("Table 5.2 (e): hidden angles, angle-change tolerance", kBoundAngles)};
}

bool HasPaperBTables(const RunData& run, const ScenarioSummary& scenario) {
  return scenario.task == "ik" && KeepsSeries(run, scenario, kErrorSeries);
}

std::vector<PaperBCondition> PaperBTables(const RunData& run, const ScenarioSummary& scenario) {
  if (!HasPaperBTables(run, scenario)) return {};
  const CellSeriesIndex series(run);
  std::vector<PaperBCondition> conditions;
  for (const ConditionSummary& summary : scenario.conditions) {
    const Rows rows = RowsUnder(run, scenario.name, summary.condition);
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

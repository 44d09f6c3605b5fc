#include "reports/paper/paper_b_figures.h"

namespace etude {
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

}  // namespace

std::vector<PaperColumns> PaperBErrorColumns() {
  return {{"position error (cm)", {"X", "Y", "Z"}}, {"orientation error (degrees)", {"X", "Y", "Z"}}};
}

std::vector<PaperColumns> PaperBAngleColumns() { return {{"rotation difference (degrees)", {"X", "Y", "Z"}}}; }

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

}  // namespace etude

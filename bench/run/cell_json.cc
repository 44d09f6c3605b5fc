#include "bench/run/cell_json.h"

#include <nlohmann/json.hpp>

#include "bench/results/row_json.h"

namespace etude {
namespace {

void AddUsage(const CellUsage& usage, Json& json) {
  json["wall_s"] = usage.wall_s;
  json["cpu_s"] = usage.cpu_s;
  json["peak_mb"] = usage.peak_mb;
  if (usage.world_wall_s > 0) {
    json["world_wall_s"] = usage.world_wall_s;
    json["world_cpu_s"] = usage.world_cpu_s;
  }
}

}  // namespace

Json EncodeFinishedCell(FinishedCell cell) {
  Json json = EncodeCell(std::move(cell.row));
  AddUsage(cell.usage, json["usage"]);
  return json;
}

Result<FinishedCell> DecodeFinishedCell(const Json& json, const Place& place) {
  ASSIGN_OR_RETURN(auto row, DecodeCell(json, place));
  FinishedCell cell{std::move(row), {}};
  try {
    const Json& usage = json.at("usage");
    cell.usage = {usage.at("wall_s").get<double>(), usage.at("cpu_s").get<double>(), usage.at("peak_mb").get<double>(),
                  usage.value("world_wall_s", 0.0), usage.value("world_cpu_s", 0.0)};
  } catch (const Json::exception& error) {
    return Fail(place, "not a cell's usage: {}", error.what());
  }
  return cell;
}

Json EncodeUsage(const std::string& cell, const CellUsage& usage) {
  Json json{{"cell", cell}};
  AddUsage(usage, json);
  return json;
}

}  // namespace etude

#include "bench/limits/ceiling_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace gnbv {
namespace {

/// The rows of the report: a name for readers, one for programs, and the shares.
struct Row {
  const char* text;
  const char* key;
  std::array<double, 3> share;
};

std::array<Row, 4> rows_of(const Ceiling& ceiling) {
  return {{{"seen, of the surface visible from outside", "outside", ceiling.outside},
           {"seen, of all surface", "raw", ceiling.raw},
           {"kept by the cloud, visible from outside", "leaf_outside", ceiling.leaf_outside},
           {"kept by the cloud, of all surface", "leaf_raw", ceiling.leaf_raw}}};
}

std::string oracle_text(std::span<const OracleReach> reaches) {
  std::string text =
      "known the structure, metres and views planned for that share of the cloud's "
      "0.05 m voxels alone:\n";
  for (const OracleReach& reach : reaches) {
    text += fmt::format("{:>4.0f} %{:>9.1f} m in {} views; greedily {:.1f} m in {}\n",
                        100.0 * reach.share, reach.length_m, reach.views, reach.greedy_m,
                        reach.greedy_views);
  }
  return text;
}

nlohmann::ordered_json oracle_json(std::span<const OracleReach> reaches) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const OracleReach& reach : reaches) {
    out.push_back({{"share", reach.share},
                   {"views", reach.views},
                   {"length_m", reach.length_m},
                   {"greedy_views", reach.greedy_views},
                   {"greedy_m", reach.greedy_m}});
  }
  return out;
}

}  // namespace

std::string ceiling_json(const Scenario& scenario, const Ceiling& ceiling,
                         std::span<const OracleReach> reaches, double wall_s) {
  nlohmann::ordered_json out = {{"schema", "gnbv-ceiling-1"},
                                {"scenario", scenario.name},
                                {"structure", structure_name(scenario.structure)},
                                {"seed", scenario.seed},
                                {"positions", ceiling.positions}};
  for (const Row& row : rows_of(ceiling)) {
    out[row.key] = {{"0.05", row.share[0]}, {"0.10", row.share[1]}, {"0.50", row.share[2]}};
  }
  if (!reaches.empty()) out["oracle"] = oracle_json(reaches);
  out["wall_s"] = wall_s;
  return out.dump(2) + "\n";
}

std::string ceiling_text(const Ceiling& ceiling, std::span<const OracleReach> reaches,
                         double wall_s) {
  std::string text =
      fmt::format("{:<44}{:>9}{:>9}{:>9}\n", "share of the voxels", "0.05 m", "0.10 m", "0.50 m");
  for (const Row& row : rows_of(ceiling)) {
    text += fmt::format("{:<44}{:>7.1f} %{:>7.1f} %{:>7.1f} %\n", row.text, 100.0 * row.share[0],
                        100.0 * row.share[1], 100.0 * row.share[2]);
  }
  text += fmt::format(
      "{} legal positions and the places between them, {:.1f} s\n"
      "of exact sensors, the profile's LIDAR among them: noise can lift a mission above it\n"
      "a voxel counts with surface of a tenth of its face\n",
      ceiling.positions, wall_s);
  return reaches.empty() ? text : text + oracle_text(reaches);
}

}  // namespace gnbv

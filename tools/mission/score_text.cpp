#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/mission/rescore.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {
namespace {

template <typename Value>
std::string percent_row(const std::string& name, std::size_t columns, const Value& value_at) {
  std::string row = fmt::format("{:<26}", name);
  for (std::size_t i = 0; i < columns; ++i) row += fmt::format("{:>9.1f}%", 100.0 * value_at(i));
  return row + "\n";
}

std::string heading(const std::string& name, std::span<const double> columns_m) {
  std::string row = fmt::format("{:<26}", name);
  for (const double column_m : columns_m) row += fmt::format("{:>8} m", size_name(column_m));
  return row + "\n" + std::string(26 + 10 * columns_m.size(), '-') + "\n";
}

/// Of one of the sizes that were asked for.
double share_at(const MissionScore& score, double size_m, const std::array<double, 3>& papers,
                double SizedCoverage::*share) {
  if (const auto size = papers_size(size_m)) return papers[*size];
  const auto at = std::find_if(score.more.begin(), score.more.end(),
                               [&](const SizedCoverage& c) { return c.size_m == size_m; });
  GNBV_CHECK(at != score.more.end(), "no score at {} m", size_m);
  return (*at).*share;
}

}  // namespace

std::string score_text(const Scored& scored, const std::string& name, bool is_run,
                       std::size_t width) {
  const MissionScore& score = scored.score;
  std::string text = fmt::format("{}: {} points against {}, its surface above z = {} m\n", name,
                                 grouped(scored.points), scored.structure, scored.floor_z_m);
  if (scored.points_below_floor > 0) {
    text += fmt::format("{} below z = {} m left out\n", counted(scored.points_below_floor, "point"),
                        scored.floor_z_m);
  }
  text += "\n";
  text += heading("Coverage, voxels of", scored.sizes_m);
  const auto coverage_row = [&](const std::string& row, const std::array<double, 3>& shares,
                                double SizedCoverage::*share) {
    text += percent_row(row, scored.sizes_m.size(), [&](std::size_t i) {
      return share_at(score, scored.sizes_m[i], shares, share);
    });
  };
  const bool is_outside = score.area_samples == 0;
  coverage_row(is_outside ? "seen from outside" : "area samples", score.final,
               &SizedCoverage::final);
  coverage_row("of it accurate", score.accurate, &SizedCoverage::accurate);
  coverage_row("all surface, also inner", score.final_raw, &SizedCoverage::final_raw);
  if (is_run) {
    coverage_row(is_outside ? "profile, from outside" : "profile, area samples", score.profile,
                 &SizedCoverage::profile);
  }
  text +=
      "a voxel counts when it holds such surface of at least a tenth of its face; accurate "
      "coverage asks for a point within a fifth of the voxel's size of the surface\n";
  if (!is_outside) {
    text += fmt::format("area samples: voxels {}\n", reference_words(score.area_samples));
  }
  text += "\n" + heading("Within", kScoreDistances_m);
  const auto& at = score.distances.at;
  text += percent_row("precision", at.size(), [&](std::size_t i) { return at[i].precision; });
  text +=
      percent_row("recall, from outside", at.size(), [&](std::size_t i) { return at[i].recall; });
  text += percent_row("F", at.size(), [&](std::size_t i) { return at[i].f; });
  text += fmt::format(
      "\nChamfer distance {:.4f} m: accuracy {:.4f} m, completeness {:.4f} m; a distance beyond {} "
      "m counts as that\n",
      score.distances.chamfer_m, score.distances.accuracy_m, score.distances.completeness_m,
      kFarthest_m);
  text += fmt::format(
      "Points in a voxel of {} m that holds any: {:.1f}, variation {:.2f}; Points/voxel in tables "
      "is the paper's: points divided by the map's occupied voxels\n",
      score.density.voxel_m, score.density.mean_points, score.density.variation);
  return folded_text(text, width);
}

std::string score_json(const Scored& scored, bool is_run) {
  nlohmann::ordered_json json = {{"schema", "gnbv-score-1"},
                                 {"structure", scored.structure},
                                 {"points", scored.points},
                                 {"points_below_floor", scored.points_below_floor},
                                 {"floor_z_m", scored.floor_z_m}};
  json.update(nlohmann::ordered_json::parse(score_json(scored.score, is_run)));
  json["wall_s"] = {{"reference", scored.reference_s}, {"score", scored.score_s}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gnbv

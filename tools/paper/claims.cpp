// What the paper says of its figures in words, asked of our missions.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/text.hpp"
#include "tools/paper/comparisons.hpp"
#include "tools/paper/verdicts.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

Json claim(const char* figure, const char* sentence, std::string finding, std::string rule,
           PaperVerdict verdict) {
  return {{"figure", figure},
          {"sentence", sentence},
          {"finding", std::move(finding)},
          {"rule", std::move(rule)},
          {"verdict", verdict}};
}

/// "28.9", or "from 28.9 to 31.2".
std::string span_text(const std::vector<double>& values, int decimals) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const std::string first = grouped(*low, decimals), last = grouped(*high, decimals);
  return first == last ? first : fmt::format("from {} to {}", first, last);
}

double share_of(std::size_t some, std::size_t all) {
  return static_cast<double>(some) / static_cast<double>(all);
}

/// Fig. 9: Proposed is densest in each iteration.
void check_densest(const PaperMaterial& material, Json& claims) {
  const PaperTable& table = *find_paper_table("aircraft");
  const std::vector<DrawnGroup> groups = mean_densities(material, table);
  if (groups.size() < table.rows.size()) return;
  const auto& proposed = groups.back().mean.y;  // the last row of the table
  std::size_t shared = proposed.size();
  for (const DrawnGroup& group : groups) shared = std::min(shared, group.mean.y.size());
  std::size_t ahead = 0;
  for (std::size_t view = 0; view < shared; ++view) {
    ahead += std::all_of(groups.begin(), groups.end() - 1, [&](const DrawnGroup& other) {
      return proposed[view].mean > other.mean.y[view].mean;
    });
  }
  const double share = share_of(ahead, shared);
  claims.push_back(
      claim("9", "In every iteration Proposed has more points a voxel than both others.",
            fmt::format("Its mean over the seeds is highest after {} of {} views, {:.1f} %.",
                        grouped(ahead), grouped(shared), 100.0 * share),
            rule_of_share("views"), claim_of_share(share)));
}

/// Text on Table 3: frontier views bring the coverage above 90 %.
void check_coverage(const PaperMaterial& material, Json& claims) {
  const PaperRow& row = *find_row(*find_paper_table("power_plant"), "proposed");
  std::vector<double> percents;
  std::size_t above = 0;
  std::size_t cut = 0;  // below it when they were cut short: they tell nothing
  for (const PaperMission* mission : missions_of(material, "power_plant", "proposed")) {
    const double coverage = mission->record.figures->coverage_final[0];
    percents.push_back(100.0 * coverage);
    above += coverage > 0.9;
    cut += coverage <= 0.9 && is_cut(*mission, row);
  }
  if (percents.empty()) return;
  const std::size_t told = percents.size() - cut;
  claims.push_back(
      claim("10", "Frontier views beside those of the grid take the plant's coverage above 90 %.",
            fmt::format("Above it at the end, at 0.05 m: {} of {}; coverage {} %.{}", above,
                        counted(percents.size(), "mission"), span_text(percents, 1),
                        cut > 0 ? fmt::format(" Not counted, cut short below it: {}.", cut) : ""),
            rule_of_share("missions"),
            told > 0 ? claim_of_share(share_of(above, told)) : PaperVerdict::cut));
}

/// Fig. 11: while views are found at frontiers, entropy falls and density rises.
void check_phases(const PaperMaterial& material, Json& claims) {
  std::size_t phases = 0, falling = 0, rising = 0, both = 0;
  for (const PaperMission* mission : missions_of(material, "power_plant", "proposed")) {
    const std::vector<ViewRecord>& views = mission->record.views;
    for (const Phase& phase : frontier_phases(views)) {
      if (phase.first == 0) continue;
      const ViewRecord& before = views[static_cast<std::size_t>(phase.first) - 1];
      const ViewRecord& after = views[static_cast<std::size_t>(phase.last)];
      const bool falls = after.entropy_nat < before.entropy_nat;
      const bool rises = after.density_points_per_voxel > before.density_points_per_voxel;
      ++phases;
      falling += falls;
      rising += rises;
      both += falls && rises;
    }
  }
  if (phases == 0) return;
  const double share = share_of(both, phases);
  claims.push_back(claim(
      "11", "Where the sampler switches to frontiers, entropy falls and density rises.",
      fmt::format("Of {} such phases, entropy fell in {}, density rose in {}: both in {}, {:.1f} "
                  "%.",
                  phases, falling, rising, both, 100.0 * share),
      rule_of_share("phases"), claim_of_share(share)));
}

/// Figs 14 and 17: a measure of the views falls or rises over the iterations.
void check_trend(const PaperMaterial& material, const char* scenario, const char* figure,
                 const char* sentence, double ViewRecord::*measure, int sign, Json& claims) {
  std::vector<double> trends;
  for (const PaperMission* mission : missions_of(material, scenario, "proposed")) {
    std::vector<double> values;
    for (const ViewRecord& view : mission->record.views) values.push_back(view.*measure);
    trends.push_back(rank_trend(values));
  }
  if (trends.empty()) return;
  claims.push_back(claim(figure, sentence,
                         fmt::format("Rank correlation with the iterations {} over {}.",
                                     span_text(trends, 2), counted(trends.size(), "mission")),
                         rule_of_trends(sign), claim_of_trends(trends, sign)));
}

}  // namespace

Json checked_claims(const PaperMaterial& material) {
  Json claims = Json::array();
  check_densest(material, claims);
  check_coverage(material, claims);
  check_phases(material, claims);
  for (const auto& [scenario, figure] : {std::pair("lab_model", "14"), {"lab_airplane", "17"}}) {
    check_trend(material, scenario, figure, "Entropy falls over the iterations.",
                &ViewRecord::entropy_nat, -1, claims);
    check_trend(material, scenario, figure, "Density rises over the iterations.",
                &ViewRecord::density_points_per_voxel, 1, claims);
  }
  return claims;
}

}  // namespace gnbv

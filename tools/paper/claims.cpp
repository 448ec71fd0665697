// What the paper says of its figures in words, asked of our missions.
#include <fmt/format.h>

#include <algorithm>

#include "bench/compare/text_table.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/curves.hpp"
#include "tools/paper/comparisons.hpp"

namespace gnbv {
namespace {

using Missions = std::vector<const PaperMission*>;

/// "28.9", or "from 28.9 to 31.2".
std::string span_text(double low, double high, int decimals) {
  const std::string first = grouped(low, decimals);
  const std::string last = grouped(high, decimals);
  return first == last ? first : fmt::format("from {} to {}", first, last);
}

/// Fig. 9: Proposed is densest in each iteration.
void check_densest(const PaperMaterial& material, std::vector<CheckedClaim>& claims) {
  const PaperTable* const table = find_paper_table("aircraft");
  const std::vector<DrawnGroup> series = mean_densities(material, *table);
  if (series.size() < table->rows.size()) return;
  const DrawnGroup& proposed = series.back();  // the last row of the table
  std::size_t shared = proposed.mean.y.size();
  for (const DrawnGroup& one : series) shared = std::min(shared, one.mean.y.size());
  std::size_t ahead = 0;
  for (std::size_t view = 0; view < shared; ++view) {
    ahead += std::all_of(series.begin(), series.end() - 1, [&](const DrawnGroup& other) {
      return proposed.mean.y[view].mean > other.mean.y[view].mean;
    });
  }
  if (shared == 0) return;
  const double share = static_cast<double>(ahead) / static_cast<double>(shared);
  claims.push_back(
      {"9", "In every iteration Proposed has more points a voxel than both others.",
       fmt::format("Its mean over the seeds is highest after {} of {} views, {:.1f} %.",
                   grouped(ahead), grouped(shared), 100.0 * share),
       rule_of_share("views"), claim_of_share(share)});
}

/// Text on Table 3: frontier views bring the coverage above 90 %.
void check_coverage(const PaperMaterial& material, std::vector<CheckedClaim>& claims) {
  const Missions missions = missions_of(material, "power_plant", "proposed");
  if (missions.empty()) return;
  const PaperRow* const row = find_row(*find_paper_table("power_plant"), "proposed");
  std::size_t above = 0;
  std::size_t cut = 0;  // below it when they were cut short: they tell nothing
  double least = 1.0;
  double most = 0.0;
  for (const PaperMission* mission : missions) {
    const double coverage = mission->record.figures->coverage_final[0];
    above += coverage > 0.9;
    cut += coverage <= 0.9 && row != nullptr && is_cut(*mission, *row);
    least = std::min(least, coverage);
    most = std::max(most, coverage);
  }
  const std::size_t told = missions.size() - cut;
  claims.push_back(
      {"10", "Frontier views beside those of the grid take the plant's coverage above 90 %.",
       fmt::format("Above it at the end, at 0.05 m: {} of {}; coverage {} %.{}", above,
                   counted(missions.size(), "mission"), span_text(100.0 * least, 100.0 * most, 1),
                   cut > 0 ? fmt::format(" Not counted, cut short below it: {}.", cut) : ""),
       rule_of_share("missions"),
       told > 0 ? claim_of_share(static_cast<double>(above) / static_cast<double>(told))
                : ClaimVerdict::cut});
}

/// Fig. 11: while views are found at frontiers, entropy falls and density rises.
void check_phases(const PaperMaterial& material, std::vector<CheckedClaim>& claims) {
  std::size_t phases = 0;
  std::size_t falling = 0;
  std::size_t rising = 0;
  std::size_t both = 0;
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
  claims.push_back(
      {"11", "Where the sampler switches to frontiers, entropy falls and density rises.",
       fmt::format("Of {} such phases, entropy fell in {}, density rose in {}: both in {}, "
                   "{:.1f} %.",
                   phases, falling, rising, both,
                   100.0 * static_cast<double>(both) / static_cast<double>(phases)),
       rule_of_share("phases"),
       claim_of_share(static_cast<double>(both) / static_cast<double>(phases))});
}

/// Figs 14 and 17: entropy falls and density rises over the iterations.
void check_trends(const PaperMaterial& material, const std::string& scenario,
                  const std::string& figure, std::vector<CheckedClaim>& claims) {
  std::vector<double> entropy;
  std::vector<double> density;
  for (const PaperMission* mission : missions_of(material, scenario, "proposed")) {
    std::vector<double> of_entropy;
    std::vector<double> of_density;
    for (const ViewRecord& view : mission->record.views) {
      of_entropy.push_back(view.entropy_nat);
      of_density.push_back(view.density_points_per_voxel);
    }
    entropy.push_back(rank_trend(of_entropy));
    density.push_back(rank_trend(of_density));
  }
  if (entropy.empty()) return;
  const auto add = [&](const char* sentence, const std::vector<double>& trends, int sign) {
    const auto [low, high] = std::minmax_element(trends.begin(), trends.end());
    claims.push_back({figure, sentence,
                      fmt::format("Rank correlation with the iterations {} over {}.",
                                  span_text(*low, *high, 2), counted(trends.size(), "mission")),
                      rule_of_trends(sign), claim_of_trends(trends, sign)});
  };
  add("Entropy falls over the iterations.", entropy, -1);
  add("Density rises over the iterations.", density, 1);
}

}  // namespace

std::vector<CheckedClaim> check_claims(const PaperMaterial& material) {
  std::vector<CheckedClaim> claims;
  check_densest(material, claims);
  check_coverage(material, claims);
  check_phases(material, claims);
  check_trends(material, "lab_model", "14", claims);
  check_trends(material, "lab_airplane", "17", claims);
  return claims;
}

}  // namespace gnbv

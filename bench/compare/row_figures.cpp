#include "bench/compare/row_figures.hpp"

#include <algorithm>

#include "bench/score/run_figures.hpp"

namespace gnbv {
namespace {

MeanEstimate printed(double value) { return {.n = 1, .mean = value, .half_width = {}}; }

/// Over the runs, at the sizes that all of them have.
std::map<double, MeanEstimate> estimate_more(const RunsOfRow& runs, double SizedCoverage::*share) {
  std::map<double, std::vector<double>> values;
  for (const RunFigures* run : runs) {
    for (const SizedCoverage& at : run->more) values[at.size_m].push_back(at.*share);
  }
  std::map<double, MeanEstimate> estimates;
  for (const auto& [size_m, shares] : values) {
    if (shares.size() == runs.size()) estimates.emplace(size_m, estimate_mean(shares));
  }
  return estimates;
}

void add_share(RowFigures& f, const std::optional<Ceiling>& ceiling) {
  if (!ceiling || ceiling->leaf_outside[0] <= 0.0) return;
  MeanEstimate share = *f.coverage[0];
  share.mean /= ceiling->leaf_outside[0];
  if (share.half_width) *share.half_width /= ceiling->leaf_outside[0];
  f.share_of_ceiling = share;
}

}  // namespace

std::set<double> more_sizes(std::span<const RunFigures> runs) {
  std::set<double> sizes_m;
  for (const RunFigures& run : runs) {
    for (const SizedCoverage& at : run.more) sizes_m.insert(at.size_m);
  }
  return sizes_m;
}

RowFigures paper_figures(const PaperRow& row) {
  RowFigures f{.label = std::string(row.label), .kind = "paper"};
  if (row.iterations) f.iterations = printed(*row.iterations);
  if (row.entropy_reduction) f.entropy_reduction = printed(*row.entropy_reduction);
  if (row.distance_m) f.distance_m = printed(*row.distance_m);
  if (row.time_min) f.time_min = printed(*row.time_min);
  if (row.density_points_per_voxel) f.density = printed(*row.density_points_per_voxel);
  for (std::size_t size = 0; row.coverage_percent && size < 3; ++size) {
    f.coverage[size] = printed((*row.coverage_percent)[size] / 100.0);
  }
  if (is_doubtful(row)) f.mark = "†";
  return f;
}

RowFigures our_figures(const std::string& label, const RunsOfRow& runs,
                       const std::optional<Ceiling>& ceiling) {
  RowFigures f{.label = label, .kind = "ours", .runs = runs.size()};
  f.iterations = estimate(runs, [](const RunFigures& r) { return r.iterations; });
  f.entropy_reduction = estimate(runs, [](const RunFigures& r) { return r.entropy_reduction_nat; });
  f.distance_m = estimate(runs, [](const RunFigures& r) { return r.straight_m; });
  f.density = estimate(runs, [](const RunFigures& r) { return r.density_points_per_voxel; });
  const auto has_views = [](const RunFigures* r) { return r->curve.seconds.size() > 1; };
  if (std::all_of(runs.begin(), runs.end(), has_views)) {
    f.time_min = estimate(runs, [](const RunFigures& r) {
      return seconds_of_views(r.curve, r.curve.views()) / 60.0;
    });
  }
  for (std::size_t size = 0; size < 3; ++size) {
    f.coverage[size] = estimate(runs, [&](const RunFigures& r) { return r.coverage_final[size]; });
  }
  f.more = estimate_more(runs, &SizedCoverage::final);
  add_share(f, ceiling);
  return f;
}

std::optional<RowFigures> our_figures_as_long(const std::string& label, const RunsOfRow& runs,
                                              const PaperRow& row,
                                              const std::optional<Ceiling>& ceiling) {
  const auto most = static_cast<std::size_t>(row.iterations.value_or(0));
  const auto is_longer = [&](const RunFigures* run) { return run->curve.views() > most; };
  if (most == 0 || std::none_of(runs.begin(), runs.end(), is_longer)) return std::nullopt;
  std::vector<RunFigures> cut;
  for (const RunFigures* run : runs) {
    RunFigures& figures = cut.emplace_back(*run);
    CoverageCurve& curve = figures.curve;
    if (curve.views() <= most) continue;
    for (std::vector<double>* values : {&curve.metres, &curve.seconds}) values->resize(most + 1);
    curve.coverage.resize(most + 1);
    figures.iterations = *row.iterations;
    figures.straight_m = curve.metres.back();
    figures.coverage_final = curve.coverage.back();
    for (SizedCoverage& at : figures.more) {
      if (most < at.curve.size()) at.final = at.curve[most];
    }
  }
  RunsOfRow as_long;
  for (const RunFigures& figures : cut) as_long.push_back(&figures);
  RowFigures f = our_figures(label, as_long, ceiling);
  f.kind = "ours, cut";
  f.entropy_reduction.reset();
  f.density.reset();
  return f;
}

RowFigures our_profile(const RunsOfRow& runs, const std::optional<Ceiling>& ceiling) {
  std::map<std::uint64_t, const RunFigures*> by_seed;
  for (const RunFigures* run : runs) by_seed.emplace(run->seed, run);
  RunsOfRow profiles;
  for (const auto& [seed, run] : by_seed) profiles.push_back(run);
  RowFigures f{.label = "Profile", .kind = "ours", .runs = profiles.size()};
  f.distance_m = estimate(profiles, [](const RunFigures& r) { return r.before.profile_m; });
  for (std::size_t size = 0; size < 3; ++size) {
    f.coverage[size] =
        estimate(profiles, [&](const RunFigures& r) { return r.coverage_profile[size]; });
  }
  f.more = estimate_more(profiles, &SizedCoverage::profile);
  add_share(f, ceiling);
  return f;
}

RowFigures ceiling_figures(const std::string& kind, const std::array<double, 3>& coverage) {
  RowFigures f{.label = "Ceiling", .kind = kind};
  for (std::size_t size = 0; size < 3; ++size) f.coverage[size] = printed(coverage[size]);
  return f;
}

}  // namespace gnbv

// Laws of the plots of one run: their data are its own figures.
#include "tools/plots/run_plots.hpp"

#include <cstdio>

#include "tests/tools/plots/plot_support.hpp"
#include "tools/plots/coverage_plot.hpp"
#include "tools/plots/density_plot.hpp"
#include "tools/plots/flight_plot.hpp"
#include "tools/plots/script_parts.hpp"
#include "tools/plots/terms_plot.hpp"
#include "tools/plots/tracking_plot.hpp"

namespace gnbv {
namespace {

/// Where a plot of all runs has the densities, that of each has entropy alone.
TEST(RunPlots, DensityIsDrawnOnce) {
  const RunRecord record = scored_record();
  const Plot both = *density_entropy_plot(record);
  const Plot entropy = *density_entropy_plot(record, false);
  EXPECT_EQ(both.name, "density");
  EXPECT_EQ(entropy.name, "entropy");
  EXPECT_NE(both.body.find("density (points"), std::string::npos);
  EXPECT_EQ(entropy.body.find("density (points"), std::string::npos);
  EXPECT_NE(entropy.body.find("'views'"), std::string::npos);  // its axis is the last one
  EXPECT_NE(entropy.body.find("$end using 1:2 with points"), std::string::npos);
  EXPECT_NE(both.body.find("$end using 1:3 with points"), std::string::npos);
}

/// As on the axis of coverage: what was known after the first view stands at 1.
TEST(Plots, DensityAndEntropyAreTheRunsFigures) {
  const RunRecord record = scored_record();
  const auto rows = block(density_entropy_plot(record)->body, "views");
  ASSERT_EQ(rows.size(), record.views.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i], (std::vector<double>{static_cast<double>(i + 1), record.views[i].entropy_nat,
                                            record.views[i].density_points_per_voxel}));
  }
}

TEST(Plots, FrontierPhasesAreTheRowsOfTheirSampler) {
  const RunRecord record = scored_record();
  const std::vector<Phase> phases = frontier_phases(record.views);
  ASSERT_EQ(phases.size(), 2U);
  EXPECT_EQ(phases[0].first, 4);
  EXPECT_EQ(phases[0].last, 6);
  EXPECT_EQ(phases[1].first, 11);
  EXPECT_EQ(phases[1].last, 11);
  const std::string body = density_entropy_plot(record)->body;
  EXPECT_NE(body.find("rectangle from 4.5,graph 0 to 7.5,graph 1"), std::string::npos);
  EXPECT_NE(body.find("rectangle from 11.5,graph 0 to 12.5,graph 1"), std::string::npos);
}

TEST(Plots, AnAxisOfEntropyThatDoesNotBeginAtZeroSaysSo) {
  RunRecord record = scored_record();  // from 900 down to 820
  EXPECT_NE(density_entropy_plot(record)->body.find("'entropy (nat), axis cut'"),
            std::string::npos);
  record.views.back().entropy_nat = 3.0;
  EXPECT_NE(density_entropy_plot(record)->body.find("'entropy (nat)'"), std::string::npos);
}

/// 54 pixels below the upper edge, at the left, in every plot.
TEST(Plots, TitlesStandAtOnePlace) {
  const std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5})};
  const RunGroup group = group_of(runs);
  const RunRecord record = scored_record();
  std::vector<Plot> plots = {coverage_plot({&group, 1}, Effort::metres, 0),
                             mean_density_plot(mean_densities({&group, 1}), "Smoke"),
                             *density_entropy_plot(record),
                             *terms_plot(record),
                             *flight_plot(made_record()),
                             *tracking_plot(made_record())};
  for (const Plot& plot : plots) {
    const std::size_t at = plot.body.find("set label 1 'Smoke");
    ASSERT_NE(at, std::string::npos) << plot.name;
    double x = 0.0;
    double y = 0.0;
    const std::string place = plot.body.substr(plot.body.find(" at screen ", at));
    ASSERT_EQ(std::sscanf(place.c_str(), " at screen %lf,%lf left", &x, &y), 2) << plot.name;
    EXPECT_EQ(x, 0.02) << plot.name;
    EXPECT_NEAR((1.0 - y) * plot.height_px, 54.0, 0.2) << plot.name;
  }
}

TEST(Plots, OneViewIsEnough) {
  RunRecord record = scored_record();
  record.views = {record.views[1]};
  record.views[0].density_points_per_voxel = 0.0;
  for (const auto& plot : {density_entropy_plot(record), terms_plot(record)}) {
    ASSERT_TRUE(plot.has_value());
    expect_drawable(*plot);
  }
  const std::vector<RunRecord> runs = {covered_record(1, {0.2})};
  for (const Effort effort : {Effort::views, Effort::metres, Effort::seconds}) {
    const RunGroup group = group_of(runs);
    expect_drawable(coverage_plot({&group, 1}, effort, 0));
  }
}

}  // namespace
}  // namespace gnbv

// What tests of plots share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sim/core/error.hpp"
#include "tests/support/covered_record.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/plots/curves.hpp"
#include "tools/plots/gnuplot.hpp"

namespace gnbv {

/// The rows of a data block of a script.
inline std::vector<std::vector<double>> block(const std::string& script, const std::string& name) {
  std::istringstream text(script.substr(script.find("$" + name + " << EOD\n")));
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line) && line != "EOD") {
    std::istringstream numbers(line);
    rows.emplace_back();
    for (double value = 0.0; numbers >> value;) rows.back().push_back(value);
  }
  return rows;
}

/// Twelve views by Eq. (2), those from 4 to 6 and the last from frontiers.
inline RunRecord scored_record() {
  RunRecord record = made_record();
  record.views.clear();
  for (int i = 0; i < 12; ++i) {
    ViewRecord view{.iteration = i};
    view.entropy_nat = 900.0 - 7.3 * i;
    view.density_points_per_voxel = 10.0 + 0.7 * i;
    view.decision.sampler = (i >= 4 && i <= 6) || i == 11 ? Sampler::fvs
                            : i == 0                      ? Sampler::start
                                                          : Sampler::agvs;
    if (i == 0) {  // which nobody scored
      record.views.push_back(view);
      continue;
    }
    Score& s = view.decision.score;
    s = {.value = 0.0, .information = 0.01 * i, .density = 0.8, .prediction = 0.3, .distance = 0.9};
    s.value = (1.0 + 10.0 * s.information) * 0.55 * 0.9 * std::log10(50.0 + i);
    record.views.push_back(view);
  }
  return record;
}

inline RunGroup group_of(const std::vector<RunRecord>& runs) {
  RunGroup group{.label = "some", .runs = {}};
  for (const RunRecord& run : runs) group.runs.push_back(&run);
  return group;
}

inline bool has_gnuplot() {
  try {
    TempFolder temp;
    draw_plot("print 1\n", temp.path() / "any");
    return true;
  } catch (const BadInput&) {
    return false;
  }
}

/// Where gnuplot is installed, it takes the plot's script.
inline void expect_drawable(const Plot& plot) {
  if (!has_gnuplot()) return;
  const TempFolder temp;
  EXPECT_NO_THROW(
      draw_plot(plot_script(plot, PlotFormat::svg, {}), temp.path() / (plot.name + ".svg")));
}

}  // namespace gnbv

// What tests of figures share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/covered_record.hpp"
#include "tools/figures/curves.hpp"
#include "tools/figures/figure.hpp"

namespace gnbv {

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
  RunGroup group{.label = "some", .runs = {}, .look = look_of_slot(0)};
  for (const RunRecord& run : runs) group.runs.push_back(&run);
  return group;
}

/// The series of that name, in the first panel that has it; an empty one where none has.
inline Series series_of(const Figure& figure, const std::string& name) {
  for (const FigurePanel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      if (series.name == name) return series;
    }
  }
  return {.name = ""};
}

inline bool has_note(const Figure& figure, const std::string& words) {
  return std::any_of(figure.notes.begin(), figure.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

inline std::vector<std::string> labels_in(const Figure& figure) {
  std::vector<std::string> labels;
  for (const FigurePanel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      if (!series.label.empty()) labels.push_back(series.label);
    }
  }
  return labels;
}

}  // namespace gnbv

// The plots of a page, as figures of tools/figures: the page draws them and computes nothing.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "tools/figures/curves.hpp"
#include "tools/figures/figure.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/page/report.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<double>;
/// What a run's line shows over an effort; without entries where nothing was recorded.
using CurveOf = std::function<StepCurve(const RunRecord&, Effort)>;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kRoom = 1.02;  // right of the last view, so that no mark lies on the edge
constexpr std::array<const char*, kEfforts.size()> kEffortWords = {
    "Views",
    "Metres from the first view on, straight",
    "Seconds from the first view on",
    "Metres from take-off, straight",
    "Seconds from take-off",
    "Wh from take-off"};
constexpr std::array<const char*, 3> kSizes = {"0.05 m", "0.10 m", "0.50 m"};

struct Term {
  const char* words;
  double Score::*value;
  double rest;  // where the formula has no use for it
};
constexpr std::array<Term, 5> kTerms = {{{"Utility", &Score::value, kUnknown},
                                         {"Information", &Score::information, 0.0},
                                         {"Density term", &Score::density, 0.0},
                                         {"Prediction", &Score::prediction, 0.0},
                                         {"Distance factor", &Score::distance, 1.0}}};

/// From take-off of scored runs alone.
bool is_known(const RunRecord& record, Effort effort) {
  if (!is_from_take_off(effort)) return true;
  return record.figures && record.figures->curve.views() == record.views.size() &&
         is_known(record.figures->curve, effort);
}

/// What the first `views` views had taken. Requires that it is known.
double spent(const RunRecord& record, Effort effort, std::size_t views) {
  if (is_from_take_off(effort)) {
    return effort_at(record.figures->curve, record.figures->before, effort, views);
  }
  if (views == 0) return 0.0;
  const ViewRecord& last = record.views.at(views - 1);
  return effort == Effort::views    ? static_cast<double>(views)
         : effort == Effort::metres ? last.straight_m
                                    : last.time_s - record.views.front().time_s;
}

/// Of values after each view, or after the profile and each view.
StepCurve curve_over(const RunRecord& record, Effort effort, Values values) {
  if (!is_known(record, effort)) return {};
  StepCurve curve{.x = {}, .y = std::move(values)};
  const std::size_t first = curve.y.size() > record.views.size() ? 0 : 1;
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    curve.x.push_back(spent(record, effort, i + first));
  }
  return curve;
}

StepCurve coverage(const RunRecord& record, Effort effort, std::size_t size) {
  if (!record.figures) return {};
  return coverage_steps(*record.figures, effort, kCoverageSizes_m[size]).value_or(StepCurve{});
}

StepCurve entropy(const RunRecord& record, Effort effort) {
  Values values;
  for (const ViewRecord& view : record.views) values.push_back(view.entropy_nat);
  if (record.figures && !values.empty()) {
    values.insert(values.begin(), values.back() + record.figures->entropy_reduction_nat);
  }
  return curve_over(record, effort, std::move(values));
}

StepCurve density(const RunRecord& record, Effort effort) {
  Values values;
  for (const ViewRecord& v : record.views) values.push_back(v.density_points_per_voxel);
  return curve_over(record, effort, std::move(values));
}

/// A start, or a move that was not chosen among candidates, has no score.
Values scores(const RunRecord& record, const Term& term) {
  Values values;
  for (const ViewRecord& v : record.views) {
    values.push_back(v.decision.candidates > 0 ? v.decision.score.*term.value : kUnknown);
  }
  return values;
}

Values shares_of_largest(Values values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::isnan(v) ? 0.0 : std::abs(v));
  for (double& value : values) value /= most > 0.0 ? most : 1.0;
  return values;
}

/// When views were found at frontiers.
std::vector<std::array<double, 2>> frontier_spans(const RunRecord& record, Effort effort) {
  std::vector<std::array<double, 2>> spans;
  if (!is_known(record, effort)) return spans;
  for (const Phase& phase : frontier_phases(record.views)) {
    spans.push_back({spent(record, effort, static_cast<std::size_t>(phase.first)),
                     spent(record, effort, static_cast<std::size_t>(phase.last) + 1)});
  }
  return spans;
}

Axis axis_of(const std::vector<Series>& all, const std::string& unit) {
  Values known;
  for (const Series& series : all) {
    for (const Values& values : {series.y, series.low, series.high}) {
      std::copy_if(values.begin(), values.end(), std::back_inserter(known),
                   [](double y) { return std::isfinite(y); });
    }
  }
  if (known.empty()) return axis_from(unit, 0.0, 1.0);
  const auto [low, high] = std::minmax_element(known.begin(), known.end());
  return axis_around(unit, *low, *high);
}

class PlotMaker {
 public:
  PlotMaker(const std::vector<RunRecord>& records, const std::vector<std::string>& labels,
            page::Arrays& arrays)
      : records_(records), labels_(labels), arrays_(arrays), looks_(line_looks(records)) {
    std::vector<std::string> told_by_tables;
    groups_ = group_runs(records, told_by_tables);
    has_seeds_ = std::any_of(groups_.begin(), groups_.end(),
                             [](const RunGroup& group) { return group.runs.size() > 1; });
  }

  /// A figure an effort: a line a run and, where runs differ in their seeds alone, the means of
  /// the groups; of coverage with what it is compared with.
  page::PlotChoice choice(const std::string& label, const std::string& unit, Mark mark,
                          const CurveOf& curve_of, std::optional<double> voxel_m = {}) {
    page::PlotChoice choice{.label = label};
    for (const Effort effort : kEfforts) {
      FigurePanel panel;
      for (std::size_t run = 0; run < records_.size(); ++run) {
        const StepCurve curve = curve_of(records_[run], effort);
        if (curve.x.empty()) continue;
        const std::string& name = records_.size() == 1 ? label : labels_[run];
        panel.series.push_back({.name = name,
                                .label = name,
                                .mark = mark,
                                .look = looks_[run],
                                .width_pt = kGroupWidth_pt,
                                .x = curve.x,
                                .y = curve.y});
      }
      choice.runs.push_back(finished(std::move(panel), effort, unit, voxel_m, {}));
      if (!has_seeds_) continue;
      std::vector<DrawnGroup> drawn;
      for (const RunGroup& group : groups_) {
        std::vector<StepCurve> curves;
        for (const RunRecord* const run : group.runs) {
          StepCurve curve = curve_of(*run, effort);
          if (!curve.x.empty()) curves.push_back(std::move(curve));
        }
        if (curves.empty()) continue;
        drawn.emplace_back(group.label, group.look, std::move(curves));
      }
      FigurePanel means;
      std::vector<std::string> notes;
      add_groups(drawn, mark, means, notes);
      choice.means.push_back(finished(std::move(means), effort, unit, voxel_m, notes));
    }
    return choice;
  }

 private:
  /// A figure of figures.schema.json whose numbers lie in the page's block; without a panel where
  /// nothing was recorded.
  Json finished(FigurePanel panel, Effort effort, const std::string& unit,
                std::optional<double> voxel_m, const std::vector<std::string>& notes) {
    Figure figure{.name = "", .kind = "coverage", .notes = notes};
    if (!panel.series.empty()) {
      if (voxel_m && !groups_.empty()) {
        const std::vector<Series> levels = coverage_levels(groups_, *voxel_m);
        panel.series.insert(panel.series.end(), levels.begin(), levels.end());
      }
      double end = 0.0;
      for (const RunRecord& run : records_) {
        if (is_known(run, effort)) end = std::max(end, spent(run, effort, run.views.size()));
      }
      panel.x = axis_from(kEffortWords[static_cast<std::size_t>(effort)], 0.0,
                          kRoom * (end > 0.0 ? end : 1.0));
      panel.y = axis_of(panel.series, unit);
      if (records_.size() == 1) {
        panel.shades = {"frontier views (FVS)", frontier_spans(records_[0], effort)};
      } else if (voxel_m) {
        add_lanes(effort, panel.x, figure.panels);
      }
      figure.panels.push_back(std::move(panel));
    }
    Json json = Json::parse(figures_json(std::span(&figure, 1)))["figures"][0];
    for (Json& of_panel : json["panels"]) {
      for (Json& series : of_panel["series"]) {
        for (const char* const name : {"x", "y", "low", "high"}) pack(series[name]);
      }
    }
    return json;
  }

  /// When each of several runs chose frontier views, in lanes above the curves, which no curve
  /// enters.
  void add_lanes(Effort effort, const Axis& x, std::vector<FigurePanel>& panels) const {
    FigurePanel lanes{.x = x, .y = {.label = "FVS: when each run chose frontier views"}};
    for (std::size_t run = 0; run < records_.size(); ++run) {
      Series lane{.name = labels_[run], .mark = Mark::interval, .look = looks_[run]};
      for (const auto& [begin, end] : frontier_spans(records_[run], effort)) {
        lane.x.push_back(0.5 * (begin + end));
        lane.y.push_back(-0.5 - static_cast<double>(lanes.series.size()));
        lane.low.push_back(begin);
        lane.high.push_back(end);
      }
      if (!lane.x.empty()) lanes.series.push_back(std::move(lane));
    }
    if (lanes.series.empty()) return;
    lanes.y.low = -static_cast<double>(lanes.series.size());
    lanes.y.high = 0.0;
    lanes.y.ticks = {{0.5 * lanes.y.low, "FVS"}};
    panels.push_back(std::move(lanes));
  }

  /// Each list of numbers once: over metres and seconds the y are the same.
  void pack(Json& numbers) {
    const auto [entry, is_new] = packed_.try_emplace(numbers.dump());
    if (is_new) {
      Values values;
      for (const Json& number : numbers)
        values.push_back(number.is_null() ? kUnknown : double(number));
      entry->second = arrays_.add(values);
    }
    numbers = entry->second;
  }

  const std::vector<RunRecord>& records_;
  const std::vector<std::string>& labels_;
  page::Arrays& arrays_;
  std::vector<SeriesLook> looks_;
  std::vector<RunGroup> groups_ = {};
  bool has_seeds_ = false;
  std::map<std::string, page::Array<double>> packed_ = {};
};

/// Utilities of different formulas have different units: several in one plot are shares of each
/// run's largest.
std::vector<page::PlotChoice> choices_of_terms(const std::vector<RunRecord>& records,
                                               PlotMaker& make) {
  std::set<std::string> utilities;
  for (const RunRecord& record : records) utilities.insert(record.scenario.planner.utility.name);
  const bool is_share = utilities.size() > 1;
  std::vector<page::PlotChoice> choices;
  for (const Term& term : kTerms) {
    const Values first = scores(records[0], term);
    const auto says_nothing = [&](double v) { return std::isnan(v) || v == term.rest; };
    if (records.size() == 1 && std::all_of(first.begin(), first.end(), says_nothing)) continue;
    choices.push_back(make.choice(
        term.words, is_share ? "share of each run's largest" : "", Mark::line,
        [&](const RunRecord& record, Effort effort) {
          const Values values = scores(record, term);
          return curve_over(record, effort, is_share ? shares_of_largest(values) : values);
        }));
  }
  return choices;
}

}  // namespace

std::vector<SeriesLook> line_looks(const std::vector<RunRecord>& records) {
  std::vector<std::string> methods;
  for (const RunRecord& record : records) methods.push_back(method_of(record));
  return method_looks(methods);
}

std::vector<page::Plot> plots_of(const std::vector<RunRecord>& records,
                                 const std::vector<std::string>& labels, page::Arrays& arrays) {
  PlotMaker make(records, labels, arrays);
  page::Plot covered{.title = "Coverage", .chooses = "Voxel size of the coverage"};
  for (std::size_t size = 0; size < kSizes.size(); ++size) {
    covered.choices.push_back(make.choice(
        kSizes[size], "%", Mark::steps,
        [&](const RunRecord& record, Effort effort) { return coverage(record, effort, size); },
        kCoverageSizes_m[size]));
  }
  return {std::move(covered),
          {.title = "Entropy of the map",
           .choices = {make.choice("Entropy", "nat", Mark::steps, entropy)}},
          {.title = "Density",
           .choices = {make.choice("Density", "points a voxel", Mark::steps, density)}},
          {.title = "Utility of the chosen views",
           .note = "The first view is chosen by nobody: it has no utility",
           .chooses = "Term of the utility",
           .choices = choices_of_terms(records, make)}};
}

}  // namespace gnbv

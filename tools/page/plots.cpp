#include "tools/page/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tools/figures/curves.hpp"
#include "tools/figures/groups.hpp"
#include "tools/figures/looks.hpp"

namespace gnbv {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
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

/// A value after each view, or after the profile and each view.
using Values = std::vector<double>;
using Efforts = std::array<Values, 3>;
using EffortArrays = std::array<page::Array<double>, 3>;

/// What a run had taken after the profile and each view.
Efforts efforts_of(const RunRecord& record) {
  Efforts efforts = {{{0.0}, {0.0}, {0.0}}};
  for (const ViewRecord& view : record.views) {
    efforts[0].push_back(static_cast<double>(efforts[0].size()));
    efforts[1].push_back(view.straight_m);
    efforts[2].push_back(view.time_s - record.views.front().time_s);
  }
  return efforts;
}

double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values)
    most = std::max(most, std::isnan(value) ? 0.0 : std::abs(value));
  return most > 0.0 ? most : 1.0;
}

Values shares(Values values) {
  const double most = largest(values);
  for (double& value : values) value /= most;
  return values;
}

class PlotMaker {
 public:
  PlotMaker(const std::vector<RunRecord>& records, const page::PageData& page,
            const std::vector<std::array<std::optional<double>, 3>>& ceilings, page::Arrays& arrays)
      : records_(records),
        page_(page),
        ceilings_(ceilings),
        arrays_(arrays),
        looks_(line_looks(records)) {
    for (const RunRecord& record : records) {
      efforts_.push_back(efforts_of(record));
      const auto arrays_from = [&](std::ptrdiff_t from) {
        EffortArrays all;
        for (std::size_t k = 0; k < 3; ++k) {
          const Values& x = efforts_.back()[k];
          all[k] = arrays_.add(Values(x.begin() + from, x.end()));
        }
        return all;
      };
      x_.push_back({arrays_from(0), arrays_from(1)});
    }
    std::vector<std::string> notes;
    for (const RunGroup& group : group_runs(records, notes)) {
      if (group.runs.size() < 2) continue;
      groups_.emplace_back();
      for (const RunRecord* const run : group.runs) {
        groups_.back().push_back(static_cast<std::size_t>(run - records.data()));
      }
    }
  }

  page::Plot coverage() {
    page::Plot plot{.title = "Coverage", .chooses = "Voxel size of the coverage", .decimals = 1};
    for (std::size_t k = 0; k < kSizes.size(); ++k) {
      page::PlotChoice choice = choice_of(kSizes[k], "%", true, [&](const RunRecord& record) {
        Values values;
        for (const auto& sizes : record.figures ? record.figures->curve.coverage
                                                : std::vector<std::array<double, 3>>{}) {
          values.push_back(100.0 * sizes[k]);
        }
        return values;
      });
      for (std::size_t run = 0; run < records_.size(); ++run) {
        const auto& paper = page_.runs[run].paper;
        if (!paper || !paper->coverage_percent) continue;
        choice.rings.push_back(ring(run, *paper, (*paper->coverage_percent)[k]));
      }
      add_ceilings(k, choice);
      plot.choices.push_back(std::move(choice));
    }
    return is_alone() ? all_sizes(std::move(plot)) : plot;
  }

  page::Plot entropy() {
    return one("Entropy of the map", "nat", 0, [](const RunRecord& record) {
      Values values;
      for (const ViewRecord& view : record.views) values.push_back(view.entropy_nat);
      if (record.figures && !values.empty()) {
        values.insert(values.begin(), values.back() + record.figures->entropy_reduction_nat);
      }
      return values;
    });
  }

  page::Plot density() {
    page::Plot plot = one("Density", "points a voxel", 1, [](const RunRecord& record) {
      Values values;
      for (const ViewRecord& v : record.views) values.push_back(v.density_points_per_voxel);
      return values;
    });
    for (std::size_t run = 0; run < records_.size(); ++run) {
      const auto& paper = page_.runs[run].paper;
      if (paper && paper->density) {
        plot.choices[0].rings.push_back(ring(run, *paper, *paper->density));
      }
    }
    return plot;
  }

  /// Utilities of different formulas have different units: several in one plot are shares of each
  /// run's largest; and so are all terms of one run beside each other.
  page::Plot terms() {
    std::set<std::string> utilities;
    for (const RunRecord& record : records_) utilities.insert(record.scenario.planner.utility.name);
    page::Plot plot{.title = "Utility of the chosen views",
                    .note = "The first view is chosen by nobody: it has no utility",
                    .chooses = "Term of the utility"};
    page::PlotChoice all{.label = "All terms", .unit = "share of each term's largest"};
    for (const Term& term : kTerms) {
      const auto values_of = [&](const RunRecord& record) {
        Values values;  // a start, or a move that was not chosen among candidates, has no score
        for (const ViewRecord& v : record.views) {
          values.push_back(v.decision.candidates > 0 ? v.decision.score.*term.value : kUnknown);
        }
        return values;
      };
      const Values first = values_of(records_[0]);
      if (is_alone() && std::all_of(first.begin(), first.end(), [&](double value) {
            return std::isnan(value) || value == term.rest;
          })) {
        continue;
      }
      const bool is_share = utilities.size() > 1;
      plot.choices.push_back(choice_of(
          term.words, is_share ? "share of each run's largest" : "", false,
          [&](const RunRecord& r) { return is_share ? shares(values_of(r)) : values_of(r); }));
      if (is_alone()) {
        all.series.push_back(
            series(0, term.words, look_of_slot(all.series.size()), false, shares(first)));
      }
    }
    if (is_alone()) plot.choices.push_back(std::move(all));
    return plot;
  }

 private:
  bool is_alone() const { return records_.size() == 1; }

  static page::PlotSeries line(std::size_t run, const std::string& label, const SeriesLook& look,
                               bool is_step) {
    return {.label = label,
            .run = static_cast<int>(run),
            .colour = look.colour,
            .dashes = look.dashes,
            .is_step = is_step};
  }

  page::PlotSeries series(std::size_t run, const std::string& label, const SeriesLook& look,
                          bool is_step, const Values& values) {
    const EffortArrays& x = x_[run][values.size() > records_[run].views.size() ? 0 : 1];
    const page::Array<double> y = arrays_.add(values);
    page::PlotSeries out = line(run, label, look, is_step);
    for (std::size_t k = 0; k < 3; ++k) out.by[k] = {.x = x[k], .y = y};
    return out;
  }

  /// A line a run that has values, and one a group of seeds.
  template <typename ValuesOf>
  page::PlotChoice choice_of(const std::string& label, const std::string& unit, bool is_step,
                             const ValuesOf& values_of) {
    page::PlotChoice choice{.label = label, .unit = unit};
    std::vector<Values> all;
    for (std::size_t run = 0; run < records_.size(); ++run) {
      all.push_back(values_of(records_[run]));
      if (all.back().empty()) continue;
      choice.series.push_back(series(run, is_alone() ? label : page_.runs[run].label, looks_[run],
                                     is_step, all.back()));
    }
    for (const std::vector<std::size_t>& group : groups_) {
      if (std::any_of(group.begin(), group.end(), [&](auto run) { return all[run].empty(); })) {
        continue;
      }
      choice.means.push_back(mean_of_runs(group, all, is_step));
    }
    return choice;
  }

  /// The mean as figures have it, within the range of the runs.
  page::PlotSeries mean_of_runs(const std::vector<std::size_t>& group,
                                const std::vector<Values>& all, bool is_step) {
    std::string label = page_.runs[group[0]].label;
    if (const auto seed = label.rfind(", seed "); seed != std::string::npos) label.resize(seed);
    page::PlotSeries out = line(group[0], fmt::format("{}: mean of {} seeds", label, group.size()),
                                looks_[group[0]], is_step);
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<StepCurve> curves;
      for (const std::size_t run : group) {
        const Values& x = efforts_[run][k];
        curves.push_back(
            {{x.end() - static_cast<std::ptrdiff_t>(all[run].size()), x.end()}, all[run]});
      }
      const MeanCurve mean = mean_curve(curves);
      Values y, low, high;
      for (std::size_t i = 0; i < mean.x.size(); ++i) {
        Values there;
        for (const StepCurve& curve : curves) there.push_back(curve.at(mean.x[i]));
        y.push_back(mean.y[i].mean);
        low.push_back(*std::min_element(there.begin(), there.end()));
        high.push_back(*std::max_element(there.begin(), there.end()));
      }
      out.by[k] = {.x = arrays_.add(mean.x),
                   .y = arrays_.add(y),
                   .low = arrays_.add(low),
                   .high = arrays_.add(high)};
    }
    return out;
  }

  template <typename ValuesOf>
  page::Plot one(const std::string& title, const std::string& unit, int decimals,
                 const ValuesOf& values_of) {
    return {
        .title = title, .decimals = decimals, .choices = {choice_of(title, unit, true, values_of)}};
  }

  page::PlotRing ring(std::size_t run, const page::PaperEnd& paper, double y) const {
    return {.label = paper.label,
            .run = static_cast<int>(run),
            .colour = looks_[run].colour,
            .x = {paper.views, paper.metres, paper.seconds},
            .y = y};
  }

  /// What could be reached at a voxel size, each once, as far as it is known.
  void add_ceilings(std::size_t size, page::PlotChoice& choice) {
    std::set<double> known;
    for (const auto& shares : ceilings_) {
      if (shares[size]) known.insert(100.0 * *shares[size]);
    }
    const SeriesLook look = {"#667080", {5, 4}};
    for (const double percent : known) {
      page::PlotSeries level{.label = fmt::format("ceiling, {}", kSizes[size]),
                             .run = -1,
                             .colour = look.colour,
                             .dashes = look.dashes,
                             .is_step = true};
      for (std::size_t k = 0; k < 3; ++k) {
        double end = 0.0;
        for (const Efforts& efforts : efforts_) end = std::max(end, efforts[k].back());
        level.by[k] = {.x = arrays_.add(Values{0.0, end}), .y = arrays_.add(Values(2, percent))};
      }
      choice.series.push_back(level);
      choice.means.push_back(level);
    }
  }

  /// Of one run in one plot, with the ceiling that tables name.
  static page::Plot all_sizes(page::Plot plot) {
    page::PlotChoice all{.label = "", .unit = "%"};
    for (std::size_t k = 0; k < plot.choices.size(); ++k) {
      for (page::PlotSeries& series : plot.choices[k].series) {
        if (series.run < 0 && k > 0) continue;
        if (series.run >= 0) series.colour = look_of_slot(k).colour;
        if (series.run >= 0) series.dashes = {};
        all.series.push_back(std::move(series));
      }
      for (page::PlotRing& ring : plot.choices[k].rings) {
        ring.colour = look_of_slot(k).colour;
        all.rings.push_back(std::move(ring));
      }
    }
    plot.choices = {std::move(all)};
    return plot;
  }

  const std::vector<RunRecord>& records_;
  const page::PageData& page_;
  const std::vector<std::array<std::optional<double>, 3>>& ceilings_;
  page::Arrays& arrays_;
  std::vector<SeriesLook> looks_;
  std::vector<Efforts> efforts_;
  std::vector<std::array<EffortArrays, 2>> x_;  // a run's, from the profile and from view 1 on
  std::vector<std::vector<std::size_t>> groups_;
};

}  // namespace

std::vector<SeriesLook> line_looks(const std::vector<RunRecord>& records) {
  std::vector<std::string> methods;
  for (const RunRecord& record : records) methods.push_back(method_of(record));
  return method_looks(methods);
}

std::vector<page::Plot> plots_of(const std::vector<RunRecord>& records, const page::PageData& page,
                                 const std::vector<std::array<std::optional<double>, 3>>& ceilings,
                                 page::Arrays& arrays) {
  PlotMaker make(records, page, ceilings, arrays);
  return {make.coverage(), make.entropy(), make.density(), make.terms()};
}

}  // namespace gnbv

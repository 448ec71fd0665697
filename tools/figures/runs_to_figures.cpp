#include "tools/figures/runs_to_figures.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <regex>
#include <utility>

#include "sim/core/error.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/figures/run_figures.hpp"

namespace gnbv {
namespace {

bool wants(const FigureRequest& request, const std::string& kind) {
  return std::find(request.kinds.begin(), request.kinds.end(), kind) != request.kinds.end();
}

/// The figures of single runs, each named after its run where there are several. Where
/// `has_densities`, another figure has those of all of them.
std::vector<Figure> figures_of_each(std::span<const RunRecord> records,
                                    const FigureRequest& request, bool has_densities,
                                    std::vector<std::string>& notes) {
  std::vector<std::filesystem::path> folders;
  for (const RunRecord& record : records) folders.push_back(record.folder);
  const std::vector<std::string> names = run_names(folders);
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const RunRecord& record = records[i];
    const auto add = [&](const std::string& kind, const std::string& name, const auto& make) {
      if (!wants(request, kind)) return;
      std::optional<Figure> figure = make();
      if (!figure) {
        notes.push_back(fmt::format("{}: no views to plot as {}", record.folder.string(), name));
        return;
      }
      figure->name = records.size() > 1 ? name + "-" + names[i] : name;
      figures.push_back(std::move(*figure));
    };
    add("density", has_densities ? "entropy" : "density",
        [&] { return density_entropy_figure(record, !has_densities); });
    add("terms", "terms", [&] { return terms_figure(record); });
    add("predictions", "predictions", [&] { return predictions_figure(record); });
    add("tracking", "tracking", [&] { return tracking_figure(record); });
    add("flight", "flight", [&] { return flight_figure(record); });
  }
  return figures;
}

/// Those that are known of all runs.
std::vector<Effort> known_efforts(const std::vector<RunGroup>& groups) {
  std::vector<Effort> known;
  std::ranges::copy_if(kEfforts, std::back_inserter(known), [&](Effort effort) {
    return std::ranges::all_of(groups, [&](const RunGroup& group) {
      return std::ranges::all_of(
          group.runs, [&](const RunRecord* run) { return is_known(run->figures->curve, effort); });
    });
  });
  return known;
}

/// Of each group the runs that were scored at the size; groups without any are gone.
std::vector<RunGroup> groups_at(std::vector<RunGroup> groups, double size_m,
                                std::vector<std::string>& notes) {
  for (RunGroup& group : groups) {
    std::erase_if(group.runs, [&](const RunRecord* run) {
      if (coverage_steps(*run->figures, Effort::views, size_m)) return false;
      notes.push_back(fmt::format(
          "{}: not scored at {} m: left out; `gnbv score RUN --resolution {} --update` scores it",
          run->folder.string(), size_name(size_m), size_name(size_m)));
      return true;
    });
  }
  std::erase_if(groups, [](const RunGroup& group) { return group.runs.empty(); });
  return groups;
}

void add_coverage(const std::vector<RunGroup>& groups, double size_m, std::vector<Figure>& figures,
                  std::vector<std::string>& notes) {
  const std::vector<RunGroup> scored = groups_at(groups, size_m, notes);
  if (scored.empty()) return;
  for (const Effort effort : known_efforts(scored)) {
    figures.push_back(coverage_figure(scored, effort, size_m));
    if (auto end = coverage_end_figure(scored, effort, size_m)) figures.push_back(std::move(*end));
  }
}

void add_reach(const std::vector<RunGroup>& groups, int percent, std::vector<Figure>& figures,
               std::vector<std::string>& notes) {
  const std::size_t before = figures.size();
  for (const Effort effort : known_efforts(groups)) {
    if (auto reach = reach_figure(groups, effort, percent / 100.0)) {
      figures.push_back(std::move(*reach));
    }
  }
  if (figures.size() > before) return;
  notes.emplace_back(
      "no run's ceiling is known, so not how far they got; `gnbv score RUN --update --ceiling` "
      "finds it");
}

/// Finds groups by the words of a user: the label, the method, or the number from 1.
class GroupFinder {
 public:
  explicit GroupFinder(std::span<const RunGroup> groups) {
    const std::string title = common_scenario(groups);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      labels_.push_back(label_below(title, groups[i].label));
      methods_.push_back(method_of(*groups[i].runs.front()));
      numbers_.push_back(std::to_string(i + 1));
    }
  }

  /// Of "GROUP=VALUE"; either may hold an equals sign.
  std::pair<std::size_t, std::string> need_pair(const char* option, const std::string& text) const {
    if (text.find('=') == std::string::npos) {
      throw BadInput("{}: value '{}': must be GROUP=VALUE", option, text);
    }
    for (const std::vector<std::string>* const names : {&labels_, &methods_, &numbers_}) {
      for (std::size_t i = 0; i < names->size(); ++i) {
        const std::string said = names->at(i) + "=";
        if (text.starts_with(said)) return {i, text.substr(said.size())};
      }
    }
    throw BadInput("{}: value '{}': no such group; there are: {}", option,
                   text.substr(0, text.rfind('=')), fmt::join(labels_, ", "));
  }

  std::size_t need(const char* option, const std::string& word) const {
    return need_pair(option, word + "=").first;
  }

 private:
  std::vector<std::string> labels_, methods_, numbers_;
};

}  // namespace

const std::vector<std::string>& figure_kinds_of_runs() {
  static const std::vector<std::string> kinds = {"density", "coverage", "terms",      "reach",
                                                 "flight",  "tracking", "predictions"};
  return kinds;
}

void dress_groups(std::vector<RunGroup>& groups, const FigureRequest& request) {
  if (groups.empty()) return;
  const GroupFinder finder(groups);
  for (std::size_t i = 0; i < request.labels.size();) {
    std::string text = request.labels[i];
    // a label may hold the commas that part them: what has no group goes on with the one before
    while (++i < request.labels.size() && request.labels[i].find('=') == std::string::npos) {
      text += ',' + request.labels[i];
    }
    auto [group, label] = finder.need_pair("--labels", text);
    groups[group].label = std::move(label);
  }
  for (const std::string& text : request.colours) {
    auto [group, colour] = finder.need_pair("--colors", text);
    std::transform(colour.begin(), colour.end(), colour.begin(), ::tolower);
    if (!std::regex_match(colour, std::regex("#[0-9a-f]{6}"))) {
      throw BadInput("--colors: value '{}': a colour is #rrggbb", text);
    }
    groups[group].look.colour = colour;
  }
  std::vector<std::size_t> order;
  for (const std::string& word : request.order) order.push_back(finder.need("--order", word));
  for (std::size_t i = 0; i < groups.size(); ++i) order.push_back(i);
  std::vector<RunGroup> ordered;
  for (const std::size_t i : order) {
    if (!groups[i].runs.empty()) ordered.push_back(std::exchange(groups[i], {}));
  }
  groups = std::move(ordered);
}

std::vector<Figure> figures_of_runs(std::span<const RunRecord> records,
                                    const FigureRequest& request, std::vector<std::string>& notes) {
  std::vector<RunGroup> groups;
  if (wants(request, "coverage") || wants(request, "reach") || wants(request, "density")) {
    groups = group_runs(records, notes);
  }
  dress_groups(groups, request);
  std::optional<Figure> densities;
  if (wants(request, "density") && groups.size() > 1) densities = density_figure(groups);
  std::vector<Figure> figures = figures_of_each(records, request, densities.has_value(), notes);
  if (wants(request, "coverage")) add_coverage(groups, request.voxel_m, figures, notes);
  if (densities) figures.push_back(std::move(*densities));
  // how many runs got there says nothing of a single one
  if (!groups.empty() && wants(request, "reach") &&
      (records.size() > 1 || request.has_reach_of_one)) {
    add_reach(groups, request.reach_percent, figures, notes);
  }
  for (Figure& figure : figures) {
    if (!request.title.empty()) figure.title = request.title;
  }
  return figures;
}

}  // namespace gnbv

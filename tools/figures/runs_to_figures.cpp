#include "tools/figures/runs_to_figures.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>

#include "sim/core/error.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/figures/run_figures.hpp"

namespace gnbv {
namespace {

constexpr std::array<Effort, 3> kEfforts = {Effort::views, Effort::metres, Effort::seconds};

bool wants(const FigureRequest& request, const std::string& kind) {
  return std::find(request.kinds.begin(), request.kinds.end(), kind) != request.kinds.end();
}

/// What follows the names of figures of one run: nothing for a single run, else "-RUN".
std::vector<std::string> name_ends(std::span<const RunRecord> records) {
  if (records.size() == 1) return {""};
  std::vector<std::filesystem::path> folders;
  for (const RunRecord& record : records) folders.push_back(record.folder);
  std::vector<std::string> ends = run_names(folders);
  for (std::string& end : ends) end.insert(0, "-");
  return ends;
}

/// Where `has_densities`, another figure has those of all of them.
void add_figures_of_each(std::span<const RunRecord> records, const FigureRequest& request,
                         bool has_densities, std::vector<Figure>& figures,
                         std::vector<std::string>& notes) {
  const std::vector<std::string> ends = name_ends(records);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const RunRecord& record = records[i];
    const auto add = [&](const std::string& kind, const std::string& name, const auto& make) {
      if (!wants(request, kind)) return;
      std::optional<Figure> figure = make();
      if (!figure) {
        notes.push_back(fmt::format("{}: no views to plot as {}", record.folder.string(), name));
        return;
      }
      figure->name = name + ends[i];
      figures.push_back(std::move(*figure));
    };
    add("density", has_densities ? "entropy" : "density",
        [&] { return density_entropy_figure(record, !has_densities); });
    add("terms", "terms", [&] { return terms_figure(record); });
    add("predictions", "predictions", [&] { return predictions_figure(record); });
    add("tracking", "tracking", [&] { return tracking_figure(record); });
    add("flight", "flight", [&] { return flight_figure(record); });
  }
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
  for (const Effort effort : kEfforts) {
    figures.push_back(coverage_figure(scored, effort, size_m));
    if (auto end = coverage_end_figure(scored, effort, size_m)) figures.push_back(std::move(*end));
  }
}

void add_reach(const std::vector<RunGroup>& groups, int percent, std::vector<Figure>& figures,
               std::vector<std::string>& notes) {
  const std::size_t before = figures.size();
  for (const Effort effort : kEfforts) {
    if (auto reach = reach_figure(groups, effort, percent / 100.0)) {
      figures.push_back(std::move(*reach));
    }
  }
  if (figures.size() > before) return;
  notes.emplace_back(
      "no run's ceiling is known, so not how far they got; `gnbv score RUN --update --ceiling` "
      "finds it");
}

bool is_colour(const std::string& text) {
  return text.size() == 7 && text[0] == '#' &&
         text.find_first_not_of("0123456789abcdef", 1) == std::string::npos;
}

/// Finds groups by the words of a user.
class GroupFinder {
 public:
  explicit GroupFinder(std::span<const RunGroup> groups) {
    const std::string title = common_scenario(groups);
    for (const RunGroup& group : groups) {
      labels_.push_back(label_below(title, group.label));
      methods_.push_back(method_of(*group.runs.front()));
    }
  }

  /// By label, method, or number from 1.
  std::optional<std::size_t> find(std::string_view word) const {
    for (const std::vector<std::string>* const names : {&labels_, &methods_}) {
      const auto at = std::find(names->begin(), names->end(), word);
      if (at != names->end()) return static_cast<std::size_t>(at - names->begin());
    }
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = error == std::errc() && end == word.data() + word.size();
    if (!is_number || number < 1 || number > labels_.size()) return std::nullopt;
    return number - 1;
  }

  std::size_t need(const char* option, const std::string& word) const {
    if (const std::optional<std::size_t> group = find(word)) return *group;
    throw BadInput(fmt::format("{}: value '{}': no such group; there are: {}", option, word,
                               fmt::join(labels_, ", ")));
  }

  /// "GROUP=VALUE"; either may hold an equals sign.
  std::pair<std::size_t, std::string> need_pair(const char* option, const std::string& text) const {
    std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      throw BadInput(fmt::format("{}: value '{}': must be GROUP=VALUE", option, text));
    }
    for (std::size_t at = equals; at != std::string::npos; at = text.find('=', at + 1)) {
      if (find(text.substr(0, at))) equals = at;
    }
    return {need(option, text.substr(0, equals)), text.substr(equals + 1)};
  }

 private:
  std::vector<std::string> labels_, methods_;
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
  for (const std::string& text : request.labels) {
    auto [group, label] = finder.need_pair("--labels", text);
    groups[group].label = std::move(label);
  }
  for (const std::string& text : request.colours) {
    auto [group, colour] = finder.need_pair("--colors", text);
    std::transform(colour.begin(), colour.end(), colour.begin(), ::tolower);
    if (!is_colour(colour)) {
      throw BadInput(fmt::format("--colors: value '{}': a colour is #rrggbb", text));
    }
    groups[group].look.colour = colour;
  }
  std::vector<std::size_t> places(groups.size(), request.order.size());
  for (std::size_t i = 0; i < request.order.size(); ++i) {
    places[finder.need("--order", request.order[i])] = i;
  }
  std::vector<std::size_t> numbers(groups.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
  std::vector<RunGroup> ordered;
  for (const std::size_t number : numbers) ordered.push_back(std::move(groups[number]));
  groups = std::move(ordered);
}

std::vector<Figure> figures_of_runs(std::span<const RunRecord> records,
                                    const FigureRequest& request, std::vector<std::string>& notes) {
  std::vector<Figure> of_groups;
  const bool has_groups =
      wants(request, "coverage") || wants(request, "reach") || wants(request, "density");
  std::vector<RunGroup> groups;
  if (has_groups) groups = group_runs(records, notes);
  dress_groups(groups, request);
  std::optional<Figure> densities;
  if (wants(request, "density") && groups.size() > 1) densities = density_figure(groups);
  if (!groups.empty() && wants(request, "coverage")) {
    add_coverage(groups, request.voxel_m, of_groups, notes);
  }
  std::vector<Figure> figures;
  add_figures_of_each(records, request, densities.has_value(), figures, notes);
  if (densities) of_groups.push_back(std::move(*densities));
  // how many runs got there says nothing of a single one
  if (!groups.empty() && wants(request, "reach") &&
      (records.size() > 1 || request.has_reach_of_one)) {
    add_reach(groups, request.reach_percent, of_groups, notes);
  }
  for (Figure& figure : of_groups) figures.push_back(std::move(figure));
  for (Figure& figure : figures) {
    if (!request.title.empty()) figure.title = request.title;
  }
  return figures;
}

}  // namespace gnbv

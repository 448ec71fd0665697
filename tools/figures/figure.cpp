#include "tools/figures/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/embed.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

GNBV_EMBED(figures_schema_json, GNBV_FIGURES_SCHEMA);

constexpr std::array<const char*, 6> kMarkNames = {"line", "steps",    "points",
                                                   "area", "interval", "level"};

/// What is not known is null.
Json numbers_json(const std::vector<double>& numbers) {
  Json json = Json::array();
  for (const double number : numbers) {
    json.push_back(std::isfinite(number) ? Json(number) : Json(nullptr));
  }
  return json;
}

Json axis_json(const Axis& axis) {
  Json ticks = Json::array();
  for (const AxisTick& tick : axis.ticks) ticks.push_back({{"at", tick.at}, {"text", tick.text}});
  return {{"label", axis.label},
          {"low", axis.low},
          {"high", axis.high},
          {"log", axis.is_log},
          {"ticks", std::move(ticks)}};
}

Json series_json(const Series& series) {
  Json json = {{"name", series.name},
               {"label", series.label},
               {"mark", kMarkNames.at(static_cast<std::size_t>(series.mark))},
               {"colour", series.look.colour},
               {"dashes", series.look.dashes},
               {"marker", series.look.marker},
               {"width_pt", series.width_pt},
               {"size_pt", series.size_pt},
               {"opacity", series.opacity},
               {"filled", series.is_filled},
               {"x", numbers_json(series.x)},
               {"y", numbers_json(series.y)},
               {"low", numbers_json(series.low)},
               {"high", numbers_json(series.high)},
               {"end", nullptr}};
  if (series.end) json["end"] = *series.end;
  return json;
}

Json panel_json(const FigurePanel& panel) {
  Json json = {{"heading", panel.heading},
               {"height_px", panel.height_px},
               {"categories", panel.has_categories},
               {"x", axis_json(panel.x)},
               {"y", axis_json(panel.y)},
               {"shades", {{"label", panel.shades.label}, {"spans", panel.shades.spans}}},
               {"series", Json::array()}};
  for (const Series& series : panel.series) json["series"].push_back(series_json(series));
  return json;
}

Json figure_json(const Figure& figure) {
  Json json = {{"name", figure.name},   {"kind", figure.kind},   {"title", figure.title},
               {"notes", figure.notes}, {"rows", Json::array()}, {"panels", Json::array()}};
  json["rows"] = figure.panels_in_rows.empty() ? std::vector<int>(figure.panels.size(), 1)
                                               : figure.panels_in_rows;
  for (const FigurePanel& panel : figure.panels) json["panels"].push_back(panel_json(panel));
  return json;
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string csv_number(const std::vector<double>& numbers, std::size_t i) {
  return i < numbers.size() && std::isfinite(numbers[i]) ? fmt::format("{}", numbers[i]) : "";
}

}  // namespace

std::string figures_json(std::span<const Figure> figures) {
  Json json = {{"schema", 1}, {"figures", Json::array()}};
  for (const Figure& figure : figures) json["figures"].push_back(figure_json(figure));
  // bytes of a user's name that are no UTF-8 become the replacement character
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string_view figures_schema() { return figures_schema_json(); }

std::string figure_csv(const Figure& figure) {
  std::string text = "panel,series,x,y,low,high\n";
  for (const FigurePanel& panel : figure.panels) {
    const std::string of_y = panel.y.label.empty() ? panel.heading : panel.y.label;
    const auto panel_name = [&](const Series& series, std::size_t i) {
      // bands are one high, from 0 downwards
      const auto band = static_cast<std::size_t>(std::max(0.0, series.y.at(i) * -1.0));
      const bool is_band = panel.has_categories && band < panel.y.ticks.size();
      return csv_text(
          fmt::format("{} over {}", is_band ? panel.y.ticks[band].text : of_y, panel.x.label));
    };
    for (const Series& series : panel.series) {
      for (std::size_t i = 0; i < series.y.size(); ++i) {
        text += fmt::format("{},{},{},{},{},{}\n", panel_name(series, i), csv_text(series.name),
                            csv_number(series.x, i), csv_number(series.y, i),
                            csv_number(series.low, i), csv_number(series.high, i));
      }
    }
  }
  return text;
}

}  // namespace gnbv

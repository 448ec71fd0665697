#include "tools/figures/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/compare/text_table.hpp"
#include "sim/core/embed.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

GNBV_EMBED(figures_schema_json, GNBV_FIGURES_SCHEMA);

constexpr std::array<const char*, 6> kMarkNames = {"line", "steps",    "points",
                                                   "area", "interval", "level"};

std::string csv_number(const std::vector<double>& numbers, std::size_t i) {
  return i < numbers.size() && std::isfinite(numbers[i]) ? fmt::format("{}", numbers[i]) : "";
}

}  // namespace

// How each part is written; what is not known is NaN, which becomes null.

static void to_json(Json& json, const AxisTick& tick) {
  json = {{"at", tick.at}, {"text", tick.text}};
}

static void to_json(Json& json, const Axis& axis) {
  json = {{"label", axis.label},
          {"low", axis.low},
          {"high", axis.high},
          {"log", axis.is_log},
          {"ticks", axis.ticks}};
}

static void to_json(Json& json, const Series& series) {
  json = {{"name", series.name},
          {"label", series.label},
          {"mark", kMarkNames.at(static_cast<std::size_t>(series.mark))},
          {"colour", series.look.colour},
          {"dashes", series.look.dashes},
          {"marker", series.look.marker},
          {"width_pt", series.width_pt},
          {"size_pt", series.size_pt},
          {"opacity", series.opacity},
          {"filled", series.is_filled},
          {"x", series.x},
          {"y", series.y},
          {"low", series.low},
          {"high", series.high},
          {"end", series.end ? Json(*series.end) : Json(nullptr)}};
}

static void to_json(Json& json, const FigurePanel& panel) {
  json = {{"heading", panel.heading},
          {"height_px", panel.height_px},
          {"categories", panel.has_categories},
          {"x", panel.x},
          {"y", panel.y},
          {"shades", {{"label", panel.shades.label}, {"spans", panel.shades.spans}}},
          {"series", panel.series}};
}

static void to_json(Json& json, const Figure& figure) {
  const bool is_plain = figure.panels_in_rows.empty();
  json = {{"name", figure.name},
          {"kind", figure.kind},
          {"title", figure.title},
          {"notes", figure.notes},
          {"rows", is_plain ? std::vector<int>(figure.panels.size(), 1) : figure.panels_in_rows},
          {"panels", figure.panels}};
}

std::string figures_json(std::span<const Figure> figures) {
  const Json json = {{"schema", 1},
                     {"figures", std::vector<Figure>(figures.begin(), figures.end())}};
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
      return csv_field(
          fmt::format("{} over {}", is_band ? panel.y.ticks[band].text : of_y, panel.x.label));
    };
    for (const Series& series : panel.series) {
      for (std::size_t i = 0; i < series.y.size(); ++i) {
        text += fmt::format("{},{},{},{},{},{}\n", panel_name(series, i), csv_field(series.name),
                            csv_number(series.x, i), csv_number(series.y, i),
                            csv_number(series.low, i), csv_number(series.high, i));
      }
    }
  }
  return text;
}

}  // namespace gnbv

#include "tools/figures/figure_files.hpp"

#include <nlohmann/json.hpp>

#include "sim/core/embed.hpp"
#include "sim/core/file.hpp"
#include "tools/mission/python_script.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

GNBV_EMBED(draw_py, GNBV_DRAW);

}  // namespace

void draw_to_files(std::span<const FigureTarget> files, const FigureStyle& style) {
  if (files.empty()) return;
  std::vector<Figure> figures;
  Json paths = Json::array();
  for (const FigureTarget& file : files) {
    figures.push_back(*file.figure);
    paths.push_back(fs::absolute(file.path).string());
  }
  const Json request = {{"figures", Json::parse(figures_json(figures))["figures"]},
                        {"paths", std::move(paths)},
                        {"width_px", style.width_px},
                        {"height_px", style.height_px},
                        {"font", style.font}};
  ask_python({.what = "figures",
              .modules = {{"draw", draw_py()}},
              .entry = "draw",
              .apt = "python3-matplotlib",
              .pip = "matplotlib"},
             request);
}

std::vector<fs::path> write_figures(std::span<const Figure> figures,
                                    std::span<const std::string> extensions,
                                    const FigureStyle& style, const fs::path& folder) {
  std::vector<FigureTarget> drawn;
  std::vector<fs::path> written;
  bool has_json = false;
  for (const Figure& figure : figures) {
    for (const std::string& extension : extensions) {
      has_json = has_json || extension == "json";
      if (extension == "json") continue;
      drawn.push_back({&figure, folder / (figure.name + "." + extension)});
      written.push_back(drawn.back().path);
    }
    written.push_back(folder / (figure.name + ".csv"));
  }
  draw_to_files(drawn, style);
  for (const Figure& figure : figures) {
    write_file_atomically(folder / (figure.name + ".csv"), figure_csv(figure));
  }
  if (!has_json) return written;
  written.push_back(folder / "figures.json");
  write_file_atomically(written.back(), figures_json(figures));
  return written;
}

}  // namespace gnbv

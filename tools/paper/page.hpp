// The paper's evaluation as one document, and the folder of the page that is made of it.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/paper/missions.hpp"

namespace gnbv {

/// Told before each figure.
using FigureProgress = std::function<void(double share_done, const std::string& figure)>;

/// Every figure whose scenario was asked for: pictures in 3D are written to FOLDER/figures, curves
/// are data for whoever draws the page. What cannot be drawn is named. Two parts of the paper's
/// document (paper.schema.json): "shown", and "figures" as of figures.schema.json.
nlohmann::ordered_json draw_figures(const PaperMaterial& material,
                                    const std::filesystem::path& folder, int threads,
                                    const FigureProgress& progress);

/// The page is laid out in Python. Throws BadInput with the line that installs what that takes,
/// where it is missing.
void need_page_python();

/// Writes FOLDER/paper.json, the page FOLDER/index.html, and below FOLDER/tables and FOLDER/figures
/// what it links to. `command` makes it again. Throws BadInput as need_page_python().
void write_page(const PaperMaterial& material, const std::string& command,
                const std::filesystem::path& folder, int threads, const FigureProgress& progress);

/// The JSON Schema of paper.json.
std::string paper_schema();

}  // namespace gnbv

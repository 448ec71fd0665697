// The paper's figures as this program draws them.
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

}  // namespace gnbv

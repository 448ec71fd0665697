// The paper's evaluation as one document, and the folder of the page that is made of it.
#pragma once

#include <filesystem>
#include <string>

#include "tools/paper/figures.hpp"

namespace gnbv {

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

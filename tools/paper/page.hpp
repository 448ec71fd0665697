// The page that shows the paper's evaluation beside ours, and the folder it stands in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/compare/text_table.hpp"
#include "tools/paper/comparisons.hpp"
#include "tools/paper/figures.hpp"

namespace gnbv {

/// All that the page says of a table.
struct ShownTable {
  const PaperTable* paper = nullptr;
  std::vector<ComparedRow> rows;
  std::vector<ComparedPair> pairs;
  TextTable whole;  // as `gnbv table` prints it: beside the page as Markdown and CSV
};

struct PaperPage {
  std::string command;  // that makes it again
  std::string version;
  std::size_t seeds = 0;
  std::vector<ShownTable> tables;
  std::vector<CheckedClaim> claims;
  std::vector<DrawnFigure> figures;
  std::vector<std::string> notes;
};

/// What the missions say.
std::vector<ShownTable> shown_tables(const PaperMaterial& material);

/// The page. It holds its pictures, and links to the files of FOLDER that they are of; it forbids
/// itself any network. Throws BadInput naming a picture that cannot be read.
std::string page_html(const PaperPage& page, const std::filesystem::path& folder);

/// Writes FOLDER/tables/SCENARIO.md and .csv of each table and FOLDER/index.html, each by rename.
void write_page(const PaperPage& page, const std::filesystem::path& folder);

}  // namespace gnbv

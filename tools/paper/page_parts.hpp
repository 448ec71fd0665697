// Pieces of the page as HTML.
#pragma once

#include <string>

#include "tools/paper/page.hpp"

namespace gnbv {

/// Light, for a screen 1200 px wide and for paper.
std::string_view paper_style();

/// What agrees and what does not, in three tables: numbers, orders, sentences.
std::string summary_html(const PaperPage& page);

/// Ours at the left, the paper's at the right, and below both how far they are apart.
std::string table_html(const ShownTable& table);

/// A verdict as a small coloured mark.
std::string chip(std::string_view kind, std::string_view text);
std::string chip(ClaimVerdict verdict);

}  // namespace gnbv

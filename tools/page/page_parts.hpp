// The page that report.cpp fills, as the build bundled it from tools/page/web.
#pragma once

#include <string_view>

namespace gnbv {

/// HTML with {{POLICY}}, {{TITLE}}, {{STYLE}}, {{DATA}} and {{SCRIPT}} to be filled in.
std::string_view page_template();
std::string_view page_style();
std::string_view page_script();

/// Why style and script are empty in this program; empty where they are not.
std::string_view why_no_page();

}  // namespace gnbv

// The page that report.cpp fills, as the build bundled it from tools/report/web.
#pragma once

#include <string_view>

namespace gnbv {

/// HTML with {{POLICY}}, {{TITLE}}, {{STYLE}}, {{DATA}} and {{SCRIPT}} to be filled in.
std::string_view page_template();
std::string_view page_style();
std::string_view page_script();

}  // namespace gnbv

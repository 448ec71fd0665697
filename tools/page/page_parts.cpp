#include "sim/core/embed.hpp"
#include "tools/page/page_text.hpp"

namespace gnbv {
namespace {

GNBV_EMBED(missing, GNBV_WEB_FOLDER "/missing.txt");

}  // namespace

GNBV_EMBED(page_template, GNBV_PAGE_TEMPLATE);
GNBV_EMBED(page_style, GNBV_WEB_FOLDER "/bundle.css");
GNBV_EMBED(page_script, GNBV_WEB_FOLDER "/bundle.js");

std::string_view why_no_page() { return missing().substr(0, missing().find('\n')); }

}  // namespace gnbv

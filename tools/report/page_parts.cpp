#include "tools/report/page_parts.hpp"

#include <cstddef>

// The assembler puts each file between two labels: no copy of a megabyte of text in any source, and
// nothing to do when the program starts.
#define GNBV_EMBED(label, file)                                                \
  asm(".pushsection .rodata\n" #label "_begin:\n.incbin \"" file "\"\n" #label \
      "_end:\n.popsection\n");                                                 \
  extern "C" const char label##_begin;                                         \
  extern "C" const char label##_end

GNBV_EMBED(gnbv_page_template, GNBV_PAGE_TEMPLATE);
GNBV_EMBED(gnbv_page_style, GNBV_WEB_FOLDER "/bundle.css");
GNBV_EMBED(gnbv_page_script, GNBV_WEB_FOLDER "/bundle.js");
GNBV_EMBED(gnbv_page_missing, GNBV_WEB_FOLDER "/missing.txt");

namespace gnbv {
namespace {

std::string_view between(const char& begin, const char& end) {
  return {&begin, static_cast<std::size_t>(&end - &begin)};
}

}  // namespace

std::string_view page_template() {
  return between(gnbv_page_template_begin, gnbv_page_template_end);
}
std::string_view page_style() { return between(gnbv_page_style_begin, gnbv_page_style_end); }
std::string_view page_script() { return between(gnbv_page_script_begin, gnbv_page_script_end); }

std::string_view why_no_page() {
  const std::string_view line = between(gnbv_page_missing_begin, gnbv_page_missing_end);
  return line.substr(0, line.find('\n'));
}

}  // namespace gnbv

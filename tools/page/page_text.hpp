// The page that report.cpp fills, as the build bundled it from tools/web, and text that goes
// into a page and stays text there.
#pragma once

#include <string>
#include <string_view>

namespace gnbv {

/// HTML with {POLICY}, {TITLE}, {STYLE}, {DATA} and {SCRIPT} to be filled in by fmt.
std::string_view page_template();
std::string_view page_style();
std::string_view page_script();

/// Why style and script are empty in this program; empty where they are not.
std::string_view why_no_page();

/// For element content and quoted attributes.
std::string html_escaped(std::string_view text);

/// JSON for a <script> element: no character in it can end the element or begin a comment.
std::string script_json(std::string_view json);

/// `'sha256-...'` of an inline script or style, as a Content-Security-Policy names what may run.
std::string policy_hash(std::string_view text);

}  // namespace gnbv

#include "tools/gnbv/help.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "scenarios/validation_error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kHelp_columns = 80;
constexpr std::size_t kNames_columns = 26;  // of options and commands, two blanks included

struct Example {
  std::string_view command;
  std::string_view lines;
};
constexpr std::array<Example, 20> kExamples = {
    {{"fly", "gnbv fly smoke\ngnbv fly aircraft --mavlink udpout://127.0.0.1:14550 --speed 2"},
     {"run",
      "gnbv run aircraft --seed 1 --out runs/first\n"
      "gnbv run aircraft --utility tour --set planner.cloud.leaf_m=0.02\n"
      "gnbv run aircraft --mesh my.obj --bounds auto --frames"},
     {"sweep", "gnbv sweep sweep.yaml --out runs/sweep --jobs 2"},
     {"table", "gnbv table aircraft --seeds 5 --jobs 2"},
     {"compare", "gnbv compare smoke --utilities proposed,bircher --seeds 8"},
     {"bench",
      "gnbv bench run --track small --planner tour -o tour --jobs 2\n"
      "gnbv bench submit tour -o tour.zip\n"
      "gnbv bench verify tour.zip\n"
      "gnbv bench table tour.zip other.zip"},
     {"cache", "gnbv cache --prune"},
     {"ceiling", "gnbv ceiling aircraft"},
     {"doctor", "gnbv doctor"},
     {"render",
      "gnbv render runs/first\n"
      "gnbv render runs/first --what all -o pictures\n"
      "gnbv render runs/a runs/b --what path,coverage -o pictures --sheet both.png"},
     {"export", "gnbv export runs/first --format colmap"},
     {"plot",
      "gnbv plot runs/a runs/b -o plots --format svg,pdf\n"
      "gnbv plot runs/first --plots flight"},
     {"paper", "gnbv paper -o paper --seeds 1"},
     {"report", "gnbv report runs/a runs/b -o report.html"},
     {"asset",
      "gnbv asset aircraft -o aircraft.obj\n"
      "gnbv asset random --kind mast --seed 3 -o mast.obj"},
     {"lint", "gnbv lint my.obj"},
     {"schema", "gnbv schema > scenario.schema.json"},
     {"score",
      "gnbv score runs/first --update --ceiling\n"
      "gnbv score cloud.ply --scenario aircraft"},
     {"check", "gnbv check runs/first --against baseline.json"},
     {"surface", "gnbv surface runs/first"}}};

/// Every line behind so many blanks.
std::string indented(std::string_view text, std::size_t blanks) {
  std::string lines(blanks, ' ');
  for (const char c : text) {
    lines += c;
    if (c == '\n') lines.append(blanks, ' ');
  }
  return lines;
}

/// As CLI11's own, but folded: a name, and what it means beside it, or below where it is long.
class FoldingFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
  }
  /// A default as "=x", which CLI11 writes as " [x] " from 2.4 on.
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string opts = CLI::Formatter::make_option_opts(option);
    const std::string& value = option->get_default_str();
    const std::string newer = " [" + value + "] ";
    const std::size_t at = value.empty() ? std::string::npos : opts.find(newer);
    if (at != std::string::npos) opts.replace(at, newer.size(), "=" + value);
    return opts;
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_display_name(true), command->get_description());
  }
  std::string make_description(const CLI::App* app) const override {
    return folded_text(CLI::Formatter::make_description(app), kHelp_columns);
  }

 private:
  static std::string entry(std::string name, const std::string& meaning) {
    // lists of choices have no blanks to be folded at
    if (2 + name.size() > kHelp_columns) {
      for (std::size_t i = 0; i + 1 < name.size(); ++i) {
        if (name[i] == ',' && name[i + 1] != ' ') name.insert(i + 1, " ");
      }
    }
    // what follows the first line stands farther in than any name
    std::string lines = "  " + indented(folded_text(name, kHelp_columns - 6), 6).substr(6);
    if (meaning.empty()) return lines + "\n";
    std::string beside =
        indented(folded_text(meaning, kHelp_columns - kNames_columns), kNames_columns);
    if (lines.size() + 1 < kNames_columns) return lines + beside.substr(lines.size()) + "\n";
    return lines + "\n" + beside + "\n";
  }
};

}  // namespace

std::vector<CLI::App*> parts_of(CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

void lay_out_help(CLI::App& app) {
  const auto formatter = std::make_shared<FoldingFormatter>();
  app.formatter(formatter);
  app.footer(
      "gnbv COMMAND --help says more. To begin with:\n  gnbv run smoke --out runs/first\n"
      "  gnbv render runs/first");
  for (CLI::App* const command : parts_of(app)) {
    command->formatter(formatter);
    for (CLI::App* const part : parts_of(*command)) part->formatter(formatter);
    const auto example = std::find_if(kExamples.begin(), kExamples.end(), [&](const Example& e) {
      return e.command == command->get_name();
    });
    if (example == kExamples.end()) continue;
    const std::string more = command->get_footer();
    command->footer("Examples:\n" + indented(example->lines, 2) +
                    (more.empty() ? "" : "\n\n" + more));
  }
}

std::string meant_instead(const CLI::App& app, std::span<const std::string> words) {
  const auto all = [](const auto*) { return true; };
  std::vector<std::string_view> names;
  for (const CLI::App* const command : app.get_subcommands(all)) {
    names.emplace_back(command->get_name());
  }
  const auto is_name = [&](const std::string& word) { return std::ranges::count(names, word) > 0; };
  if (!names.empty()) {
    const auto first = std::ranges::find_if(words, [](auto& word) { return word[0] != '-'; });
    if (first == words.end()) return "";
    if (is_name(*first))
      return meant_instead(*app.get_subcommand(*first), {first + 1, words.end()});
    const std::string of = app.get_parent() == nullptr ? "gnbv " : "gnbv " + app.get_name() + ' ';
    const auto nearest = nearest_name(*first, names);
    if (nearest) return fmt::format("did you mean `{}{}`?", of, *nearest);
    if (std::ranges::any_of(words, is_name)) return "";  // after the value of an option
    return fmt::format("'{}' is no command; there are: {}", *first, join(names));
  }
  std::vector<std::string_view> options;
  for (const CLI::Option* const option : app.get_options(all)) {
    options.insert(options.end(), option->get_lnames().begin(), option->get_lnames().end());
  }
  for (const std::string& word : words) {
    if (!word.starts_with("--")) continue;
    const std::string name = word.substr(2, word.find('=') - 2);
    if (std::count(options.begin(), options.end(), name) > 0) continue;
    if (const auto near = nearest_name(name, options))
      return fmt::format("did you mean --{}?", *near);
  }
  return "";
}

}  // namespace gnbv

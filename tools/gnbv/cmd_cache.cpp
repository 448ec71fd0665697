#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/compare/text_table.hpp"
#include "bench/score/content_cache.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/gnbv/commands.hpp"

namespace gnbv {
namespace {

struct CacheOptions {
  bool prune = false;
  std::optional<std::uint64_t> limit_bytes;
  bool json = false;
};

struct CacheState {
  std::filesystem::path folder;
  std::vector<CacheKind> kinds;
  CacheUse all;
  std::uint64_t limit_bytes = 0;
  std::optional<CacheUse> removed;
};

CacheState state_of(const CacheOptions& options) {
  CacheState state = {.folder = cache_folder(), .kinds = {}, .all = {}, .removed = {}};
  state.limit_bytes = options.limit_bytes.value_or(cache_limit_bytes());
  if (state.folder.empty()) return state;
  if (options.prune) state.removed = prune_cache(state.folder, state.limit_bytes);
  state.kinds = cache_kinds(state.folder);
  for (const CacheKind& kind : state.kinds) {
    state.all.results += kind.use.results;
    state.all.bytes += kind.use.bytes;
  }
  return state;
}

std::string megabytes(std::uint64_t bytes) {
  return grouped(static_cast<double>(bytes) / 1e6, 1) + " MB";
}

std::string text_of(const CacheState& state) {
  if (state.folder.empty()) return "nothing is kept: GNBV_CACHE is empty, or there is no HOME\n";
  TextTable table{.title = state.folder.string(),
                  .columns = {{"Kind", "kind", ColumnKind::text},
                              {"Results", "results", ColumnKind::number},
                              {"Size", "bytes", ColumnKind::number}},
                  .rows = {},
                  .notes = {}};
  const auto add = [&](const std::string& name, const CacheUse& use) {
    const auto results = static_cast<double>(use.results);
    table.rows.push_back({TableCell{name},
                          {grouped(results, 0), {results}},
                          {megabytes(use.bytes), {static_cast<double>(use.bytes)}}});
  };
  for (const CacheKind& kind : state.kinds) add(kind.kind, kind.use);
  add("all", state.all);
  if (state.removed) {
    table.notes.push_back(fmt::format("Removed {} results of {}", state.removed->results,
                                      megabytes(state.removed->bytes)));
  }
  table.notes.push_back(
      fmt::format("At most {} are kept (GNBV_CACHE_LIMIT, in bytes); the longest unused go first",
                  megabytes(state.limit_bytes)));
  return terminal_text(table);
}

nlohmann::ordered_json json_of(const CacheUse& use) {
  return {{"results", use.results}, {"bytes", use.bytes}};
}

std::string json_text(const CacheState& state) {
  nlohmann::ordered_json json = {{"schema", 1},
                                 {"folder", state.folder.string()},
                                 {"limit_bytes", state.limit_bytes},
                                 {"all", json_of(state.all)},
                                 {"kinds", nlohmann::ordered_json::object()},
                                 {"removed", nullptr}};
  for (const CacheKind& kind : state.kinds) json["kinds"][kind.kind] = json_of(kind.use);
  if (state.removed) json["removed"] = json_of(*state.removed);
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void cache(const CacheOptions& options) {
  if (options.limit_bytes && !options.prune) throw BadInput("--limit: is for --prune");
  const CacheState state = state_of(options);
  fmt::print("{}", options.json ? json_text(state) : text_of(state));
}

}  // namespace

void add_cache_command(CLI::App& app) {
  auto options = std::make_shared<CacheOptions>();
  CLI::App* const command = app.add_subcommand(
      "cache", "say which true surfaces and ceilings are kept in GNBV_CACHE; prune it");
  command->add_flag("--prune", options->prune,
                    "remove results, the longest unused first, down to the limit; other programs "
                    "may run meanwhile");
  command
      ->add_option("--limit", options->limit_bytes,
                   "for --prune: bytes, also 500MB or 2GiB; 0 removes all "
                   "(default: GNBV_CACHE_LIMIT, or else 2 GiB)")
      ->transform(CLI::AsSizeValue(true))
      ->transform(CLI::Validator(
          [](std::string& text) { return text.starts_with('-') ? "has to be 0 or more" : ""; },
          "BYTES"));
  command->add_flag("--json", options->json, "print JSON instead of a table");
  command->callback([options] { cache(*options); });
}

}  // namespace gnbv

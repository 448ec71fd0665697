// Baseline files, read and written.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bench/compare/baseline.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kSchema = "gnbv-baseline-2";
constexpr std::string_view kCoverage = "coverage_";
constexpr std::array<const char*, 3> kBetterNames = {"higher", "lower", "same"};

/// Whether it is coverage at a size that not every run is scored at.
bool is_sized_coverage(const std::string& name) {
  if (!name.starts_with(kCoverage)) return false;
  const double size_m = std::strtod(name.c_str() + kCoverage.size(), nullptr);
  return size_m > 0.0 && name == fmt::format("{}{}", kCoverage, size_name(size_m));
}

/// One baseline file, for messages.
class File {
 public:
  explicit File(const fs::path& path)
      : path_(path), json_(Json::parse(read_file(path), nullptr, false)) {
    if (!json_.is_object()) throw BadInput("{}: is no JSON object", path_.string());
    const std::string schema = text({"schema"});
    if (schema != kSchema) {
      refuse({"schema"}, fmt::format("is not \"{}\": {}", kSchema, how_to_renew(path_)));
    }
  }

  Baseline baseline() const {
    Baseline baseline{.of = subject(), .termination = text({"termination"})};
    for (const BaselineMetric& known : make_baseline({}, {}).metrics) {
      baseline.metrics.push_back(metric(known.name));
    }
    for (const auto& [name, value] : at({"metrics"}).items()) {
      if (std::ranges::count(baseline.metrics, name, &BaselineMetric::name) > 0) continue;
      if (!is_sized_coverage(name)) refuse({"metrics", name}, "is no metric");
      baseline.metrics.push_back(metric(name));
    }
    if (json_.contains("result_sha256")) baseline.result_sha256 = text({"result_sha256"});
    return baseline;
  }

 private:
  using Keys = std::vector<std::string>;

  const Json& at(const Keys& keys) const {
    const Json* value = &json_;
    for (const std::string& key : keys) {
      if (!value->is_object() || !value->contains(key)) {
        throw BadInput("{}: {}: is missing", path_.string(), fmt::join(keys, "."));
      }
      value = &value->at(key);
    }
    return *value;
  }
  std::string text(const Keys& keys) const {
    if (!at(keys).is_string()) refuse(keys, "is no text");
    return at(keys).get<std::string>();
  }
  BaselineSubject subject() const {
    BaselineSubject of{.version = text({"of", "version"}), .reference = text({"of", "reference"})};
    for (const auto& [key, value] : at({"of", "configuration"}).items()) {
      of.configuration[key] = text({"of", "configuration", key});
    }
    for (const auto& [key, value] : at({"of", "files"}).items()) {
      of.files[key] = {text({"of", "files", key, "name"}), text({"of", "files", key, "sha256"})};
    }
    return of;
  }
  double number(const Keys& keys) const {
    const Json& value = at(keys);
    if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(keys, "is no number");
    return value.get<double>();
  }
  BaselineMetric metric(const std::string& name) const {
    const Keys tolerance = {"metrics", name, "tolerance"}, better = {"metrics", name, "better"};
    const auto* const found = std::find(kBetterNames.begin(), kBetterNames.end(), text(better));
    if (found == kBetterNames.end()) {
      refuse(better, "must be \"higher\", \"lower\" or \"same\"");
    }
    if (number(tolerance) < 0.0) refuse(tolerance, "is below 0");
    return {name, number({"metrics", name, "value"}), number(tolerance),
            static_cast<Better>(found - kBetterNames.begin())};
  }
  /// A stranger's list may lie deeper than dump() can go.
  [[noreturn]] void refuse(const Keys& keys, const std::string& what) const {
    const Json& value = at(keys);
    const std::string shown = value.is_array()    ? "a list"
                              : value.is_object() ? "an object"
                                                  : value.dump();
    throw BadInput("{}: {}: {} {}", path_.string(), fmt::join(keys, "."), shown, what);
  }

  fs::path path_;
  Json json_;
};

}  // namespace

Baseline read_baseline(const fs::path& path) { return File(path).baseline(); }

std::string to_json(const Baseline& baseline) {
  Json metrics;
  for (const BaselineMetric& metric : baseline.metrics) {
    metrics[metric.name] = {{"value", metric.value},
                            {"tolerance", metric.tolerance},
                            {"better", kBetterNames[static_cast<std::size_t>(metric.better)]}};
  }
  const BaselineSubject& of = baseline.of;
  Json files = Json::object();
  for (const auto& [key, file] : of.files) {
    files[key] = {{"name", file.name}, {"sha256", file.sha256}};
  }
  Json json = {{"schema", kSchema},
               {"of",
                {{"version", of.version},
                 {"reference", of.reference},
                 {"files", files},
                 {"configuration", of.configuration}}},
               {"termination", baseline.termination},
               {"metrics", metrics}};
  if (baseline.result_sha256) json["result_sha256"] = *baseline.result_sha256;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnbv

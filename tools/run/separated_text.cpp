#include "tools/run/separated_text.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"

namespace gnbv {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string_view next_part(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

std::vector<std::string_view> split(std::string_view row, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end = 0; end != row.npos; row.remove_prefix(end == row.npos ? 0 : end + 1)) {
    end = row.find(separator);
    parts.push_back(row.substr(0, end));
  }
  return parts;
}

std::vector<std::string> csv_fields(std::string_view record) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < record.size(); ++i) {
    const char c = record[i];
    const bool is_doubled = is_quoted && c == '"' && i + 1 < record.size() && record[i + 1] == '"';
    if (is_doubled) {
      fields.back() += record[i++];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::string to_string(const TextPlace& place) {
  return fmt::format("{}:{}", place.file.string(), place.line);
}

std::string read_json_text(const std::filesystem::path& file) {
  constexpr int kMostDeep = 200;
  std::string text = read_file(file);
  int deep = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') is_quoted = !is_quoted;
    if (is_quoted) {
      i += text[i] == '\\' ? 1 : 0;
      continue;
    }
    deep += text[i] == '[' || text[i] == '{' ? 1 : 0;
    deep -= text[i] == ']' || text[i] == '}' ? 1 : 0;
    if (deep > kMostDeep) {
      throw BadInput("{}: its JSON is more than {} deep", file.string(), kMostDeep);
    }
  }
  return text;
}

void for_each_line(std::string_view text, const std::filesystem::path& file,
                   const std::function<void(std::string_view, const TextPlace&)>& take, int first) {
  for (int line = first; !text.empty(); ++line) take(next_part(text, '\n'), {file, line});
}

double to_number(std::string_view text, const TextPlace& place, std::string_view what) {
  const std::string_view t = trimmed(text);
  const auto value = number_in<double>(t);
  if (value && std::isfinite(*value)) return *value;
  throw BadInput("{}: {} `{}` is not a number", to_string(place), what, t);
}

int to_count(std::string_view text, const TextPlace& place, std::string_view what) {
  const double value = to_number(text, place, what);
  if (value < 0.0 || value > 1e9 || value != std::floor(value)) {
    throw BadInput("{}: {} `{}` is not a count", to_string(place), what, text);
  }
  return static_cast<int>(value);
}

std::string json_reason(const std::exception& error) {
  const std::string_view what = error.what();
  const std::size_t end = what.starts_with("[json.exception.") ? what.find("] ") : what.npos;
  return std::string(end == what.npos ? what : what.substr(end + 2));
}

void need_header(std::string_view row, std::string_view header, const TextPlace& place,
                 std::string_view help) {
  if (row == header) return;
  throw BadInput("{}: is not the header that this version writes{}", to_string(place), help);
}

std::string pose_text(const Isometry& T, char separator) {
  const Vec3 p = T.translation();
  const Eigen::Quaterniond q(T.linear());
  return fmt::format("{1:.6f}{0}{2:.6f}{0}{3:.6f}{0}{4:.9f}{0}{5:.9f}{0}{6:.9f}{0}{7:.9f}",
                     separator, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

Isometry to_pose(std::span<const double, 7> numbers, const TextPlace& place) {
  const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (std::abs(q.norm() - 1.0) > 1e-3) {
    throw BadInput("{}: qx qy qz qw are no unit quaternion", to_string(place));
  }
  Isometry T = Isometry::Identity();
  T.translate(Vec3(numbers[0], numbers[1], numbers[2]));
  T.rotate(q.normalized());
  return T;
}

}  // namespace gnbv

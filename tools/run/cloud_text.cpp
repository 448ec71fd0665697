// read_text_cloud() of tools/run/cloud_formats.hpp.
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "tools/run/cloud_formats.hpp"

namespace gnbv {
namespace {

/// Whether a line is three numbers with a decimal comma each, which commas between numbers would
/// be taken for.
bool has_decimal_commas(std::string_view line) {
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = take_word(line);
    const std::size_t comma = word.find(',');
    const bool is_between_digits = comma != word.npos && comma > 0 && comma + 1 < word.size();
    if (!is_between_digits || word.find_first_of(",;", comma + 1) != word.npos) return false;
  }
  return true;
}

/// What stands between blanks, or between commas or semicolons: there a field may be empty.
void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  constexpr std::string_view kBlanks = " \t\r";
  const auto skip_blanks = [&] {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  };
  fields.clear();
  for (skip_blanks(); !line.empty(); skip_blanks()) {
    fields.push_back(line.substr(0, line.find_first_of(" \t\r,;")));
    line.remove_prefix(fields.back().size());
    skip_blanks();
    if (line.starts_with(',') || line.starts_with(';')) line.remove_prefix(1);
  }
}

class TextCloud {
 public:
  explicit TextCloud(CloudPoints& to) : to_(to), file_(open_file(to.path)), lines_(file_) {}

  void read() {
    while (lines_.next(line_)) {
      std::string_view rest = line_;
      const std::string_view word = take_word(rest);
      const bool is_none =
          word.empty() || word.starts_with('#') || word.starts_with("//") || word.starts_with('%');
      if (!is_none) take_row();
      is_first_ = is_first_ && is_none;
    }
    if (file_.bad()) to_.fail(std::strerror(errno));
    need_all_announced();
  }

 private:
  [[noreturn]] void fail_in_row(std::string_view what) const {
    to_.fail(fmt::format("'{}' {}", line_.substr(0, 60), what), lines_.number());
  }

  void take_row() {
    if (has_decimal_commas(line_)) fail_in_row("has decimal commas: write decimal points");
    split_fields(line_, fields_);
    if (takes_count() || (is_first_ && takes_names())) return;
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t column = columns_[axis];
      const auto value =
          column < fields_.size() ? read_decimal(fields_[column]) : std::optional<double>();
      if (!value) {
        fail_in_row(is_named_ ? "has no number under x, y or z"
                              : "does not begin with three numbers");
      }
      p_m[static_cast<Eigen::Index>(axis)] = *value;
    }
    if (announced_ && announced_at_ + *announced_ == to_.points_m.size()) {
      fail_in_row(fmt::format("follows the {} points that the file announces", *announced_));
    }
    to_.add(p_m);
  }

  /// Of the points of a block, before its first; the block before it has to be whole.
  bool takes_count() {
    if (!is_first_ && !announced_) return false;
    std::uint64_t count = 0;
    const std::string_view word = fields_.front();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (fields_.size() != 1 || error != std::errc() || end != word.data() + word.size()) {
      return false;
    }
    need_all_announced();
    announced_ = count;
    announced_at_ = to_.points_m.size();
    return true;
  }

  bool takes_names() {
    if (read_decimal(fields_.front())) return false;
    constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
    std::array<std::size_t, 3> columns{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = std::find_if(fields_.begin(), fields_.end(), [&](std::string_view field) {
        const bool is_quoted = field.size() > 2 && field.front() == '"' && field.back() == '"';
        return in_lower_case(is_quoted ? field.substr(1, field.size() - 2) : field) == kNames[axis];
      });
      if (at == fields_.end()) return false;
      columns[axis] = static_cast<std::size_t>(at - fields_.begin());
    }
    columns_ = columns;
    return is_named_ = true;
  }

  void need_all_announced() const {
    if (!announced_ || to_.points_m.size() - announced_at_ == *announced_) return;
    to_.fail(fmt::format("holds {} of the {} points that it announces",
                         to_.points_m.size() - announced_at_, *announced_));
  }

  CloudPoints& to_;
  std::ifstream file_;
  LineReader lines_;
  std::string_view line_;
  std::vector<std::string_view> fields_;
  std::array<std::size_t, 3> columns_ = {0, 1, 2};
  bool is_first_ = true;  // no row yet
  bool is_named_ = false;
  std::optional<std::uint64_t> announced_;
  std::size_t announced_at_ = 0;  // points before the block
};

}  // namespace

void read_text_cloud(CloudPoints& to) { TextCloud(to).read(); }

}  // namespace gnbv

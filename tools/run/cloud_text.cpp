// read_text_cloud() of tools/run/cloud_formats.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "sim/mesh/plain_text.hpp"
#include "tools/run/cloud_formats.hpp"

namespace gnbv {
namespace {

/// Whether one of a line's first three words is a number with a decimal comma, though blanks alone
/// part it from the next: commas between numbers would be taken for one.
bool has_decimal_commas(std::string_view line) {
  std::string_view before = take_word(line);
  for (int i = 0; i < 2; ++i) {
    const std::string_view word = take_word(line);
    const auto commas = [](std::string_view of) { return std::count(of.begin(), of.end(), ','); };
    const auto may_be_decimal = [&](std::string_view of) {
      return commas(of) == 1 && of.find_first_not_of("+-0123456789,eE") == of.npos;
    };
    if (word.empty() || commas(before) > 1) return false;
    const bool are_parted = before.ends_with(',') || word.starts_with(',');
    if (!are_parted && (may_be_decimal(before) || may_be_decimal(word))) return true;
    before = word;
  }
  return false;
}

constexpr std::string_view kCommasAndBlanks = ", ";

/// What parts the fields of a line: commas only where it has neither semicolons nor tabs. A name of
/// a column may hold blanks.
std::string_view separators_of(std::string_view line, bool is_of_names) {
  if (line.find(';') != line.npos) return ";";
  if (line.find('\t') != line.npos) return is_of_names ? "\t" : " \t";
  return is_of_names && line.find(',') != line.npos ? "," : kCommasAndBlanks;
}

/// What stands between blanks, or between other separators, the first of these: there a field may
/// be empty.
void split_fields(std::string_view line, std::string_view separators,
                  std::vector<std::string_view>& fields) {
  const std::string_view blanks = separators == "\t" ? " " : " \t";
  const auto skip_blanks = [&] {
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  };
  fields.clear();
  for (skip_blanks(); !line.empty(); skip_blanks()) {
    std::string_view field = line.substr(0, line.find_first_of(separators));
    line.remove_prefix(field.size());
    field = field.substr(0, field.find_last_not_of(blanks) + 1);
    fields.push_back(field);
    skip_blanks();
    if (line.starts_with(separators[0])) line.remove_prefix(1);
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
    if (is_first_ && takes_names()) return;
    // rows may be parted in another way than their names
    const bool is_as_names = is_named_ && line_.find_first_of(separators_) != line_.npos;
    const std::string_view separators = is_as_names ? separators_ : separators_of(line_, false);
    const std::string_view commas = "has decimal commas: write decimal points";
    if (separators == kCommasAndBlanks && has_decimal_commas(line_)) fail_in_row(commas);
    split_fields(line_, separators, fields_);
    if (takes_count()) return;
    if (is_named_ && fields_.size() > names_) {
      fail_in_row(fmt::format("has {} fields under {} names", fields_.size(), names_));
    }
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t column = columns_[axis];
      const auto value =
          column < fields_.size() ? read_decimal(fields_[column]) : std::optional<double>();
      if (!value) {
        const bool has_comma =
            column < fields_.size() && fields_[column].find(',') != std::string_view::npos;
        fail_in_row(has_comma   ? commas
                    : is_named_ ? "has no number under x, y or z"
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
    const auto count = number_in<std::uint64_t>(fields_.front());
    if (fields_.size() != 1 || !count) return false;
    need_all_announced();
    announced_ = count;
    announced_at_ = to_.points_m.size();
    return true;
  }

  bool takes_names() {
    separators_ = separators_of(line_, true);
    split_fields(line_, separators_, fields_);
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
    names_ = fields_.size();
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
  std::string_view separators_;  // of the names
  std::size_t names_ = 0;
  std::optional<std::uint64_t> announced_;
  std::size_t announced_at_ = 0;  // points before the block
};

}  // namespace

void read_text_cloud(CloudPoints& to) { TextCloud(to).read(); }

}  // namespace gnbv

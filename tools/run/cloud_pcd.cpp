// read_pcd_cloud() of tools/run/cloud_formats.hpp. Our own: PCL's library would cost every start,
// and loads VTK.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string_view>

#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "sim/mesh/plain_text.hpp"
#include "tools/run/cloud_formats.hpp"

namespace gnbv {
namespace {

using Number = double (*)(const char* bytes);

struct Field {
  std::string name;
  std::uint64_t bytes = 4;  // of one value
  char type = 'F';
  std::uint64_t count = 1;  // of values
};

template <typename T>
double as_double(const char* bytes) {
  return static_cast<double>(number_at<T>(bytes));
}

/// Nothing for a type that PCD does not know.
Number number_of(const Field& field) {
  const auto one_of = [&](Number n1, Number n2, Number n4, Number n8) {
    return field.bytes == 1   ? n1
           : field.bytes == 2 ? n2
           : field.bytes == 4 ? n4
           : field.bytes == 8 ? n8
                              : nullptr;
  };
  if (field.type == 'F') return one_of(nullptr, nullptr, as_double<float>, as_double<double>);
  if (field.type == 'U') {
    return one_of(as_double<std::uint8_t>, as_double<std::uint16_t>, as_double<std::uint32_t>,
                  as_double<std::uint64_t>);
  }
  return field.type == 'I' ? one_of(as_double<std::int8_t>, as_double<std::int16_t>,
                                    as_double<std::int32_t>, as_double<std::int64_t>)
                           : nullptr;
}

class PcdFile {
 public:
  explicit PcdFile(CloudPoints& to) : to_(to), bytes_(as_utf8(read_file(to.path))), rest_(bytes_) {}

  void read() {
    read_header();
    find_columns();
    if (data_ == "ascii") {
      read_rows();
    } else if (data_ == "binary") {
      read_records(rest_, false);
      const std::uint64_t used = points_ * record_bytes_;
      to_.left_out(rest_.size() - used, "bytes after the last point");
    } else if (data_ == "binary_compressed") {
      const std::string records = decompressed();
      read_records(records, true);
    } else {
      to_.fail(fmt::format("DATA {} is none of ascii, binary, binary_compressed", data_));
    }
    to_.left_out(not_finite_, "points that are not finite");
  }

 private:
  static constexpr std::uint64_t kMost = std::uint64_t{1} << 31U;  // points, bytes of a point

  std::uint64_t count_of(std::string_view word, std::string_view of_what) const {
    const auto count = number_in<std::uint64_t>(word);
    if (count && *count <= kMost) return *count;
    to_.fail(fmt::format("its {} '{}' is no number of the kind", of_what, word.substr(0, 60)));
  }

  void read_header() {
    std::vector<std::string_view> words;
    // a line feed after a carriage return is of its line where that is so in the first one
    const std::size_t first_end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const bool ends_in_both = rest_.substr(first_end).starts_with("\r\n");
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      const bool has_both = ends_in_both && rest_.substr(end).starts_with("\r\n");
      split(rest_.substr(0, end), words);
      rest_.remove_prefix(std::min(end + (has_both ? 2 : 1), rest_.size()));
      ++line_;
      if (words.empty() || words[0].starts_with('#')) continue;
      if (words[0] == "DATA" && words.size() == 2) {
        data_ = words[1];
        return;
      }
      read_declaration(words);
    }
    to_.fail("is no PCD file: its header has no DATA line");
  }

  void read_declaration(Words words) {
    const std::string_view key = words[0];
    const Words values = words.subspan(1);
    if (key == "FIELDS" || key == "COLUMNS") {
      fields_.clear();
      for (const std::string_view name : values) fields_.push_back({.name = in_lower_case(name)});
    } else if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
      if (values.size() != fields_.size()) {
        to_.fail(fmt::format("its {} line has {} values for {} fields", key, values.size(),
                             fields_.size()));
      }
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (key == "TYPE") fields_[i].type = values[i][0];
        if (key == "SIZE") fields_[i].bytes = count_of(values[i], key);
        if (key == "COUNT") fields_[i].count = count_of(values[i], key);
      }
    } else if (key == "WIDTH" || key == "HEIGHT" || key == "POINTS") {
      if (values.size() != 1) to_.fail(fmt::format("its {} line is no number", key));
      (key == "WIDTH" ? width_ : key == "HEIGHT" ? height_ : announced_) = count_of(values[0], key);
    } else if (key == "VIEWPOINT") {
      if (joined(words) != "VIEWPOINT 0 0 0 1 0 0 0") {
        to_.warnings.push_back(fmt::format("{}: {} is not applied: points are taken as they stand",
                                           to_.path.string(), joined(words)));
      }
    } else if (key != "VERSION") {
      to_.fail(fmt::format("its header has a bad '{}' line", key.substr(0, 60)));
    }
  }

  void find_columns() {
    columns_.fill(fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const Field& field = fields_[i];
      constexpr std::string_view kAxes = "xyz";
      const std::size_t axis = field.name.size() == 1 ? kAxes.find(field.name[0]) : kAxes.npos;
      if (axis < 3) columns_[axis] = i;
      if (axis < 3 && (field.count != 1 || number_of(field) == nullptr)) {
        to_.fail(fmt::format("its field {} of TYPE {}, SIZE {} and COUNT {} is no number",
                             field.name, field.type, field.bytes, field.count));
      }
      record_bytes_ += field.bytes * field.count;
      record_words_ += field.count;
      if (record_bytes_ > kMost || record_words_ > kMost) to_.fail("its points are too large");
    }
    if (*std::max_element(columns_.begin(), columns_.end()) == fields_.size()) {
      to_.fail("its FIELDS lack x, y or z");
    }
    if (!width_ && !announced_) to_.fail("its header has neither POINTS nor WIDTH");
    const std::uint64_t laid_out = width_.value_or(0) * height_.value_or(1);
    points_ = announced_.value_or(laid_out);
    if (width_ && points_ != laid_out) {
      to_.fail(fmt::format("its POINTS {} are not WIDTH {} times HEIGHT {}", points_, *width_,
                           height_.value_or(1)));
    }
  }

  void add(const Vec3& p_m) {
    if (p_m.allFinite()) {
      to_.add(p_m);
    } else {
      ++not_finite_;
    }
  }

  void read_rows() {
    std::istringstream text{std::string(rest_)};
    LineReader lines(text);
    std::vector<std::string_view> words;
    std::uint64_t rows = 0, over = 0;
    for (std::string_view line; lines.next(line);) {
      split(line, words);
      if (words.empty() || words[0].starts_with('#')) continue;
      if (rows == points_) {
        ++over;
        continue;
      }
      ++rows;
      if (words.size() != record_words_) {
        to_.fail(fmt::format("{} words, its header says {}", words.size(), record_words_),
                 line_ + lines.number());
      }
      add(row_place(words, line_ + lines.number()));
    }
    need_points(rows);
    to_.left_out(over, "rows after the last point");
  }

  Vec3 row_place(Words words, std::size_t line) const {
    Vec3 p_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::size_t at = 0;
      for (std::size_t i = 0; i < columns_[axis]; ++i) at += fields_[i].count;
      const auto value = read_decimal(words[at]);
      if (!value) to_.fail(fmt::format("'{}' is no number", words[at].substr(0, 60)), line);
      p_m[static_cast<Eigen::Index>(axis)] = *value;
    }
    return p_m;
  }

  /// Of a point after the other or, compressed, of a field after the other.
  void read_records(std::string_view records, bool by_field) {
    if (record_bytes_ > 0)
      need_points(std::min<std::uint64_t>(points_, records.size() / record_bytes_));
    std::array<const char*, 3> at{};
    std::array<std::uint64_t, 3> step{};
    std::array<Number, 3> number{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Field& field = fields_[columns_[axis]];
      std::uint64_t before = 0;
      for (std::size_t i = 0; i < columns_[axis]; ++i)
        before += fields_[i].bytes * fields_[i].count;
      at[axis] = records.data() + before * (by_field ? points_ : 1);
      step[axis] = by_field ? field.bytes : record_bytes_;
      number[axis] = number_of(field);
    }
    to_.points_m.reserve(points_);
    for (std::uint64_t i = 0; i < points_; ++i) {
      const auto of = [&](std::size_t axis) { return number[axis](at[axis] + i * step[axis]); };
      add({of(0), of(1), of(2)});
    }
  }

  void need_points(std::uint64_t held) const {
    if (held < points_) {
      to_.fail(
          fmt::format("ends after {} of the {} points that its header announces", held, points_));
    }
  }

  /// LibLZF's stream after two sizes. Three bytes of it stand for at most 264.
  std::string decompressed() {
    constexpr std::size_t kHead = 8, kMostRatio = 100;
    if (rest_.size() < kHead) to_.fail("ends before its compressed points");
    const std::uint64_t packed = number_at<std::uint32_t>(rest_.data());
    const std::uint64_t whole = number_at<std::uint32_t>(rest_.data() + 4);
    if (packed > rest_.size() - kHead) {
      to_.fail(fmt::format("ends after {} of {} compressed bytes", rest_.size() - kHead, packed));
    }
    to_.left_out(rest_.size() - kHead - packed, "bytes after the last point");
    if (whole != points_ * record_bytes_ || whole / kMostRatio > packed) {
      to_.fail(fmt::format("its {} points of {} bytes are not the {} that it holds compressed",
                           points_, record_bytes_, whole));
    }
    std::string out;
    out.reserve(whole);
    if (!expands(rest_.substr(kHead, packed), whole, out)) to_.fail("its compression is damaged");
    return out;
  }

  static bool expands(std::string_view in, std::uint64_t whole, std::string& out) {
    const auto next = [&] {
      const auto byte = static_cast<unsigned char>(in[0]);
      in.remove_prefix(1);
      return std::size_t{byte};
    };
    while (!in.empty()) {
      const std::size_t control = next();
      if (control < 32) {  // so many bytes, and one, as they are
        if (in.size() < control + 1) return false;
        out += in.substr(0, control + 1);
        in.remove_prefix(control + 1);
      } else {  // bytes that came before
        if (in.size() < (control >> 5U == 7 ? 2U : 1U)) return false;
        const std::size_t length = (control >> 5U) + 2 + (control >> 5U == 7 ? next() : 0);
        const std::size_t back = ((control & 31U) << 8U) + next() + 1;
        if (back > out.size()) return false;
        for (std::size_t i = 0; i < length; ++i) out += out[out.size() - back];
      }
      if (out.size() > whole) return false;
    }
    return out.size() == whole;
  }

  CloudPoints& to_;
  const std::string bytes_;
  std::string_view rest_, data_;
  std::size_t line_ = 0;
  std::vector<Field> fields_;
  std::array<std::size_t, 3> columns_{};  // x, y, z among the fields
  std::optional<std::uint64_t> width_, height_, announced_;
  std::uint64_t points_ = 0, record_bytes_ = 0, record_words_ = 0, not_finite_ = 0;
};

}  // namespace

void read_pcd_cloud(CloudPoints& to) { PcdFile(to).read(); }

}  // namespace gnbv

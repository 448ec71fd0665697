// The container of a PLY file: its header, and the items of the elements that it announces.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "sim/mesh/plain_text.hpp"

namespace gnbv {

struct PlyType {
  std::string_view name, other_name;
  std::size_t bytes;
  double full;  // level of a colour channel
  double (*number_at)(const char* bytes);
};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count_type = nullptr;  // of a list; null for a single number

  bool is_corners() const { return count_type != nullptr && name.starts_with("vertex_ind"); }
  /// Without it there is no shape: it must be a number.
  bool is_needed() const { return is_corners() || name == "x" || name == "y" || name == "z"; }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

using PlyItem = std::vector<std::vector<double>>;  // the numbers of each property, and one 0 more

/// A PLY file: a header, and the items of the elements that it announces, in text or in bytes of
/// either order.
class PlyFile {
 public:
  /// Reads the header.
  explicit PlyFile(const std::filesystem::path& path);

  const std::string& path() const { return path_; }
  const std::vector<PlyElement>& elements() const { return elements_; }

  /// Calls use(item) for each item of the next element.
  template <typename Use>
  void for_each_item(const PlyElement& element, const Use& use) {
    const std::size_t properties = element.properties.size();
    if (properties == 0) return;
    PlyItem item(properties + 1, {0.0});
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < properties; ++k) {
        const PlyProperty& property = element.properties[k];
        double count = 1.0;
        if (property.count_type != nullptr) {
          take_numbers(*property.count_type, 1.0, true, item[k]);
          need_whole_numbers(item[k], 0.0, property);
          count = item[k][0];
        }
        take_numbers(*property.type, count, property.is_needed(), item[k]);
        if (property.is_corners()) need_whole_numbers(item[k], kLowest, property);
      }
      end_row(element);
      use(item);
    }
  }

  /// What a comment names as its picture; empty without one.
  const std::string& picture() const { return picture_; }

  /// Whether a row does not end with its line, so that only the end tells of words left over.
  bool is_free() const { return is_free_.value_or(false); }

  /// Warns of what stands after all that the header announces; how many faces that may be.
  std::size_t warn_of_rest(std::vector<std::string>& warnings);

  [[noreturn]] void fail(const std::string& what) const;

  /// How many items are worth reserving, whatever the header says.
  std::size_t most_items(const PlyElement& element) const {
    return std::min<std::uint64_t>(element.count,
                                   bytes_ / std::max<std::size_t>(element.properties.size(), 1));
  }

 private:
  static constexpr double kLowest = -std::numeric_limits<double>::infinity();

  /// Naming the line of the header, or of a text.
  [[noreturn]] void fail_in_line(const std::string& what) const;

  /// Of a list, its length or the vertices in it: a row of another element has what they cannot be.
  void need_whole_numbers(std::span<const double> values, double least,
                          const PlyProperty& list) const;

  /// The first row of a text says whether rows end with their lines.
  void end_row(const PlyElement& element);

  std::istream& in() { return converted_ ? static_cast<std::istream&>(*converted_) : in_; }

  /// A line of the header. Bytes may follow the last one at once: a line feed after a carriage
  /// return belongs to it where that is so in the first line.
  bool next_header_line();

  void read_header();

  bool read_declaration(Words words);

  const PlyType* type_of(std::string_view name) const;

  /// Reads in pieces, since a wrong count may be of any size.
  void take_numbers(const PlyType& type, double count, bool is_needed,
                    std::vector<double>& numbers);

  double take_number(bool is_needed);

  [[noreturn]] void end_early() const;

  std::string path_;
  std::ifstream in_;
  std::optional<std::istringstream> converted_;  // from UTF-16
  std::uint64_t bytes_ = 0;                      // of the file
  std::string line_;                             // of the header
  std::string picture_;
  std::size_t header_lines_ = 0;
  bool ends_in_cr_ = false;          // its first line
  std::optional<bool> is_free_;      // a text, of rows that do not end with their lines
  std::optional<LineReader> lines_;  // after it
  std::string_view rest_;            // of a line of those
  bool is_text_ = true, is_big_endian_ = false;
  std::vector<PlyElement> elements_;
};

}  // namespace gnbv

// What PLY files are made of: a header, and items of the elements that it announces, in text or
// bytes of either order. Own reader: assimp's (5.2.4) crashes on sound binary files and does not
// know the colours of faces.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/pose.hpp"
#include "sim/mesh/chunked_file.hpp"

namespace gnbv {

struct PlyType {
  std::string_view name, other_name;
  std::uint8_t bytes;
  bool is_signed, is_real;
};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count_type = nullptr;  // of a list; null for a single number
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Places among the properties of numbers, not lists, with these names; the last of each name.
  std::array<std::optional<std::size_t>, 3> columns(
      const std::array<std::string_view, 3>& names) const;
};

struct PlyItem {
  std::vector<double> numbers;             // a number a property, 0 for a list
  std::vector<std::vector<double>> lists;  // a list a property, empty for a number
};

/// Throws BadInput naming what is wrong with the file when it is no PLY, ends too early or holds
/// what is no number.
class PlyReader {
 public:
  /// Reads the header.
  explicit PlyReader(const std::filesystem::path& path);

  const std::vector<PlyElement>& elements() const { return elements_; }

  /// The next item, those of the elements following each other. An element without properties has
  /// no items.
  void read_item(const PlyElement& element, PlyItem& item);
  void skip(const PlyElement& element);

  /// How many items of the element, or numbers in lists of it, the rest of the file can hold:
  /// what is worth reserving, whatever the header says.
  std::size_t most_items(const PlyElement& element) const;
  std::size_t most_list_numbers(const PlyElement& element) const;

 private:
  enum class Encoding { text, little_endian, big_endian };

  [[noreturn]] void fail(const std::string& what) const;
  void read_header();
  bool read_declaration(const std::vector<std::string_view>& words);
  const PlyType* type_of(std::string_view name) const;
  double take_number(const PlyType& type);
  std::size_t least_bytes(const PlyType& type) const;
  std::size_t least_bytes(const PlyElement& element) const;

  std::string path_;
  ChunkedFile file_;
  Encoding encoding_ = Encoding::text;
  std::vector<PlyElement> elements_;
};

/// Where the vertices of an element are; a coordinate that it does not have is 0.
class PlyPositions {
 public:
  explicit PlyPositions(const PlyElement& element) : columns_(element.columns({"x", "y", "z"})) {}

  Vec3 of(const PlyItem& item) const {
    const auto axis = [&](std::size_t a) { return columns_[a] ? item.numbers[*columns_[a]] : 0.0; };
    return {axis(0), axis(1), axis(2)};
  }

 private:
  std::array<std::optional<std::size_t>, 3> columns_;
};

}  // namespace gnbv

// A file read from its beginning to its end, of which only a chunk is ever in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

namespace gnbv {

/// What it hands out stays valid until the next call. Throws BadInput naming the path when the file
/// cannot be read.
class ChunkedFile {
 public:
  explicit ChunkedFile(const std::filesystem::path& path);

  /// The next line, without its line feed; nothing at the end of the file.
  std::optional<std::string_view> line();

  /// The next word between blanks and line ends; empty at the end of the file.
  std::string_view word();

  /// The next bytes; null when the file ends before.
  const char* bytes(std::size_t count) {
    while (end_ - at_ < count) {
      if (!read_more()) return nullptr;
    }
    at_ += count;
    return buffer_.data() + at_ - count;
  }

  /// Upper bound of what is to come.
  std::uint64_t bytes_left() const { return unread_ + (end_ - at_); }

 private:
  /// Keeps what is not handed out yet; false at the end of the file.
  bool read_more();
  std::string_view ahead() const { return {buffer_.data() + at_, end_ - at_}; }

  std::filesystem::path path_;
  std::ifstream in_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;  // of the buffer: what is read, but not handed out
  std::uint64_t unread_ = 0;
};

}  // namespace gnbv

#include "sim/mesh/chunked_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kChunk_bytes = 1 << 20;
constexpr std::string_view kSeparators = " \t\r\n";

}  // namespace

ChunkedFile::ChunkedFile(const std::filesystem::path& path)
    : path_(path), in_(path, std::ios::binary), buffer_(kChunk_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw BadInput(fmt::format("{}: is a directory, not a file", path.string()));
  }
  if (!in_) throw BadInput(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (!error) unread_ = size;
}

bool ChunkedFile::read_more() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(at_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= at_;
  at_ = 0;
  if (end_ == buffer_.size()) buffer_.resize(2 * end_);  // one line or word is longer
  in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
  if (in_.bad()) throw BadInput(fmt::format("{}: {}", path_.string(), std::strerror(errno)));
  const auto count = static_cast<std::size_t>(in_.gcount());
  end_ += count;
  unread_ -= std::min<std::uint64_t>(unread_, count);
  return count > 0;
}

std::optional<std::string_view> ChunkedFile::line() {
  std::size_t length = ahead().find('\n');
  while (length == std::string_view::npos) {
    const std::size_t searched = end_ - at_;
    if (!read_more()) {
      if (searched == 0) return std::nullopt;
      return std::string_view(bytes(searched), searched);
    }
    length = ahead().find('\n', searched);
  }
  return std::string_view(bytes(length + 1), length);
}

std::string_view ChunkedFile::word() {
  do {
    at_ += std::min(ahead().find_first_not_of(kSeparators), end_ - at_);
  } while (at_ == end_ && read_more());
  std::size_t length = ahead().find_first_of(kSeparators);
  while (length == std::string_view::npos) {
    const std::size_t searched = end_ - at_;
    if (!read_more()) return {bytes(searched), searched};
    length = ahead().find_first_of(kSeparators, searched);
  }
  return {bytes(length), length};
}

}  // namespace gnbv

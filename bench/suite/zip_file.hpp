// Zip archives that strangers send: read whole and within limits, or refused by name.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace gnbv {

/// What an archive may be at most.
struct ZipLimits {
  std::size_t members = 1000;
  std::size_t member_bytes = std::size_t{64} << 20;
  std::size_t total_bytes = std::size_t{256} << 20;
  std::size_t ratio = 200;  // of a member's size to what it takes in the archive
};

/// Name and content of every member, read into memory alone. Throws BadInput naming file and member
/// for what is no archive, is damaged (checksums), encrypted or exceeds the limits, and for members
/// that are folders, links or devices, are there twice, or whose names are no plain relative paths
/// (absolute, "..", ".", backslashes, control characters).
std::map<std::string, std::string> read_zip(const std::filesystem::path& file,
                                            const ZipLimits& limits = {});

/// Writes an archive by rename: the same bytes for the same members.
void write_zip(const std::filesystem::path& file,
               const std::map<std::string, std::string>& members);

}  // namespace gnbv

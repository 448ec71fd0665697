// Files that are either whole or not there.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace gnbv {

/// The extension in lower case, with its dot: ".obj"; empty without one.
std::string extension_of(const std::filesystem::path& path);

/// The whole file. Throws BadInput naming the path when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes beside `path` and renames: a reader sees the old file or the new one, never a part.
/// Throws BadInput naming the path when it cannot be written.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for writers that want a path of their own: `write` fills the temporary file.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path&)>& write);

/// Makes the folder and those above it; whether it is new. Throws BadInput naming it.
bool make_folder(const std::filesystem::path& folder);

}  // namespace gnbv

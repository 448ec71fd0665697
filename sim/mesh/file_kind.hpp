// What a file is that is no mesh of the format it is named for.
#pragma once

#include <filesystem>
#include <string>

namespace gnbv {

/// "is a Git LFS pointer, ..." and what to do; empty for what may be a mesh of that extension.
/// Looks at the first bytes.
std::string what_it_is_instead(const std::filesystem::path& path, const std::string& extension);

/// "holds no faces", and for points what reads them.
std::string no_faces_text(std::size_t points);

}  // namespace gnbv

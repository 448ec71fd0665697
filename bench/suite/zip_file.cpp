#include "bench/suite/zip_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <zip.h>

#include <algorithm>
#include <memory>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kName_bytes = 200;
constexpr int kMembersTime = 315532800;  // 1980-01-01, where zip's own times begin

[[noreturn]] void refuse(const fs::path& file, const std::string& member, const std::string& what) {
  const std::string of = member.empty() ? "" : fmt::format(" member '{}':", printable(member));
  throw BadInput("{}:{} {}", file.string(), of, what);
}

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* member) const { zip_fclose(member); }
};

/// Why a name is no plain relative path; "" for one that is.
std::string fault_of_name(const std::string& name) {
  if (name.empty() || name.size() > kName_bytes) return "has no name, or a very long one";
  if (name.front() == '/') return "is an absolute path";
  if (name.find('\\') != name.npos || name.find(':') != name.npos) return "is no plain path";
  if (std::ranges::any_of(name, [](unsigned char c) { return c < 0x20 || c >= 0x7f; })) {
    return "has other characters than ASCII in its name";
  }
  if (name.back() == '/') return "is a folder";
  for (const fs::path& part : fs::path(name)) {
    if (part == "..") return "leads out of its folder";
    if (part == "." || part.empty()) return "is no plain path";
  }
  if (name.find("//") != name.npos) return "is no plain path";
  return "";
}

/// Why the member of that index is none that is read; "" for one that is.
std::string fault_of(zip_t* archive, zip_uint64_t index, const zip_stat_t& about,
                     const ZipLimits& limits) {
  constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE |
                                   ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
  if ((about.valid & kNeeded) != kNeeded) return "is damaged";
  if (about.encryption_method != ZIP_EM_NONE) return "is encrypted";
  if (about.comp_method != ZIP_CM_STORE && about.comp_method != ZIP_CM_DEFLATE) {
    return "is compressed by another method than deflate";
  }
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  zip_file_get_external_attributes(archive, index, 0, &system, &attributes);
  const auto mode = static_cast<mode_t>(attributes >> 16);
  if (system == ZIP_OPSYS_UNIX && (mode & S_IFMT) != 0 && !S_ISREG(mode)) {
    return "is a link, a folder or a device";
  }
  if (about.size > limits.member_bytes) return "is larger than any of a submission";
  constexpr zip_uint64_t kSmall_bytes = 4096;  // many a small text packs well
  if (about.size > kSmall_bytes + limits.ratio * about.comp_size) {
    return "unpacks to so much more than it takes that it is a bomb";
  }
  return "";
}

std::string content_of(zip_t* archive, zip_uint64_t index, const zip_stat_t& about,
                       const fs::path& file) {
  const std::unique_ptr<zip_file_t, Discard> member(zip_fopen_index(archive, index, 0));
  if (!member) refuse(file, about.name, zip_strerror(archive));
  std::string content(about.size + 1, '\0');  // a byte more: its size may be a lie
  const zip_int64_t read = zip_fread(member.get(), content.data(), content.size());
  if (read < 0)
    refuse(file, about.name, fmt::format("is damaged: {}", zip_file_strerror(member.get())));
  if (static_cast<zip_uint64_t>(read) != about.size) {
    refuse(file, about.name, "is of another size than it says");
  }
  char beyond = '\0';  // its checksum is compared where its end is read
  if (zip_fread(member.get(), &beyond, 1) != 0) {
    refuse(file, about.name, fmt::format("is damaged: {}", zip_file_strerror(member.get())));
  }
  content.pop_back();
  return content;
}

}  // namespace

std::map<std::string, std::string> read_zip(const fs::path& file, const ZipLimits& limits) {
  open_file(file);  // throws, with the cause
  int error = 0;
  const std::unique_ptr<zip_t, Discard> archive(
      zip_open(file.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &error));
  if (!archive) {
    zip_error_t why;
    zip_error_init_with_code(&why, error);
    const std::string text = zip_error_strerror(&why);
    zip_error_fini(&why);
    refuse(file, "", fmt::format("is no zip archive, or a damaged one: {}", text));
  }
  const auto count = static_cast<zip_uint64_t>(zip_get_num_entries(archive.get(), 0));
  if (count > limits.members) refuse(file, "", fmt::format("has {} members", count));
  std::map<std::string, std::string> members;
  std::size_t total = 0;
  for (zip_uint64_t i = 0; i < count; ++i) {
    zip_stat_t about;
    if (zip_stat_index(archive.get(), i, ZIP_FL_ENC_RAW, &about) != 0) {
      refuse(file, "", zip_strerror(archive.get()));
    }
    const std::string name = about.name;
    if (const std::string fault = fault_of_name(name); !fault.empty()) refuse(file, name, fault);
    if (members.contains(name)) refuse(file, name, "is there twice");
    if (const std::string fault = fault_of(archive.get(), i, about, limits); !fault.empty()) {
      refuse(file, name, fault);
    }
    total += about.size;
    if (total > limits.total_bytes) refuse(file, "", "unpacks to more than any submission holds");
    members[name] = content_of(archive.get(), i, about, file);
  }
  return members;
}

void write_zip(const fs::path& file, const std::map<std::string, std::string>& members) {
  write_file_atomically(file, [&](const fs::path& part) {
    int error = 0;
    zip_t* const archive = zip_open(part.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
    if (archive == nullptr) refuse_to_write(file, 0);
    bool is_well = true;
    for (const auto& [name, content] : members) {
      zip_source_t* const source = zip_source_buffer(archive, content.data(), content.size(), 0);
      const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
      is_well = is_well && index >= 0;
      if (index < 0) continue;
      const auto at = static_cast<zip_uint64_t>(index);
      zip_set_file_compression(archive, at, ZIP_CM_DEFLATE, 9);
      zip_file_set_mtime(archive, at, kMembersTime, 0);
      zip_file_set_external_attributes(archive, at, 0, ZIP_OPSYS_UNIX,
                                       static_cast<zip_uint32_t>(S_IFREG | 0644) << 16);
    }
    if (!is_well || zip_close(archive) != 0) {
      zip_discard(archive);
      refuse_to_write(file, 0);
    }
  });
}

}  // namespace gnbv

#include "sim/mesh/glb_write.hpp"

namespace gnbv {
namespace {

void append_chunk(std::string& out, std::uint32_t type, std::string_view content, char padding) {
  const std::size_t padded = (content.size() + 3) / 4 * 4;
  append_bytes(out, static_cast<std::uint32_t>(padded));
  append_bytes(out, type);
  out += content;
  out.append(padded - content.size(), padding);
}

}  // namespace

std::string glb_bytes(GlbBuffer::Json json, const GlbBuffer& buffer) {
  // values of the specification
  constexpr std::uint32_t kMagic = 0x46546C67;      // glTF
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // JSON
  constexpr std::uint32_t kBinChunk = 0x004E4942;   // BIN
  json["accessors"] = buffer.accessors;
  json["bufferViews"] = buffer.views;
  json["buffers"] = {{{"byteLength", buffer.bytes.size()}}};
  std::string chunks;
  append_chunk(chunks, kJsonChunk,
               json.dump(-1, ' ', false, GlbBuffer::Json::error_handler_t::replace), ' ');
  append_chunk(chunks, kBinChunk, buffer.bytes, '\0');
  std::string glb;
  append_bytes(glb, kMagic);
  append_bytes(glb, std::uint32_t{2});
  append_bytes(glb, static_cast<std::uint32_t>(12 + chunks.size()));
  return glb + chunks;
}

}  // namespace gnbv

// An XML document as a tree of elements, by libxml2: any encoding, names without their prefixes.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct _xmlNode;
struct _xmlDoc;

namespace gnbv {

/// An element of an XmlTree; of none, all is empty.
class XmlElement {
 public:
  XmlElement() = default;
  explicit XmlElement(const _xmlNode* node) : node_(node) {}

  explicit operator bool() const { return node_ != nullptr; }
  bool operator==(const XmlElement&) const = default;
  std::string_view name() const;
  /// Whether its name is `prefix:name`, declared or not.
  bool has_prefix(std::string_view prefix) const;
  std::optional<std::string> attribute(const char* name) const;
  /// All text within it, without comments.
  std::string text() const;
  std::size_t line() const;
  /// The elements in it, of any name or of one.
  std::vector<XmlElement> children(std::string_view name = "") const;
  /// The first of that name; none without it.
  XmlElement child(std::string_view name) const;
  const _xmlNode* node() const { return node_; }

 private:
  const _xmlNode* node_ = nullptr;
};

class XmlTree {
 public:
  /// Throws BadInput naming the file and the line that is no XML. Bytes and entities that XML does
  /// not know are passed over with a warning.
  XmlTree(const std::filesystem::path& path, std::vector<std::string>& warnings);

  XmlElement root() const;
  /// Calls use(element) for every element.
  void for_each(const std::function<void(XmlElement)>& use) const;

 private:
  std::shared_ptr<_xmlDoc> document_;
};

}  // namespace gnbv

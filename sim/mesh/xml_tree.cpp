#include "sim/mesh/xml_tree.hpp"

#include <libxml/parser.h>
#include <libxml/tree.h>
#include <libxml/xmlerror.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"

namespace gnbv {
namespace {

const char* chars(const xmlChar* text) { return reinterpret_cast<const char*>(text); }

std::string taken(xmlChar* text) {
  std::string out = text != nullptr ? chars(text) : "";
  xmlFree(text);
  return out;
}

/// What exporters get wrong in names and comments, and the shape does without.
bool is_harmless(int code) {
  constexpr int kHarmless[] = {
      XML_ERR_INVALID_CHAR,      XML_ERR_INVALID_ENCODING,    XML_ERR_UNDECLARED_ENTITY,
      XML_WAR_UNDECLARED_ENTITY, XML_ERR_NAME_REQUIRED,       XML_ERR_ENTITYREF_SEMICOL_MISSING,
      XML_ERR_INVALID_CHARREF,   XML_ERR_HYPHEN_IN_COMMENT,   XML_ERR_ATTRIBUTE_REDEFINED,
      XML_ERR_RESERVED_XML_NAME, XML_ERR_UNSUPPORTED_ENCODING};
  return std::find(std::begin(kHarmless), std::end(kHarmless), code) != std::end(kHarmless);
}

struct Faults {
  std::string fatal, harmless;  // the first of each, with its line
};

void note_fault(void* context, xmlErrorPtr error) {
  auto& faults = *static_cast<Faults*>(static_cast<xmlParserCtxtPtr>(context)->_private);
  if (error->level < XML_ERR_ERROR || error->domain == XML_FROM_NAMESPACE) return;
  std::string& first = is_harmless(error->code) ? faults.harmless : faults.fatal;
  if (!first.empty()) return;
  std::string what = error->message != nullptr ? error->message : "no XML";
  what.resize(std::min({what.find('\n'), what.size(), std::size_t{120}}));
  first = fmt::format("{}: {}", std::max(error->line, 1), what);
}

}  // namespace

std::string_view XmlElement::name() const {
  const std::string_view whole = node_ != nullptr ? chars(node_->name) : "";
  return whole.substr(whole.find(':') + 1);  // of a prefix that nobody declared
}

bool XmlElement::has_prefix(std::string_view prefix) const {
  if (node_ == nullptr) return false;
  if (node_->ns == nullptr)
    return std::string(chars(node_->name)).starts_with(fmt::format("{}:", prefix));
  return node_->ns->prefix != nullptr && chars(node_->ns->prefix) == prefix;
}

std::optional<std::string> XmlElement::attribute(const char* name) const {
  xmlChar* const value =
      node_ != nullptr ? xmlGetProp(node_, reinterpret_cast<const xmlChar*>(name)) : nullptr;
  if (value == nullptr) return std::nullopt;
  return taken(value);
}

std::string XmlElement::text() const {
  return node_ != nullptr ? taken(xmlNodeGetContent(node_)) : "";
}

std::size_t XmlElement::line() const {
  return node_ != nullptr ? static_cast<std::size_t>(std::max(xmlGetLineNo(node_), 0L)) : 0;
}

std::vector<XmlElement> XmlElement::children(std::string_view name) const {
  std::vector<XmlElement> out;
  const _xmlNode* at = node_ != nullptr ? node_->children : nullptr;
  for (; at != nullptr; at = at->next) {
    if (at->type != XML_ELEMENT_NODE) continue;
    if (name.empty() || XmlElement(at).name() == name) out.emplace_back(at);
  }
  return out;
}

XmlElement XmlElement::child(std::string_view name) const {
  const std::vector<XmlElement> all = children(name);
  return all.empty() ? XmlElement() : all.front();
}

XmlTree::XmlTree(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  static const bool is_ready = (xmlInitParser(), true);
  static_cast<void>(is_ready);
  std::string text = read_file(path);
  const bool is_wide = is_utf16(text);
  text = as_utf8(std::move(text));
  // entities of a file's own can stand for any amount of text
  if (text.find("<!ENTITY") != text.npos) {
    throw BadInput("{}: declares entities, which are not read", path.string());
  }
  text.erase(0, std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  const std::unique_ptr<xmlParserCtxt, decltype(&xmlFreeParserCtxt)> context(xmlNewParserCtxt(),
                                                                             xmlFreeParserCtxt);
  if (!context) throw std::bad_alloc();
  Faults faults;
  context->_private = &faults;
  context->sax->serror = note_fault;
  const int options = XML_PARSE_NONET | XML_PARSE_RECOVER | XML_PARSE_HUGE | XML_PARSE_BIG_LINES |
                      (is_wide ? XML_PARSE_IGNORE_ENC : 0);
  if (text.size() > 2'000'000'000) throw BadInput("{}: more than 2 GB", path.string());
  document_.reset(xmlCtxtReadMemory(context.get(), text.data(), static_cast<int>(text.size()),
                                    nullptr, nullptr, options),
                  xmlFreeDoc);
  if (!faults.fatal.empty() || !document_ || !root()) {
    throw BadInput("{}:{}", path.string(), faults.fatal.empty() ? " is no XML" : faults.fatal);
  }
  if (!faults.harmless.empty()) {
    warnings.push_back(fmt::format("{}:{}: passed over", path.string(), faults.harmless));
  }
}

XmlElement XmlTree::root() const {
  return XmlElement(document_ ? xmlDocGetRootElement(document_.get()) : nullptr);
}

void XmlTree::for_each(const std::function<void(XmlElement)>& use) const {
  std::vector<XmlElement> open = {root()};
  while (!open.empty()) {
    const XmlElement element = open.back();
    open.pop_back();
    use(element);
    const std::vector<XmlElement> children = element.children();
    open.insert(open.end(), children.rbegin(), children.rend());
  }
}

}  // namespace gnbv

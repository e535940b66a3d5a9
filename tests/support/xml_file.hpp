#pragma once

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace gvd::test {

using Xml = boost::property_tree::ptree;

/// Throws if the text is not well-formed.
inline Xml parse_xml(const std::string& text) {
  std::istringstream in(text);
  Xml tree;
  boost::property_tree::read_xml(in, tree);
  return tree;
}

inline std::vector<unsigned char> decode_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const auto digit = digits.find(c);
    if (digit == std::string::npos) throw std::runtime_error("not base64");
    buffer = buffer << 6 | static_cast<unsigned>(digit);
    if ((bits += 6) >= 8) bytes.push_back(static_cast<unsigned char>(buffer >> (bits -= 8)));
  }
  return bytes;
}

/// The values of the VTK data array of that name below `parent`; its declared type must be that of Number.
template <class Number>
std::vector<Number> data_array(const Xml& parent, const std::string& name) {
  const std::string type = std::is_same_v<Number, double> ? "Float64" : sizeof(Number) == 8 ? "Int64" : "Int32";
  for (const Xml::value_type& entry : parent) {
    const Xml& child = entry.second;
    if (entry.first != "DataArray" || child.get<std::string>("<xmlattr>.Name") != name) continue;
    if (child.get<std::string>("<xmlattr>.type") != type) throw std::runtime_error(name + " is not of type " + type);
    const auto bytes = decode_base64(child.data());
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    if (bytes.size() != sizeof size + size) throw std::runtime_error(name + " has not its declared size");
    std::vector<Number> values(size / sizeof(Number));
    if (size != 0) std::memcpy(values.data(), bytes.data() + sizeof size, size);
    return values;
  }
  throw std::runtime_error("there is no array " + name);
}

}  // namespace gvd::test

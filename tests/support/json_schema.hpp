#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gvd::test {

/// Checks a JSON value against the part of JSON Schema that docs/diagram-schema.json uses: type, enum, const, properties, required,
/// additionalProperties, items, minItems, maxItems, minimum, anyOf, $ref to #/$defs. Returns the first violation, or "".
class SchemaChecker {
 public:
  explicit SchemaChecker(nlohmann::json schema) : schema_(std::move(schema)) {}

  std::string violation(const nlohmann::json& value) const { return check(value, schema_, "$"); }

 private:
  using Json = nlohmann::json;

  static bool has_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "null") return value.is_null();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    return false;
  }

  static bool has_one_type(const Json& value, const Json& types) {
    if (types.is_string()) return has_type(value, types);
    for (const auto& type : types)
      if (has_type(value, type)) return true;
    return false;
  }

  std::string check(const Json& value, const Json& schema, const std::string& path) const {
    if (schema.contains("$ref")) {
      const std::string name = schema["$ref"].get<std::string>().substr(std::string("#/$defs/").size());
      return check(value, schema_.at("$defs").at(name), path);
    }
    if (schema.contains("type") && !has_one_type(value, schema["type"])) return path + ": not of type " + schema["type"].dump();
    if (schema.contains("const") && value != schema["const"]) return path + ": not " + schema["const"].dump();
    if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
      return path + ": not one of " + schema["enum"].dump();
    if (schema.contains("minimum") && value.is_number() && value < schema["minimum"]) return path + ": too small";
    if (schema.contains("anyOf")) {
      bool fits = false;
      for (const auto& option : schema["anyOf"]) fits = fits || check(value, option, path).empty();
      if (!fits) return path + ": fits no option";
    }
    if (value.is_object()) return check_object(value, schema, path);
    if (value.is_array()) return check_array(value, schema, path);
    return "";
  }

  std::string check_object(const Json& value, const Json& schema, const std::string& path) const {
    if (schema.contains("required"))
      for (const auto& key : schema["required"])
        if (!value.contains(key)) return path + ": lacks " + key.get<std::string>();
    for (const auto& [key, member] : value.items()) {
      if (schema.contains("properties") && schema["properties"].contains(key)) {
        if (auto bad = check(member, schema["properties"][key], path + "." + key); !bad.empty()) return bad;
      } else if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object()) {
        if (auto bad = check(member, schema["additionalProperties"], path + "." + key); !bad.empty()) return bad;
      } else if (schema.value("additionalProperties", Json(true)) == false) {
        return path + ": unknown member " + key;
      }
    }
    return "";
  }

  std::string check_array(const Json& value, const Json& schema, const std::string& path) const {
    if (schema.contains("minItems") && value.size() < schema["minItems"]) return path + ": too short";
    if (schema.contains("maxItems") && value.size() > schema["maxItems"]) return path + ": too long";
    if (!schema.contains("items")) return "";
    for (std::size_t i = 0; i < value.size(); ++i)
      if (auto bad = check(value[i], schema["items"], path + "[" + std::to_string(i) + "]"); !bad.empty()) return bad;
    return "";
  }

  nlohmann::json schema_;
};

}  // namespace gvd::test

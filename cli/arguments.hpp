#pragma once

#include <cstdint>
#include <string>

namespace gvd::cli {

/// "4G", "512M", "1.5GiB", "100000": bytes; K, M, G, T are powers of 1024. Throws std::invalid_argument with one sentence.
std::uint64_t parse_bytes(const std::string& text);

/// "30s", "10m", "1.5h", "200ms", "45": seconds. Throws std::invalid_argument with one sentence.
double parse_seconds(const std::string& text);

}  // namespace gvd::cli

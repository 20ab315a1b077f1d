// SHA-256 of bytes: names a problem file in results.
#pragma once

#include <string>
#include <string_view>

namespace mamo::io {

/// 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace mamo::io

// Numbers as short text inside a page.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace mamo::view {

std::string base64(const std::vector<std::uint8_t>& bytes);

/// Rounded to multiples of `unit`, each as the difference from the one before, in bytes of seven bits (a zero is
/// followed by how many more zeros follow): {"n": count, "u": unit, "d": base64}. page/codec.js reads it.
nlohmann::json series(const std::vector<double>& values, double unit);

}  // namespace mamo::view

// What a playback page knows, as JSON for its script (page/main.js says what each key is for).
#pragma once

#include <string>

#include "view/stage.hpp"

namespace mamo::view {

/// One line; safe inside a script element.
std::string page_data(const Stage& stage);

}  // namespace mamo::view

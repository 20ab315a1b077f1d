#include "view/embedded.hpp"
#include "view/page_data.hpp"
#include "view/page_template.hpp"
#include "view/stage.hpp"

#include "mamo/view/playback.hpp"
#include "mamo/view/svg.hpp"

namespace mamo::view {

std::string playback_page(const Playback& playback) {
  const Stage stage(playback);
  std::string script;
  for (const char* name : {"theme.js", "codec.js", "replay.js", "stage.js", "orbit.js", "bodies.js", "contacts.js",
                           "layers.js", "timeline.js", "curves.js", "panel.js", "main.js"})
    script += std::string(embedded(name)) + "\n";
  return filled(embedded("playback.html"), {{"title", escaped(stage.problem().name)},
                                            {"style", page_style() + std::string(embedded("playback.css"))},
                                            {"three", std::string(embedded("three.min.js"))},
                                            {"data", page_data(stage)},
                                            {"script", script}});
}

}  // namespace mamo::view

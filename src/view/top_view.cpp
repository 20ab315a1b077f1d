#include "mamo/view/top_view.hpp"

#include "view/top_scene.hpp"
#include "view/top_view_style.hpp"

namespace mamo::view {

std::string top_view_svg(const Problem& problem, const Plan* plan, const TopViewOptions& options) {
  const TopScene scene(problem, plan, options);
  const std::string width = px(scene.size.x()), height = px(scene.size.y());
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
                    "\" viewBox=\"0 0 " + width + " " + height + "\">\n<style>" + kTopViewStyle + "</style>\n";
  out += "<rect class=\"bg\" width=\"100%\" height=\"100%\"/>\n";
  out += "<clipPath id=\"field\"><rect x=\"" + px(scene.field.min().x()) + "\" y=\"" + px(scene.field.min().y()) +
         "\" width=\"" + px(scene.field.sizes().x()) + "\" height=\"" + px(scene.field.sizes().y()) +
         "\"/></clipPath>\n";
  out += "<g clip-path=\"url(#field)\">\n" + draw_bodies(scene) + draw_labels(scene) + "</g>\n";
  return out + draw_frame(scene) + "</svg>\n";
}

}  // namespace mamo::view

// A picture in software: a shadow map, a picture twice as fine as asked for, lines where bodies meet.
#include <numbers>

#include "view/raster.hpp"
#include "view/surfaces.hpp"

#include "mamo/view/playback.hpp"

namespace mamo::view {
namespace {

constexpr int kFiner = 2;             // samples per pixel and direction
constexpr int kShadowSize = 2048;     // px
constexpr double kShadowBias = 4e-3;  // m
constexpr float kLine = 0.45f;        // how much of the colour is left where bodies meet

const Eigen::Vector3d kSun = Eigen::Vector3d(0.9, 1.1, -2.6).normalized();  // where its light goes

class Image {
 public:
  Image(const Stage& stage, const ImageOptions& options)
      : stage_(stage), options_(options), width_(options.width * kFiner), height_(options.height * kFiner) {
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    sky_ = linear_colour(options.dark ? "#171c22" : "#eef2f6");
    colour_.assign(pixels, sky_);
    depth_.assign(pixels, std::numeric_limits<double>::infinity());
    body_.assign(pixels, 0);
    aim();
  }

  std::string png() {
    const std::vector<Surface> surfaces = surfaces_at(stage_, options_);
    cast_shadows(surfaces);
    for (const Surface& s : surfaces)
      if (s.alpha >= 1) draw(s);
    line_bodies();
    std::vector<const Surface*> glass;
    for (const Surface& s : surfaces)
      if (s.alpha < 1) glass.push_back(&s);
    const auto distance = [&](const Surface* s) { return ((s->p[0] + s->p[1] + s->p[2]) / 3 - eye_).norm(); };
    std::stable_sort(glass.begin(), glass.end(), [&](auto* a, auto* b) { return distance(a) > distance(b); });
    for (const Surface* s : glass) draw(*s);
    return png_bytes(shrunk(), options_.width, options_.height);
  }

 private:
  void aim() {
    const Camera camera = stage_.camera();
    constexpr double kDegree = std::numbers::pi / 180;
    const double yaw = camera.yaw + options_.yaw_deg * kDegree;
    const double pitch = std::clamp(camera.pitch + options_.pitch_deg * kDegree, -1.5, 1.5);
    const double narrow = std::max(1.0, 0.95 * options_.height / options_.width);
    const double distance = camera.distance * narrow / options_.zoom;
    target_ = camera.target;
    eye_ = target_ + distance * Eigen::Vector3d(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                                                std::sin(pitch));
    eye_projection_ = Projection::perspective(eye_, target_, Camera::kFieldOfView, width_, height_);
    sun_projection_ = Projection::parallel(target_, kSun, std::clamp(camera.distance, 1.8, 4.5), kShadowSize);
  }

  void cast_shadows(const std::vector<Surface>& surfaces) {
    shadow_.assign(static_cast<std::size_t>(kShadowSize) * kShadowSize, std::numeric_limits<double>::infinity());
    for (const Surface& s : surfaces) {
      if (s.alpha < 1 || s.finish != Finish::lit) continue;
      rasterise(sun_projection_, s.p, kShadowSize, kShadowSize,
                [&](int x, int y, double depth, const Eigen::Vector3d&) {
                  double& nearest = shadow_[static_cast<std::size_t>(y) * kShadowSize + static_cast<std::size_t>(x)];
                  nearest = std::min(nearest, depth);
                });
    }
  }

  /// Share of the sun that reaches a point: 5 x 5 samples of the shadow map.
  float sunlight(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    const Eigen::Vector4d at = sun_projection_(p + normal * kShadowBias);
    const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
    int lit = 0;
    for (int dx = -2; dx <= 2; ++dx)
      for (int dy = -2; dy <= 2; ++dy) {
        const int u = x + dx, v = y + dy;
        const bool inside = u >= 0 && v >= 0 && u < kShadowSize && v < kShadowSize;
        lit += !inside ||
               at.z() - kShadowBias < shadow_[static_cast<std::size_t>(v) * kShadowSize + static_cast<std::size_t>(u)];
      }
    return static_cast<float>(lit) / 25.0f;
  }

  Eigen::Vector3f shade(const Surface& s, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    if (s.finish == Finish::plain) return s.colour;
    const float sun = static_cast<float>(std::max(0.0, -normal.dot(kSun))) * sunlight(p, normal);
    const float sky = 0.5f + 0.5f * static_cast<float>(normal.z());
    Eigen::Vector3f light = Eigen::Vector3f::Constant(0.62f * sun) + (sky * Eigen::Vector3f(0.52f, 0.53f, 0.55f) +
                                                                      (1 - sky) * Eigen::Vector3f(0.26f, 0.25f, 0.23f));
    Eigen::Vector3f rgb = s.colour.cwiseProduct(light);
    if (s.finish != Finish::floor) return rgb;
    const auto line = [](double v) { return std::abs(v / 0.2 - std::round(v / 0.2)) * 0.2 < 0.0018; };
    if (line(p.x()) || line(p.y())) rgb *= 0.88f;
    const double away = (p - target_).head<2>().norm();
    const float fade = static_cast<float>(std::clamp((away - 1.2) / 1.8, 0.0, 1.0));
    return rgb + fade * (sky_ - rgb);
  }

  void draw(const Surface& s) {
    Eigen::Vector3d normal = (s.p[1] - s.p[0]).cross(s.p[2] - s.p[0]);
    if (normal.norm() < 1e-14) return;
    normal.normalize();
    if (normal.dot(eye_ - s.p[0]) < 0) normal = -normal;  // visual meshes are not all closed
    rasterise(eye_projection_, s.p, width_, height_, [&](int x, int y, double depth, const Eigen::Vector3d& weights) {
      const std::size_t at = index(x, y);
      if (depth >= depth_[at]) return;
      const Eigen::Vector3d p = s.p[0] * weights[0] + s.p[1] * weights[1] + s.p[2] * weights[2];
      const Eigen::Vector3f rgb = shade(s, p, normal);
      if (s.alpha < 1) {
        colour_[at] += s.alpha * (rgb - colour_[at]);
        return;
      }
      colour_[at] = rgb;
      depth_[at] = depth;
      body_[at] = s.body;
    });
  }

  void line_bodies() {
    std::vector<std::size_t> lines;
    for (int y = 0; y + 1 < height_; ++y)
      for (int x = 0; x + 1 < width_; ++x)
        if (body_[index(x, y)] != body_[index(x + 1, y)] || body_[index(x, y)] != body_[index(x, y + 1)])
          lines.push_back(index(x, y));
    for (std::size_t at : lines) colour_[at] *= kLine;
  }

  std::vector<std::uint8_t> shrunk() const {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(static_cast<std::size_t>(options_.width) * static_cast<std::size_t>(options_.height) * 3);
    for (int y = 0; y < options_.height; ++y)
      for (int x = 0; x < options_.width; ++x) {
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        for (int dy = 0; dy < kFiner; ++dy)
          for (int dx = 0; dx < kFiner; ++dx) sum += colour_[index(x * kFiner + dx, y * kFiner + dy)];
        sum /= kFiner * kFiner;
        for (float v : sum)
          rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * std::pow(std::clamp(v, 0.0f, 1.0f), 1 / 2.2f))));
      }
    return rgb;
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  const Stage& stage_;
  const ImageOptions& options_;
  int width_, height_;
  Eigen::Vector3f sky_;
  Eigen::Vector3d eye_, target_;
  Projection eye_projection_, sun_projection_;
  std::vector<Eigen::Vector3f> colour_;  // linear
  std::vector<double> depth_, shadow_;
  std::vector<int> body_;
};

}  // namespace

Result<std::string> playback_image(const Playback& playback, const ImageOptions& options) {
  const Stage stage(playback);
  std::string bytes = Image(stage, options).png();
  if (bytes.empty()) return Error{"the PNG library refused the picture", ErrorKind::internal};
  return bytes;
}

}  // namespace mamo::view

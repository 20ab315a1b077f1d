// A plan out of JSON: a result object or its bare plan. What is wrong with its motion is for `verify` to say; here
// only what cannot be held in a Plan is refused.
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

#include "io/recognise.hpp"
#include "io/text.hpp"

#include "mamo/io/load.hpp"
#include "mamo/common/nearest_name.hpp"

namespace mamo::io {
namespace {

using Json = nlohmann::json;

/// The first thing wrong; the readers return harmless values after it.
class PlanReader {
 public:
  PlanReader(const std::string& path, const Scene& scene) : path_(path), scene_(scene) {}

  Result<Plan> read(const Json& root) {
    Plan plan;
    const Json* segments = find_segments(root);
    for (std::size_t i = 0; segments && i < segments->size() && !error_; ++i) {
      where_ = "segment " + std::to_string(i);
      plan.segments.push_back(read_segment((*segments)[i]));
    }
    if (error_) return *error_;
    return plan;
  }

 private:
  void fail(const std::string& message) {
    if (!error_) error_ = Error{one_line(path_) + ": " + (where_.empty() ? "" : where_ + ": ") + message};
  }

  const Json* find_segments(const Json& root) {
    if (!root.is_object()) return fail("a plan is an object with 'segments'"), nullptr;
    const Json* plan = &root;
    if (root.contains("schema") || root.contains("plan")) {
      const Json& schema = root.value("schema", Json());
      if (schema.is_string() && schema != "mamo-result/1")
        return fail("schema is " + in_quotes(schema.get<std::string>()) + ", expected mamo-result/1"), nullptr;
      if (!root.contains("plan")) return fail("the result holds no 'plan'"), nullptr;
      plan = &root["plan"];
    }
    const bool good = plan->is_object() && plan->contains("segments") && (*plan)["segments"].is_array();
    if (!good) return fail("a plan is an object with a list 'segments'"), nullptr;
    const Json& segments = (*plan)["segments"];
    const Json status = root.value("status", Json());
    if (segments.empty() && status.is_string() && status != "solved")
      return fail("the result holds no plan (its status is " + in_quotes(status.get<std::string>()) + ")"), nullptr;
    return &segments;
  }

  const Json& need(const Json& object, const char* key) {
    static const Json kNothing;
    if (object.is_object() && object.contains(key)) return object[key];
    fail(std::string("misses the key '") + key + "'");
    return kNothing;
  }

  double number(const Json& value, const std::string& what) {
    if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
    fail(what + " is " + in_quotes(value.dump(-1, ' ', true, Json::error_handler_t::replace)) + ", expected a number");
    return 0;
  }

  ObjectId object(const std::string& name) {
    const ObjectId id = scene_.find(name);
    if (id.valid()) return id;
    std::vector<std::string> known;
    for (const Object& o : scene_.objects) known.push_back(o.id);
    fail("the problem has no object " + in_quotes(name) +
         (known.empty() ? "" : ", the nearest is " + in_quotes(nearest_name(name, known))));
    return kNoObject;
  }

  Segment read_segment(const Json& json) {
    Segment segment;
    if (!json.is_object()) return fail("is not an object"), segment;
    segment.kind = read_kind(need(json, "kind"));
    if (const Json name = json.value("object", Json()); name.is_string())
      segment.object = object(name.get<std::string>());
    else if (!name.is_null())
      fail("object must be the id of an object or null");
    const Json& names = need(json, "joint_names");
    if (!names.is_array()) return fail("joint_names must be a list"), segment;
    for (const Json& name : names) {
      if (!name.is_string()) return fail("joint_names must be a list of names"), segment;
      segment.joint_names.push_back(name.get<std::string>());
    }
    read_points(need(json, "points"), segment);
    read_poses(need(json, "objects_after"), segment);
    return segment;
  }

  SegmentKind read_kind(const Json& value) {
    for (SegmentKind kind : {SegmentKind::approach, SegmentKind::push, SegmentKind::retreat, SegmentKind::reach,
                             SegmentKind::grasp, SegmentKind::extract})
      if (value.is_string() && value.get<std::string>() == to_string(kind)) return kind;
    fail("kind must be one of approach, push, retreat, reach, grasp, extract");
    return SegmentKind::reach;
  }

  void read_points(const Json& points, Segment& segment) {
    if (!points.is_array()) return fail("points must be a list");
    for (std::size_t k = 0; k < points.size() && !error_; ++k) {
      const std::string point = "point " + std::to_string(k);
      segment.motion.t.push_back(number(need(points[k], "t"), "t of " + point));
      const Json& q = need(points[k], "q");
      if (!q.is_array() || q.size() != segment.joint_names.size())
        return fail("q of " + point + " must have one number per joint name (" +
                    std::to_string(segment.joint_names.size()) + ")");
      Eigen::VectorXd values(static_cast<Eigen::Index>(q.size()));
      for (std::size_t i = 0; i < q.size(); ++i)
        values[static_cast<Eigen::Index>(i)] = number(q[i], "q[" + std::to_string(i) + "] of " + point);
      segment.motion.q.push_back(values);
    }
  }

  void read_poses(const Json& poses, Segment& segment) {
    if (!poses.is_object()) return fail("objects_after must be an object");
    for (const auto& [name, pose] : poses.items()) {
      const ObjectId id = object(name);
      if (!pose.is_array() || pose.size() != 7)
        return fail("objects_after of " + in_quotes(name) + " must have 7 numbers (x y z qx qy qz qw)");
      std::array<double, 7> v{};
      for (std::size_t i = 0; i < 7; ++i) v[i] = number(pose[i], "objects_after of " + in_quotes(name));
      const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
      if (error_) return;
      if (!(q.norm() > 1e-3 && q.norm() < 1e3))
        return fail("the quaternion of " + in_quotes(name) + " in objects_after cannot be normalised");
      Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
      X.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
      X.linear() = q.normalized().toRotationMatrix();
      segment.objects_after[id] = X;
    }
  }

  const std::string& path_;
  const Scene& scene_;
  std::string where_;
  std::optional<Error> error_;
};

/// 1-based line and column of a byte.
std::pair<int, int> place_of(const std::string& text, std::size_t byte) {
  int line = 1, column = 1;
  for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
    ++column;
    if (text[i] == '\n') ++line, column = 1;
  }
  return {line, column};
}

}  // namespace

Result<Plan> load_plan(const std::string& path, const Problem& problem) {
  Result<std::string> text = read_file(path, 256u << 20);
  if (!text) return text.error();
  if (Status s = check_is_text(*text, path); !s) return s.error();
  try {
    return PlanReader(path, problem.scene).read(Json::parse(*text));
  } catch (const Json::parse_error& e) {
    const auto [line, column] = place_of(*text, e.byte);
    const bool truncated = e.byte > text->size();
    return error_at(path, line, column,
                    truncated ? "bad JSON: the file ends too early" : "bad JSON, a plan was expected");
  } catch (const Json::exception& e) {
    return error_at(path, 0, 0, "bad JSON: " + one_line(e.what()));
  }
}

}  // namespace mamo::io
